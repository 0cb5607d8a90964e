//! The reasons why a page has no answer.

use ppum::field::FieldError;
use ppum_render::RenderError;
use ppum_render::range::RangeError;
use ppum_render::view::ViewError;
use ppum_scene::colors::MapError;
use ppum_scene::layers::LayersError;
use ppum_scene::scene::ShownError;
use ppum_scene::shot::ShotError;

/// The reason why there is no image, or no value.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PageError {
    /// The dataset has no such step, or no field there.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// A text that means nothing that could be shown.
    #[error(transparent)]
    Shown(#[from] ShownError),
    /// The view.
    #[error(transparent)]
    View(#[from] ViewError),
    /// The values.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The colours.
    #[error(transparent)]
    Shot(#[from] ShotError),
    /// The colour map.
    #[error(transparent)]
    Colormap(#[from] MapError),
    /// The range of the colours.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// The overlays.
    #[error(transparent)]
    Layers(#[from] LayersError),
    /// Not one value for each pixel.
    #[error("{0} values for {1} pixels")]
    Values(usize, usize),
    /// Rows that the view does not have, or that do not begin at a band.
    #[error("rows {0} to {1} of an image of {2}")]
    Rows(u32, u32, u32),
}
