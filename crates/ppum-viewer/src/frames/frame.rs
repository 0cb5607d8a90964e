//! Images with what they were made of.

use std::ops::Deref;
use std::sync::Arc;

use ppum_render::resample::norms::DifferenceNorms;
use ppum_render::view::View;
use ppum_scene::colors::ColorOptions;
use ppum_scene::difference::{self, DifferenceSide, FieldDifference};
use ppum_scene::values::PixelValues;

use super::fault::ImageFailure;
use super::overlay_shapes::OverlayShapes;
use super::paint::ColoredImage;
use super::request::FrameRequest;
use super::resampled::ResampledView;
use super::subject::FrameSubject;

/// An image with all that it was made of.
#[derive(Clone, Debug)]
pub struct RenderedFrame {
    /// The request.
    pub request: FrameRequest,
    /// The field and the quantity that are shown.
    pub subject: FrameSubject,
    /// Its values; of a rough image those of its own view.
    pub drawn: Arc<PixelValues>,
    /// How far the two sides of a difference are from each other, in the view that was last drawn
    /// whole.
    pub norms: Option<DifferenceNorms>,
    /// Their colours, and the view that they are of.
    pub colored: Arc<ColoredImage>,
    /// The layers over them; of an older view until they are drawn again.
    pub layers: Arc<OverlayShapes>,
    /// The view in whose pixels the layers are.
    pub layers_view: View,
    /// The resampled image, if that was requested; of an older view until it is there.
    pub other: Option<Arc<ResampledView>>,
    /// True if nothing better will come.
    pub is_final: bool,
    /// The reason why the processor draws in place of the graphics card that was to.
    pub note: Option<String>,
    /// The time that its values took \[s\].
    pub seconds: f64,
}

/// An image, or why there is none.
pub(super) type FrameResult = Result<Arc<RenderedFrame>, ImageFailure>;

impl Deref for RenderedFrame {
    type Target = FrameSubject;

    fn deref(&self) -> &FrameSubject {
        &self.subject
    }
}

impl RenderedFrame {
    /// The two sides of a difference, if it is one.
    pub(crate) fn minus(&self) -> Option<FieldDifference<'_>> {
        let left = self.left.as_ref()?.side();
        let right = DifferenceSide { field: self.field.field(), shown: &self.shown };
        Some(FieldDifference { right, left })
    }

    /// The ends of the range of its colours.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        let norm = &self.colored.normalization;
        [norm.min(), norm.max()]
    }

    /// The symbol of what its colours mean, or the words for it, and the unit.
    #[must_use]
    pub fn words(&self) -> [String; 2] {
        self.image().words()
    }

    /// The map of its colours where none is chosen.
    #[must_use]
    pub fn default_map(&self) -> &'static str {
        match self.left {
            Some(_) => difference::MAP,
            None => ColorOptions::default_map(self.shown.quantity()),
        }
    }
}
