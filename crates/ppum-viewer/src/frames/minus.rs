//! What is subtracted from a picture.

use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum_render::resample::norms::Norms;
use ppum_scene::drawing::Shown;
use ppum_scene::scene::Subject;

use crate::field::OwnedField;

/// Another picture, which is subtracted from one of the same view.
#[derive(Clone, Debug)]
pub struct Minus {
    /// Its dataset.
    pub dataset: Arc<Dataset>,
    /// What of it is looked at.
    pub subject: Subject,
    /// What is shown of that.
    pub quantity: Option<String>,
}

impl PartialEq for Minus {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.dataset, &other.dataset)
            && self.subject == other.subject
            && self.quantity == other.quantity
    }
}

/// What was subtracted from a picture.
#[derive(Clone, Debug)]
pub struct Subtracted {
    /// Its field.
    pub field: Arc<OwnedField>,
    /// What is shown of it.
    pub shown: Arc<Shown>,
    /// How far the two are from each other, in the view that was last drawn whole.
    pub norms: Option<Norms>,
}
