//! Interfaces: lines and curves across which constants of the material, or given strains, jump.
//!
//! Displacements are continuous there; their gradients are not, so that tractions are. If ψ is a
//! smooth function that vanishes on the interface and whose gradient does not, such a field is
//!
//! ```text
//! u = v + |ψ| w        v, w smooth
//! ```
//!
//! so |ψ| times polynomials of degree p − 1, beside polynomials of degree p, has the full order. ψ
//! is what the material's formula shows: the argument of its `sign`, of the inequality of its `if`.
//! Whether the constants really jump is seen by looking at both sides.

mod interface;
mod point;
mod unresolved;

pub use interface::Interfaces;
pub(crate) use interface::{Interface, proportional};
pub(crate) use point::{BESIDE, InterfacePoint};
pub use unresolved::{UnresolvedCause, UnresolvedInterface};

#[cfg(test)]
mod tests;
