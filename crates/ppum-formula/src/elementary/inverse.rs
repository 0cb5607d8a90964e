//! The inverse circular functions.

use super::pair::{halves, quotient, sum};
use super::polynomial;
use crate::real::Double;

/// (arctan √z / √z − 1) / z for z ≤ tan²(π/8)
const ARCTAN: [f64; 11] = [
    -0.333_333_333_333_332,
    0.199_999_999_999_540_7,
    -0.142_857_142_802_473_75,
    0.111_111_107_860_758_83,
    -0.090_908_978_345_457_29,
    0.076_920_616_014_433_63,
    -0.066_631_199_605_248_73,
    0.058_480_057_204_845_04,
    -0.050_398_306_435_115_54,
    0.038_077_932_326_746_4,
    -0.017_921_842_677_147_748,
];

/// (arcsin √z / √z − 1) / z for z ≤ ¼
const ARCSIN: [f64; 13] = [
    0.166_666_666_666_667_63,
    0.074_999_999_999_702_58,
    0.044_642_857_175_123_424,
    0.030_381_942_683_513_89,
    0.022_372_215_662_732_505,
    0.017_351_600_055_353_834,
    0.013_980_961_815_263_357,
    0.011_397_773_531_450_647,
    0.010_786_540_280_698_67,
    0.003_683_007_971_302_103_7,
    0.021_763_563_842_834_65,
    -0.021_077_360_994_078_09,
    0.032_676_919_960_004_665,
];

/// π/4, the first part with 50 bits: its product with 3 is exact.
const QUARTER: [f64; 2] = [std::f64::consts::FRAC_PI_4, 3.061616997868383e-17];

/// 2⁴⁰⁰
const POWER_400: f64 = f64::from_bits(0x58F0_0000_0000_0000);

/// tan(π/8) = √2 − 1
const TAN_EIGHTH: f64 = std::f64::consts::SQRT_2 - 1.0;

/// k π/4 + s arctan(t + low) for 0 ≤ |t| ≤ tan(π/8), s = ±1, k = 0 … 4.
#[inline(always)]
fn turned<R: Double>(k: R, s: R, [t, low]: [R; 2]) -> R {
    let z = t * t;
    let [high, rest] = sum(k * t.broadcast(QUARTER[0]), s * t);
    high + (rest + (s * (t * z * polynomial(z, ARCTAN) + low) + k * t.broadcast(QUARTER[1])))
}

/// The arc tangent, from −π/2 to π/2.
#[inline(always)]
pub(super) fn atan<R: Double>(x: R) -> R {
    let (one, a) = (x.broadcast(1.0), x.abs());
    // beyond it is π/2
    first_octants(x.broadcast(1e18).min(a), one, one).copysign(x)
}

/// The angle of the point (x, y), from −π to π.
#[inline(always)]
pub(super) fn atan2<R: Double>(y: R, x: R) -> R {
    let (zero, one) = (x.broadcast(0.0), x.broadcast(1.0));
    let (width, height) = (x.abs(), y.abs());
    // sums and their parts must be normal numbers; infinities of both are as far as each other
    let (up, down) = (x.broadcast(POWER_400), x.broadcast(1.0 / POWER_400));
    let longer = width.max(height);
    let large = R::select(longer.gt(x.broadcast(1e250)), down, one);
    let scale = R::select(x.broadcast(1e-200).gt(longer), up, large);
    let are_infinite = width.min(height).ge(x.broadcast(f64::INFINITY));
    let scaled = |a: R| R::select(are_infinite, one, a * scale);
    let (width, height) = (scaled(width), scaled(height));
    let side = R::select(zero.gt(one.copysign(x)), -one, one);
    let angle = first_octants(height, width, side);
    R::select(x.ge(x), R::select(y.ge(y), angle, y), x).copysign(y)
}

