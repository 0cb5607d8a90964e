//! Largest eigenvalue of a small generalised eigenproblem B x = λ A x where A is singular.
//!
//! Nitsche's method is stable with β = f λ_max, f > 1, where A is the energy of a boundary cell
//! and B = ∫ |σ(u) n|² ds over the part of its boundary with prescribed displacement: λ_max is the
//! sharp constant of the inverse estimate ∫ |σ(u) n|² ds ≤ λ_max a(u, u). Both forms vanish for
//! Rigid-body modes, which are therefore taken out of A first:
//!
//! ```text
//! D = diag(A)^−½,   D A D = U Λ Uᵀ,   keep λ > 1e−10 λ_max,   R = Λ^−½ Uᵀ,   λ_max(R D B D Rᵀ)
//! ```

use faer::MatRef;

use super::eigen::{EigenError, SymmetricEigen, inverse_root_diagonal, scaled};

/// Eigenvalues of the scaled A up to this fraction of the largest belong to its null space.
/// Rounding leaves about 1e−15 there; deformations of enriched cells lie above 1e−8.
const NULL_SPACE: f64 = 1e-10;

/// Diagonal entries of A up to this fraction of the largest belong to functions without energy.
const VANISHING: f64 = 1e-40;

/// The largest λ of B x = λ A x over the complement of the null space of A.
///
/// `a` and `b` are symmetric and positive semi-definite [n × n]; the null space of A must lie in
/// that of B. Zero if A is zero or empty.
///
/// # Errors
/// An entry that is not finite.
pub(crate) fn largest_eigenvalue(
    a: MatRef<'_, f64>,
    b: MatRef<'_, f64>,
) -> Result<f64, EigenError> {
    let d = inverse_root_diagonal(a, VANISHING);
    let eigen = SymmetricEigen::new(scaled(a, &d).as_ref())?;
    let largest = eigen.values.first().copied().unwrap_or(0.0);
    let root = eigen.inverse_root(NULL_SPACE * largest.max(0.0));
    let reduced = &root * scaled(b, &d) * root.transpose();
    let eigen = SymmetricEigen::new(reduced.as_ref())?;
    Ok(eigen.values.first().copied().unwrap_or(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;
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
            let b = Mat::from_fn(n, n, |i, j| (i * j) as f64);
            let lambda = largest_eigenvalue(a.as_ref(), b.as_ref()).unwrap();
            let exact = f64::from(degree * degree) / 2.0;
            assert!((lambda / exact - 1.0).abs() < 1e-8, "degree {degree}: {lambda}, not {exact}");
        }
    }

    #[test]
    fn a_null_space_in_general_position_is_left_out() {
        // A = Gᵀ diag(1, 2, 4, 0) G and B = Gᵀ diag(3, 5, 4, 0) G: eigenvalues 3, 5/2, 1.
        let mut random = Random(7);
        let g = Mat::from_fn(4, 4, |_, _| random.between(-1.0, 1.0));
        let with = |d: [f64; 4]| g.transpose() * Mat::from_fn(4, 4, |i, j| d[i] * g[(i, j)]);
        let (a, b) = (with([1.0, 2.0, 4.0, 0.0]), with([3.0, 5.0, 4.0, 0.0]));
        let lambda = largest_eigenvalue(a.as_ref(), b.as_ref()).unwrap();
        assert!((lambda - 3.0).abs() < 1e-9, "{lambda}");
    }

    #[test]
    fn nothing_and_zero_energy_give_zero() {
        let (empty, zero) = (Mat::zeros(0, 0), Mat::zeros(3, 3));
        assert_eq!(largest_eigenvalue(empty.as_ref(), empty.as_ref()), Ok(0.0));
        assert_eq!(largest_eigenvalue(zero.as_ref(), zero.as_ref()), Ok(0.0));
    }
}
