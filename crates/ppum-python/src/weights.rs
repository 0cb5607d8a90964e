//! Weight functions, and factors of loads by them.

use std::path::PathBuf;

use numpy::{PyArray1, PyArray2};
use ppum::dataset::Dataset as Data;
use ppum::vec2::Vec2;
use ppum_fracture::weight::{self, WeightError};
use ppum_problem::Problem;
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;

use crate::dataset::PyDataset;
use crate::errors::{SolveError, problem, unsolved};
use crate::values::rows;
use crate::watch::long;

/// The text of a problem, its name and the folder of files that it names.
type ProblemText = (String, String, PathBuf);

/// Places, normals, whether they lie on the face to the right, lengths along the crack, and the
/// influence of forces and of strains there.
type Influences<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
);

fn no_weight(error: WeightError) -> PyErr {
    match error {
        WeightError::Solve(error) => unsolved(error),
        WeightError::Problem(mistakes) => problem(&mistakes),
        error @ WeightError::NoTip { .. } => PyIndexError::new_err(error.to_string()),
        error => SolveError::new_err(error.to_string()),
    }
}

/// The results of all steps.
fn of_steps<T>(
    data: &Data,
    of: impl Fn(usize) -> Result<T, WeightError>,
) -> Result<Vec<T>, WeightError> {
    (0..data.steps.len()).map(of).collect()
}

fn read(py: Python<'_>, (text, name, folder): &ProblemText) -> PyResult<Problem> {
    let read = long(py, None, None, |_| Problem::parse(text, name, folder))?;
    read.map_err(|mistakes| problem(&mistakes))
}

/// The weight functions of one tip or of all tips of a step of a solved problem, whose text the
/// dataset holds, and the mode of each of its steps.
#[pyfunction]
pub(crate) fn weight_functions(
    py: Python<'_>,
    dataset: &PyDataset,
    step: usize,
    tip: Option<usize>,
    memory: Option<u64>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<(PyDataset, Vec<usize>)> {
    let data = dataset.at(step)?;
    let own = Problem::of_step(&data, step).map_err(|mistakes| problem(&mistakes))?;
    let own = own.ok_or_else(|| no_weight(WeightError::NoProblem))?;
    let found = long(py, None, progress.as_ref(), |watcher| {
        weight::weight_functions(&own, tip, memory, watcher)
    })?;
    let found = found.map_err(no_weight)?;
    let modes = of_steps(&found, |step| weight::mode(&found, step)).map_err(no_weight)?;
    Ok((PyDataset::new(found), modes))
}

/// K of the loads of a problem by the weight function of each step.
#[pyfunction]
pub(crate) fn factor(
    py: Python<'_>,
    weights: &PyDataset,
    loads: ProblemText,
) -> PyResult<Vec<f64>> {
    let (data, loads) = (weights.whole()?, read(py, &loads)?);
    let all = long(py, None, None, |watcher| {
        of_steps(&data, |step| weight::factor(&data, step, &loads, watcher))
    })?;
    all.map_err(no_weight)
}

/// The influence of tractions on the place of a boundary condition of a problem, by its number, or
/// of forces and strains inside, by the weight function of a step.
#[pyfunction]
pub(crate) fn influence<'py>(
    py: Python<'py>,
    weights: &PyDataset,
    step: usize,
    loads: ProblemText,
    condition: Option<usize>,
) -> PyResult<Influences<'py>> {
    let (data, loads) = (weights.at(step)?, read(py, &loads)?);
    let on = condition.map(|number| loads.boundary[number].on);
    let found = long(py, None, None, |_| {
        let found = weight::influence(&data, step, &loads, on)?;
        let lengths = weight::lengths(&data, step, &found.at)?;
        Ok((found, lengths))
    })?;
    let (found, lengths) = found.map_err(no_weight)?;
    let pairs = |all: &[Vec2]| rows(py, all.iter().flat_map(|p| [p.x, p.y]).collect(), 2);
    Ok((
        pairs(&found.at)?,
        pairs(&found.normals)?,
        PyArray1::from_vec(py, found.below),
        PyArray1::from_vec(py, lengths),
        rows(py, found.forces.into_iter().flatten().collect(), 2)?,
        rows(py, found.strains.into_iter().flatten().collect(), 3)?,
    ))
}

/// Influence coefficients of powers of pressures on the crack of the weight function of each step.
#[pyfunction]
pub(crate) fn polynomials(
    py: Python<'_>,
    weights: &PyDataset,
    count: usize,
) -> PyResult<Vec<Vec<f64>>> {
    let data = weights.whole()?;
    let all =
        long(py, None, None, |_| of_steps(&data, |step| weight::polynomials(&data, step, count)))?;
    all.map_err(no_weight)
}

/// The change of the displacement with the length of the crack, of steps and their factors.
#[pyfunction]
pub(crate) fn rate(
    py: Python<'_>,
    weights: &PyDataset,
    parts: Vec<(usize, f64)>,
) -> PyResult<PyDataset> {
    let data = weights.whole()?;
    long(py, None, None, |_| weight::rate(&data, &parts))?.map(PyDataset::new).map_err(no_weight)
}

/// The derivatives of K by a parameter, of which two problems have values so far apart, by the
/// weight function of each step and the last step of a solution with the value between them.
#[pyfunction]
pub(crate) fn derivative(
    py: Python<'_>,
    weights: &PyDataset,
    solution: &PyDataset,
    loads: [ProblemText; 2],
    between: f64,
) -> PyResult<Vec<f64>> {
    let (data, solved) = (weights.whole()?, solution.whole()?);
    let problems = [read(py, &loads[0])?, read(py, &loads[1])?];
    let last = (&*solved, solved.steps.len() - 1);
    let all = long(py, None, None, |watcher| {
        of_steps(&data, |step| {
            weight::derivative((&data, step), last, problems.each_ref(), between, watcher)
        })
    })?;
    all.map_err(no_weight)
}
