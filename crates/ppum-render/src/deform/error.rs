//! The reasons why bodies are not drawn deformed.

use ppum::field::Field;
use ppum::progress::Cancelled;
use ppum::quantity::QuantityError;
use ppum_raster::view::ViewError;

/// Largest factor: squares of what it magnifies must stay finite. From 10⁶ on images hardly
/// change with it.
pub const LARGEST_FACTOR: f64 = 1e100;

/// The reason why a body is not drawn deformed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DeformError {
    /// The field is no displacement.
    #[error("the field `{0}` is no displacement of the plane: nothing deforms")]
    NoDisplacement(String),
    /// The factor is not finite, or larger than [`LARGEST_FACTOR`].
    #[error(
        "the displacement's factor is {0:?}; give a number of at most {LARGEST_FACTOR:?} in size"
    )]
    Factor(f64),
    /// The body folds too often for the image.
    #[error(
        "magnified {0} times the plate lies over itself too often to be drawn; choose a smaller factor"
    )]
    TooFolded(f64),
    /// Pixels are smaller than the rounding of the places to which points move.
    #[error(
        "a view {0:?} wide is finer than double precision knows places of the deformed plate; widen it, or choose one \
         around a crack tip"
    )]
    TooFine(f64),
    /// There is no such view.
    #[error(transparent)]
    View(#[from] ViewError),
    /// The quantity has no meaning for the field.
    #[error(transparent)]
    Quantity(#[from] QuantityError),
    /// The watcher stopped the call.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Refuses fields that are no displacements of the plane.
pub(super) fn check(field: &Field<'_>) -> Result<(), DeformError> {
    if !field.is_displacement() {
        return Err(DeformError::NoDisplacement(field.data.name.clone()));
    }
    Ok(())
}
