//! A patch on a column of vectors: weight × polynomial in x collapses to polynomials in y.
//!
//! At a vector of columns ξ is fixed, and with the weight's factor a(ξ)
//!
//! ```text
//! W p = b(η) Σ_j A_j η^j     A_j = a Σ_k c_kj ξ^k     B_j = ∂A_j/∂x
//! ```
//!
//! whose coefficients are vectors, on rows then taken with one η each: no lane is wasted on rows.

use ppum::dataset::monomials;
use ppum::jet::Jet;
use ppum::real::{LaneNumber, Real};

use crate::rows::BAND;

/// Rows of a tile: whole vectors of lanes.
pub(super) const ROWS: usize = BAND as usize;

/// Numbers of a jet.
#[inline(always)]
pub(super) const fn numbers<const D: usize>() -> usize {
    1 + 2 * D
}

/// Length of a block's table: A, and with derivatives B.
#[inline(always)]
pub(super) const fn table_len<R: Real, const D: usize>(degree: usize) -> usize {
    (degree + 1) * (1 + D) * R::LANES
}

/// A factor of the weight and its derivative in the world.
#[derive(Clone, Copy)]
pub(super) struct WeightFactor<R> {
    pub(super) value: R,
    pub(super) slope: R,
}

/// A value with its derivatives by x and y.
#[derive(Clone, Copy)]
pub(super) struct Slopes<R> {
    pub(super) v: R,
    pub(super) x: R,
    pub(super) y: R,
}

impl<R: Real> Slopes<R> {
    #[inline(always)]
    pub(super) fn constant(v: R) -> Self {
        let zero = v.broadcast(0.0);
        Self { v, x: zero, y: zero }
    }

    #[inline(always)]
    pub(super) fn from_jet(jet: Jet<R>) -> Self {
        Self { v: jet.v, x: jet.x, y: jet.y }
    }

    /// Quotient by the quotient rule.
    #[inline(always)]
    pub(super) fn over<const D: usize>(self, b: Self) -> Self {
        let inverse = b.v.broadcast(1.0) / b.v;
        let mut out = Self::constant(self.v * inverse);
        if D >= 1 {
            out.x = (self.x - out.v * b.x) * inverse;
            out.y = (self.y - out.v * b.y) * inverse;
        }
        out
    }
}

/// A number known only at run time, where a constant is asked for.
pub(super) const ANY: usize = usize::MAX;

/// `constant` unless it is [`ANY`]: loops up to a constant unroll.
#[inline(always)]
pub(super) const fn constant_or(constant: usize, number: usize) -> usize {
    if constant == ANY { number } else { constant }
}

/// [`collapse_degree`] with the common degrees as constants.
#[inline(always)]
pub(super) fn collapse<R: Real, const D: usize, const ADD: bool>(
    coefficients: &[R::Scalar],
    degree: usize,
    across: &Across<R>,
    table: &mut [R::Scalar],
) {
    match degree {
        0 => collapse_degree::<R, D, 0, ADD>(coefficients, degree, across, table),
        1 => collapse_degree::<R, D, 1, ADD>(coefficients, degree, across, table),
        2 => collapse_degree::<R, D, 2, ADD>(coefficients, degree, across, table),
        3 => collapse_degree::<R, D, 3, ADD>(coefficients, degree, across, table),
        _ => collapse_degree::<R, D, ANY, ADD>(coefficients, degree, across, table),
    }
}

/// A patch at a vector of columns.
pub(super) struct Across<R> {
    /// Coordinate ξ of the polynomials.
    pub(super) xi: R,
    /// Factor of the weight.
    pub(super) factor: WeightFactor<R>,
    /// The factor, for slopes by ξ.
    pub(super) scaled: R,
}

/// Writes the table of one block, or adds to it: for j from the degree down to 0 the vectors A_j
/// and B_j.
#[inline(always)]
fn collapse_degree<R: Real, const D: usize, const P: usize, const ADD: bool>(
    coefficients: &[R::Scalar],
    degree: usize,
    across: &Across<R>,
    table: &mut [R::Scalar],
) {
    let degree = constant_or(P, degree);
    let coefficients = &coefficients[..monomials(degree)];
    let table = &mut table[..table_len::<R, D>(degree)];
    let mut j = degree + 1;
    let mut at = 0;
    while j > 0 {
        j -= 1;
        let [a, b] = inner::<R, D>(coefficients, degree, j, across.xi);
        put::<R, ADD>(across.factor.value, a, &mut table[at..]);
        if D >= 1 {
            let slope = across.factor.slope * a;
            let slope = if j == degree { slope } else { across.scaled.mul_add(b, slope) };
            put_sum::<R, ADD>(slope, &mut table[at + R::LANES..]);
        }
        at += (1 + D) * R::LANES;
    }
}

/// Σ_k c_kj ξ^k and its derivative by ξ, by Horner's scheme.
#[inline(always)]
fn inner<R: Real, const D: usize>(c: &[R::Scalar], degree: usize, j: usize, xi: R) -> [R; 2] {
    let last = degree - j;
    let (mut a, mut b) = (fill_lanes(xi, c[monomials(degree) - 1 - last]), xi.broadcast(0.0));
    let mut k = last;
    while k > 0 {
        if D >= 1 {
            b = if k == last { a } else { b.mul_add(xi, a) };
        }
        k -= 1;
        a = a.mul_add(xi, fill_lanes(xi, c[monomials(j + k) - 1 - k]));
    }
    [a, b]
}

/// A block of `C` components at a row of a vector of columns: of each Σ A_j η^j and its derivatives
/// by x and y. `P` is the degree or [`ANY`].
#[inline(always)]
pub(super) fn evaluate<R: Real, const D: usize, const P: usize, const C: usize>(
    tables: [&[R::Scalar]; C],
    degree: usize,
    eta: R,
    scale: R,
) -> [Slopes<R>; C] {
    let degree = constant_or(P, degree);
    let mut v = [Slopes::constant(eta.broadcast(0.0)); C];
    let (mut at, mut j) = (0, 0);
    while j <= degree {
        let mut c = 0;
        while c < C {
            let table = &tables[c][at..];
            if D >= 1 {
                v[c].y = if j <= 1 { v[c].v } else { v[c].y.mul_add(eta, v[c].v) };
                v[c].x = next(j, v[c].x, eta, eta.load(&table[R::LANES..]));
            }
            v[c].v = next(j, v[c].v, eta, eta.load(table));
            c += 1;
        }
        at += (1 + D) * R::LANES;
        j += 1;
    }
    let mut c = 0;
    while D >= 1 && degree >= 1 && c < C {
        v[c].y = v[c].y * scale;
        c += 1;
    }
    v
}

/// A step of Horner's scheme; the first takes the coefficient.
#[inline(always)]
fn next<R: Real>(j: usize, value: R, eta: R, coefficient: R) -> R {
    if j == 0 { coefficient } else { value.mul_add(eta, coefficient) }
}

/// Writes a product, or adds it.
#[inline(always)]
pub(super) fn put<R: Real, const ADD: bool>(a: R, b: R, to: &mut [R::Scalar]) {
    let value = if ADD { a.mul_add(b, a.load(to)) } else { a * b };
    value.store(to);
}

/// Writes, or adds.
#[inline(always)]
pub(super) fn put_sum<R: Real, const ADD: bool>(value: R, to: &mut [R::Scalar]) {
    let value = if ADD { value + value.load(to) } else { value };
    value.store(to);
}

/// A number in every lane.
#[inline(always)]
pub(super) fn fill_lanes<R: Real>(like: R, value: R::Scalar) -> R {
    like.broadcast(value.to_f64())
}
