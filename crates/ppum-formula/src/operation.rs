//! The operations of formulas on numbers: the meaning that every back end has to reproduce.

use crate::elementary;
use crate::real::DoubleFunction as _;

/// Functions of one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Unary {
    Neg,
    Sqrt,
    Cbrt,
    Exp,
    /// Natural logarithm.
    Log,
    Log10,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Abs,
    /// −1, 0 or +1.
    Sign,
    Floor,
}

impl Unary {
    /// The value at `a`.
    pub(crate) fn apply(self, a: f64) -> f64 {
        match self {
            Self::Neg => -a,
            Self::Sqrt => a.sqrt(),
            Self::Cbrt => elementary::Cbrt.apply([a]),
            Self::Exp => elementary::Exp.apply([a]),
            Self::Log => elementary::Log.apply([a]),
            Self::Log10 => elementary::Log10.apply([a]),
            Self::Sin => elementary::Sin.apply([a]),
            Self::Cos => elementary::Cos.apply([a]),
            Self::Tan => elementary::Tan.apply([a]),
            Self::Asin => elementary::Asin.apply([a]),
            Self::Acos => elementary::Acos.apply([a]),
            Self::Atan => elementary::Atan.apply([a]),
            Self::Sinh => elementary::Sinh.apply([a]),
            Self::Cosh => elementary::Cosh.apply([a]),
            Self::Tanh => elementary::Tanh.apply([a]),
            Self::Abs => a.abs(),
            Self::Sign => sign(a),
            Self::Floor => a.floor(),
        }
    }
}

/// −1, 0 or +1; NaN of NaN.
fn sign(a: f64) -> f64 {
    if a > 0.0 {
        1.0
    } else if a < 0.0 {
        -1.0
    } else {
        a
    }
}

/// Functions of two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Binary {
    Add,
    Sub,
    Mul,
    Div,
    Pow,
    /// Angle of the point (b, a), as in `atan2(y, x)`.
    Atan2,
    Min,
    Max,
    /// √(a² + b²) without overflow.
    Hypot,
}

impl Binary {
    /// The value at `(a, b)`. Unlike those of std, `min` and `max` hand NaN on.
    pub(crate) fn apply(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Add => a + b,
            Self::Sub => a - b,
            Self::Mul => a * b,
            Self::Div => a / b,
            Self::Pow => elementary::Pow.apply([a, b]),
            Self::Atan2 => elementary::Atan2.apply([a, b]),
            Self::Min if a < b || a.is_nan() => a,
            Self::Max if a > b || a.is_nan() => a,
            Self::Min | Self::Max => b,
            Self::Hypot => elementary::Hypot.apply([a, b]),
        }
    }
}

/// Comparisons; the others are these with exchanged operands or negated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Comparison {
    Less,
    LessEqual,
    Equal,
}

impl Comparison {
    /// The operator, in formulas and in WGSL.
    pub(crate) fn symbol(self) -> &'static str {
        match self {
            Self::Less => "<",
            Self::LessEqual => "<=",
            Self::Equal => "==",
        }
    }

    /// Whether it holds; never for NaN.
    #[expect(clippy::float_cmp, reason = "`==` of formulas is exact")]
    pub(crate) fn holds(self, a: f64, b: f64) -> bool {
        match self {
            Self::Less => a < b,
            Self::LessEqual => a <= b,
            Self::Equal => a == b,
        }
    }
}

/// aⁿ by repeated squaring: the same products in every back end.
pub(crate) fn power(a: f64, n: i32) -> f64 {
    let (mut square, mut rest, mut product) = (a, n.unsigned_abs(), 1.0);
    while rest > 0 {
        if rest & 1 == 1 {
            product *= square;
        }
        square *= square;
        rest >>= 1;
    }
    if n < 0 { 1.0 / product } else { product }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integer_powers() {
        for n in -16..=16 {
            for a in [-2.5, -1.0, 0.3, 1.7] {
                let expected = f64::powf(a, f64::from(n));
                assert!((power(a, n) - expected).abs() <= 4e-15 * expected.abs(), "{a}^{n}");
            }
        }
        assert_eq!(power(0.0, -1), f64::INFINITY);
        assert_eq!(power(f64::NAN, 0), 1.0);
    }

    #[test]
    fn extrema_hand_nan_on() {
        for op in [Binary::Min, Binary::Max] {
            assert!(op.apply(f64::NAN, 1.0).is_nan());
            assert!(op.apply(1.0, f64::NAN).is_nan());
        }
        assert_eq!(Binary::Min.apply(1.0, 2.0), 1.0);
        assert_eq!(Binary::Max.apply(1.0, 2.0), 2.0);
    }
}
