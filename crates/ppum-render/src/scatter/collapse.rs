//! A patch on rows of pixels: weight × polynomial in y collapses to polynomials in x.
//!
//! On one row η is fixed, and with the weight's factor b(η)
//!
//! ```text
//! W p = a(ξ) Σ_k A_k ξ^k     A_k = b Σ_j c_kj η^j     B_k = ∂A_k/∂y     D_k = (k + 1) A_{k+1} ∂ξ/∂x
//! ```
//!
//! The collapse works on lanes of rows; the rows are then evaluated on lanes of columns.

use ppum::dataset::monomials;
use ppum::real::{Real, Scalar};

use super::plan::Affine;

/// Rows of a tile, and of the tables here: one vector of lanes.
#[inline(always)]
pub(super) const fn rows<T: Scalar>() -> usize {
    T::VECTOR
}

/// Polynomials kept for a block: A, and with derivatives B and D.
#[inline(always)]
pub(super) const fn polynomials<const D: usize>() -> usize {
    1 + 2 * D
}

/// Length of a block's table.
#[inline(always)]
pub(super) const fn table_len<T: Scalar, const D: usize>(degree: usize) -> usize {
    (degree + 1) * polynomials::<D>() * rows::<T>()
}

/// The factor b(η) of the weight and its derivative by y on lanes of rows.
#[derive(Clone, Copy)]
pub(super) struct Factor<R> {
    pub(super) value: R,
    pub(super) slope: R,
}

/// Writes the table of one block: for k from the degree down to 0 the lanes of A_k, B_k and D_k.
///
/// `shift` is subtracted from the constant coefficient; `eta` are the rows in the polynomials'
/// frame.
#[inline(always)]
pub(super) fn collapse<R: Real, const D: usize>(
    coefficients: &[f64],
    degree: usize,
    shift: f64,
    frame: [Affine; 2],
    eta: R,
    factor: Factor<R>,
    table: &mut [R::Scalar],
) {
    let n = rows::<R::Scalar>();
    let mut k = degree + 1;
    let mut at = 0;
    let scaled = factor.value * eta.lit(frame[1].scale);
    while k > 0 {
        k -= 1;
        let [a, b] = inner::<R, D>(coefficients, degree, k, shift, eta);
        let weighted = factor.value * a;
        weighted.store(&mut table[at..]);
        if D >= 1 {
            factor.slope.mul_add(a, scaled * b).store(&mut table[at + n..]);
            if k > 0 {
                let slope = weighted * eta.lit(k as f64 * frame[0].scale);
                slope.store(&mut table[at + 5 * n..]);
            }
        }
        at += polynomials::<D>() * n;
    }
}

/// Σ_j c_kj η^j and its derivative by η, by Horner's scheme.
#[inline(always)]
fn inner<R: Real, const D: usize>(
    c: &[f64],
    degree: usize,
    k: usize,
    shift: f64,
    eta: R,
) -> [R; 2] {
    let zero = eta.lit(0.0);
    let (mut a, mut b) = (zero, zero);
    let mut j = degree - k + 1;
    while j > 0 {
        j -= 1;
        let mut coefficient = c[monomials(j + k) - 1 - k];
        if j + k == 0 {
            coefficient -= shift;
        }
        if D >= 1 {
            b = b.mul_add(eta, a);
        }
        a = a.mul_add(eta, zero.lit(coefficient));
    }
    [a, b]
}

/// A block on lanes of columns: Σ A_k ξ^k and its derivatives by x and y. `table` begins at the
/// row.
#[inline(always)]
pub(super) fn evaluate<R: Real, const D: usize>(
    table: &[R::Scalar],
    degree: usize,
    xi: R,
) -> [R; 3] {
    let n = rows::<R::Scalar>();
    let zero = xi.lit(0.0);
    let mut v = splat(zero, table[0]);
    let (mut vx, mut vy) = (zero, zero);
    if D >= 1 {
        vy = splat(zero, table[n]);
    }
    let mut k = 0;
    let mut at = 0;
    while k < degree {
        k += 1;
        at += polynomials::<D>() * n;
        v = v.mul_add(xi, splat(zero, table[at]));
        if D >= 1 {
            vy = vy.mul_add(xi, splat(zero, table[at + n]));
            vx = vx.mul_add(xi, splat(zero, table[at + 2 * n]));
        }
    }
    [v, vx, vy]
}

/// A number in every lane.
#[inline(always)]
pub(super) fn splat<R: Real>(like: R, value: R::Scalar) -> R {
    like.lit(value.to_f64())
}
