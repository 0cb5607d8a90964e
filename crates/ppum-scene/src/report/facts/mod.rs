//! The facts of a dataset, made once: the commands print them as text and JSON, Python has them as
//! objects, the window as tables.
//!
//! Each is a plain value in the shape of its JSON, which docs/commands documents.

mod about;
mod number;
mod reactions;
mod results;
mod solver;
mod tips;

pub use about::{CommonFacts, CrackFacts};
pub use number::JsonNumber;
pub use reactions::{ReactionFacts, reaction_lines, reactions};
pub use results::{GrowthFacts, RecordFacts, ResultFacts, WarningFacts, increment, warnings};
pub use solver::SolverFacts;
pub use tips::{HEADS, MEANING, Tip, all_tips};
