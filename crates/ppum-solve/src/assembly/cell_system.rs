//! The contribution of one cell to the system.

use super::functions::CellFunctions;
use super::reaction::CellReaction;
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
    /// Nitsche's β over λ + 2μ or the conductivity [1/L]; zero where no values are given.
    pub(crate) penalty: f64,
    /// Forces of the restraints in the cell, one entry per condition that gives values.
    pub(crate) reactions: Vec<CellReaction>,
}

impl CellSystem {
    /// The stiffness between the unknowns of patches `k` and `l`, in the order of the system.
    pub(crate) fn block(&self, k: usize, l: usize, components: usize) -> Mat<f64> {
        let rows = self.functions.unknowns(k, components);
        let columns = self.functions.unknowns(l, components);
        Mat::from_fn(rows.len(), columns.len(), |a, b| self.matrix[(rows[a], columns[b])])
    }
}
