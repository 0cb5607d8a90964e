//! What is subtracted from a picture.

use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum_render::resample::norms::Norms;
use ppum_scene::drawing::Shown;
use ppum_scene::minus::{self, Side};
use ppum_scene::scene::Subject;

use super::Frame;
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

impl Frame {
    /// The two sides of a difference, if it is one.
    #[must_use]
    pub fn minus(&self) -> Option<minus::Minus<'_>> {
        let left = self.subtracted.as_ref()?;
        let right = Side { field: self.field.field(), shown: &self.shown };
        Some(minus::Minus { right, left: Side { field: left.field.field(), shown: &left.shown } })
    }

    /// What was subtracted: a field, and what is shown of it.
    #[must_use]
    pub fn left(&self) -> Option<(Arc<OwnedField>, Arc<Shown>)> {
        let left = self.subtracted.as_ref()?;
        Some((Arc::clone(&left.field), Arc::clone(&left.shown)))
    }

    /// The symbol of what its colours mean, or the words for it, and the unit.
    #[must_use]
    pub fn words(&self) -> [String; 2] {
        match self.minus() {
            Some(minus) => minus.words(),
            None => self.shown.words(self.field.field()),
        }
    }

    /// The map of its colours where none is chosen.
    #[must_use]
    pub fn default_map(&self) -> &'static str {
        match self.subtracted {
            Some(_) => minus::MAP,
            None => ppum_scene::colors::Colors::default_map(self.shown.quantity()),
        }
    }
}
