//! All instruction sets of this processor, for tests.

use fearless_simd::{Level, Simd, f64x8, prelude::*};

use super::traits::LaneJob;

/// Runs a job on the vectors of an instruction set.
fn on<S: Simd, J: LaneJob<f64>>(simd: S, job: J) -> J::Output {
    simd.vectorize(
        #[inline(always)]
        || job.run(f64x8::splat(simd, 0.0)),
    )
}

/// Runs a job with numbers one by one, and on vectors of every instruction set there is; names
/// and results.
pub(crate) fn run<J: LaneJob<f64> + Copy>(job: J) -> Vec<(&'static str, J::Output)> {
    let mut results = vec![("scalar", job.run(0.0f64))];
    #[cfg(target_arch = "x86_64")]
    {
        let level = Level::new();
        results.extend(level.as_avx2().map(|simd| ("AVX2", on(simd, job))));
        results.extend(level.as_avx512().map(|simd| ("AVX-512", on(simd, job))));
    }
    #[cfg(target_arch = "aarch64")]
    results.extend(Level::new().as_neon().map(|simd| ("NEON", on(simd, job))));
    results
}
