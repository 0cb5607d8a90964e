//! Solves two-dimensional problems of elasticity and Poisson's equation with cracks by the
//! particle-partition of unity method.

mod basis;
mod batch;
mod block_matrix;
mod border;
mod cell;
mod cholesky;
mod eigen;
mod enrichment;
mod gauge;
pub mod intensity;
pub mod law;
pub mod norms;
mod pencil;
pub mod problem;
pub mod quadrature;
#[cfg(test)]
mod random;
mod refine;
mod rigid;
pub mod shape;
pub mod solve;
pub mod space;
mod system;
mod transform;
