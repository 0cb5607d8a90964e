//! What tests share, and the functions of shaders against their twins.

mod compute;
mod corpus;
mod points;
mod texts;

use crate::{Choice, Gpu, GpuError};

/// The graphics device that tests run on, software too. Where there is none tests say visibly that they
/// are skipped, or fail if `PPUM_REQUIRE_GPU` is set.
///
/// # Panics
/// When a device is required and there is none, or when opening it fails.
pub(crate) fn gpu_or_skip() -> Option<Gpu> {
    match Gpu::open(Choice::Any) {
        Ok(gpu) => Some(gpu),
        Err(error @ GpuError::NoAdapter { .. }) => {
            assert!(std::env::var_os("PPUM_REQUIRE_GPU").is_none(), "{error}");
            eprintln!("SKIPPED: no graphics adapter");
            None
        }
        Err(error) => panic!("{error}"),
    }
}
