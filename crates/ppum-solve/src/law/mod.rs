//! The constitutive law: what stress a gradient has.
//!
//! Whoever needs a stress asks [`Law`], elasticity and Poisson alike. Temperatures and given
//! strains are known here alone: they make the stress an affine function of the gradient, which is
//! not zero where the body does not deform (`Law::initial_stress`).

mod heat;
mod slope;
mod stress;

pub(crate) use heat::joined;
pub use heat::{FaceLocation, Temperature};
pub use slope::EnergySlope;
pub(crate) use stress::Rigidity;
pub use stress::{Coefficients, Law, LawAt};
