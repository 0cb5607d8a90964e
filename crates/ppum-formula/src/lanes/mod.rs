//! Formulas on vectors of the processor: tapes and their interpreter.

mod interpret;
mod tape;

#[cfg(test)]
pub(crate) use interpret::{GREATEST_SQUARE, LEAST_SQUARE};
pub(crate) use interpret::{Tape, VECTORS, interpret};
