//! Equilibrium of the pieces that cracks and holes cut a body into: their rigid-body modes, what
//! holds them and what loads them.

mod balance;
mod body;
mod pieces;
mod supports;
#[cfg(test)]
mod tests;
mod touching;

pub(crate) use balance::Balance;
pub use balance::UnbalancedError;
pub use body::{BodyEquilibrium, EquilibriumError};
pub use pieces::BodyPieces;
pub(crate) use pieces::{SegmentMesh, crossing};
pub(crate) use supports::PieceConditions;
pub use supports::SupportError;
pub(crate) use touching::RigidMotion;