/// The angle of (x, y) with x, y ≥ 0, or of (−x, y) if `side` is −1: with a ≤ b the lengths, it is
/// π/4 − arctan((b − a)/(b + a)) or arctan(a/b) from one of the axes.
#[inline(always)]
fn first_octants<R: Double>(y: R, x: R, side: R) -> R {
    let (zero, one, two) = (x.broadcast(0.0), x.broadcast(1.0), x.broadcast(2.0));
    let is_steep = y.gt(x);
    let (a, b) = (R::select(is_steep, x, y), R::select(is_steep, y, x));
    let is_middle = a.gt(b * x.broadcast(TAN_EIGHTH));
    let pick = |m: R, n: R| R::select(is_middle, m, n);
    let (less, more) = (sum(-b, a), sum(b, a));
    let above = [pick(less[0], a), pick(less[1], zero)];
    let below = [pick(more[0], R::select(b.gt(zero), b, one)), pick(more[1], zero)];
    // octants from the axis ahead: of the angle, and the way it turns
    let k = pick(one, zero);
    let k = R::select(is_steep, two - k, k);
    let s = R::select(is_steep, -one, one);
    let [t, low] = quotient(above, below);
    // a quotient that small needs no more bits, nor has its rest any
    let low = R::select(t.abs().gt(x.broadcast(1e-60)), low, zero);
    turned(two - side * (two - k), s * side, [t, low])
}

/// √z and arcsin √z − √z for z ≤ ¼, where |x| ≤ ½ has z = x², and beyond 1 − |x| = 2z. The root is
/// a sum, its first part short.
struct RootAndArcsine<R: Double> {
    is_outer: R::Mask,
    high: R,
    rest: R,
}

#[inline(always)]
fn root<R: Double>(x: R) -> RootAndArcsine<R> {
    let (zero, one, half) = (x.broadcast(0.0), x.broadcast(1.0), x.broadcast(0.5));
    let a = x.abs();
    let is_outer = a.gt(half);
    let z = R::select(is_outer, (one - a) * half, a * a);
    let s = R::select(is_outer, z.sqrt(), a);
    let short = halves(s)[0];
    let lost = (z - short * short) / R::select(s.gt(zero), s + short, one);
    let high = R::select(is_outer, short, a);
    let rest = s * z * polynomial(z, ARCSIN) + R::select(is_outer, lost, zero);
    RootAndArcsine { is_outer, high, rest }
}

/// The arc sine: of |x| > ½ it is π/2 − 2 arcsin √((1 − |x|)/2).
#[inline(always)]
pub(super) fn asin<R: Double>(x: R) -> R {
    let (zero, one, two) = (x.broadcast(0.0), x.broadcast(1.0), x.broadcast(2.0));
    let RootAndArcsine { is_outer, high, rest } = root(x);
    let (k, s) = (R::select(is_outer, two, zero), R::select(is_outer, -two, one));
    quarters(k, s * high, s * rest).copysign(x)
}

/// The arc cosine: of |x| > ½ it is 2 arcsin √((1 − x)/2), or π less that of −x.
#[inline(always)]
pub(super) fn acos<R: Double>(x: R) -> R {
    let (zero, one, two, four) =
        (x.broadcast(0.0), x.broadcast(1.0), x.broadcast(2.0), x.broadcast(4.0));
    let RootAndArcsine { is_outer, high, rest } = root(x);
    let negative = zero.gt(x);
    let k = R::select(is_outer, R::select(negative, four, zero), two);
    let outer = R::select(negative, -two, two);
    let s = R::select(is_outer, outer, R::select(negative, one, -one));
    quarters(k, s * high, s * rest)
}

/// k π/4 + high + low
#[inline(always)]
fn quarters<R: Double>(k: R, high: R, rest: R) -> R {
    let [high, low] = sum(k * k.broadcast(QUARTER[0]), high);
    high + (low + (rest + k * k.broadcast(QUARTER[1])))
}
