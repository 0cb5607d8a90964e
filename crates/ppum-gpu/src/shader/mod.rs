//! The texts of shaders: small files of WGSL, and what is written for a field and a quantity.
//!
//! ```text
//! wgsl/*.wgsl                                  the same for all fields
//! weight, functions, quantity, smooth          for one field and quantity
//! compose                                      all of them with constants, records and bindings
//! ```

pub(crate) mod compose;
pub(crate) mod functions;
pub(crate) mod passes;
pub(crate) mod quantity;
pub(crate) mod smooth;
pub(crate) mod texts;
pub(crate) mod weight;
