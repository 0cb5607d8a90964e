//! Exact solutions: as Rust functions, and as formula text for problem files.
//!
//! Both forms of a field are written separately — the functions in complex numbers, the text in
//! real ones — so that each checks the other. The texts are formulas of x and y in the syntax of
//! `ppum::formula`; what they bind with `let` is named `dx`, `px`, … and never `r` or `theta`.

mod arc_crack;
mod collinear;
mod field;
mod in_plane;
mod round_hole;
mod slit;
mod smooth;
#[cfg(test)]
mod tests;
mod williams;

pub use arc_crack::ArcCrack;
pub use collinear::CollinearCracks;
pub use field::{Component, ElasticField, ExactField, stress};
pub use in_plane::CrackInPlane;
pub use round_hole::RoundHole;
pub use slit::Slit;
pub use smooth::Smooth;
pub use williams::Williams;
