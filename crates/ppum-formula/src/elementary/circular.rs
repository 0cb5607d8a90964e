//! Sine, cosine and tangent: x = n π/2 + r with a whole number n and |r| ≤ π/4, and polynomials
//! of r.

use super::pair::{quotient, sum};
use super::polynomial;
use super::remainder::{Quadrant, quadrant};
use crate::real::Double;

/// (sin √z / √z − 1) / z for z ≤ (π/4)²
const SIN: [f64; 6] = [
    -0.166_666_666_666_666_32,
    0.008_333_333_333_322_41,
    -0.000_198_412_698_298_050_24,
    2.755_731_369_091_826_7e-6,
    -2.505_075_795_347_243_7e-8,
    1.589_678_597_685_710_2e-10,
];

/// (cos √z − 1 + z/2) / z² there
const COS: [f64; 6] = [
    0.041_666_666_666_666_6,
    -0.001_388_888_888_887_412,
    2.480_158_728_947_937_6e-5,
    -2.755_731_435_148_426_6e-7,
    2.087_572_315_306_874e-9,
    -1.135_964_134_375_359e-11,
];

/// sin r and cos r as pairs, n modulo 4 from −2 to 2, and whether n is odd.
struct SinCos<R: Double> {
    sin: [R; 2],
    cos: [R; 2],
    n: R,
    is_odd: R::Mask,
}

#[inline(always)]
fn circle<R: Double>(x: R) -> SinCos<R> {
    let Quadrant { n, high, low } = quadrant(x);
    let (one, half) = (x.broadcast(1.0), x.broadcast(0.5));
    let z = high * high;
    let [near, rest] = sum(one, -(z * half));
    let sin = sum(high, high * z * polynomial(z, SIN) + low * near);
    let cos = sum(near, rest + (z * z * polynomial(z, COS) - high * low));
    SinCos { sin, cos, n, is_odd: half.ge((n.abs() - one).abs()) }
}

/// Sine.
#[inline(always)]
pub(super) fn sin<R: Double>(x: R) -> R {
    let SinCos { sin, cos, n, is_odd } = circle(x);
    let value = R::select(is_odd, cos[0], sin[0]);
    // quadrants 2, −2 and −1
    let negative = (n - n.broadcast(0.5)).abs().gt(n.broadcast(1.0));
    // of zero, whose sign is lost, and of NaN it is x
    R::select(x.abs().gt(x.broadcast(0.0)), R::select(negative, -value, value), x)
}

/// Cosine.
#[inline(always)]
pub(super) fn cos<R: Double>(x: R) -> R {
    let SinCos { sin, cos, n, is_odd } = circle(x);
    let value = R::select(is_odd, sin[0], cos[0]);
    // quadrants 1, 2 and −2
    let negative = (n + n.broadcast(0.5)).abs().gt(n.broadcast(1.0));
    R::select(negative, -value, value)
}

/// Tangent.
#[inline(always)]
pub(super) fn tan<R: Double>(x: R) -> R {
    let SinCos { sin, cos, is_odd, .. } = circle(x);
    let pick = |a: R, b: R| R::select(is_odd, a, b);
    let above = [pick(-cos[0], sin[0]), pick(-cos[1], sin[1])];
    let below = [pick(sin[0], cos[0]), pick(sin[1], cos[1])];
    let [high, low] = quotient(above, below);
    // the quotient's parts of the smallest numbers are none
    R::select(x.abs().gt(x.broadcast(1e-300)), high + low, x)
}
