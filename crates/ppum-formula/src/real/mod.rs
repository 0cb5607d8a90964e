//! The number type of the evaluators: one text for f64, f32 and SIMD lanes.
//!
//! Kernels are written once over [`Real`]. The instance `f64` is the reference; lanes are the
//! vectors of `fearless_simd`, chosen at run time by [`Scalar::dispatch`]. There are no branches on
//! values, only [`Real::select`].
//!
//! Every kernel that runs on lanes must be `#[inline(always)]` and must not call a closure that is
//! not inlined: a call leaves the region compiled for the wider instruction set, which costs a
//! factor of ten or more and changes no result.

use fearless_simd::{Level, Select as _, Simd, f32x16, f64x8, prelude::*};
use std::cell::Cell;
use std::ops::{Add, Div, Mul, Neg, Sub};

mod double;
#[cfg(test)]
pub(crate) mod levels;

pub use double::{Double, DoubleFunction};

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
    type Scalar: Scalar;
    /// Result of a comparison.
    type Mask: Copy;
    /// The numbers in the lanes.
    type Array: Copy + AsRef<[Self::Scalar]> + AsMut<[Self::Scalar]>;
    /// Number of lanes.
    const LANES: usize;

    /// A constant in every lane. Taken from an existing value, because lanes carry the proof that
    /// the processor has them.
    fn lit(self, value: f64) -> Self;
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
    fn in_double<const N: usize>(operands: [Self; N], function: impl DoubleFunction<N>) -> Self;
    /// The lanes widened to f64; zero beyond [`Self::LANES`].
    #[inline(always)]
    fn lanes(self) -> Lanes {
        let mut lanes = [Self::Scalar::default(); WIDEST];
        self.store(&mut lanes);
        lanes.map(Scalar::to_f64)
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
pub trait Job<T: Scalar> {
    /// The result of the work.
    type Output;
    /// Runs with numbers of type `R`; `zero` is a zero to take constants from. Must be
    /// `#[inline(always)]`.
    fn run<R: Real<Scalar = T>>(self, zero: R) -> Self::Output;
}

/// One lane: f64 or f32.
pub trait Scalar:
    Real<Scalar = Self> + Default + PartialOrd + Send + Sync + std::fmt::Debug
{
    /// Lanes in a vector of [`Scalar::dispatch`]; buffers are padded to a multiple of it.
    const VECTOR: usize;
    /// Rounds from f64.
    fn from_f64(value: f64) -> Self;
    /// Widens to f64.
    fn to_f64(self) -> f64;
    /// Numbers of a kind that is known.
    fn numbers(of: &mut [Self]) -> Numbers<'_>;
    /// Runs the job on the widest vectors of this processor.
    fn dispatch<J: Job<Self>>(job: J) -> J::Output;
}

/// Numbers whose kind is asked at run time: for what is compiled once for both, and not again in
/// every crate that uses it.
#[derive(Debug)]
pub enum Numbers<'a> {
    /// f64
    Double(&'a mut [f64]),
    /// f32
    Single(&'a mut [f32]),
}

thread_local! {
    static IS_NARROWED: Cell<bool> = const { Cell::new(false) };
}

/// Does work whose jobs on this thread run on the vectors that every processor of the architecture
/// has, in place of the widest: for measurements of what those gain. Values may differ in the last
/// bits where the wider ones fuse.
pub fn narrowed<T>(work: impl FnOnce() -> T) -> T {
    struct Before(bool);
    impl Drop for Before {
        fn drop(&mut self) {
            IS_NARROWED.set(self.0);
        }
    }
    let _before = Before(IS_NARROWED.replace(true));
    work()
}

/// The instruction set of [`Scalar::dispatch`].
fn level() -> Level {
    if IS_NARROWED.get() { Level::baseline() } else { Level::new() }
}

/// Name of the instruction set that [`Scalar::dispatch`] takes on this thread.
#[must_use]
pub fn instructions() -> &'static str {
    name(level())
}

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
fn name(level: Level) -> &'static str {
    if level.as_avx512().is_some() {
        "AVX-512"
    } else if level.as_avx2().is_some() {
        "AVX2"
    } else {
        "scalar"
    }
}

