//! Elementary functions on vectors, right to two units in the last place of double precision.
//!
//! One text for all vectors and for one number: sums, products, quotients and roots alone, each
//! rounded as written, so that all instruction sets give the same bits and no library of the
//! platform is asked. Special arguments, such as those beyond 10⁵ of the circular functions or
//! powers of zero, are evaluated lane by lane, where a vector has such a lane.
//!
//! Polynomials are best approximations in the relative sense (Remez) of what stands beside them.
//! Constants that are needed to more than 53 bits are pairs; the first of a pair that multiplies
//! whole numbers is short enough for the product to be exact (Cody and Waite 1980).

mod circular;
mod exponential;
mod inverse;
mod logarithm;
mod pair;
mod power;
mod remainder;
mod root;
#[cfg(test)]
mod tests;

use crate::real::{Double, DoubleFunction};

/// The functions: their names and what computes them.
macro_rules! functions {
    ($($(#[$doc:meta])+ $name:ident = $module:ident::$function:ident [$($a:ident),+];)+) => {$(
        $(#[$doc])+
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl DoubleFunction<{ [$(stringify!($a)),+].len() }> for $name {
            #[inline(always)]
            fn apply<R: Double>(self, [$($a),+]: [R; [$(stringify!($a)),+].len()]) -> R {
                $module::$function($($a),+)
            }
        }
    )+};
}

functions! {
    /// e^a
    Exp = exponential::exp [a];
    /// Natural logarithm.
    Log = logarithm::log [a];
    /// Logarithm to base 10.
    Log10 = logarithm::log10 [a];
    /// Sine.
    Sin = circular::sin [a];
    /// Cosine.
    Cos = circular::cos [a];
    /// Tangent.
    Tan = circular::tan [a];
    /// Arc sine.
    Asin = inverse::asin [a];
    /// Arc cosine.
    Acos = inverse::acos [a];
    /// Arc tangent.
    Atan = inverse::atan [a];
    /// Hyperbolic sine.
    Sinh = exponential::sinh [a];
    /// Hyperbolic cosine.
    Cosh = exponential::cosh [a];
    /// Hyperbolic tangent.
    Tanh = exponential::tanh [a];
    /// Cube root.
    Cbrt = root::cbrt [a];
    /// a^b
    Pow = power::pow [a, b];
    /// Angle of the point (b, a).
    Atan2 = inverse::atan2 [a, b];
    /// √(a² + b²)
    Hypot = root::hypot [a, b];
}

/// ln 2, the first part with 32 bits.
const LN_2: [f64; 2] = [0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10];

/// The polynomial with the given coefficients, constant first: even and odd powers apart, which
/// halves the way through.
#[inline(always)]
fn polynomial<R: Double, const N: usize>(x: R, c: [f64; N]) -> R {
    let square = x * x;
    let mut sums = [x.broadcast(c[N - 2]), x.broadcast(c[N - 1])];
    let mut k = N - 2;
    while k >= 2 {
        k -= 2;
        sums = [sums[0] * square + x.broadcast(c[k]), sums[1] * square + x.broadcast(c[k + 1])];
    }
    let sum = sums[0] + sums[1] * x;
    if k == 0 { sum } else { sum * x + x.broadcast(c[0]) }
}

/// The whole number nearest to one below 2⁵¹; of two as near the even one.
#[inline(always)]
fn whole<R: Double>(x: R) -> R {
    // 3 · 2⁵¹: doubles near it are the whole numbers
    let shift = x.broadcast(6_755_399_441_055_744.0);
    (x + shift) - shift
}
