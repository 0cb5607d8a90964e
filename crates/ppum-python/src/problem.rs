//! Problems: read, checked, solved.

use std::path::PathBuf;

use ppum::progress::Watcher;
use ppum_fracture::growth::series;
use ppum_fracture::solve::Plan;
use ppum_problem::Problem;
use pyo3::prelude::*;

use crate::dataset::PyDataset;
use crate::errors::{ProblemFinding, findings, problem, ungrown, unsolved};
use crate::watch::long;

/// Everything that is wrong in the text of a problem; nothing if it can be read.
#[pyfunction]
pub(crate) fn check(
    py: Python<'_>,
    text: &str,
    name: &str,
    folder: PathBuf,
) -> PyResult<Vec<ProblemFinding>> {
    let read = long(py, None, None, |_| Problem::parse(text, name, &folder))?;
    Ok(read.err().map_or_else(Vec::new, |mistakes| findings(&mistakes)))
}

/// Solves the problem of a text; files that it names are looked for in the folder. A problem with
/// growing cracks gives all steps of the series.
#[pyfunction]
#[pyo3(signature = (text, name, folder, memory=None, threads=None, progress=None))]
pub(crate) fn solve(
    py: Python<'_>,
    text: &str,
    name: &str,
    folder: PathBuf,
    memory: Option<u64>,
    threads: Option<usize>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<PyDataset> {
    let read = long(py, threads, None, |_| Problem::parse(text, name, &folder))?;
    let read = read.map_err(|mistakes| problem(&mistakes))?;
    let progress = progress.as_ref();
    let solved = if read.growth.is_some() {
        let grown = |watcher: &dyn Watcher| series(&read, memory, watcher);
        long(py, threads, progress, grown)?.map_err(ungrown)
    } else {
        let once = |watcher: &dyn Watcher| Plan::new(&read, memory, watcher)?.solve(watcher);
        long(py, threads, progress, once)?.map_err(unsolved)
    };
    solved.map(PyDataset::new)
}
