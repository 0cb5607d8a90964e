//! Numbers and vectors of numbers, and what is done with them.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Lanes of the widest vector there is: f32 on 512 bits.
const WIDEST: usize = 16;

/// The lanes of any vector, widened to f64.
pub type Lanes = [f64; WIDEST];

/// A number or a vector of numbers.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Type of one lane.
    type Scalar: LaneNumber;
    /// Result of a comparison.
    type Mask: Copy;
    /// The numbers in the lanes.
    type Array: Copy + AsRef<[Self::Scalar]> + AsMut<[Self::Scalar]>;
    /// Number of lanes.
    const LANES: usize;

    /// A constant in every lane. Taken from an existing value, because lanes carry the proof that
    /// the processor has them.
    fn broadcast(self, value: f64) -> Self;
    /// `self · b + c`, fused where the processor fuses.
    fn mul_add(self, b: Self, c: Self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Magnitude.
    fn abs(self) -> Self;
    /// Largest integer that is not above it.
    fn floor(self) -> Self;
    /// Larger value; `other` if `self` is NaN.
    fn max(self, other: Self) -> Self;
    /// Smaller value; `other` if `self` is NaN.
    fn min(self, other: Self) -> Self;
    /// `self ≥ other`, lane by lane; false for NaN.
    fn ge(self, other: Self) -> Self::Mask;
    /// `self > other`, lane by lane; false for NaN.
    fn gt(self, other: Self) -> Self::Mask;
    /// `a` where the mask holds, else `b`.
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self;
    /// True if the mask holds in a lane: to leave the vectors where what they cannot do is
    /// needed, seldom.
    fn any(mask: Self::Mask) -> bool;
    /// The first [`Self::LANES`] numbers of a slice.
    fn load(self, from: &[Self::Scalar]) -> Self;
    /// Whole vectors of a slice.
    fn arrays_mut(of: &mut [Self::Scalar]) -> &mut [Self::Array];
    /// The lanes from an array.
    fn load_array(self, array: &Self::Array) -> Self;
    /// The lanes as an array.
    fn store_array(self, array: &mut Self::Array);
    /// Writes the lanes to the start of a slice.
    fn store(self, to: &mut [Self::Scalar]);
    /// A function found in double precision and rounded: of the numbers themselves if they are
    /// double, else of halves of the vectors. `operands` has one at least.
    fn via_f64<const N: usize>(operands: [Self; N], function: impl DoubleFunction<N>) -> Self;
    /// The lanes widened to f64; zero beyond [`Self::LANES`].
    #[inline(always)]
    fn lanes(self) -> Lanes {
        let mut lanes = [Self::Scalar::default(); WIDEST];
        self.store(&mut lanes);
        lanes.map(LaneNumber::to_f64)
    }
    /// The number of each lane, rounded from f64; `self` is any value to take the kind from.
    #[inline(always)]
    fn with_lanes(self, mut number: impl FnMut(usize) -> f64) -> Self {
        let mut lanes = [Self::Scalar::default(); WIDEST];
        for (k, lane) in lanes.iter_mut().enumerate().take(Self::LANES) {
            *lane = Self::Scalar::from_f64(number(k));
        }
        self.load(&lanes)
    }
    /// Applies a scalar function in f64 lane by lane: the slow path for functions without a kernel.
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let lanes = self.lanes();
        self.with_lanes(|k| f(lanes[k]))
    }
    /// As [`map`](Self::map), a function of several results.
    #[inline(always)]
    fn map_to<const N: usize>(self, mut f: impl FnMut(f64) -> [f64; N]) -> [Self; N] {
        let (lanes, mut results) = (self.lanes(), [Lanes::default(); N]);
        for (k, &number) in lanes.iter().enumerate().take(Self::LANES) {
            for (result, value) in results.iter_mut().zip(f(number)) {
                result[k] = value;
            }
        }
        results.map(|lanes| self.with_lanes(|k| lanes[k]))
    }
    /// Writes the lanes to a slice, or as many as there is room for.
    #[inline(always)]
    fn store_some(self, to: &mut [Self::Scalar]) {
        if to.len() >= Self::LANES {
            return self.store(to);
        }
        let mut lanes = [Self::Scalar::default(); WIDEST];
        self.store(&mut lanes);
        to.copy_from_slice(&lanes[..to.len()]);
    }
    /// +1 where the mask holds, else −1; `one` is a one to take the kind from.
    #[inline(always)]
    fn sign(positive: Self::Mask, one: Self) -> Self {
        Self::select(positive, one, -one)
    }
}

/// Work that is compiled for every instruction set and run with the widest the processor has.
pub trait LaneJob<T: LaneNumber> {
    /// The result of the work.
    type Output;
    /// Runs with numbers of type `R`; `zero` is a zero to take constants from. Must be
    /// `#[inline(always)]`.
    fn run<R: Real<Scalar = T>>(self, zero: R) -> Self::Output;
}

/// One lane: f64 or f32.
pub trait LaneNumber:
    Real<Scalar = Self> + Default + PartialOrd + Send + Sync + std::fmt::Debug
{
    /// Lanes in a vector of [`LaneNumber::dispatch`]; buffers are padded to a multiple of it.
    const VECTOR: usize;
    /// Rounds from f64.
    fn from_f64(value: f64) -> Self;
    /// Widens to f64.
    fn to_f64(self) -> f64;
    /// Numbers of a kind that is known.
    fn numbers(of: &mut [Self]) -> NumberKind<'_>;
    /// Runs the job on the widest vectors of this processor.
    fn dispatch<J: LaneJob<Self>>(job: J) -> J::Output;
}

/// Numbers whose kind is asked at run time: for what is compiled once for both, and not again in
/// every crate that uses it.
#[derive(Debug)]
pub enum NumberKind<'a> {
    /// f64
    Double(&'a mut [f64]),
    /// f32
    Single(&'a mut [f32]),
}

/// A number in double precision, or a vector of such.
pub trait Double: Real<Scalar = f64> {
    /// 2ⁿ of a whole number n from −1022 to 1023; of others any number.
    fn power_of_two(self) -> Self;
    /// The largest n with 2ⁿ ≤ |self|, of normal numbers; of others any number.
    fn exponent(self) -> Self;
    /// The magnitude of `self` with the sign of another number, zeros and NaN included. Select
    /// first, then copy the sign: for AVX-512 LLVM up to 22 makes one masked instruction of
    /// `select(mask, a.copysign(b), b)`, with the wrong table (llvm/llvm-project#157929).
    fn copysign(self, sign: Self) -> Self;
}

/// A function of `N` numbers in double precision.
pub trait DoubleFunction<const N: usize>: Copy {
    /// Its value. Must be `#[inline(always)]`.
    fn apply<R: Double>(self, operands: [R; N]) -> R;
}
