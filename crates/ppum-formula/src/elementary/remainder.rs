//! The remainder of a division by π/2.

use std::ops::Neg as _;

use super::pair::{product_of_pairs, sum};
use super::whole;
use crate::real::Double;

/// x = n π/2 + r, |r| ≤ π/4.
pub(super) struct Quadrant<R> {
    /// n modulo 4, from −2 to 2.
    pub(super) n: R,
    /// r to 53 bits.
    pub(super) high: R,
    /// The part that r lacks.
    pub(super) low: R,
}

/// Up to there n has 16 bits.
const NEAR: f64 = 1e5;

/// π/2 in three parts, the first two of 37 bits: their products with n are exact.
const PARTS: [f64; 3] =
    [1.570_796_326_792_333_3, 2.563_344_151_583_955_8e-12, 1.056_299_906_698_742_8e-23];

/// The remainder of any number; NaN of what is not finite.
#[inline(always)]
pub(super) fn quadrant<R: Double>(x: R) -> Quadrant<R> {
    if R::any(x.abs().gt(x.broadcast(NEAR))) {
        let [n, high, low] = x.map_to(one);
        return Quadrant { n, high, low };
    }
    near(x)
}

#[cold]
#[inline(never)]
fn one(x: f64) -> [f64; 3] {
    let Quadrant { n, high, low } = if x.abs() > NEAR { far(x) } else { near(x) };
    [n, high, low]
}

#[inline(always)]
fn near<R: Double>(x: R) -> Quadrant<R> {
    let n = whole(x * x.broadcast(std::f64::consts::FRAC_2_PI));
    let first = x - n * x.broadcast(PARTS[0]);
    let second = n * x.broadcast(PARTS[1]);
    let middle = first - second;
    // what the difference has lost (Knuth)
    let back = middle - first;
    let lost = (first - (middle - back)) - (second + back);
    let [high, low] = sum(middle, lost - n * x.broadcast(PARTS[2]));
    Quadrant { n: n - x.broadcast(4.0) * whole(n * x.broadcast(0.25)), high, low }
}

/// 2/π after the binary point, and a word of zeros before it.
const TWO_OVER_PI: [u64; 20] = [
    0,
    0xa2f9_836e_4e44_1529,
    0xfc27_57d1_f534_ddc0,
    0xdb62_9599_3c43_9041,
    0xfe51_63ab_debb_c561,
    0xb724_6e3a_424d_d2e0,
    0x0649_2eea_09d1_921c,
    0xfe1d_eb1c_b129_a73e,
    0xe882_35f5_2ebb_4484,
    0xe99c_7026_b45f_7e41,
    0x3991_d639_8353_39f4,
    0x9c84_5f8b_bdf9_283b,
    0x1ff8_97ff_de05_980f,
    0xef2f_118b_5a0a_6d1f,
    0x6d36_7ecf_27cb_09b7,
    0x4f46_3f66_9e5f_ea2d,
    0x7527_bac7_ebe5_f17b,
    0x3d07_39f7_8a52_92ea,
    0x6bfb_5fb1_1f8d_5d08,
    0x5603_3046_fc7b_6bab,
];

/// The remainder of a large number m 2^q: of the bits of 2/π those are taken whose products with m
/// decide (Payne and Hanek 1983).
fn far(x: f64) -> Quadrant<f64> {
    if !x.is_finite() {
        return Quadrant { n: f64::NAN, high: f64::NAN, low: f64::NAN };
    }
    let bits = x.abs().to_bits();
    let m = bits & ((1 << 52) - 1) | 1 << 52;
    // The first bit after the point that counts is bit q − 1: what stands before gives multiples
    // of 4. The biased exponent is q + 1075, and the table begins 64 bits before the point.
    let turns = multiply(m, window((bits >> 52) as usize + 62 - 1075));
    let n = (turns[0] >> 62) + (turns[0] >> 61 & 1);
    let fraction = (u128::from(turns[0]) << 64 | u128::from(turns[1])) << 2;
    let fraction = (fraction | u128::from(turns[2] >> 62)).cast_signed();
    let half_pi = [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17];
    let [high, low] = product_of_pairs(to_pair(fraction.unsigned_abs()), half_pi);
    let [high, low] = sum(high, low);
    let sign = if fraction < 0 { -x.signum() } else { x.signum() };
    let n = [0.0, 1.0, 2.0, -1.0][n as usize % 4] * x.signum();
    Quadrant { n, high: high * sign, low: low * sign }
}

/// 192 bits of the table.
fn window(start: usize) -> [u64; 3] {
    let (word, shift) = (start / 64, start % 64);
    std::array::from_fn(|k| {
        let two = u128::from(TWO_OVER_PI[word + k]) << 64 | u128::from(TWO_OVER_PI[word + k + 1]);
        (two << shift >> 64) as u64
    })
}

/// m w modulo 2¹⁹², highest word first.
fn multiply(m: u64, w: [u64; 3]) -> [u64; 3] {
    let [high, middle, low] = w.map(|word| u128::from(m) * u128::from(word));
    let middle = middle + (low >> 64);
    let high = high + (middle >> 64);
    [high as u64, middle as u64, low as u64]
}

/// `fraction` / 2¹²⁸ to 106 bits.
fn to_pair(fraction: u128) -> [f64; 2] {
    let zeros = fraction.leading_zeros().min(127);
    let bits = fraction << zeros;
    let scale = f64::from(zeros).neg().power_of_two();
    let part = |shift: u32| (bits >> shift & ((1 << 53) - 1)) as f64;
    [part(75) * scale * 2f64.powi(-53), part(22) * scale * 2f64.powi(-106)]
}
