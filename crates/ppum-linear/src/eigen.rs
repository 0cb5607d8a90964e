//! Eigen-decomposition A = U Λ Uᵀ of small dense symmetric matrices: the tool of
//! stable bases and of [`super::pencil`].
//!
//! Always sequential, so that the result does not depend on the number of threads.

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, self_adjoint_evd, self_adjoint_evd_scratch};
use faer::{Mat, MatRef, Par};

/// A symmetric matrix whose eigenvalues cannot be computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "no eigenvalues for a {size} × {size} symmetric matrix: an entry is not finite or the \
     iteration did not converge; look for a quadrature point on a crack tip or for material \
     constants that are not finite"
)]
#[non_exhaustive]
pub struct EigenError {
    /// Rows of the matrix.
    pub size: usize,
}

/// Eigenvalues and orthonormal eigenvectors of a symmetric matrix.
pub struct SymmetricEigen {
    /// Eigenvalues, largest first.
    pub values: Vec<f64>,
    /// Eigenvectors as columns, in the order of `values`; the entry of largest modulus is positive.
    pub vectors: Mat<f64>,
}

impl SymmetricEigen {
    /// Decomposes `a` [n × n]; only its lower triangle is read.
    pub fn new(a: MatRef<'_, f64>) -> Result<Self, EigenError> {
        let n = a.nrows();
        let error = EigenError { size: n };
        if n == 0 {
            return Ok(Self { values: Vec::new(), vectors: Mat::zeros(0, 0) });
        }
        // The decomposition may loop or panic on NaN, so this is asked first.
        if !(0..n).all(|j| (j..n).all(|i| a[(i, j)].is_finite())) {
            return Err(error);
        }
        let (mut s, mut u) = (Diag::<f64>::zeros(n), Mat::<f64>::zeros(n, n));
        let scratch = self_adjoint_evd_scratch::<f64>(
            n,
            ComputeEigenvectors::Yes,
            Par::Seq,
            Default::default(),
        );
        let mut buffer = MemBuffer::new(scratch);
        let stack = MemStack::new(&mut buffer);
        self_adjoint_evd(a, s.as_mut(), Some(u.as_mut()), Par::Seq, stack, Default::default())
            .map_err(|_| error)?;
        let values = (0..n).rev().map(|k| s[k]).collect();
        let signs: Vec<f64> = (0..n).map(|k| sign_of_largest(u.col(k).iter().copied())).collect();
        let vectors = Mat::from_fn(n, n, |i, k| signs[n - 1 - k] * u[(i, n - 1 - k)]);
        Ok(Self { values, vectors })
    }

    /// Decomposes a tridiagonal matrix, whose `coupling[k]` is between k and k + 1.
    pub(super) fn tridiagonal(diagonal: &[f64], coupling: &[f64]) -> Result<Self, EigenError> {
        let n = diagonal.len();
        let matrix = Mat::from_fn(n, n, |i, j| match i.abs_diff(j) {
            0 => diagonal[i],
            1 => coupling[i.min(j)],
            _ => 0.0,
        });
        Self::new(matrix.as_ref())
    }

    /// The matrix R = Λ^−½ Uᵀ [kept × n] of the eigenvalues above `limit`, so that R A Rᵀ = I.
    pub fn inverse_root(&self, limit: f64) -> Mat<f64> {
        let kept = self.values.iter().take_while(|&&value| value > limit).count();
        Mat::from_fn(kept, self.values.len(), |k, i| self.vectors[(i, k)] / self.values[k].sqrt())
    }
}

/// Sign of the entry of largest modulus, the first one if several are equal.
fn sign_of_largest(entries: impl Iterator<Item = f64>) -> f64 {
    let largest = entries.fold(0.0_f64, |best, x| if x.abs() > best.abs() { x } else { best });
    if largest < 0.0 { -1.0 } else { 1.0 }
}

/// D_k = A_kk^−½, and 0 where A_kk is not above `vanishing` times the largest diagonal entry.
pub fn inverse_root_diagonal(a: MatRef<'_, f64>, vanishing: f64) -> Vec<f64> {
    let diagonal = || (0..a.nrows()).map(|k| a[(k, k)]);
    let limit = vanishing * diagonal().fold(0.0, f64::max);
    let root = |x: f64| match x {
        // not to be taken for a function that vanishes
        x if !x.is_finite() => f64::NAN,
        x if x > limit => x.sqrt().recip(),
        _ => 0.0,
    };
    diagonal().map(root).collect()
}

/// The congruence D A D with a diagonal D.
pub fn scaled(a: MatRef<'_, f64>, d: &[f64]) -> Mat<f64> {
    Mat::from_fn(a.nrows(), a.ncols(), |i, j| {
        // 0 · ∞ must not bring a vanishing function back as NaN
        if d[i] == 0.0 || d[j] == 0.0 { 0.0 } else { d[i] * a[(i, j)] * d[j] }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_by_two_by_hand() {
        // [[2, 1], [1, 2]]: 3 with (1, 1)/√2 and 1 with (1, −1)/√2.
        let a = Mat::from_fn(2, 2, |i, j| if i == j { 2.0 } else { 1.0 });
        let eigen = SymmetricEigen::new(a.as_ref()).unwrap();
        assert!((eigen.values[0] - 3.0).abs() < 1e-15 && (eigen.values[1] - 1.0).abs() < 1e-15);
        let half = 0.5_f64.sqrt();
        for i in 0..2 {
            assert!((eigen.vectors[(i, 0)] - half).abs() < 1e-15);
            assert!((eigen.vectors[(i, 1)].abs() - half).abs() < 1e-15);
        }
    }

    #[test]
    fn second_difference_matrix_has_its_known_spectrum() {
        let n = 40;
        let a = Mat::from_fn(n, n, |i, j| match i.abs_diff(j) {
            0 => 2.0,
            1 => -1.0,
            _ => 0.0,
        });
        let eigen = SymmetricEigen::new(a.as_ref()).unwrap();
        for (k, value) in eigen.values.iter().enumerate() {
            let angle = std::f64::consts::PI * (n - k) as f64 / (n + 1) as f64;
            assert!((value - (2.0 - 2.0 * angle.cos())).abs() < 1e-13);
        }
        let r = eigen.inverse_root(0.0);
        let identity = &r * &a * r.transpose();
        assert!((identity - Mat::<f64>::identity(n, n)).norm_max() < 1e-12);
    }

    #[test]
    fn an_entry_that_is_not_finite_is_an_error() {
        let mut a = Mat::<f64>::identity(3, 3);
        a[(2, 1)] = f64::NAN;
        assert_eq!(SymmetricEigen::new(a.as_ref()).err(), Some(EigenError { size: 3 }));
    }
}
