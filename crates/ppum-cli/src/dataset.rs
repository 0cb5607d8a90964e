//! Opening datasets and choosing among what is in them.

use std::path::Path;

use anyhow::Context as _;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_format::ReadError;

use crate::given::Given;

/// Reads a dataset; an error names the file.
pub(crate) fn open(path: &Path) -> anyhow::Result<Dataset> {
    let read = ppum_format::read(path);
    match read {
        Err(error @ ReadError::Io { .. }) => Err(error.into()),
        other => other.with_context(|| path.display().to_string()),
    }
}

/// The first field of a step, by default of the last one.
pub(crate) fn field(dataset: &Dataset, step: Option<usize>) -> anyhow::Result<Field<'_>> {
    let last = dataset.steps.len().saturating_sub(1);
    Ok(Field::new(dataset, step.unwrap_or(last))?)
}

/// A quantity by its name or formula, or by `@` and a file with one, if the field has what it needs.
pub(crate) fn quantity(field: &Field<'_>, given: &str) -> anyhow::Result<Quantity> {
    let given = Given::read(given)?;
    let quantity = given.explain(Quantity::parse(&given.text, field))?;
    quantity.check(field)?;
    Ok(quantity)
}
