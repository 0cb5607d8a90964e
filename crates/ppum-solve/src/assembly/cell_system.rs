//! The contribution of one cell to the right-hand sides.

use super::functions::CellFunctions;
use super::reaction::CellReaction;

/// The contribution of one cell beside its stiffness. Unknown (function a, component i) is row a · components + i.
#[derive(Clone, Debug)]
pub(crate) struct CellSystem {
    /// The functions that live in the cell.
    pub(crate) functions: CellFunctions,
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
