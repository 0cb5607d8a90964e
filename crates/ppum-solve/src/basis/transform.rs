//! The stable transformation of a patch: a basis of its local space in which the Gram matrix is
//! the identity, with numerically dependent functions cut off.
//!
//! M is the scalar Gram matrix of the *weighted* functions of the patch, polynomials P first and
//! enrichments E after them,
//!
//! ```text
//! M_kl = ∫ ∇(φ ψ_k)·∇(φ ψ_l) + h⁻² φ² ψ_k ψ_l dx,     D = diag(M)^−½, for E ≤ κ/n,     M ← D M D
//! M_PP = U Λ Uᵀ,   keep λ > ε λ_max,   T_P = Λ^−½ Uᵀ
//! Q    = T_P M_PE
//! S    = M_EE − Qᵀ Q = U Λ Uᵀ,   keep λ > ε,   T_E = Λ^−½ Uᵀ [−Qᵀ T_P | I]
//! T    = [T_P 0; T_E] D,   T M Tᵀ = I
//! ```
//!
//! The fields of series tie components, jumps leave each component its own. So that jumps need no
//! fields, series give way to them: in the second step E are the jumps alone, in a third one P are
//! all functions so far and E the series.
//!
//! The functions are transformed before anything is integrated ([`crate::basis`]); the plain
//! coefficients are u = Tᵀ ũ. An enrichment is
//! cut off only if the polynomials and the other enrichments reproduce it, polynomials never give
//! way to enrichments. The limit of the Schur complement S is absolute because its functions have
//! norm one after the scaling, or less:
//!
//! A crack may leave a corner of the patch where φ is nearly nothing, the less the smoother the
//! weight: a jump there has a tiny norm, and made to have norm one it gets coefficients that hide
//! the field elsewhere, where they have to cancel. n² = ∫ h⁻² ψ² dx, without φ, tells such a
//! function from one that is merely small: no function is scaled beyond κ/n, with κ = [`REACH`].
//! Functions that φ weights with less than √ε/κ are cut off, and coefficients are at most κ/(n √ε).
//!
//! The construction follows Schweitzer, "Stable enrichment and local preconditioning in the
//! particle-partition of unity method", Numer. Math. 118 (2011), with another inner product: one
//! restricted to the flat top, where φ = 1, cannot see a crack that runs in the overlap.

use faer::{Mat, MatRef};

use ppum_linear::{EigenError, SymmetricEigen, inverse_root_diagonal, scaled};
use std::ops::Range;

/// Cut-off ε below which a function counts as dependent.
///
/// Small enough to lose nothing that is seen in the error (1e−12 costs 1e−5 of the energy norm
/// where a tip function is nearly a polynomial, 1e−9 ten times that), large enough above the
/// rounding of the eigenvalues, 1e−15. `docs/decisions/0002-stable-basis.md` has the measurements.
pub(crate) const CUT_OFF: f64 = 1e-13;

/// Ratio κ of the norms of ψ and of φψ beyond which an enrichment is out of φ's reach.
///
/// Large enough to leave alone whatever has a share in the solution, small enough to bound
/// coefficients: those of a field of size one stay below κ/√ε times its error of discretisation.
/// `docs/decisions/0002-stable-basis.md` has the measurements.
pub(crate) const REACH: f64 = 100.0;

/// Diagonal entries up to this fraction of the largest belong to functions that vanish on the
/// patch. Smaller ones would ask for coefficients beyond 1e20, which single precision cannot hold.
const VANISHING: f64 = 1e-40;

/// Functions of a patch, and the combinations of them that are kept.
pub(super) type FunctionCombinations = (Range<usize>, Mat<f64>);

/// The stable transformation T of one patch.
#[derive(Clone, Debug)]
pub(crate) struct Transform {
    /// T, shape [kept, functions]: row k holds the new function k in the plain functions.
    pub(crate) matrix: Mat<f64>,
    /// Number of new functions that are made of the first plain ones, polynomials and jumps: the
    /// first ones.
    pub(crate) first: usize,
    /// Number of functions that were cut off.
    pub(crate) dropped: usize,
    /// The least eigenvalue that was kept, of the polynomials as a part of their largest: far from
    /// one the functions nearly depend on each other. One if nothing was kept.
    pub(crate) least: f64,
}

