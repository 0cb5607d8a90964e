//! The solver against exact solutions and independent reference values.

mod examples;
mod formulas;
mod kernels;
mod physics;
mod pieces;
mod plates;
mod problem_files;
#[path = "../studies/mod.rs"]
mod studies;
