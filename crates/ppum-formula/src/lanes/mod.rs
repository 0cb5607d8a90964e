//! Vectors of the processor: the numbers of kernels, and the interpreter of formulas on them.
//!
//! The three need each other: what a number can do is known to the interpreter, and a number knows how a
//! tape is run on it, so that the interpreter is compiled here and not in every crate that uses it.

mod interpret;
pub mod real;
mod tape;

pub(crate) use interpret::VECTORS;
pub(crate) use tape::Tape;
