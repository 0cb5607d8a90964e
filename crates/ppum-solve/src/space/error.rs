//! Spaces that cannot be built.

use super::inspect::InspectError;
use crate::problem::OrderError;
use crate::refine::RefineError;
use ppum::progress::Cancelled;

/// The space of a problem cannot be built.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SpaceError {
    /// The cover.
    #[error(transparent)]
    Refine(RefineError),
    /// Holes that leave nothing.
    #[error("the holes swallow the whole domain; make them smaller")]
    Nothing,
    /// The order formula.
    #[error(transparent)]
    Order(#[from] OrderError),
    /// A function that cannot be used.
    #[error(transparent)]
    Function(#[from] InspectError),
    /// The watcher wanted the work to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl From<RefineError> for SpaceError {
    fn from(error: RefineError) -> Self {
        match error {
            RefineError::Cancelled(cancelled) => Self::Cancelled(cancelled),
            error => Self::Refine(error),
        }
    }
}
