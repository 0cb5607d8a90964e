//! The conformance corpus of formulas: `tests/corpus` at the repository's root, whose `README.md`
//! says what a record means and where its numbers come from.
//!
//! [`cases()`] reads it, a [`FormulaBackend`] evaluates a case, [`check`] compares and counts.

mod backend;
mod cases;
pub mod hostile;
mod record;
mod report;
mod tolerance;

pub use backend::{
    CaseOutcome, DerivativeFormulas, FormulaBackend, LaneBlocks, ScalarJets, jets, orders, parse,
};
pub use cases::{Bound, FormulaCase, THEMES, cases, folder, tables};
pub use report::{CorpusReport, check};
pub use tolerance::{LANES, LANES_SINGLE, SCALAR, SHADER, Tolerance};
