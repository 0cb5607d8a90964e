//! Parts that tests share, and the functions of shaders against their twins.

mod compute;
mod corpus;
mod points;
mod prepare;
mod texts;

use ppum_testkit::skipped::skipped;

use crate::{AdapterChoice, Gpu, GpuError};

/// The graphics device that tests run on, software too. Where there is none tests are
/// [`skipped`].
///
/// # Panics
/// When a device is required and there is none, or when opening it fails.
pub(crate) fn gpu_or_skip() -> Option<Gpu> {
    match Gpu::open(AdapterChoice::Any) {
        Ok(gpu) => Some(gpu),
        Err(GpuError::NoAdapter { .. }) => {
            skipped("no graphics adapter");
            None
        }
        Err(error) => panic!("{error}"),
    }
}
