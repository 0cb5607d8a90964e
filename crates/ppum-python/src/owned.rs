//! A field with the dataset that it borrows.

use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum::field::{Field, FieldError};
use ppum::sample::AnchorMap;
use self_cell::self_cell;

/// A compiled field, and where its points are seen from.
pub(crate) struct AnchoredField<'d> {
    pub(crate) field: Field<'d>,
    pub(crate) seats: AnchorMap<'d>,
    /// The number of its step.
    pub(crate) number: usize,
}

self_cell!(
    /// The first field of a step, with its dataset.
    pub(crate) struct FieldInDataset {
        owner: Arc<Dataset>,
        #[covariant]
        dependent: AnchoredField,
    }
);

impl FieldInDataset {
    /// # Errors
    /// No such step; functions that cannot be compiled.
    pub(crate) fn compiled(dataset: Arc<Dataset>, number: usize) -> Result<Self, FieldError> {
        Self::try_new(dataset, |dataset| {
            let field = Field::new(dataset, number)?;
            Ok(AnchoredField { seats: AnchorMap::new(&field), field, number })
        })
    }
}
