//! The conformance corpus of formulas: `tests/corpus` at the repository's root, whose `README.md`
//! says what a record means and where its numbers come from.
//!
//! [`cases()`] reads it, [`check`] compares what an evaluator says of them, and counts.

mod backend;
mod cases;
pub mod hostile;
mod record;
mod report;
mod tolerance;

pub use backend::{CaseResult, derivative_formulas, jets, lane_blocks, orders, parse, scalar_jets};
pub use cases::{Bound, FormulaCase, THEMES, cases, folder, tables};
pub use report::{CorpusReport, check};
pub use tolerance::{LANES, LANES_SINGLE, SCALAR, SHADER, Tolerance};
