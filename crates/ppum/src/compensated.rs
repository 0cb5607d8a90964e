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
