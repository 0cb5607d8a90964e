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
}

impl<'d> AnchoredField<'d> {
    fn new(dataset: &'d Dataset, step: usize) -> Result<Self, FieldError> {
        let field = Field::new(dataset, step)?;
        Ok(Self { seats: AnchorMap::new(&field), field })
    }
}

self_cell!(
    struct FieldInDataset {
        owner: Arc<Dataset>,
        #[covariant]
        dependent: AnchoredField,
    }
);

/// The first field of a step, with its dataset.
pub(crate) struct PyOwnedField {
    both: FieldInDataset,
    step: usize,
}

impl PyOwnedField {
    /// # Errors
    /// No such step; functions that cannot be compiled.
    pub(crate) fn new(dataset: Arc<Dataset>, step: usize) -> Result<Self, FieldError> {
        let both = FieldInDataset::try_new(dataset, |dataset| AnchoredField::new(dataset, step))?;
        Ok(Self { both, step })
    }

    pub(crate) fn dataset(&self) -> &Dataset {
        self.both.borrow_owner()
    }

    /// The dataset, and the number of the step.
    pub(crate) fn place(&self) -> (&Dataset, usize) {
        (self.dataset(), self.step)
    }

    pub(crate) fn seen(&self) -> &AnchoredField<'_> {
        self.both.borrow_dependent()
    }

    pub(crate) fn field(&self) -> &Field<'_> {
        &self.seen().field
    }
}
