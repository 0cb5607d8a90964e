//! The contribution of one cell to the system.

use super::Assembly;
use super::functions::CellFunctions;
use super::reaction::CellReaction;
use crate::linear::{product, taken};
use faer::Mat;

/// The contribution of one cell. Unknown (function a, component i) is row a · components + i.
#[derive(Clone, Debug)]
pub(crate) struct CellSystem {
    /// The functions that live in the cell.
    pub(crate) functions: CellFunctions,
    /// Stiffness, square, all of it.
    pub(crate) matrix: Mat<f64>,
    /// Right-hand side.
    pub(crate) load: Vec<f64>,
    /// ∫ N·m of each free mode m.
    pub(crate) moments: Vec<Vec<f64>>,
    /// K(N) of both modes, if the cell is in a disc of a tip.
    pub(crate) duals: Vec<Vec<f64>>,
    /// Nitsche's β over λ + 2μ or the conductivity [1/L]; zero where no values are given.
    pub(crate) penalty: f64,
    /// Forces of the restraints in the cell, one entry per condition that gives values.
    pub(crate) reactions: Vec<CellReaction>,
}

impl CellSystem {
    /// The stiffness between the unknowns of all pairs of patches, in the order of the system: of patch 0 and all from 0 on, of
    /// patch 1 and all from 1 on, …
    pub(crate) fn blocks(&self, assembly: &Assembly<'_>) -> Vec<Mat<f64>> {
        let n = self.functions.patches.len();
        let pairs = (0..n).flat_map(|k| (k..n).map(move |l| (k, l)));
        pairs.map(|(k, l)| self.block(assembly, k, l)).collect()
    }

    fn block(&self, assembly: &Assembly<'_>, k: usize, l: usize) -> Mat<f64> {
        let [rows, columns] = [k, l].map(|k| self.functions.free(k, assembly.components()));
        let free = taken(&self.matrix, &rows, &columns);
        let [left, right] = [k, l].map(|k| assembly.basis.tie(self.functions.patches[k]));
        let half = left.map(|tie| product(tie.as_ref(), free.as_ref())).unwrap_or(free);
        right.map(|tie| product(half.as_ref(), tie.transpose())).unwrap_or(half)
    }
}