impl Transform {
    /// The transformation of a patch with the Gram matrix `gram` [n × n, symmetric], whose first p
    /// functions are the polynomials and whose functions from f on give way to all before them,
    /// with cut-off `eps` (usually [`CUT_OFF`]); `plain` are the squares of the norms of the
    /// functions without φ, n².
    ///
    /// # Errors
    /// An entry of the Gram matrix that is not finite.
    ///
    /// # Panics
    /// If `gram` is not square or not 0 ≤ p ≤ f ≤ n.
    pub(crate) fn new(
        gram: MatRef<'_, f64>,
        plain: &[f64],
        [p, f]: [usize; 2],
        eps: f64,
    ) -> Result<Self, EigenError> {
        let n = gram.nrows();
        assert!(n == gram.ncols() && p <= f && f <= n, "a square Gram matrix, polynomials first");
        let mut d = inverse_root_diagonal(gram, VANISHING);
        for (d, n2) in d.iter_mut().zip(plain).skip(p).filter(|(d, _)| d.is_finite()) {
            *d = d.min(REACH / n2.sqrt());
        }
        let m = scaled(gram, &d);
        let (polynomials, of_these) = orthonormal_polynomials(m.submatrix(0, 0, p, p), eps)?;
        let (first, of_those) =
            with_enrichments(m.submatrix(0, 0, f, f), polynomials.as_ref(), eps)?;
        let (mut matrix, of_others) = with_enrichments(m.as_ref(), first.as_ref(), eps)?;
        for (j, scale) in d.into_iter().enumerate() {
            matrix.col_mut(j).iter_mut().for_each(|entry| *entry *= scale);
        }
        let (first, dropped) = (first.nrows(), n - matrix.nrows());
        Ok(Self { matrix, first, dropped, least: of_these.min(of_those).min(of_others) })
    }
}

/// T_P [kept × p] of the scaled polynomial block, and its least kept eigenvalue as a part of
/// the largest.
fn orthonormal_polynomials(m: MatRef<'_, f64>, eps: f64) -> Result<(Mat<f64>, f64), EigenError> {
    let eigen = SymmetricEigen::new(m)?;
    let largest = eigen.values.first().copied().unwrap_or(0.0);
    let root = eigen.inverse_root(eps * largest.max(0.0));
    let least = least_of(&eigen, root.nrows());
    Ok((root, least / if largest > 0.0 { largest } else { 1.0 }))
}

/// The last of the eigenvalues that were kept, one if there are none; they fall.
fn least_of(eigen: &SymmetricEigen, kept: usize) -> f64 {
    kept.checked_sub(1).map_or(1.0, |last| eigen.values[last])
}

