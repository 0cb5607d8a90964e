//! Whether what is being made is still wanted.

use super::Failure;

/// The end of a step without a result.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum StageEnd {
    /// Something else is wanted.
    Cancelled,
    /// There can be none.
    Failed(Failure),
}

/// Whether what is being made is still wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Claim {
    Wanted,
    /// Something else is wanted by now.
    Replaced,
    /// Nobody wants anything any more.
    Gone,
}

/// Asks for it, from any thread.
pub(super) type Ask<'a> = &'a (dyn Fn() -> Claim + Sync);
