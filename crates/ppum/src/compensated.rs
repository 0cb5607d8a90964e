//! Differences and products that carry their rounding errors (Dekker 1971, Shewchuk 1997).

use crate::vec2::Vec2;
use ppum_formula::real::Real;

/// A number as the sum of a rounded value and its rounding error.
pub(crate) type SumWithError = (f64, f64);

/// a − b.
#[inline(always)]
pub(crate) fn difference<R: Real>(a: R, b: R) -> (R, R) {
    let d = a - b;
    let bb = a - d;
    (d, (a - (d + bb)) + (bb - b))
}

/// u v of numbers, by their halves: not all processors fuse.
#[inline(always)]
pub(crate) fn exact_product<R: Real>(u: R, v: R) -> (R, R) {
    let ((a, b), (c, d), high) = (halves(u), halves(v), u * v);
    (high, b * d - (((high - a * c) - b * c) - a * d))
}

#[inline(always)]
fn halves<R: Real>(u: R) -> (R, R) {
    let wide = u.broadcast(134_217_729.0) * u;
    let high = wide - (wide - u);
    (high, u - high)
}

/// u v.
pub(crate) fn product(u: SumWithError, v: SumWithError) -> SumWithError {
    let (high, low) = exact_product(u.0, v.0);
    (high, low + (u.0 * v.1 + u.1 * v.0))
}

/// a + b of pairs.
pub(crate) fn plus(a: SumWithError, b: SumWithError) -> SumWithError {
    minus(a, (-b.0, -b.1))
}

/// a − b of pairs.
pub(crate) fn minus(a: SumWithError, b: SumWithError) -> SumWithError {
    let (high, low) = difference(a.0, b.0);
    (high, low + (a.1 - b.1))
}

/// (b − a) × (p − a), correctly rounded except for a last bit.
pub(crate) fn cross(a: Vec2, b: Vec2, p: Vec2) -> f64 {
    let (ux, uy) = (difference(b.x, a.x), difference(b.y, a.y));
    let (vx, vy) = (difference(p.x, a.x), difference(p.y, a.y));
    let (high, low) = minus(product(ux, vy), product(uy, vx));
    high + low
}

/// |p − center|² − radius², correctly rounded except for a last bit.
pub(crate) fn circle(center: Vec2, radius: f64, p: Vec2) -> f64 {
    let (dx, dy) = (difference(p.x, center.x), difference(p.y, center.y));
    let (yy, rr) = (product(dy, dy), product((radius, 0.0), (radius, 0.0)));
    let (high, low) = minus(minus(product(dx, dx), rr), (-yy.0, -yy.1));
    high + low
}

/// (1 − β²) (b − a) × (p − a) + 2β (p − a)·(b − p), correctly rounded except for a last bit: zero
/// on the circle of an arc from a to b with the bulge β, positive on its left.
pub(crate) fn arc(a: Vec2, b: Vec2, bulge: f64, p: Vec2) -> f64 {
    let between = |a: Vec2, b: Vec2| (difference(b.x, a.x), difference(b.y, a.y));
    let ((dx, dy), (ux, uy), (vx, vy)) = (between(a, b), between(a, p), between(p, b));
    let cross = minus(product(dx, uy), product(dy, ux));
    let dot = plus(product(ux, vx), product(uy, vy));
    let (square, twice) = (exact_product(bulge, bulge), (2.0 * bulge, 0.0));
    let (high, low) = plus(product(minus((1.0, 0.0), square), cross), product(twice, dot));
    high + low
}

/// b² − 4 a c as a pair.
pub(crate) fn discriminant(a: f64, b: f64, c: f64) -> SumWithError {
    minus(exact_product(b, b), exact_product(4.0 * a, c))
}
