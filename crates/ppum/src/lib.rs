//! Particle-partition of unity fields, evaluated exactly.
pub mod crack;
pub mod dataset;
pub mod formula;
pub mod function;
pub mod vec2;
pub mod weight;
