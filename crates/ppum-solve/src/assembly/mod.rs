//! The system K u = f of a problem in the stable basis, cell by cell.
//!
//! ```text
//! K = ∫ ∇N·C·∇N + Nitsche's terms        f = ∫ N·b + ∫_Γt N·t + Nitsche's terms
//! ```
//!
//! [`PrescribedData`] says what acts on a cell and on its boundary, `CellAssembler` integrates it
//! into a `CellSystem`, [`System`] adds these up. [`NullSpaceConstraint`] makes solutions unique on
//! pieces of the body that nothing holds.

mod border;
mod cell;
mod cell_matrix;
mod cell_system;
mod contact;
mod dual;
mod functions;
mod given;
mod loads;
mod null_space;
mod point;
mod reaction;
mod spring;
mod stiffness;
mod system;
mod template;

pub use cell::Functionals;
pub use contact::{CellErrors, FaceContacts, FaceState, RowFactors};
pub use dual::{Duals, FACTORS, LinearFunctional, ModeKernel};
pub use functions::Assembly;
pub use given::PrescribedData;
pub(crate) use loads::border_rules;
pub use null_space::{FreeModes, NullSpaceConstraint};
pub use point::values_at;
pub use system::{System, pattern, slivers};
