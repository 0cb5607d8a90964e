//! Datasets: files, bytes, and what stands in them.

use std::path::PathBuf;
use std::sync::Arc;

use ppum::dataset::Dataset as Data;
use ppum_format::{from_bytes as decode, to_bytes, write};
use ppum_solve::report::ASSEMBLY_SECONDS;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors::{unreadable, unwritable};
use crate::facts;
use crate::watch::{guard, long};

/// A dataset, which never changes.
#[pyclass(frozen, module = "ppum._core")]
pub(crate) struct Dataset(pub(crate) Arc<Data>);

/// Reads a file with all its steps.
#[pyfunction]
pub(crate) fn read(py: Python<'_>, path: PathBuf) -> PyResult<Dataset> {
    let name = path.display().to_string();
    let read = long(py, None, None, |_| ppum_format::read(&path))?;
    read.map(Dataset::new).map_err(|error| unreadable(&name, error))
}

/// Reads the bytes of a file.
#[pyfunction]
pub(crate) fn from_bytes(py: Python<'_>, bytes: Vec<u8>) -> PyResult<Dataset> {
    let read = long(py, None, None, |_| decode(bytes))?;
    read.map(Dataset::new).map_err(|error| unreadable("the bytes of a dataset", error))
}

/// A copy without what differs from run to run: the seconds of phases and cells.
fn untimed(data: &Data) -> Data {
    let mut data = data.clone();
    for step in &mut data.steps {
        let seconds = step.history.iter_mut().filter(|record| record.unit == "s");
        seconds.for_each(|record| record.value = 0.0);
        step.attributes.retain(|attribute| attribute.name != ASSEMBLY_SECONDS);
    }
    data
}

/// Copies are made of datasets with equal fields alone, which differ in little else.
fn are_equal_untimed(one: &Data, other: &Data) -> bool {
    let mut steps = one.steps.iter().zip(&other.steps);
    one.steps.len() == other.steps.len()
        && steps.all(|(a, b)| a.fields == b.fields)
        && untimed(one) == untimed(other)
}

impl Dataset {
    pub(crate) fn new(dataset: Data) -> Self {
        Self(Arc::new(dataset))
    }
}

#[pymethods]
impl Dataset {
    /// Writes a file, in one step: what was there before stays until the new one is complete.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        long(py, None, None, |_| write(&self.0, &path))?.map_err(unwritable)
    }

    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = long(py, None, None, |_| to_bytes(&self.0))?.map_err(unwritable)?;
        Ok(PyBytes::new(py, &bytes))
    }

    fn __len__(&self) -> usize {
        self.0.steps.len()
    }

    /// Whether all numbers and texts are equal, but for the times that solving took.
    fn __eq__(&self, other: &Self) -> bool {
        *self.0 == *other.0 || are_equal_untimed(&self.0, &other.0)
    }

    /// What all steps have in common, as JSON.
    fn about(&self) -> PyResult<String> {
        guard(|| Ok(facts::about(&self.0)))
    }

    /// What is in a step but for its fields, as JSON.
    fn step(&self, number: usize) -> PyResult<String> {
        guard(|| facts::step_json(&self.0, number))
    }

    /// The stored values of cells, by their names.
    fn attributes<'py>(
        &self,
        py: Python<'py>,
        number: usize,
    ) -> PyResult<Vec<(String, Bound<'py, numpy::PyArray1<f64>>)>> {
        let step = facts::step(&self.0, number)?;
        let array = |values: &[f64]| numpy::PyArray1::from_slice(py, values);
        Ok(step.attributes.iter().map(|a| (a.name.clone(), array(&a.values))).collect())
    }
}
