//! The image that is subtracted from another.

use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum_render::resample::norms::DifferenceNorms;
use ppum_scene::drawing::DisplayedQuantity;
use ppum_scene::scene::Subject;

use crate::field::OwnedField;

/// Another image, which is subtracted from one of the same view.
#[derive(Clone, Debug)]
pub struct SubtractedImage {
    /// Its dataset.
    pub dataset: Arc<Dataset>,
    /// The chosen step, part and replacements of the dataset.
    pub subject: Subject,
    /// The quantity.
    pub quantity: Option<String>,
}

impl PartialEq for SubtractedImage {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.dataset, &other.dataset)
            && self.subject == other.subject
            && self.quantity == other.quantity
    }
}

/// The values that were subtracted from an image.
#[derive(Clone, Debug)]
pub struct SubtractedValues {
    /// Its field.
    pub field: Arc<OwnedField>,
    /// The displayed quantity of the field.
    pub shown: Arc<DisplayedQuantity>,
    /// How far the two are from each other, in the view that was last drawn whole.
    pub norms: Option<DifferenceNorms>,
}
