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

/// Rows of a tile, and of the tables here: whole vectors of lanes.
pub(super) const ROWS: usize = 16;

/// Polynomials kept for a block: A, and with derivatives B and D.
#[inline(always)]
pub(super) const fn polynomials<const D: usize>() -> usize {
    1 + 2 * D
}

/// Length of a block's table.
#[inline(always)]
pub(super) const fn table_len<const D: usize>(degree: usize) -> usize {
    (degree + 1) * polynomials::<D>() * ROWS
}

/// The factor b(η) of the weight and its derivative by y on lanes of rows.
#[derive(Clone, Copy)]
pub(super) struct Factor<R> {
    pub(super) value: R,
    pub(super) slope: R,
}

/// A number known only at run time, where a constant is asked for.
pub(super) const ANY: usize = usize::MAX;

/// `constant` unless it is [`ANY`]: loops up to a constant unroll.
#[inline(always)]
pub(super) const fn known(constant: usize, number: usize) -> usize {
    if constant == ANY { number } else { constant }
}

/// [`collapse_degree`] with the common degrees as constants.
#[inline(always)]
pub(super) fn collapse<R: Real, const D: usize>(
    coefficients: &[f64],
    degree: usize,
    shift: f64,
    rows: &Rows<R>,
    table: &mut [R::Scalar],
) {
    match degree {
        0 => collapse_degree::<R, D, 0>(coefficients, degree, shift, rows, table),
        1 => collapse_degree::<R, D, 1>(coefficients, degree, shift, rows, table),
        2 => collapse_degree::<R, D, 2>(coefficients, degree, shift, rows, table),
        3 => collapse_degree::<R, D, 3>(coefficients, degree, shift, rows, table),
        _ => collapse_degree::<R, D, ANY>(coefficients, degree, shift, rows, table),
    }
}

/// Lanes of rows of a patch.
pub(super) struct Rows<R> {
    /// Coordinates η of the polynomials.
    pub(super) eta: R,
    /// Factor of the weight.
    pub(super) factor: Factor<R>,
    /// Derivatives of ξ and η by x and y.
    pub(super) scale: [f64; 2],
}

/// Writes the table of one block: for k from the degree down to 0 the lanes of A_k, B_k and D_k.
///
/// `shift` is subtracted from the constant coefficient.
#[inline(always)]
fn collapse_degree<R: Real, const D: usize, const P: usize>(
    coefficients: &[f64],
    degree: usize,
    shift: f64,
    rows: &Rows<R>,
    table: &mut [R::Scalar],
) {
    let degree = known(P, degree);
    let coefficients = &coefficients[..monomials(degree)];
    // The last lanes of the table may belong to the rows before these.
    let table = &mut table[..(degree + 1) * polynomials::<D>() * ROWS - ROWS + R::LANES];
    let scaled = rows.factor.value * rows.eta.lit(rows.scale[1]);
    let mut k = degree + 1;
    let mut at = 0;
    while k > 0 {
        k -= 1;
        let [a, b] = inner::<R, D>(coefficients, degree, k, shift, rows.eta);
        let weighted = rows.factor.value * a;
        weighted.store(&mut table[at..]);
        if D >= 1 {
            rows.factor.slope.mul_add(a, scaled * b).store(&mut table[at + ROWS..]);
            if k > 0 {
                let slope = weighted * rows.eta.lit(k as f64 * rows.scale[0]);
                slope.store(&mut table[at + 5 * ROWS..]);
            }
        }
        at += polynomials::<D>() * ROWS;
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
/// row; `P` is the degree or [`ANY`].
#[inline(always)]
pub(super) fn evaluate<R: Real, const D: usize, const P: usize>(
    table: &[R::Scalar],
    degree: usize,
    xi: R,
) -> [R; 3] {
    let degree = known(P, degree);
    let zero = xi.lit(0.0);
    let table = &table[..((degree + 1) * polynomials::<D>() - 1) * ROWS + 1];
    let mut v = splat(zero, table[0]);
    let (mut vx, mut vy) = (zero, zero);
    if D >= 1 {
        vy = splat(zero, table[ROWS]);
    }
    let mut k = 0;
    let mut at = 0;
    while k < degree {
        k += 1;
        at += polynomials::<D>() * ROWS;
        v = v.mul_add(xi, splat(zero, table[at]));
        if D >= 1 {
            vy = vy.mul_add(xi, splat(zero, table[at + ROWS]));
            vx = if k == 1 {
                splat(zero, table[at + 2 * ROWS])
            } else {
                vx.mul_add(xi, splat(zero, table[at + 2 * ROWS]))
            };
        }
    }
    [v, vx, vy]
}

/// A number in every lane.
#[inline(always)]
pub(super) fn splat<R: Real>(like: R, value: R::Scalar) -> R {
    like.lit(value.to_f64())
}
