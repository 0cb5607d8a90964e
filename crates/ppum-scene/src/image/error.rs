//! The reasons why there is no image.

use ppum::field::FieldError;
use ppum_figure::figure::FigureError;
use ppum_render::RasterError;
use ppum_render::animation::AnimationError;
use ppum_render::deform::DeformError;
use ppum_render::range::RangeError;
use ppum_render::view::ViewError;

use super::quantity::DisplayError;
use crate::request::PanelsError;
use crate::request::colors::MapError;
use crate::request::mirror::MirrorError;
use crate::request::overlays::Overlay;
use crate::request::region::PlaceError;
use crate::request::scene::SubjectError;

/// The reason why there is no such image; small, since every image may fail.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub struct ImageError(pub Box<ImageErrorKind>);

impl<E> From<E> for ImageError
where
    ImageErrorKind: From<E>,
{
    fn from(error: E) -> Self {
        Self(Box::new(error.into()))
    }
}

/// The kinds of reasons.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImageErrorKind {
    /// A step that is not there.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// A part or a replacement.
    #[error(transparent)]
    Subject(#[from] SubjectError),
    /// Nothing that could be shown.
    #[error(transparent)]
    Shown(#[from] DisplayError),
    /// The quantity, isolines, or a watcher that stopped it.
    #[error(transparent)]
    Render(#[from] RasterError),
    /// Isolines of values that are constant in each cell.
    #[error("values that are constant in each cell have no isolines")]
    NoIsolines,
    /// Double precision on a device.
    #[error(
        "graphics devices compute in single precision; use backend cpu, or leave precision out"
    )]
    Double,
    /// The deformed body on a device, or in single precision.
    #[error(
        "the deformed plate is drawn by the processor, in double precision; leave backend and precision out"
    )]
    DeformedOnDevice,
    /// The device.
    #[error(transparent)]
    Card(#[from] CardError),
    /// Means of samples where there are none.
    #[error("samples: {0} drawn at the centres of pixels; leave samples out")]
    Samples(&'static str),
    /// Means of more samples of the whole of a half than memory is meant for.
    #[error(
        "samples: mirrored images hold all samples at once; take fewer, a smaller size, or `mirror = none`"
    )]
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
    /// Crosses of something else than elasticity.
    #[error(
        "crosses show principal stresses, which only elasticity has; arrows show vectors, or the gradient of one \
         component"
    )]
    Crosses,
    /// An overlay that belongs to the body as it was.
    #[error("{}: of these overlays the deformed plate has cells and cracks alone", .0.name())]
    Overlay(Overlay),
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
    /// Not one value for each pixel.
    #[error("{0} values for {1} pixels")]
    Values(usize, usize),
    /// Rows that the view does not have, or that do not begin at a band.
    #[error("rows {0} to {1} of an image of {2}")]
    Rows(u32, u32, u32),
    /// The file of an animation.
    #[error(transparent)]
    Animation(#[from] AnimationError),
}

/// A device that fails.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
pub struct CardError {
    /// The reason.
    pub message: String,
    /// True if there is no device, as is normal, or if the processor will say the same.
    pub is_normal: bool,
}
