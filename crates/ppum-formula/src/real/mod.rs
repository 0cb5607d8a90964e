//! The number type of the evaluators: one text for f64, f32 and SIMD lanes.
//!
//! Kernels are written once over [`Real`]. The instance `f64` is the reference; lanes are the
//! vectors of `fearless_simd`, chosen at run time by [`LaneNumber::dispatch`]. There are no
//! branches on values, only [`Real::select`].
//!
//! Every kernel that runs on lanes must be `#[inline(always)]` and must not call a closure that is
//! not inlined: a call leaves the region compiled for the wider instruction set, which costs a
//! factor of ten or more and changes no result.

mod double;
#[cfg(test)]
pub(crate) mod levels;
mod traits;
mod vectors;

pub use traits::{Double, DoubleFunction, LaneJob, LaneNumber, Lanes, NumberKind, Real};
pub use vectors::{instructions, narrowed};
