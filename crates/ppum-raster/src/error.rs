//! The failures of renderers.

use ppum::progress::Cancelled;
use ppum::quantity::QuantityError;

use crate::view::ViewError;

/// The reason why a view was not evaluated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RasterError {
    /// The quantity has no meaning for the field.
    #[error(transparent)]
    Quantity(#[from] QuantityError),
    /// One value for each cell, of a cover without cells.
    #[error("the cover has no cells that could have one value each; sample on a grid instead")]
    NoCells,
    /// The watcher stopped the call.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// Isolines would have more points than this.
    #[error(
        "the isolines have more than {0} points: the quantity passes so many levels in the picture that they say nothing; \
         ask for fewer levels, or show less"
    )]
    TooManyLines(usize),
    /// The samples of the view's pixels cannot be told apart.
    #[error(transparent)]
    View(#[from] ViewError),
}
