//! x^y = e^(y log x), with a logarithm of more bits than the result.

use super::exponential::exp_of_sum;
use super::logarithm::log_pair;
use super::pair::product_of_pairs;
use crate::real::Double;

/// x^y, as IEEE 754 defines `pow`.
#[inline(always)]
pub(super) fn pow<R: Double>(x: R, y: R) -> R {
    let (zero, one, infinity) = (x.broadcast(0.0), x.broadcast(1.0), x.broadcast(f64::INFINITY));
    let size = x.abs();
    // from there on the result is 0 or ∞, unless x is 1
    let far = x.broadcast(1e19);
    let exponent = far.min((-far).max(y));
    let [high, low] = product_of_pairs(log_pair(size), [exponent, zero]);
    let low = R::select(x.broadcast(760.0).gt(high.abs()), low, zero);
    let value = with_sign(exp_of_sum(high, low), x, y);
    let is_finite = R::select(infinity.gt(size), R::select(infinity.gt(y.abs()), one, zero), zero);
    let is_usual = R::select(size.gt(zero), is_finite, zero);
    if R::any(zero.ge(is_usual)) {
        let (xs, ys, values) = (x.lanes(), y.lanes(), value.lanes());
        return x.with_lanes(|k| special(xs[k], ys[k]).unwrap_or(values[k]));
    }
    value
}

/// |x|^y with the sign of x^y; NaN where x < 0 and y is not whole.
#[inline(always)]
fn with_sign<R: Double>(value: R, x: R, y: R) -> R {
    let negative = x.broadcast(0.0).gt(x);
    if !R::any(negative) {
        return value;
    }
    let half = y * y.broadcast(0.5);
    let is_even = half.floor().ge(half);
    let signed = R::select(is_even, value, -value);
    R::select(negative, R::select(y.floor().ge(y), signed, x.broadcast(f64::NAN)), value)
}

/// x^y where one of them is zero, infinite or NaN.
#[cold]
fn special(x: f64, y: f64) -> Option<f64> {
    let size = x.abs();
    if size > 0.0 && size < f64::INFINITY && y.abs() < f64::INFINITY {
        return None;
    }
    let is_odd = y.abs() < 9e15 && (y * 0.5).floor() != y * 0.5 && y.floor() == y;
    Some(if y == 0.0 || x == 1.0 {
        1.0
    } else if x.is_nan() || y.is_nan() {
        f64::NAN
    } else if size == 1.0 {
        1.0
    } else {
        let result = if (size > 1.0) == (y > 0.0) { f64::INFINITY } else { 0.0 };
        if is_odd && x.is_sign_negative() { -result } else { result }
    })
}
