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
mod contact;
mod dual;
mod functions;
mod gauge;
mod given;
mod loads;
mod point;
mod reaction;
mod spring;
mod stiffness;
mod system;
mod template;

pub use cell::Functionals;
pub use contact::{CellErrors, FaceContacts, FaceState, RowFactors};
pub use dual::{Duals, FACTORS, Kernel, LinearFunctional};
pub use functions::Assembly;
pub use gauge::{FreeModes, Gauge};
pub use given::Given;
pub(crate) use loads::border_rules;
pub use point::values_at;
pub use system::{System, pattern, slivers};
