//! The system K u = f of a problem in the stable basis, cell by cell.
//!
//! ```text
//! K = ∫ ∇N·C·∇N + Nitsche's terms        f = ∫ N·b + ∫_Γt N·t + Nitsche's terms
//! ```
//!
//! [`PrescribedData`] says what acts on a cell and on its boundary, `CellAssembler` integrates it
//! into a `CellSystem`, [`System`] adds these up. [`NullSpaceConstraint`] makes solutions unique on
//! pieces of the body that nothing holds.

mod boundary;
mod cell;
mod cell_matrix;
mod cell_system;
mod contact;
mod dual;
mod functions;
mod loads;
mod null_space;
mod point;
mod prescribed;
mod reaction;
mod spring;
mod stiffness;
mod system;
mod template;
mod work;

pub use cell::Functionals;
pub use contact::{CellErrors, FaceContacts, FaceState, RowFactors};
pub use dual::{DualLoads, FACTORS, LinearFunctional};
pub use functions::Assembly;
pub(crate) use loads::boundary_rules;
pub use null_space::{FreeModes, NullSpaceConstraint};
pub use point::values_at;
pub use prescribed::PrescribedData;
pub use system::{System, pattern, slivers};
pub use work::{Influence, PENALTY, WorkOnField};
