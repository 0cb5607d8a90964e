//! Modules of WGSL, checked as a driver would, and functions of them executed: what shaders
//! compute, without a graphics card.
//!
//! naga parses and validates. The interpreter here walks its representation with the operations
//! that formulas and fields need: numbers and conditions, vectors, arrays and structures of them,
//! variables, branches, loops and calls. It computes as IEEE 754 says in single precision, other
//! functions than √ and ⌊⌋ in double precision and rounded. Where WGSL leaves a result open, it is
//! NaN, so that nobody can rely on it.

mod backend;
mod elementary;
mod interpreter;
mod module;
mod value;

pub use backend::{Shader, tells_wrong_derivative, with_wrong_derivative};
pub use elementary::{ELEMENTARY, Elementary};
pub use module::Module;
