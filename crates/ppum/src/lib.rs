//! Particle-partition of unity fields, evaluated exactly.
pub mod box_tree;
pub mod cover;
pub mod crack;
pub mod dataset;
pub mod field;
pub mod formula;
pub mod function;
pub mod jet;
mod morton;
pub mod polynomial;
pub mod quantity;
#[cfg(test)]
mod random;
pub mod real;
pub mod vec2;
pub mod weight;
