//! Stress intensity factors found from a field, whoever made it.

use ppum::crack::{TipId, tips};
use ppum::dataset::{Dataset, TipIntensity};
use ppum::progress::Watcher;
use ppum_fracture::diagnostics::recompute;
use ppum_fracture::intensity::{CircleError, TipResult, on_circle};
use ppum_fracture::solve::SolveError as Unsolved;
use ppum_problem::Problem;
use ppum_scene::facts::Tip;
use ppum_scene::region::numbered_tip;
use pyo3::prelude::*;

use crate::errors::{SolveError, cancelled, no_field, picture, unsolved};
use crate::facts::to_python;
use crate::field::PyField;
use crate::watch::long;

/// The tips with the names of their ends, and the messages of the diagnostics.
type TipResults<'py> = (Bound<'py, PyAny>, Vec<&'static str>, Vec<String>);

/// The factors of one tip by the discs inside a circle of a radius, or those of all tips by the
/// discs that the solver chooses.
#[pyfunction]
pub(crate) fn intensities<'py>(
    this: &PyField,
    py: Python<'py>,
    on: Option<(usize, f64)>,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<TipResults<'py>> {
    let (dataset, step) = this.place();
    let problem = loads(dataset, step)?;
    let problem = problem.as_ref();
    let mut ids: Vec<TipId> = tips(&dataset.steps[step].cracks).collect();
    let progress = progress.as_ref();
    let (found, warnings) = match on {
        Some((tip, radius)) => {
            let tip = numbered_tip(this.field(), tip).map_err(|error| picture(error.into()))?;
            let found =
                |watcher: &dyn Watcher| on_circle(dataset, step, tip, radius, problem, watcher);
            let factors = long(py, None, progress, found)?.map_err(unfound)?;
            ids = vec![tip];
            (vec![Tip::new(dataset, step, &factors)], Vec::new())
        }
        None => all(py, dataset, step, problem, progress)?,
    };
    let ends = ids.iter().map(|tip| tip.end.name()).collect();
    Ok((to_python(py, &found)?, ends, warnings))
}

fn all(
    py: Python<'_>,
    dataset: &Dataset,
    step: usize,
    problem: Option<&Problem>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<(Vec<Tip>, Vec<String>)> {
    let found = |watcher: &dyn Watcher| recompute(dataset, step, problem, watcher);
    let (outcomes, warnings) = long(py, None, progress, found)?.map_err(|error| match error {
        Unsolved::Field(error) => no_field(error),
        error => unsolved(error),
    })?;
    let tip = |outcome: &TipResult| {
        let unknown = || TipIntensity::new(outcome.tip, f64::NAN, f64::NAN);
        Tip::new(dataset, step, &outcome.factors.clone().unwrap_or_else(unknown))
    };
    let messages = warnings.into_iter().map(|warning| warning.message).collect();
    Ok((outcomes.iter().map(tip).collect(), messages))
}

/// The problem whose loads act near the tips; none if the dataset holds none, or its field is
/// no displacement.
///
/// # Errors
/// A problem that cannot be read, or one on other cracks: its loads are not known.
fn loads(dataset: &Dataset, step: usize) -> PyResult<Option<Problem>> {
    if dataset.equation.elastic().is_none() {
        let why = "only displacements of elasticity have stress intensity factors";
        return Err(SolveError::new_err(why));
    }
    Problem::of_step(dataset, step).map_err(|mistakes| {
        SolveError::new_err(format!(
            "the loads near the tips are not known: {mistakes}; the step's `tips` have the factors that the solver \
             found"
        ))
    })
}

fn unfound(error: CircleError) -> PyErr {
    match error {
        CircleError::Cancelled(error) => cancelled(error),
        CircleError::Field(error) => no_field(error),
        error => SolveError::new_err(error.to_string()),
    }
}