#[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
fn name(level: Level) -> &'static str {
    #[cfg(target_arch = "aarch64")]
    if level.as_neon().is_some() {
        return "NEON";
    }
    #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
    if level.as_wasm_simd128().is_some() {
        return "SIMD128";
    }
    if level.is_fallback() { "scalar" } else { "vectors" }
}

/// Runs a job on the widest vectors of the processor. Each instruction set compiles all kernels
/// once more, and those of SSE2, whose vectors are the narrowest, are the longest. An x86 processor
/// without AVX2 (before 2013) therefore computes with scalars, to the same numbers: neither fuses
/// multiplication and addition.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
macro_rules! vectors {
    ($job:expr, $t:ident, $vector:ident) => {{
        let level = level();
        if let Some(simd) = level.as_avx512() {
            return simd.vectorize(
                #[inline(always)]
                || $job.run($vector::splat(simd, 0.0)),
            );
        }
        if let Some(simd) = level.as_avx2() {
            return simd.vectorize(
                #[inline(always)]
                || $job.run($vector::splat(simd, 0.0)),
            );
        }
        $job.run($t::default())
    }};
}

#[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
macro_rules! vectors {
    ($job:expr, $t:ident, $vector:ident) => {
        fearless_simd::dispatch!(level(), simd => $job.run($vector::splat(simd, 0.0)))
    };
}

macro_rules! scalar {
    ($t:ident, $vector:ident, $lanes:literal, $kind:ident, $of_vectors:ident) => {
        impl Real for $t {
            type Scalar = $t;
            type Mask = bool;
            type Array = [$t; 1];
            const LANES: usize = 1;

            #[inline(always)]
            fn lit(self, value: f64) -> Self {
                value as $t
            }
            // Not fused: without the instruction `mul_add` is a library call, ten times slower.
            #[inline(always)]
            fn mul_add(self, b: Self, c: Self) -> Self {
                self * b + c
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $t::sqrt(self)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $t::abs(self)
            }
            #[inline(always)]
            fn floor(self) -> Self {
                $t::floor(self)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if self > other { self } else { other }
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if self < other { self } else { other }
            }
            #[inline(always)]
            fn ge(self, other: Self) -> bool {
                self >= other
            }
            #[inline(always)]
            fn gt(self, other: Self) -> bool {
                self > other
            }
            #[inline(always)]
            fn select(mask: bool, a: Self, b: Self) -> Self {
                if mask { a } else { b }
            }
            #[inline(always)]
            fn any(mask: bool) -> bool {
                mask
            }
            #[inline(always)]
            fn load(self, from: &[$t]) -> Self {
                from[0]
            }
            #[inline(always)]
            fn arrays_mut(of: &mut [$t]) -> &mut [[$t; 1]] {
                of.as_chunks_mut().0
            }
            #[inline(always)]
            fn load_array(self, array: &[$t; 1]) -> Self {
                array[0]
            }
            #[inline(always)]
            fn store_array(self, array: &mut [$t; 1]) {
                array[0] = self;
            }
            #[inline(always)]
            fn store(self, to: &mut [$t]) {
                to[0] = self;
            }
            #[inline(always)]
            fn in_double<const N: usize>(of: [Self; N], function: impl DoubleFunction<N>) -> Self {
                function.apply(of.map(f64::from)) as $t
            }
            #[inline(always)]
            fn map(self, f: impl Fn(f64) -> f64) -> Self {
                f(f64::from(self)) as $t
            }
        }

        impl Scalar for $t {
            const VECTOR: usize = $lanes;
            fn from_f64(value: f64) -> Self {
                value as $t
            }
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            fn numbers(of: &mut [Self]) -> Numbers<'_> {
                Numbers::$kind(of)
            }
            fn dispatch<J: Job<Self>>(job: J) -> J::Output {
                vectors!(job, $t, $vector)
            }
        }

        impl<S: Simd> Real for $vector<S> {
            type Scalar = $t;
            type Mask = <Self as SimdBase<S>>::Mask;
            type Array = [$t; $lanes];
            const LANES: usize = $lanes;

            #[inline(always)]
            fn lit(self, value: f64) -> Self {
                Self::splat(self.token(), value as $t)
            }
            #[inline(always)]
            fn mul_add(self, b: Self, c: Self) -> Self {
                SimdFloat::mul_add(self, b, c)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                SimdFloat::sqrt(self)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                SimdBase::abs(self)
            }
            #[inline(always)]
            fn floor(self) -> Self {
                SimdFloat::floor(self)
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                self.simd_gt(other).select(self, other)
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                self.simd_lt(other).select(self, other)
            }
            #[inline(always)]
            fn ge(self, other: Self) -> Self::Mask {
                self.simd_ge(other)
            }
            #[inline(always)]
            fn gt(self, other: Self) -> Self::Mask {
                self.simd_gt(other)
            }
            #[inline(always)]
            fn select(mask: Self::Mask, a: Self, b: Self) -> Self {
                mask.select(a, b)
            }
            #[inline(always)]
            fn any(mask: Self::Mask) -> bool {
                mask.any_true()
            }
            #[inline(always)]
            fn load(self, from: &[$t]) -> Self {
                Self::from_slice(self.token(), &from[..$lanes])
            }
            #[inline(always)]
            fn arrays_mut(of: &mut [$t]) -> &mut [[$t; $lanes]] {
                of.as_chunks_mut().0
            }
            #[inline(always)]
            fn load_array(self, array: &[$t; $lanes]) -> Self {
                Self::from_slice(self.token(), array)
            }
            #[inline(always)]
            fn store_array(self, array: &mut [$t; $lanes]) {
                self.store_slice(array);
            }
            #[inline(always)]
            fn store(self, to: &mut [$t]) {
                self.store_slice(&mut to[..$lanes]);
            }
            #[inline(always)]
            fn in_double<const N: usize>(of: [Self; N], function: impl DoubleFunction<N>) -> Self {
                double::$of_vectors(of, function)
            }
        }
    };
}

