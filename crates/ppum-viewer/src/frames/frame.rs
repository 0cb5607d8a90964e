//! Images with what they were made of.

use std::sync::Arc;

use ppum_render::view::View;
use ppum_scene::difference::{self, DifferenceSide};
use ppum_scene::drawing::{DisplayedQuantity, PixelValues};
use ppum_scene::mirror::MirrorLines;

use super::fault::ImageFailure;
use super::overlay_shapes::OverlayShapes;
use super::paint::ColoredImage;
use super::resampled::ResampledView;
use super::subtrahend::SubtractedValues;
use super::wanted::FrameRequest;
use crate::field::OwnedField;

/// An image with all that it was made of.
#[derive(Clone, Debug)]
pub struct RenderedFrame {
    /// The request.
    pub wanted: FrameRequest,
    /// The field, with what is replaced in it.
    pub field: Arc<OwnedField>,
    /// The displayed quantity.
    pub shown: Arc<DisplayedQuantity>,
    /// The subtrahend.
    pub subtracted: Option<SubtractedValues>,
    /// Its values; of a rough image those of its own view.
    pub drawn: Arc<PixelValues>,
    /// Their colours, and the view that they are of.
    pub picture: Arc<ColoredImage>,
    /// The layers over them; of an older view until it is drawn again.
    pub layers: Arc<OverlayShapes>,
    /// The view in whose pixels the layers are.
    pub layers_view: View,
    /// How many times its displacement the body is drawn with, if it is deformed.
    pub factor: Option<f64>,
    /// The lines at which it is mirrored.
    pub lines: MirrorLines,
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

impl RenderedFrame {
    /// The two sides of a difference, if it is one.
    #[must_use]
    pub fn minus(&self) -> Option<difference::FieldDifference<'_>> {
        let left = self.subtracted.as_ref()?;
        let right = DifferenceSide { field: self.field.field(), shown: &self.shown };
        Some(difference::FieldDifference {
            right,
            left: DifferenceSide { field: left.field.field(), shown: &left.shown },
        })
    }

    /// Returns the subtrahend: a field, and what is shown of it.
    #[must_use]
    pub fn left(&self) -> Option<(Arc<OwnedField>, Arc<DisplayedQuantity>)> {
        let left = self.subtracted.as_ref()?;
        Some((Arc::clone(&left.field), Arc::clone(&left.shown)))
    }

    /// The symbol of what its colours mean, or the words for it, and the unit.
    #[must_use]
    pub fn words(&self) -> [String; 2] {
        let minus = self.minus();
        minus.map_or_else(|| self.shown.words(self.field.field()), |minus| minus.words())
    }

    /// The map of its colours where none is chosen.
    #[must_use]
    pub fn default_map(&self) -> &'static str {
        match self.subtracted {
            Some(_) => difference::MAP,
            None => ppum_scene::colors::ColorOptions::default_map(self.shown.quantity()),
        }
    }
}
