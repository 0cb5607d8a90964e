//! The failures of renderers.

use ppum::progress::Cancelled;
use ppum::quantity::QuantityError;

use crate::view::ViewError;

/// The reason why a view was not evaluated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The quantity has no meaning for the field.
    #[error(transparent)]
    Quantity(#[from] QuantityError),
    /// The watcher stopped the call.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// Isolines would have more points than [`MOST_POINTS`](crate::isoline::MOST_POINTS).
    #[error(
        "the isolines have more than {} points: the quantity passes so many levels in the picture that they say nothing; \
         ask for fewer levels, or show less",
        crate::isoline::MOST_POINTS
    )]
    TooManyLines,
    /// The samples of the view's pixels cannot be told apart.
    #[error(transparent)]
    View(#[from] ViewError),
}
