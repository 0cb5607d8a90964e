//! Double precision: the bits of numbers, as elementary functions need them.

use fearless_simd::{Simd, f32x16, f64x8, prelude::*, u64x8};

use super::traits::{Double, DoubleFunction, Real};

/// Bits of 2⁵², whose last bits count ones: those of 2⁵² + n are these or n.
const ONES: u64 = 1075 << MANTISSA;

/// 2⁵² and the bias of exponents.
const BIASED: f64 = 4_503_599_627_370_496.0 + 1023.0;

/// Bits of the mantissa.
const MANTISSA: u32 = 52;

impl Double for f64 {
    #[inline(always)]
    fn power_of_two(self) -> Self {
        Self::from_bits((self + BIASED).to_bits() << MANTISSA)
    }
    #[inline(always)]
    fn exponent(self) -> Self {
        Self::from_bits(Self::abs(self).to_bits() >> MANTISSA | ONES) - BIASED
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self::copysign(self, sign)
    }
}

impl<S: Simd> Double for f64x8<S> {
    #[inline(always)]
    fn power_of_two(self) -> Self {
        let bits: u64x8<S> = (self + self.broadcast(BIASED)).bitcast();
        (bits << MANTISSA).bitcast()
    }
    #[inline(always)]
    fn exponent(self) -> Self {
        let bits: u64x8<S> = SimdBase::abs(self).bitcast();
        let ones = u64x8::splat(self.token(), ONES);
        let number: Self = ((bits >> MANTISSA) | ones).bitcast();
        number - self.broadcast(BIASED)
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        SimdFloat::copysign(self, sign)
    }
}

/// [`Real::via_f64`] of vectors in double precision.
#[inline(always)]
pub(super) fn of_doubles<S: Simd, const N: usize>(
    operands: [f64x8<S>; N],
    function: impl DoubleFunction<N>,
) -> f64x8<S> {
    function.apply(operands)
}

/// [`Real::via_f64`] of vectors in single precision.
#[inline(always)]
pub(super) fn of_singles<S: Simd, const N: usize>(
    operands: [f32x16<S>; N],
    function: impl DoubleFunction<N>,
) -> f32x16<S> {
    let first = operands[0].widen().0;
    let (mut low, mut high) = ([first; N], [first; N]);
    let mut k = 0;
    while k < N {
        (low[k], high[k]) = operands[k].widen();
        k += 1;
    }
    function.apply(low).narrow(function.apply(high))
}
