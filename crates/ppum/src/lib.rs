//! Particle-partition of unity fields, evaluated exactly.
pub mod crack;
pub mod dataset;
pub mod function;
pub mod jet;
pub mod polynomial;
pub mod real;
pub mod vec2;
pub mod weight;
