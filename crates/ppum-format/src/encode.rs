//! Dataset → content.

use ppum::dataset::{Dataset, Step};

use crate::content::{ObjectTree, step_path};
use crate::error::WriteError;
use crate::limits::FORMAT_VERSION;
use crate::schema::{HEAD, STEP};
use crate::writer::GroupWriter;

/// Everything of a dataset under its names in the file, without checksums.
pub(crate) fn content(dataset: &Dataset) -> Result<ObjectTree, WriteError> {
    beginning(dataset, dataset.steps.len())
}

/// Encodes the first steps alone.
pub(crate) fn beginning(dataset: &Dataset, steps: usize) -> Result<ObjectTree, WriteError> {
    let mut content = ObjectTree::new();
    let mut root = GroupWriter { path: String::new(), content: &mut content };
    root.attribute("format", &"ppum".to_owned())?;
    root.attribute("format_version", &<[u32; 2]>::from(FORMAT_VERSION))?;
    root.put(HEAD, dataset)?;
    for (k, step) in dataset.steps.iter().take(steps).enumerate() {
        root.group(&step_path(k)).put(STEP, step)?;
    }
    Ok(content)
}

/// A step under its names in the file.
pub(crate) fn one_step(number: usize, step: &Step) -> Result<ObjectTree, WriteError> {
    let mut content = ObjectTree::new();
    GroupWriter { path: step_path(number), content: &mut content }.put(STEP, step)?;
    Ok(content)
}
