//! Datasets: files, bytes, and what stands in them.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use ppum::dataset::Dataset as Data;
use ppum_format::{Series, from_bytes as decode, to_bytes, write};
use ppum_solve::report::ASSEMBLY_SECONDS;
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors::{unreadable, unwritable};
use crate::facts::{self, step_json};
use crate::watch::{guard, long};

/// A dataset, which never changes.
#[pyclass(name = "Dataset", frozen, module = "ppum._core")]
pub(crate) struct PyDataset(StepStorage);

/// The steps of a dataset.
enum StepStorage {
    /// In memory.
    Whole(Arc<Data>),
    /// In a file, read when they are asked for.
    Stored { series: Box<Series>, name: String, newest: Mutex<Option<(usize, Arc<Data>)>> },
}

/// Opens a file; one of several steps stays open.
#[pyfunction]
pub(crate) fn read(py: Python<'_>, path: PathBuf) -> PyResult<PyDataset> {
    let name = path.display().to_string();
    let opened = long(py, None, None, |_| match Series::open(&path)? {
        series if series.can_grow() && series.len() > 1 => Ok(Err(series)),
        series => series.into_dataset(0).map(Ok),
    })?;
    match opened.map_err(|error| unreadable(&name, error))? {
        Ok(data) => Ok(PyDataset::new(data)),
        Err(series) => Ok(PyDataset(StepStorage::Stored {
            series: Box::new(series),
            name,
            newest: Mutex::default(),
        })),
    }
}

/// Reads the bytes of a file.
#[pyfunction]
pub(crate) fn from_bytes(py: Python<'_>, bytes: Vec<u8>) -> PyResult<PyDataset> {
    let read = long(py, None, None, |_| decode(bytes))?;
    read.map(PyDataset::new).map_err(|error| unreadable("the bytes of a dataset", error))
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

impl PyDataset {
    pub(crate) fn new(dataset: Data) -> Self {
        Self(StepStorage::Whole(Arc::new(dataset)))
    }

    /// Returns the data that all steps have in common.
    fn head(&self) -> &Data {
        match &self.0 {
            StepStorage::Whole(data) => data,
            StepStorage::Stored { series, .. } => series.head(),
        }
    }

    /// The dataset with a step at its number; of a file the other steps are empty.
    ///
    /// # Errors
    /// `IndexError`; a step that cannot be read.
    pub(crate) fn at(&self, number: usize) -> PyResult<Arc<Data>> {
        let count = self.__len__();
        if number >= count {
            return Err(PyIndexError::new_err(format!(
                "there is no step {number}; the dataset has {count} (numbered from 0)"
            )));
        }
        match &self.0 {
            StepStorage::Whole(data) => Ok(Arc::clone(data)),
            StepStorage::Stored { series, name, newest } => {
                let known = || newest.lock().unwrap_or_else(PoisonError::into_inner);
                if let Some((_, data)) = known().as_ref().filter(|(of, _)| *of == number) {
                    return Ok(Arc::clone(data));
                }
                // without the lock: a thread that waits for parts of a step may begin another one
                let data = Arc::new(series.at(number).map_err(|error| unreadable(name, error))?);
                *known() = Some((number, Arc::clone(&data)));
                Ok(data)
            }
        }
    }

    /// The dataset with all steps, or with what the solver tells of them alone.
    fn filled(&self, is_whole: bool) -> PyResult<Arc<Data>> {
        let (series, name) = match &self.0 {
            StepStorage::Whole(data) => return Ok(Arc::clone(data)),
            StepStorage::Stored { series, name, .. } => (series, name),
        };
        let step = |number| match is_whole {
            true => series.dataset(number).map(|mut data| data.steps.remove(0)),
            false => series.results(number),
        };
        let mut data = series.head().clone();
        let steps = (0..series.len()).map(step).collect::<Result<_, _>>();
        data.steps = steps.map_err(|error| unreadable(name, error))?;
        Ok(Arc::new(data))
    }

    /// The dataset with all steps.
    ///
    /// # Errors
    /// Steps that cannot be read.
    pub(crate) fn whole(&self) -> PyResult<Arc<Data>> {
        self.filled(true)
    }

    /// The dataset with the cracks of all steps and what the solver tells of them.
    ///
    /// # Errors
    /// Steps that cannot be read.
    pub(crate) fn results(&self) -> PyResult<Arc<Data>> {
        self.filled(false)
    }
}

#[pymethods]
impl PyDataset {
    /// Writes a file, in one step: what was there before stays until the new one is complete.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        long(py, None, None, |_| write(&*self.whole()?, &path).map_err(unwritable))?
    }

    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = long(py, None, None, |_| to_bytes(&*self.whole()?).map_err(unwritable))??;
        Ok(PyBytes::new(py, &bytes))
    }

    fn __len__(&self) -> usize {
        match &self.0 {
            StepStorage::Whole(data) => data.steps.len(),
            StepStorage::Stored { series, .. } => series.len(),
        }
    }

    /// True if steps are read when they are asked for.
    fn is_stored(&self) -> bool {
        matches!(self.0, StepStorage::Stored { .. })
    }

    /// Whether all numbers and texts are equal, except for the times that solving took.
    fn __eq__(&self, py: Python<'_>, other: &Self) -> PyResult<bool> {
        if self.__len__() != other.__len__() {
            return Ok(false);
        }
        long(py, None, None, |_| {
            let (one, other) = (self.whole()?, other.whole()?);
            Ok(*one == *other || are_equal_untimed(&one, &other))
        })?
    }

    /// Returns the data that all steps have in common.
    fn about<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        guard(|| facts::about(py, self.head()))
    }

    /// Returns the content of a step except for its fields.
    fn step<'py>(&self, py: Python<'py>, number: usize) -> PyResult<Bound<'py, PyAny>> {
        let json = long(py, None, None, |_| self.at(number).map(|data| step_json(&data, number)))??;
        facts::parsed(py, &json)
    }

    /// The stored values of cells, by their names.
    fn attributes<'py>(
        &self,
        py: Python<'py>,
        number: usize,
    ) -> PyResult<Vec<(String, Bound<'py, numpy::PyArray1<f64>>)>> {
        let data = self.at(number)?;
        let array = |values: &[f64]| numpy::PyArray1::from_slice(py, values);
        let all = data.steps[number].attributes.iter();
        Ok(all.map(|a| (a.name.clone(), array(&a.values))).collect())
    }
}
