//! Particle-partition of unity fields, evaluated exactly.
pub mod check;
pub mod box_tree;
pub mod crack;
pub mod dataset;
pub mod function;
pub mod jet;
pub mod polynomial;
pub mod real;
mod morton;
pub mod vec2;
pub mod weight;
