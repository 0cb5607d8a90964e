//! The system K u = f of a problem in the stable basis, cell by cell.
//!
//! ```text
//! K = ∫ ∇N·C·∇N + Nitsche's terms        f = ∫ N·b + ∫_Γt N·t + Nitsche's terms
//! ```

mod border;
mod cell;
mod cell_system;
mod functions;
mod gauge;
mod given;
mod loads;
mod reaction;
mod system;

pub(crate) use gauge::Gauge;
pub(crate) use given::Given;
pub(crate) use system::{System, Unresolved, assemble, pattern, slivers};
