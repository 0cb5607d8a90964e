//! The operations of formulas on numbers: the meaning that every back end has to reproduce.

use crate::elementary;
use crate::real::DoubleFunction as _;

/// Operations with their texts and their values: functions have names, others a sign.
macro_rules! operations {
    ($(#[$about:meta])* $type:ident $arguments:tt {
        $($(#[$doc:meta])* $name:ident $text:literal = $value:expr;)+
    }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub(crate) enum $type { $($(#[$doc])* $name),+ }

        impl $type {
            /// All of them.
            pub(crate) const ALL: &'static [Self] = &[$(Self::$name),+];

            /// Name or sign, in formulas and in WGSL.
            pub(crate) fn text(self) -> &'static str {
                match self { $(Self::$name => $text),+ }
            }
        }

        operations!(@apply $type $arguments $($name = $value;)+);
    };
    (@apply $type:ident [$($a:ident),+] $($name:ident = $value:expr;)+) => {
        impl $type {
            /// The value. Unlike those of std, `min` and `max` hand NaN on.
            pub(crate) fn apply(self, $($a: f64),+) -> f64 {
                match self { $(Self::$name => $value),+ }
            }
        }
    };
}

operations! {
    /// Functions of one number.
    Unary [a] {
        Neg "-" = -a;
        Sqrt "sqrt" = a.sqrt();
        Cbrt "cbrt" = elementary::Cbrt.apply([a]);
        Exp "exp" = elementary::Exp.apply([a]);
        /// Natural logarithm.
        Log "log" = elementary::Log.apply([a]);
        Log10 "log10" = elementary::Log10.apply([a]);
        Sin "sin" = elementary::Sin.apply([a]);
        Cos "cos" = elementary::Cos.apply([a]);
        Tan "tan" = elementary::Tan.apply([a]);
        Asin "asin" = elementary::Asin.apply([a]);
        Acos "acos" = elementary::Acos.apply([a]);
        Atan "atan" = elementary::Atan.apply([a]);
        Sinh "sinh" = elementary::Sinh.apply([a]);
        Cosh "cosh" = elementary::Cosh.apply([a]);
        Tanh "tanh" = elementary::Tanh.apply([a]);
        Abs "abs" = a.abs();
        /// −1, 0 or +1; NaN of NaN.
        Sign "sign" = if a > 0.0 { 1.0 } else if a < 0.0 { -1.0 } else { a };
        Floor "floor" = a.floor();
    }
}

operations! {
    /// Functions of two numbers.
    Binary [a, b] {
        Add "+" = a + b;
        Sub "-" = a - b;
        Mul "*" = a * b;
        Div "/" = a / b;
        Pow "^" = elementary::Pow.apply([a, b]);
        /// Angle of the point (b, a), as in `atan2(y, x)`.
        Atan2 "atan2" = elementary::Atan2.apply([a, b]);
        Min "min" = if a < b || a.is_nan() { a } else { b };
        Max "max" = if a > b || a.is_nan() { a } else { b };
        /// √(a² + b²) without overflow.
        Hypot "hypot" = elementary::Hypot.apply([a, b]);
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
