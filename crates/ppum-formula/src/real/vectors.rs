//! The kinds of numbers: scalars and vectors of the processor, chosen at run time.

use fearless_simd::{Level, Select as _, Simd, f32x16, f64x8, prelude::*};
use std::cell::Cell;

use super::double;
use super::traits::{DoubleFunction, LaneJob, LaneNumber, NumberKind, Real};

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

/// The instruction set of [`LaneNumber::dispatch`].
fn level() -> Level {
    if IS_NARROWED.get() { Level::baseline() } else { Level::new() }
}

/// Name of the instruction set that [`LaneNumber::dispatch`] takes on this thread.
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
            fn broadcast(self, value: f64) -> Self {
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
            fn via_f64<const N: usize>(of: [Self; N], function: impl DoubleFunction<N>) -> Self {
                function.apply(of.map(f64::from)) as $t
            }
            #[inline(always)]
            fn map(self, f: impl Fn(f64) -> f64) -> Self {
                f(f64::from(self)) as $t
            }
        }

        impl LaneNumber for $t {
            const VECTOR: usize = $lanes;
            fn from_f64(value: f64) -> Self {
                value as $t
            }
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            fn numbers(of: &mut [Self]) -> NumberKind<'_> {
                NumberKind::$kind(of)
            }
            fn dispatch<J: LaneJob<Self>>(job: J) -> J::Output {
                vectors!(job, $t, $vector)
            }
        }

        impl<S: Simd> Real for $vector<S> {
            type Scalar = $t;
            type Mask = <Self as SimdBase<S>>::Mask;
            type Array = [$t; $lanes];
            const LANES: usize = $lanes;

            #[inline(always)]
            fn broadcast(self, value: f64) -> Self {
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
            fn via_f64<const N: usize>(of: [Self; N], function: impl DoubleFunction<N>) -> Self {
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

    impl<T: LaneNumber> LaneJob<T> for Kernel<'_, T> {
        type Output = ();
        #[inline(always)]
        fn run<R: Real<Scalar = T>>(self, zero: R) {
            for (from, to) in self.0.chunks_exact(R::LANES).zip(self.1.chunks_exact_mut(R::LANES)) {
                let x = zero.load(from);
                let y = x.abs().sqrt().max(zero.broadcast(0.5)) / (x + zero.broadcast(10.0));
                let z = R::select(x.ge(zero), y, -y).min(zero.broadcast(0.1));
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
