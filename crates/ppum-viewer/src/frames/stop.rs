//! Whether what is being made is still wanted.

use super::ImageFailure;

/// The end of a step without a result.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum FrameStop {
    /// Something else is wanted.
    Cancelled,
    /// There can be none.
    Failed(ImageFailure),
}

/// Whether what is being made is still wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FrameClaim {
    Wanted,
    /// Something else is wanted by now.
    Replaced,
    /// Nobody wants anything any more.
    Gone,
}

/// Asks for it, from any thread.
pub(super) type Ask<'a> = &'a (dyn Fn() -> FrameClaim + Sync);
