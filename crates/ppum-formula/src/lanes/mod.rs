//! Formulas on vectors of the processor: tapes and their interpreter.

mod interpret;
mod tape;

pub(crate) use interpret::{VECTORS, interpret};
pub(crate) use tape::Tape;
