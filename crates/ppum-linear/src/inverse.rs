//! Inverses of diagonal blocks, which may be nearly singular.

use super::eigen::{SymmetricEigen, inverse_root_diagonal, scaled};
use faer::linalg::solvers::DenseSolveCore;
use faer::{Mat, MatRef, Side};

/// Eigenvalues of a diagonal block, scaled to ones on its diagonal, up to this one belong to
/// functions that depend on others, or to motions without energy: they are left alone. The pivots
/// that the stable basis keeps are far above.
const DEPENDENT: f64 = 1e-11;

/// The inverse of a part of the matrix, row-major; of one that is nearly singular
/// the pseudo-inverse.
pub(super) fn inverse(block: MatRef<'_, f64>) -> Vec<f64> {
    let scale = inverse_root_diagonal(block, 0.0);
    let scaled = scaled(block, &scale);
    let inverse = well_conditioned_inverse(scaled.as_ref()).unwrap_or_else(|| pseudo(&scaled));
    let n = scale.len();
    (0..n * n).map(|k| scale[k / n] * inverse[(k / n, k % n)] * scale[k % n]).collect()
}

fn well_conditioned_inverse(block: MatRef<'_, f64>) -> Option<Mat<f64>> {
    let factor = block.llt(Side::Lower).ok()?;
    let l = factor.L();
    let is_definite = (0..block.nrows()).all(|k| l[(k, k)] * l[(k, k)] > DEPENDENT);
    is_definite.then(|| factor.inverse())
}

fn pseudo(block: &Mat<f64>) -> Mat<f64> {
    match SymmetricEigen::new(block.as_ref()) {
        Ok(eigen) => {
            let root = eigen.inverse_root(DEPENDENT);
            root.transpose() * &root
        }
        // entries that are not finite: the residual will tell
        Err(_) => Mat::zeros(block.nrows(), block.ncols()),
    }
}
