//! The reasons why a page has no answer.

use ppum::field::FieldError;
use ppum_scene::shot::ImageError;

/// The reason why there is no image, or no value.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PageError {
    /// The dataset has no such step, or no field there.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// The image, the view, the colours or the overlays.
    #[error(transparent)]
    Shot(Box<ImageError>),
    /// Not one value for each pixel.
    #[error("{0} values for {1} pixels")]
    Values(usize, usize),
    /// Rows that the view does not have, or that do not begin at a band.
    #[error("rows {0} to {1} of an image of {2}")]
    Rows(u32, u32, u32),
}

impl PageError {
    /// An error of an image.
    pub(crate) fn shot(error: impl Into<ImageError>) -> Self {
        Self::Shot(Box::new(error.into()))
    }
}
