//! Particle-partition of unity fields, evaluated exactly.
pub mod box_tree;
pub mod check;
pub mod crack;
pub mod dataset;
pub mod function;
pub mod jet;
mod morton;
pub mod polynomial;
pub mod real;
pub mod vec2;
pub mod weight;
