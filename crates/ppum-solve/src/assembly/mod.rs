//! The system K u = f of a problem in the stable basis, cell by cell.
//!
//! ```text
//! K = ∫ ∇N·C·∇N + Nitsche's terms        f = ∫ N·b + ∫_Γt N·t + Nitsche's terms
//! ```
//!
//! [`Given`] says what acts on a cell and on its border, `CellAssembler` integrates it into a
//! `CellSystem`, [`System`] adds these up. [`Gauge`] makes solutions unique on pieces of the plate
//! that nothing holds.

mod border;
mod cell;
mod cell_matrix;
mod cell_system;
mod dual;
mod functions;
mod gauge;
mod given;
mod loads;
mod reaction;
mod stiffness;
mod system;
mod template;

pub(crate) use cell::Functionals;
pub(crate) use dual::Duals;
pub(crate) use gauge::{FreeModes, Gauge};
pub(crate) use given::Given;
pub(crate) use loads::border_rules;
pub(crate) use system::{System, pattern, slivers};

use crate::basis::StableBasis;
use crate::law::Law;
use crate::problem::Problem;
use crate::space::Space;

/// A system that is to be assembled: the problem, the functions, and the law of its equation.
#[derive(Clone, Copy)]
pub(crate) struct Assembly<'a> {
    pub(crate) problem: &'a Problem,
    pub(crate) space: &'a Space<'a>,
    pub(crate) basis: &'a StableBasis,
    pub(crate) law: &'a Law<'a>,
}

impl Assembly<'_> {
    /// Components of the unknown field.
    pub(crate) fn components(&self) -> usize {
        self.law.components
    }

    /// Number of cells.
    pub(crate) fn n_cells(&self) -> usize {
        self.space.partition().len()
    }
}