scalar!(f64, f64x8, 8, Double, of_doubles);
scalar!(f32, f32x16, 16, Single, of_singles);

#[cfg(test)]
mod tests {
    use super::*;

    struct Kernel<'a, T>(&'a [T], &'a mut [T]);

    impl<T: Scalar> Job<T> for Kernel<'_, T> {
        type Output = ();
        #[inline(always)]
        fn run<R: Real<Scalar = T>>(self, zero: R) {
            for (from, to) in self.0.chunks_exact(R::LANES).zip(self.1.chunks_exact_mut(R::LANES)) {
                let x = zero.load(from);
                let y = x.abs().sqrt().max(zero.lit(0.5)) / (x + zero.lit(10.0));
                let z = R::select(x.ge(zero), y, -y).min(zero.lit(0.1));
                z.map(|v| v * 2.0).store(to);
            }
        }
    }

    /// Every operation of the kernel is exact or correctly rounded, so lanes and scalars agree.
    #[test]
    fn lanes_equal_scalars_bit_for_bit() {
        let xs: Vec<f64> = (0..64).map(|k| f64::from(k) * 0.37 - 9.0).collect();
        let (mut lanes, mut scalars) = (vec![0.0; 64], vec![0.0; 64]);
        f64::dispatch(Kernel(&xs, &mut lanes));
        Kernel(&xs, &mut scalars).run(0.0f64);
        assert_eq!(lanes, scalars);
        let xs: Vec<f32> = xs.iter().map(|&x| x as f32).collect();
        let (mut lanes, mut scalars) = (vec![0.0; 64], vec![0.0; 64]);
        f32::dispatch(Kernel(&xs, &mut lanes));
        Kernel(&xs, &mut scalars).run(0.0f32);
        assert_eq!(lanes, scalars);
    }

    /// The narrowest vectors compute the same, for as long as they are asked for and on
    /// this thread.
    #[test]
    fn narrowed_for_a_while() {
        let xs: Vec<f64> = (0..64).map(|k| f64::from(k) * 0.37 - 9.0).collect();
        let (mut wide, mut narrow) = (vec![0.0; 64], vec![0.0; 64]);
        let widest = instructions();
        f64::dispatch(Kernel(&xs, &mut wide));
        let inside = narrowed(|| {
            f64::dispatch(Kernel(&xs, &mut narrow));
            let other = std::thread::spawn(instructions).join().expect("no panic");
            assert_eq!(other, widest);
            instructions()
        });
        assert_eq!(wide, narrow);
        assert_eq!(instructions(), widest);
        assert!(widest == inside || inside == "scalar", "{widest} {inside}");
        let panicked = std::panic::catch_unwind(|| narrowed(|| panic!("within")));
        assert!(panicked.is_err() && instructions() == widest);
    }
}
