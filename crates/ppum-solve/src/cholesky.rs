//! temporary
#![allow(missing_docs)]
use crate::block_matrix::BlockMatrix;
use faer::linalg::solvers::Solve;
use ppum::vec2::Vec2;
#[derive(Debug, thiserror::Error)]
#[error("not positive definite")]
pub struct CholeskyError;
pub struct Cholesky {
    llt: faer::sparse::linalg::solvers::Llt<u32, f64>,
}
impl Cholesky {
    pub fn new(m: &BlockMatrix, _centers: &[Vec2]) -> Result<Self, CholeskyError> {
        let a = m.lower_triangle();
        Ok(Self { llt: a.as_ref().sp_cholesky(faer::Side::Lower).map_err(|_| CholeskyError)? })
    }
    pub fn solve(&self, f: &[f64]) -> Vec<f64> {
        let b = faer::Mat::from_fn(f.len(), 1, |i, _| f[i]);
        let x = self.llt.solve(&b);
        (0..f.len()).map(|i| x[(i, 0)]).collect()
    }
}
