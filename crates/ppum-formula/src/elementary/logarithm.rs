//! Logarithms: x = 2^e m with m near 1, and log m = 2 artanh s with s = (m − 1)/(m + 1).

use super::pair::{product, product_of_pairs, sum};
use super::{LN_2, polynomial};
use crate::real::Double;

/// (2 artanh √z / √z − 2) / z for z ≤ (3 − √8)²
const LOG: [f64; 7] = [
    0.666_666_666_666_673_4,
    0.399_999_999_994_144,
    0.285_714_287_424_576_66,
    0.222_221_985_652_891_97,
    0.181_835_647_700_816_23,
    0.153_140_383_938_400_32,
    0.147_960_788_842_788_38,
];

/// (artanh √z / √z − 1 − z/3) / z² there
const ARTANH: [f64; 7] = [
    0.200_000_000_000_011_28,
    0.142_857_142_850_497_03,
    0.111_111_112_599_742_31,
    0.090_908_921_825_977_76,
    0.076_933_787_041_467_79,
    0.066_284_080_897_434_66,
    0.065_981_707_339_906_24,
];

const THIRD: [f64; 2] = [1.0 / 3.0, 1.850_371_707_708_594e-17];

/// log₁₀ 2, the first part with 32 bits.
const LOG10_2: [f64; 2] = [0.301_029_995_549_470_2, 1.145_110_089_802_183_8e-10];

const LOG10_E: [f64; 2] = [std::f64::consts::LOG10_E, 1.098_319_650_216_765e-17];

/// e and m − 1 of a positive number 2^e m, ½√2 ≤ m ≤ √2.
#[inline(always)]
fn parts<R: Double>(x: R) -> [R; 2] {
    let (zero, one, half) = (x.broadcast(0.0), x.broadcast(1.0), x.broadcast(0.5));
    let tiny = x.broadcast(1e-300).gt(x);
    let scaled = R::select(tiny, x * x.broadcast(f64::from_bits(0x4350_0000_0000_0000)), x);
    let e = scaled.exponent();
    // 2^−e itself may be no normal number
    let m = scaled * half * (one - e).power_of_two();
    let large = m.gt(x.broadcast(std::f64::consts::SQRT_2));
    let e = e + R::select(large, one, zero) - R::select(tiny, x.broadcast(54.0), zero);
    [e, R::select(large, m * half, m) - one]
}

/// The value of a logarithm found for positive finite numbers, at any x.
#[inline(always)]
fn everywhere<R: Double>(value: R, x: R) -> R {
    let (zero, infinity) = (x.broadcast(0.0), x.broadcast(f64::INFINITY));
    let outside = R::select(x.ge(zero), -infinity, x.broadcast(f64::NAN));
    R::select(x.gt(zero), R::select(infinity.gt(x), value, x), outside)
}

/// The natural logarithm.
#[inline(always)]
pub(super) fn log<R: Double>(x: R) -> R {
    let [e, f] = parts(x);
    let s = f / (x.broadcast(2.0) + f);
    let z = s * s;
    let half_square = x.broadcast(0.5) * f * f;
    // 2s = f − s f, and s f = f²/2 − s f²/2
    let rest = s * (half_square + z * polynomial(z, LOG)) + e * x.broadcast(LN_2[1]);
    let value = e * x.broadcast(LN_2[0]) - ((half_square - rest) - f);
    everywhere(value, x)
}

/// The logarithm to base 10.
#[inline(always)]
pub(super) fn log10<R: Double>(x: R) -> R {
    let [e, f] = parts(x);
    let of_e = [x.broadcast(LOG10_E[0]), x.broadcast(LOG10_E[1])];
    let [high, low] = product_of_pairs(log_of_sum(f), of_e);
    let [high, rest] = sum(e * x.broadcast(LOG10_2[0]), high);
    everywhere(high + (rest + (low + e * x.broadcast(LOG10_2[1]))), x)
}

/// The natural logarithm of a positive finite number as a pair, to 2⁻⁶³ of it.
#[inline(always)]
pub(super) fn log_pair<R: Double>(x: R) -> [R; 2] {
    let [e, f] = parts(x);
    let [near, low] = log_of_sum(f);
    let [high, rest] = sum(e * x.broadcast(LN_2[0]), near);
    sum(high, rest + (low + e * x.broadcast(LN_2[1])))
}

/// log(1 + f) as a pair.
#[inline(always)]
fn log_of_sum<R: Double>(f: R) -> [R; 2] {
    let one = f.broadcast(1.0);
    let below = sum(f.broadcast(2.0), f);
    let inverse = one / below[0];
    let quotient = f * inverse;
    let [back, lost] = product(quotient, below[0]);
    let s = [quotient, (((f - back) - lost) - quotient * below[1]) * inverse];
    let z = product_of_pairs(s, s);
    let [high, low] = sum(f.broadcast(THIRD[0]), z[0] * polynomial(z[0], ARTANH));
    let w = product_of_pairs(z, [high, low + f.broadcast(THIRD[1])]);
    let more = product_of_pairs(s, w);
    let [high, low] = sum(s[0], more[0]);
    let two = f.broadcast(2.0);
    [high * two, (low + (more[1] + s[1])) * two]
}
