//! The solver against exact solutions and independent reference values.

mod adaptive;
mod awkward;
mod corners;
mod estimate;
mod estimator;
mod examples;
mod faces;
mod formulas;
mod goal;
mod graded;
mod holes;
mod incompressible;
mod intensity;
mod interfaces;
mod junctions;
mod kernels;
mod kinked;
mod loads;
mod physics;
mod pieces;
mod plates;
mod positions;
mod problem_files;
mod random;
mod reactions;
mod refined;
mod rims;
mod rooms;
mod slivers;
#[path = "../studies/mod.rs"]
mod studies;
mod tip_terms;
mod warnings;
mod watched;
mod weights;
mod williams;
