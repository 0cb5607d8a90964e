//! Double-double arithmetic: a number as the unevaluated sum of two f64, some 31 digits.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The number `high` + `low`, |low| ≤ ½ ulp(high).
///
/// Sums and products after Joldeș, Muller and Popescu (2017), relative errors below 2⁻¹⁰².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// The exact sum of two f64 (Knuth).
    #[must_use]
    pub fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let part = high - a;
        Self { high, low: (a - (high - part)) + (b - part) }
    }

    /// The exact product of two f64.
    #[must_use]
    pub fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        Self { high, low: a.mul_add(b, -high) }
    }

    /// Square root of a number ≥ 0, by one step of Newton's method.
    #[must_use]
    pub fn sqrt(self) -> Self {
        if self.high == 0.0 {
            return self;
        }
        let root = self.high.sqrt();
        let rest = self - Self::product(root, root);
        Self::sum(root, rest.high / (2.0 * root))
    }

    /// The nearest f64.
    #[must_use]
    pub fn to_f64(self) -> f64 {
        self.high
    }
}

impl From<f64> for DoubleDouble {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

/// Operators of a type by their values: `Add add |a, b| a plus b;`.
macro_rules! operators {
    ($type:ty: $($trait:ident $method:ident |$a:ident $(, $b:ident: $other:ty)?| $value:expr;)+) => {$(
        impl $trait $(<$other>)? for $type {
            type Output = Self;

            fn $method(self $(, $b: $other)?) -> Self {
                let $a = self;
                $value
            }
        }
    )+};
}
pub(super) use operators;

operators! {
    DoubleDouble:
    Add add |a, b: DoubleDouble| {
        let (high, low) = (Self::sum(a.high, b.high), Self::sum(a.low, b.low));
        let first = Self::sum(high.high, high.low + low.high);
        Self::sum(first.high, low.low + first.low)
    };
    Neg neg |a| Self { high: -a.high, low: -a.low };
    Sub sub |a, b: DoubleDouble| a + -b;
    Mul mul |a, b: DoubleDouble| {
        let p = Self::product(a.high, b.high);
        Self::sum(p.high, p.low + (a.high * b.low + a.low * b.high))
    };
    // long division: three digits of 53 bits
    Div div |a, b: DoubleDouble| {
        let first = a.high / b.high;
        let rest = a - b * first;
        let second = rest.high / b.high;
        let third = (rest - b * second).high / b.high;
        Self::sum(first, second) + third
    };
    Add add |a, b: f64| a + Self::from(b);
    Sub sub |a, b: f64| a - Self::from(b);
    Mul mul |a, b: f64| a * Self::from(b);
    Div div |a, b: f64| a / Self::from(b);
}

impl PartialOrd for DoubleDouble {
    fn partial_cmp(&self, b: &Self) -> Option<Ordering> {
        (*self - *b).high.partial_cmp(&0.0)
    }
}

impl PartialEq<f64> for DoubleDouble {
    fn eq(&self, b: &f64) -> bool {
        *self == Self::from(*b)
    }
}

impl PartialOrd<f64> for DoubleDouble {
    fn partial_cmp(&self, b: &f64) -> Option<Ordering> {
        self.partial_cmp(&Self::from(*b))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::SQRT_2;

    /// Errors seen through identities of integers.
    #[test]
    fn thirty_digits() {
        for k in 1..500 {
            let (a, b) =
                (DoubleDouble::from(f64::from(k)), DoubleDouble::from(f64::from(3 * k + 1)));
            assert!((((a / b) * b - a) / a).to_f64().abs() < 1e-31);
            assert!(((b.sqrt() * b.sqrt() - b) / b).to_f64().abs() < 1e-30);
            assert!(((a / b + b / a - (a * a + b * b) / (a * b)) * a / b).to_f64().abs() < 1e-31);
        }
        // √2 = 1.41421356237309504880168872420969807856967…
        let tail = DoubleDouble::from(2.0).sqrt() - SQRT_2;
        assert!((tail.to_f64() + 9.667_293_313_452_913e-17).abs() < 1e-31);
    }
}
