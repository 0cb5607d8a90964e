//! The reasons why there is no image.

use ppum_figure::figure::FigureError;
use ppum_render::RasterError;
use ppum_render::deform::DeformError;
use ppum_render::range::RangeError;
use ppum_render::view::ViewError;

use crate::colors::MapError;
use crate::engine::EngineError;
use crate::layers::LayersError;
use crate::mirror::MirrorError;
use crate::place::PlaceError;
use crate::request::PanelsError;
use crate::scene::DisplayError;

/// The reason why there is no such image.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImageError {
    /// Nothing that could be shown.
    #[error(transparent)]
    Shown(#[from] DisplayError),
    /// The quantity, isolines, or a watcher that stopped it.
    #[error(transparent)]
    Render(#[from] RasterError),
    /// Isolines of values that are constant in each cell.
    #[error("values that are constant in each cell have no isolines")]
    NoIsolines,
    /// The backend.
    #[error(transparent)]
    Engine(EngineError),
    /// Means of samples where there are none.
    #[error("samples: {0} drawn at the centres of pixels; leave samples out")]
    Samples(&'static str),
    /// Means of more samples of the whole of a half than memory is meant for.
    #[error("samples: mirrored images hold all samples at once; take fewer, or a smaller size")]
    MirroredSamples,
    /// A frame of an animation with more pixels than memory is meant for.
    #[error("frames of {}x{} pixels do not fit into memory; choose a smaller size", .0[0], .0[1])]
    TooLarge([u32; 2]),
    /// The deformed body.
    #[error(transparent)]
    Deform(#[from] DeformError),
    /// The whole of a half.
    #[error(transparent)]
    Mirror(#[from] MirrorError),
    /// The colour map.
    #[error(transparent)]
    Colormap(#[from] MapError),
    /// The range of the colours.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// The overlays.
    #[error(transparent)]
    Layers(#[from] Box<LayersError>),
    /// The page.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// The view.
    #[error(transparent)]
    View(#[from] ViewError),
    /// The place.
    #[error(transparent)]
    Place(#[from] PlaceError),
    /// The panels.
    #[error(transparent)]
    Panels(#[from] PanelsError),
}

impl From<EngineError> for ImageError {
    fn from(error: EngineError) -> Self {
        match error {
            EngineError::Render(error) => Self::Render(error),
            other => Self::Engine(other),
        }
    }
}
