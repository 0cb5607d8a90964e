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
use ppum::jet::Jet;
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
pub(super) fn collapse<R: Real, const D: usize, const ADD: bool>(
    coefficients: &[f64],
    degree: usize,
    shift: f64,
    rows: &Rows<R>,
    table: &mut [R::Scalar],
) {
    match degree {
        0 => collapse_degree::<R, D, 0, ADD>(coefficients, degree, shift, rows, table),
        1 => collapse_degree::<R, D, 1, ADD>(coefficients, degree, shift, rows, table),
        2 => collapse_degree::<R, D, 2, ADD>(coefficients, degree, shift, rows, table),
        3 => collapse_degree::<R, D, 3, ADD>(coefficients, degree, shift, rows, table),
        _ => collapse_degree::<R, D, ANY, ADD>(coefficients, degree, shift, rows, table),
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

/// Writes the table of one block, or adds to it: for k from the degree down to 0 the lanes of A_k, B_k and D_k.
///
/// `shift` is subtracted from the constant coefficient.
#[inline(always)]
fn collapse_degree<R: Real, const D: usize, const P: usize, const ADD: bool>(
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
        put::<R, ADD>(weighted, &mut table[at..]);
        if D >= 1 {
            put::<R, ADD>(rows.factor.slope.mul_add(a, scaled * b), &mut table[at + ROWS..]);
            if k > 0 {
                let slope = weighted * rows.eta.lit(k as f64 * rows.scale[0]);
                put::<R, ADD>(slope, &mut table[at + 5 * ROWS..]);
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

/// A block of `C` components on lanes of columns: of each Σ A_k ξ^k and its derivatives by x and y. Its tables have the
/// row at `row`; `P` is the degree or [`ANY`].
#[inline(always)]
pub(super) fn evaluate<R: Real, const D: usize, const P: usize, const C: usize>(
    tables: [&[R::Scalar]; C],
    row: usize,
    degree: usize,
    xi: R,
) -> [Jet<R>; C] {
    let degree = known(P, degree);
    let mut v = [Jet::constant(xi.lit(0.0)); C];
    let (mut at, mut k) = (row, 0);
    while k <= degree {
        let mut c = 0;
        while c < C {
            let table = &tables[c][at..];
            v[c].v = next::<R>(k, v[c].v, xi, table[0]);
            if D >= 1 {
                v[c].y = next::<R>(k, v[c].y, xi, table[ROWS]);
                if k > 0 {
                    v[c].x = next::<R>(k - 1, v[c].x, xi, table[2 * ROWS]);
                }
            }
            c += 1;
        }
        at += polynomials::<D>() * ROWS;
        k += 1;
    }
    v
}

/// A step of Horner's scheme; the first takes the coefficient.
#[inline(always)]
fn next<R: Real>(k: usize, value: R, xi: R, coefficient: R::Scalar) -> R {
    let coefficient = splat(xi, coefficient);
    if k == 0 { coefficient } else { value.mul_add(xi, coefficient) }
}

/// Writes, or adds.
#[inline(always)]
pub(super) fn put<R: Real, const ADD: bool>(value: R, to: &mut [R::Scalar]) {
    let value = if ADD { value + value.load(to) } else { value };
    value.store(to);
}

/// A number in every lane.
#[inline(always)]
pub(super) fn splat<R: Real>(like: R, value: R::Scalar) -> R {
    like.lit(value.to_f64())
}
