//! ppum-solve
pub mod block_matrix;
pub mod eigen;
pub mod pencil;
#[cfg(test)]
pub(crate) mod random;
pub mod transform;
