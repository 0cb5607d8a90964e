//! Ties: functions whose components share their unknowns.
//!
//! The stable basis N of a patch is orthonormal, so that coordinates tell all of a function: those
//! of ψ are T M ψ. The vector fields v of a patch are the polynomials and jumps, with each
//! component for itself, and fields whose components are tied; with the coordinates of the latter
//! as the rows of A, those of polynomials and jumps out,
//!
//! ```text
//! A Aᵀ = U Λ Uᵀ,   keep λ > ε,   C = Λ^−½ Uᵀ A
//! ```
//!
//! The rows of C are orthonormal. The unknowns are those of C N, fields that are formed at the
//! quadrature points, before anything is integrated. Where boundaries are held the system of a cell
//! is assembled in N with all components free, and what goes into the matrix is C K Cᵀ: rounding
//! errors are not amplified.

use super::transform::{CUT_OFF, Transform};
use faer::{Mat, MatRef};
use ppum_linear::{EigenError, SymmetricEigen};

/// A function of which the two components may differ, as combinations of a patch's functions.
pub(super) type VectorField = [Vec<f64>; 2];

/// The tie C of a patch: [unknowns, components · functions], component by component.
///
/// `gram` is the plain Gram matrix M, and `fields` are those beside the functions that T keeps
/// first.
///
/// # Errors
/// Functions that are not finite.
pub(super) fn tie(
    gram: MatRef<'_, f64>,
    transform: &Transform,
    fields: &[VectorField],
) -> Result<Mat<f64>, EigenError> {
    let (n, p) = (transform.matrix.nrows(), transform.first);
    let to_coordinates = &transform.matrix * gram;
    let mut rows = Mat::zeros(fields.len(), 2 * n);
    for (row, field) in fields.iter().enumerate() {
        let coordinates = field.each_ref().map(|part| &to_coordinates * column(part));
        let norm = norm(gram, field);
        for (i, part) in coordinates.iter().enumerate() {
            // what is left of the field beside the first functions
            (p..n).for_each(|k| rows[(row, i * n + k)] = part[(k, 0)] / norm);
        }
    }
    let root = SymmetricEigen::new((&rows * rows.transpose()).as_ref())?.inverse_root(CUT_OFF);
    let others = root * rows;
    let mut all = Mat::zeros(2 * p + others.nrows(), 2 * n);
    (0..2 * p).for_each(|k| all[(k, (k / p) * n + k % p)] = 1.0);
    all.submatrix_mut(2 * p, 0, others.nrows(), 2 * n).copy_from(others);
    Ok(all)
}

/// (Σ_i v_iᵀ M v_i)^½, infinite for a field that vanishes on the patch.
fn norm(gram: MatRef<'_, f64>, field: &VectorField) -> f64 {
    let square = |part: &Vec<f64>| (column(part).transpose() * gram * column(part))[(0, 0)];
    let sum: f64 = field.iter().map(square).sum();
    if sum > 0.0 { sum.sqrt() } else { f64::INFINITY }
}

fn column(part: &[f64]) -> Mat<f64> {
    Mat::from_fn(part.len(), 1, |k, _| part[k])
}

/// A tie to functions N becomes one to S N, S symmetric: of orthonormal rows with the same span.
///
/// `gram` is the Gram matrix S⁻² of N that S makes orthonormal.
///
/// # Errors
/// Functions that are not finite.
pub(super) fn renewed(
    tie: &Mat<f64>,
    gram: MatRef<'_, f64>,
    root: MatRef<'_, f64>,
) -> Result<Mat<f64>, EigenError> {
    let n = gram.nrows();
    // N = S⁻¹ (S N) = M S (S N)
    let inverse = gram * root;
    let mut rows = Mat::zeros(tie.nrows(), tie.ncols());
    for first in (0..tie.ncols()).step_by(n) {
        rows.subcols_mut(first, n).copy_from(tie.subcols(first, n) * &inverse);
    }
    let root = SymmetricEigen::new((&rows * rows.transpose()).as_ref())?.inverse_root(0.0);
    Ok(root * rows)
}
