//! The facts of a dataset, made once: the commands print them as text and JSON, Python has them as
//! objects, the window as tables.
//!
//! Each is a plain value in the shape of its JSON, which docs/cli.md documents.

mod about;
mod growth;
mod number;
mod reactions;
mod results;
mod solver;
mod tips;

pub use about::{About, Crack};
pub use growth::{Growth, increment};
pub use number::Number;
pub use reactions::{Reaction, reaction_lines, reactions};
pub use results::{Record, Results, Warning, warnings};
pub use solver::Solver;
pub use tips::{HEADS, MEANING, Tip, all_tips};
