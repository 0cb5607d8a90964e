//! Largest eigenvalue of a small generalised eigenproblem B x = λ A x where A is singular.
//!
//! Nitsche's method is stable with β = f λ_max, f > 1, where A is the energy of a boundary cell
//! and B = ∫ |σ(u) n|² ds over the part of its boundary with prescribed displacement: λ_max is the
//! sharp constant of the inverse estimate ∫ |σ(u) n|² ds ≤ λ_max a(u, u). Both forms vanish for
//! rigid-body modes, so that A is shifted by a little. B = R Rᵀ has a column of R for each point:
//!
//! ```text
//! D = diag(A)^−½,   D A D + δ I = L Lᵀ,   X = L⁻¹ D R,   λ_max = λ_max(Xᵀ X)
//! ```

use super::dense::product;
use super::eigen::{EigenError, SymmetricEigen, inverse_root_diagonal, scaled};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{cholesky_in_place, cholesky_in_place_scratch};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Mat, MatRef, Par};

/// δ: rounding leaves eigenvalues of about 1e−15 in the null space of the scaled A; deformations of
/// enriched cells lie above 1e−8, so that λ is right to 1e−4 at least.
const SHIFT: f64 = 1e-12;

/// Diagonal entries of A up to this fraction of the largest belong to functions without energy.
const VANISHING: f64 = 1e-40;

/// The largest λ of R Rᵀ x = λ A x over the complement of the null space of A.
///
/// `a` is symmetric and positive semi-definite [n × n]; its null space must lie in that of
/// `r` ᵀ [n × points]. Zero if A is zero or empty.
///
/// # Errors
/// An entry that is not finite.
pub fn largest_eigenvalue(a: MatRef<'_, f64>, r: MatRef<'_, f64>) -> Result<f64, EigenError> {
    let (n, d) = (a.nrows(), inverse_root_diagonal(a, VANISHING));
    let mut factor = scaled(a, &d);
    (0..n).for_each(|k| factor[(k, k)] += SHIFT);
    let scratch = cholesky_in_place_scratch::<f64>(n, Par::Seq, Default::default());
    let mut buffer = MemBuffer::new(scratch);
    let (stack, how) = (MemStack::new(&mut buffer), Default::default());
    cholesky_in_place(factor.as_mut(), Default::default(), Par::Seq, stack, how)
        .map_err(|_| EigenError { size: n })?;
    let mut x = Mat::from_fn(n, r.ncols(), |k, q| d[k] * r[(k, q)]);
    solve_lower_triangular_in_place(factor.as_ref(), x.as_mut(), Par::Seq);
    let eigen = SymmetricEigen::new(product(x.transpose(), x.as_ref()).as_ref())?;
    Ok(eigen.values.first().copied().unwrap_or(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    #[test]
    fn a_bar_in_polynomials_of_degree_p() {
        // The largest of q(1)² / ∫₋₁¹ q² over polynomials q = u' of degree k is (k + 1)² / 2:
        // the reproducing kernel of the Legendre polynomials at the end point.
        for degree in 1..=8_i32 {
            // u = xⁿ, n = 0 … degree: u' = n xⁿ⁻¹, and the constant is the rigid-body mode.
            let entry = |i: usize, j: usize| {
                let power = i as i32 + j as i32 - 1;
                let integral = if power % 2 == 0 { 0.0 } else { 2.0 / f64::from(power) };
                (i * j) as f64 * integral
            };
            let n = degree as usize + 1;
            let a = Mat::from_fn(n, n, entry);
            let r = Mat::from_fn(n, 1, |i, _| i as f64);
            let lambda = largest_eigenvalue(a.as_ref(), r.as_ref()).unwrap();
            let exact = f64::from(degree * degree) / 2.0;
            assert!((lambda / exact - 1.0).abs() < 1e-8, "degree {degree}: {lambda}, not {exact}");
        }
    }

    #[test]
    fn a_null_space_in_general_position_is_left_out() {
        // A = Gᵀ diag(1, 2, 4, 0) G and B = Gᵀ diag(3, 5, 4, 0) G: eigenvalues 3, 5/2, 1.
        let mut random = Random(7);
        let g = Mat::from_fn(4, 4, |_, _| random.between(-1.0, 1.0));
        let times = |d: [f64; 4]| Mat::from_fn(4, 4, |i, j| g[(j, i)] * d[j]);
        let a = times([1.0, 2.0, 4.0, 0.0]) * &g;
        let r = times([3.0, 5.0, 4.0, 0.0].map(f64::sqrt));
        let lambda = largest_eigenvalue(a.as_ref(), r.as_ref()).unwrap();
        assert!((lambda - 3.0).abs() < 1e-9, "{lambda}");
    }

    #[test]
    fn nothing_and_zero_energy_give_zero() {
        let (empty, zero) = (Mat::zeros(0, 0), Mat::zeros(3, 3));
        assert_eq!(largest_eigenvalue(empty.as_ref(), empty.as_ref()), Ok(0.0));
        assert_eq!(largest_eigenvalue(zero.as_ref(), zero.as_ref()), Ok(0.0));
    }
}
