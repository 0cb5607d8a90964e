//! e^x and the hyperbolic functions.
//!
//! x = k ln 2 + r with a whole number k and |r| ≤ ½ ln 2; of r the even and the odd part of the
//! exponential function, cosh r − 1 and sinh r.

use super::pair::{halves, quotient, sum};
use super::{LN_2, polynomial, whole};
use crate::real::Double;

/// (sinh √z / √z − 1) / z for z ≤ (½ ln 2)²
const SINH: [f64; 5] = [
    0.166_666_666_666_666_77,
    0.008_333_333_333_321_617,
    0.000_198_412_698_861_539_54,
    2.755_724_418_720_604_4e-6,
    2.510_904_282_673_966_6e-8,
];

/// (cosh √z − 1 − z/2) / z² there
const COSH: [f64; 5] = [
    0.041_666_666_666_666_685,
    0.001_388_888_888_887_346_3,
    2.480_158_734_879_021e-5,
    2.755_725_220_972_17e-7,
    2.092_163_928_755_928_5e-9,
];

/// A number x = k ln 2 + r.
pub(super) struct ReducedArgument<R> {
    /// k
    pub(super) k: R,
    /// r to 53 bits.
    pub(super) r: R,
    /// sinh r − r, r being known to more than its bits.
    pub(super) odd: R,
    /// cosh r − 1
    pub(super) even: R,
}

/// Reduces x + `low`, of a magnitude below 2²⁰.
#[inline(always)]
pub(super) fn reduce<R: Double>(x: R, low: R) -> ReducedArgument<R> {
    let k = whole(x * x.broadcast(std::f64::consts::LOG2_E));
    let near = x - k * x.broadcast(LN_2[0]);
    let rest = low - k * x.broadcast(LN_2[1]);
    let [r, low] = sum(near, rest);
    let z = r * r;
    let even = z * (x.broadcast(0.5) + z * polynomial(z, COSH));
    // what r lacks counts with the derivative, cosh r
    let odd = r * z * polynomial(z, SINH) + (low + low * even);
    ReducedArgument { k, r, odd, even }
}

/// `x` within ±`limit`, NaN as it is.
#[inline(always)]
fn within<R: Double>(x: R, limit: f64) -> R {
    x.broadcast(limit).min(x.broadcast(-limit).max(x))
}

/// e^x
#[inline(always)]
pub(super) fn exp<R: Double>(x: R) -> R {
    let zero = x.broadcast(0.0);
    exp_of_sum(x, zero)
}

/// e^(x + low), `low` being a correction of x.
#[inline(always)]
pub(super) fn exp_of_sum<R: Double>(x: R, low: R) -> R {
    // beyond ±760 the result is 0 or ∞
    let ReducedArgument { k, r, odd, even } = reduce(within(x, 760.0), low);
    let [high, low] = sum(x.broadcast(1.0), r);
    let value = high + (low + (even + odd));
    // in two steps, for results that are no normal numbers
    let half = whole(k * x.broadcast(0.5));
    value * half.power_of_two() * (k - half).power_of_two()
}

/// An eighth of 2^k + 2^−k and of 2^k − 2^−k, as pairs.
#[inline(always)]
fn powers<R: Double>(k: R) -> [[R; 2]; 2] {
    let (zero, one, three, least) =
        (k.broadcast(0.0), k.broadcast(1.0), k.broadcast(3.0), k.broadcast(-1022.0));
    let size = k.abs();
    let (up, down) = ((size - three).power_of_two(), least.max(-size - three).power_of_two());
    let side = R::select(zero.gt(k), -one, one);
    [sum(up, down), sum(up, -down).map(|part| side * part)]
}

/// sinh x = sinh(k ln 2) cosh r + cosh(k ln 2) sinh r
#[inline(always)]
pub(super) fn sinh<R: Double>(x: R) -> R {
    let ReducedArgument { k, r, odd, even } = reduce(within(x, 711.0), x.broadcast(0.0));
    let [[c, _], [s, s_low]] = powers(k);
    // c is short where s is no larger
    let [short, more] = halves(r);
    let [high, low] = sum(s, c * short);
    let value = high + (low + (s_low + (s * even + c * (odd + more))));
    // the eighth of the smallest numbers is none; of zero and of NaN it is x
    R::select(x.abs().gt(x.broadcast(1e-300)), value * x.broadcast(4.0), x)
}

/// cosh x = cosh(k ln 2) cosh r + sinh(k ln 2) sinh r
#[inline(always)]
pub(super) fn cosh<R: Double>(x: R) -> R {
    let ReducedArgument { k, r, odd, even } = reduce(within(x, 711.0), x.broadcast(0.0));
    let [[c, c_low], [s, _]] = powers(k);
    let [high, low] = sum(c, s * r);
    let value = high + (low + (c_low + (c * even + s * odd)));
    value * x.broadcast(4.0)
}

/// tanh x = e / (e + 2) with e = e^2x − 1
#[inline(always)]
pub(super) fn tanh<R: Double>(x: R) -> R {
    let (one, two) = (x.broadcast(1.0), x.broadcast(2.0));
    // from 22 on it is 1
    let ReducedArgument { k, r, odd, even } = reduce(within(x.abs(), 22.0) * two, x.broadcast(0.0));
    let power = k.power_of_two();
    let [high, low] = sum(power - one, power * r);
    let rest = low + power * (even + odd);
    let e = sum(high, rest);
    let [below, more] = sum(e[0].max(two), e[0].min(two));
    let [high, low] = quotient(e, [below, more + e[1]]);
    R::select(x.abs().gt(x.broadcast(1e-300)), high + low, x).copysign(x)
}
