//! The contribution of one cell to the right-hand sides.

use super::functions::CellFunctions;
use super::reaction::CellReaction;
use crate::basis::StableBasis;
use faer::MatRef;

/// The contribution of one cell beside its stiffness. Unknown (function a, component i) is row a ·
/// components + i.
#[derive(Clone, Debug)]
pub(crate) struct CellSystem {
    /// The functions that live in the cell.
    pub(crate) functions: CellFunctions,
    /// Right-hand side.
    pub(crate) load: Vec<f64>,
    /// ∫ N·m of each free mode m.
    pub(crate) moments: Vec<Vec<f64>>,
    /// ∫ u_s·m of each free mode m, of the known part of the field.
    pub(crate) known: Vec<f64>,
    /// K(N) of both modes, if the cell is in a disc of a tip.
    pub(crate) duals: Vec<Vec<f64>>,
    /// Nitsche's β over λ + 2μ or the conductivity [1/L]; zero where no values are given.
    pub(crate) penalty: f64,
    /// Forces of the restraints in the cell, one entry per condition that gives values.
    pub(crate) reactions: Vec<CellReaction>,
}

impl CellSystem {
    /// Adds the functionals of a system of the same cell over the functions that are evaluated: of
    /// N = T ψ they are T times those of ψ.
    pub(super) fn add_functionals(&mut self, plain: &Self, basis: &StableBasis, components: usize) {
        let all = plain.moments.iter().chain(&plain.duals);
        for (sum, part) in self.moments.iter_mut().chain(&mut self.duals).zip(all) {
            for (k, &patch) in self.functions.patches.iter().enumerate() {
                let (t, first) = (basis.transform(patch), plain.functions.first[k] * components);
                let part = &part[first..first + t.ncols() * components];
                let own = t * MatRef::from_row_major_slice(part, t.ncols(), components);
                let sum = sum[self.functions.first[k] * components..].chunks_exact_mut(components);
                for (sum, own) in sum.zip(own.row_iter()) {
                    sum.iter_mut().zip(own.iter()).for_each(|(sum, own)| *sum += own);
                }
            }
        }
    }
}
