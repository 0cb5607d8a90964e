//! Spaces that cannot be built.

use super::inspect::InspectError;
use crate::refine::RefineError;
use ppum::progress::Cancelled;
use ppum::text::trimmed;
use ppum::vec2::Vec2;
use ppum_problem::OrderError;

/// The space of a problem cannot be built.
#[derive(Debug, thiserror::Error)]
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
    /// A known field beside what it cannot go on beyond.
    #[error(
        "the force at [{}, {}] is too near to a border, a crack or a tip for the cells there: patches may reach {} \
         from it, but reach farther; {}",
        trimmed(at.x), trimmed(at.y), trimmed(*reach),
        match is_refined {
            true => "move it away from there",
            false => "leave out `refine = false`, or divide the cells there by [[refine]]",
        }
    )]
    Reach {
        /// The point.
        at: Vec2,
        /// The distance that patches may reach.
        reach: f64,
        /// True if cells were divided as far as they may be.
        is_refined: bool,
    },
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
