//! Datasets as files: round trips, damage, and what FORMAT.md says.

#[path = "../damage/mod.rs"]
mod damage;
mod evaluation;
mod files;
mod links;
mod page;
mod series;
