//! Particle-partition of unity fields, evaluated exactly.
pub mod check;
pub mod crack;
pub mod dataset;
pub mod function;
pub mod vec2;
pub mod weight;
