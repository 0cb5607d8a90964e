//! The constitutive law: what stress a strain has.
//!
//! Whoever needs a stress asks [`Law`], elasticity and Poisson alike. Temperatures and given
//! strains are known here alone: they make the stress an affine function of the strain, which is
//! not zero where the body does not deform (`Law::initial_stress`). [`Strain`] and the shape
//! functions of a space alone know the numbers that a strain is made of.

mod heat;
mod slope;
mod strain;
mod stress;

pub(crate) use heat::joined;
pub use heat::{FaceLocation, Temperature};
pub use slope::EnergySlope;
pub(crate) use strain::{HOOP, MODES, OPERATORS, PerMode, RigidModes, hoop, operators};
pub use strain::{Strain, Stress};
pub use stress::{Coefficients, Law, LawAt};
