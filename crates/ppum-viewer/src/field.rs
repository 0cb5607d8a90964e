//! A field beside the dataset that it belongs to, so that both can be kept and shared.

use std::fmt;
use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum::field::{Field, FieldError};
use self_cell::self_cell;

self_cell!(
    struct FieldAndDataset {
        owner: Arc<Dataset>,
        #[covariant]
        dependent: Field,
    }
);

/// A dataset's field at one step, with the dataset.
pub struct OwnedField(FieldAndDataset);

impl OwnedField {
    /// The first field of a step, ready to be evaluated.
    ///
    /// # Errors
    /// No such step; functions that cannot be compiled.
    pub fn new(dataset: Arc<Dataset>, step: usize) -> Result<Self, FieldError> {
        FieldAndDataset::try_new(dataset, |dataset| Field::new(dataset, step)).map(Self)
    }

    /// The dataset.
    #[must_use]
    pub fn dataset(&self) -> &Arc<Dataset> {
        self.0.borrow_owner()
    }

    /// The field.
    #[must_use]
    pub fn field(&self) -> &Field<'_> {
        self.0.borrow_dependent()
    }
}

impl fmt::Debug for OwnedField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("OwnedField").field("title", &self.dataset().title).finish_non_exhaustive()
    }
}