/// T_P, or the rows of other functions that are orthonormal, and T_E below [kept × n] for the
/// scaled Gram matrix `m`, and the least kept eigenvalue of S.
fn with_enrichments(
    m: MatRef<'_, f64>,
    first: MatRef<'_, f64>,
    eps: f64,
) -> Result<(Mat<f64>, f64), EigenError> {
    let (n, p, q) = (m.nrows(), first.ncols(), first.nrows());
    let projection = first * m.submatrix(0, p, p, n - p);
    let schur = m.submatrix(p, p, n - p, n - p) - projection.transpose() * &projection;
    let eigen = SymmetricEigen::new(schur.as_ref())?;
    let root = eigen.inverse_root(eps);
    let mut rows = Mat::zeros(q + root.nrows(), n);
    rows.submatrix_mut(0, 0, q, p).copy_from(first);
    rows.submatrix_mut(q, 0, root.nrows(), p).copy_from(-(&root * projection.transpose() * first));
    rows.submatrix_mut(q, p, root.nrows(), n - p).copy_from(&root);
    Ok((rows, least_of(&eigen, root.nrows())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    /// Gram matrix of functions on [−1, 1], by the midpoint rule with many points, in the inner
    /// product ∫ f g dx: enough for the algebra, which knows nothing of functions.
    fn gram(functions: &[&dyn Fn(f64) -> f64]) -> Mat<f64> {
        let count = 4000;
        let points: Vec<f64> =
            (0..count).map(|k| (2 * k + 1) as f64 / count as f64 - 1.0).collect();
        let values = Mat::from_fn(functions.len(), count, |i, k| functions[i](points[k]));
        &values * values.transpose() * faer::Scale(2.0 / count as f64)
    }

    /// The transformation of functions that nothing multiplies.
    fn within_reach(m: MatRef<'_, f64>, n_polynomials: usize) -> Result<Transform, EigenError> {
        let plain: Vec<_> = (0..m.nrows()).map(|k| m[(k, k)]).collect();
        Transform::new(m, &plain, [n_polynomials, m.nrows()], CUT_OFF)
    }

    fn distance_to_identity(transform: &Transform, gram: &Mat<f64>) -> f64 {
        let t = &transform.matrix;
        (t * gram * t.transpose() - Mat::<f64>::identity(t.nrows(), t.nrows())).norm_max()
    }

    #[test]
    fn polynomials_and_a_jump_become_orthonormal() {
        let m = gram(&[
            &|_| 1.0,
            &|x| x,
            &|x| x * x,
            &|x| (x - 0.3).signum(),
            &|x| x * (x - 0.3).signum(),
            &|x| (x + 1.0).sqrt(),
        ]);
        let transform = within_reach(m.as_ref(), 3).unwrap();
        assert_eq!(transform.dropped, 0);
        assert!(distance_to_identity(&transform, &m) < 1e-10);
        // The new polynomials are polynomials still.
        assert!((0..3).all(|k| (3..6).all(|j| transform.matrix[(k, j)] == 0.0)));
    }

    #[test]
    fn orthogonal_functions_are_only_scaled() {
        // Legendre polynomials, ∫ P_k² = 2 / (2k + 1), with exact entries.
        let m = Mat::from_fn(4, 4, |i, j| if i == j { 2.0 / (2 * i + 1) as f64 } else { 0.0 });
        let transform = within_reach(m.as_ref(), 2).unwrap();
        let squares = transform.matrix.transpose() * &transform.matrix;
        for k in 0..4 {
            assert!((squares[(k, k)] - (2 * k + 1) as f64 / 2.0).abs() < 1e-14);
        }
    }

    #[test]
    fn a_nearly_dependent_function_is_cut_off() {
        for distance in [0.0, 1e-13, 1e-7] {
            let m = gram(&[&|_| 1.0, &|x| x, &|x| 1.0 + distance * (7.0 * x).sin()]);
            for n_polynomials in [1, 2, 3] {
                let transform = within_reach(m.as_ref(), n_polynomials).unwrap();
                assert_eq!((transform.matrix.nrows(), transform.dropped), (2, 1));
                assert!(distance_to_identity(&transform, &m) < 1e-6);
            }
        }
    }

    #[test]
    fn a_function_at_a_distance_above_the_cut_off_is_kept() {
        let m = gram(&[&|_| 1.0, &|x| x, &|x| 1.0 + 1e-3 * (7.0 * x).sin()]);
        let transform = within_reach(m.as_ref(), 2).unwrap();
        assert_eq!(transform.dropped, 0);
        assert!(distance_to_identity(&transform, &m) < 1e-8);
    }

    #[test]
    fn functions_that_vanish_are_cut_off_wherever_they_stand() {
        let m = gram(&[&|_| 1.0, &|_| 0.0, &|x| x, &|_| 0.0, &|x| x.abs(), &|x| 1e-25 * x.cos()]);
        let transform = within_reach(m.as_ref(), 3).unwrap();
        assert_eq!(transform.dropped, 3);
        assert!(distance_to_identity(&transform, &m) < 1e-12);
        for j in [1, 3, 5] {
            assert!(transform.matrix.col(j).iter().all(|&entry| entry == 0.0));
        }
        let nothing = within_reach(Mat::zeros(3, 3).as_ref(), 2).unwrap();
        assert_eq!((nothing.matrix.nrows(), nothing.matrix.ncols(), nothing.dropped), (0, 3, 3));
    }

    #[test]
    fn functions_that_are_not_finite_are_an_error() {
        for value in [f64::NAN, f64::INFINITY] {
            let m = Mat::from_fn(3, 3, |i, j| match (i, j) {
                (2, 2) => value,
                _ => f64::from(u8::from(i == j)),
            });
            assert!(within_reach(m.as_ref(), 2).is_err());
        }
    }

    #[test]
    fn the_scale_of_the_functions_does_not_matter() {
        let mut random = Random(3);
        let factor = Mat::from_fn(12, 12, |_, _| random.between(-1.0, 1.0));
        let m = &factor * factor.transpose();
        let scales: Vec<f64> = (0..12).map(|k| 10.0_f64.powi(k - 6)).collect();
        let rescaled = scaled(m.as_ref(), &scales);
        let plain = within_reach(m.as_ref(), 7).unwrap();
        let transform = within_reach(rescaled.as_ref(), 7).unwrap();
        assert_eq!((plain.dropped, transform.dropped), (0, 0));
        assert!(distance_to_identity(&transform, &rescaled) < 1e-9);
        let back = Mat::from_fn(12, 12, |k, j| transform.matrix[(k, j)] * scales[j]);
        assert!((back - &plain.matrix).norm_max() < 1e-7 * plain.matrix.norm_max());
    }

    /// Functions 1, x and what is left of a jump and of a jump times x where a factor takes all but
    /// `part` of it.
    #[test]
    fn a_function_out_of_reach_gets_no_large_coefficients() {
        let bound = REACH / CUT_OFF.sqrt();
        for part in [1.0, 1e-3, 1e-6, 1e-9, 1e-15] {
            let jump = |x: f64| if x > 0.6 { 1.0 } else { 0.0 };
            let m = gram(&[&|_| 1.0, &|x| x, &|x| part * jump(x), &|x| part * jump(x) * x]);
            let plain: Vec<_> = [2.0, 2.0 / 3.0, 0.4, (1.0 - 0.216) / 3.0].into();
            let transform = Transform::new(m.as_ref(), &plain, [2, 4], CUT_OFF).unwrap();
            let rows =
                transform.matrix.row_iter().flat_map(|row| row.iter().copied().collect::<Vec<_>>());
            let largest = rows.fold(0.0_f64, |most, entry| most.max(entry.abs()));
            assert!(largest < 2.0 * bound, "{part}: {largest:e}");
            assert_eq!(transform.dropped, if part > 1e-8 { 0 } else { 2 }, "{part}");
        }
    }
}
