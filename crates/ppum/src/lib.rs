//! Particle-partition of unity fields, evaluated exactly.
pub mod box_tree;
pub mod crack;
pub mod dataset;
pub mod function;
mod morton;
pub mod vec2;
pub mod weight;
