//! Extreme eigenvalues of the system: how well the stable basis is conditioned.
//!
//! Lanczos' method with full reorthogonalisation, on K for the largest eigenvalue and on K⁻¹, by
//! the Cholesky factor, for the smallest. A Ritz value θ lies within |β s| of an eigenvalue, β the
//! last coupling and s the last entry of its vector in the Krylov space: iteration ends when that
//! is a thousandth of θ (Parlett, "The Symmetric Eigenvalue Problem", 1980, chapter 13).

use super::block_matrix::BlockMatrix;
use super::cholesky::Cholesky;
use super::conjugate::{dot, norm};
use super::eigen::{EigenError, SymmetricEigen};

/// Relative accuracy of the eigenvalues.
const ACCURACY: f64 = 1e-3;

/// Steps after which the best value so far is taken, a lower bound of the largest eigenvalue.
const MOST_STEPS: usize = 120;

/// The golden ratio less one: the fractions {k² g} are spread evenly and without pattern, so that a
/// start vector of such numbers has parts of all eigenvectors.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The extreme eigenvalues of a stiffness matrix in the stable basis, restraints and null-space
/// constraint included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spectrum {
    /// The smallest eigenvalue.
    pub smallest: f64,
    /// The largest eigenvalue.
    pub largest: f64,
}

impl Spectrum {
    /// The extreme eigenvalues of a matrix and its solver. `step` is called before each product,
    /// and ends the work by an error.
    ///
    /// # Errors
    /// That of `step`; entries that are not finite.
    pub fn new<E: From<EigenError>>(
        matrix: &BlockMatrix,
        solver: &Cholesky<'_>,
        step: &dyn Fn() -> Result<(), E>,
    ) -> Result<Self, E> {
        let n = matrix.n_unknowns();
        let largest = largest_eigenvalue(n, |x| step().map(|()| matrix.multiply(x)))?;
        let inverse = largest_eigenvalue(n, |x| step().map(|()| solver.apply_inverse(x)))?;
        Ok(Self { largest, smallest: inverse.recip() })
    }

    /// The condition number, the quotient of the two.
    #[must_use]
    pub fn condition(&self) -> f64 {
        self.largest / self.smallest
    }
}

/// The largest eigenvalue of a symmetric operator on n unknowns.
fn largest_eigenvalue<E: From<EigenError>>(
    n: usize,
    apply: impl Fn(&[f64]) -> Result<Vec<f64>, E>,
) -> Result<f64, E> {
    let mut next: Vec<f64> =
        (0..n).map(|k| 2.0 * ((k * k) as f64 * GOLDEN).fract() - 1.0).collect();
    let (mut basis, mut diagonal, mut coupling) = (Vec::new(), Vec::new(), vec![norm(&next)]);
    let mut found = 0.0;
    for step in 0..MOST_STEPS.min(n) {
        next.iter_mut().for_each(|x| *x /= coupling[step]);
        basis.push(next);
        next = apply(&basis[step])?;
        diagonal.push(dot(&next, &basis[step]));
        orthogonalise(&mut next, &basis);
        coupling.push(norm(&next));
        let ritz = SymmetricEigen::tridiagonal(&diagonal, &coupling[1..])?;
        found = ritz.values[0];
        if coupling[step + 1] * ritz.vectors[(step, 0)].abs() <= ACCURACY * found {
            break;
        }
    }
    Ok(found)
}

/// Takes the parts along an orthonormal basis out of x; twice, so that rounding leaves none.
fn orthogonalise(x: &mut [f64], basis: &[Vec<f64>]) {
    for v in basis.iter().chain(basis) {
        let part = dot(x, v);
        x.iter_mut().zip(v).for_each(|(x, v)| *x -= part * v);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BlockPattern;
    use faer::Mat;

    /// Second differences on a line have the eigenvalues 2 − 2 cos(kπ/(n + 1)).
    #[test]
    fn second_differences() {
        let n = 150;
        let columns = (0..n as u32).flat_map(|i| i..(i + 2).min(n as u32)).collect();
        let starts = (0..=n).map(|i| (2 * i).min(2 * n - 1)).collect();
        let mut matrix = BlockMatrix::new(&vec![1; n], BlockPattern::new(starts, columns));
        let entry = |value| Mat::from_fn(1, 1, |_, _| value);
        for i in 0..n {
            matrix.add_block(i, i, entry(2.0).as_ref());
            if i + 1 < n {
                matrix.add_block(i, i + 1, entry(-1.0).as_ref());
            }
        }
        let factor = Cholesky::new(&matrix).expect("a definite matrix");
        let found =
            Spectrum::new(&matrix, &factor, &|| Ok::<(), EigenError>(())).expect("eigenvalues");
        let exact = |k: usize| 2.0 - 2.0 * (std::f64::consts::PI * k as f64 / (n + 1) as f64).cos();
        assert!((found.smallest / exact(1) - 1.0).abs() < ACCURACY, "{found:?}");
        assert!((found.largest / exact(n) - 1.0).abs() < ACCURACY, "{found:?}");
        assert_eq!(found.condition(), found.largest / found.smallest);
    }
}
