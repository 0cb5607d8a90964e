//! Datasets as files: round trips, damage, and what FORMAT.md says.

mod evaluation;
mod files;
mod links;
mod page;
mod series;
