//! The program's plots: curves over axes, as the bytes of files.

use std::sync::Arc;

use ppum::dataset::Dataset as Data;
use ppum::progress::Watcher;
use ppum_figure::plot::{LEAST, Plot, plot};
use ppum_scene::plots::{
    self, NamedDataset, PlotError, Profiles, SeriesAxis, SeriesNumber, SolverWork,
};
use ppum_scene::profile::ProfileCurve;
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::dataset::PyDataset;
use crate::errors::{RenderError, no_profile, render_error};
use crate::field::{PyField, read_data};
use crate::picture::page_format;
use crate::watch::long;

/// Curves over axes, ready to be drawn.
#[pyclass(frozen, module = "ppum._core")]
pub(crate) struct Curves {
    plot: Plot,
    names: Vec<String>,
    warnings: Vec<String>,
}

/// The label of a curve and its points.
type LabeledCurve = (String, Vec<[f64; 2]>);

#[pymethods]
impl Curves {
    /// The bytes of a file, `png`, `svg` or `pdf`.
    fn bytes<'py>(
        &self,
        py: Python<'py>,
        size: [u32; 2],
        form: &str,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let (form, [least, lowest]) = (page_format(form), LEAST);
        if size[0] < least || size[1] < lowest {
            let [width, height] = size;
            return Err(RenderError::new_err(format!(
                "a plot of {width}x{height} pixels leaves no room; give at least {least}x{lowest}"
            )));
        }
        let names: Vec<&str> = self.names.iter().map(String::as_str).collect();
        let texts = plots::texts(&names, &self.plot);
        let bytes = long(py, None, None, |_| form.bytes(&plot(&self.plot, size), None, &texts))?;
        Ok(PyBytes::new(py, &bytes?))
    }

    /// The labels of the curves as they are told, and their points.
    fn curves(&self) -> Vec<LabeledCurve> {
        let curves = self.plot.curves.iter();
        curves.map(|curve| (plots::plain(&curve.label), curve.points.clone())).collect()
    }

    /// Returns features that curves do not show.
    fn warnings(&self) -> Vec<String> {
        self.warnings.clone()
    }
}

/// Makes logarithmic the axes whose letters are given, and looks for what cannot be seen.
fn finished(mut plot: Plot, names: Vec<String>, log: &str) -> PyResult<Curves> {
    for (letter, axis) in [('x', &mut plot.x), ('y', &mut plot.y)] {
        if log.contains(letter) {
            *axis = std::mem::take(axis).logarithmic();
        }
    }
    let warnings = plots::check(&plot).map_err(unplotted)?;
    Ok(Curves { plot, names, warnings })
}

/// A plot that cannot be.
fn unplotted(error: PlotError) -> PyErr {
    match error {
        PlotError::Step { .. } => PyIndexError::new_err(error.to_string()),
        error => render_error(error),
    }
}

/// Quantities of fields along one curve.
#[pyfunction]
pub(crate) fn profiles(
    py: Python<'_>,
    named: Vec<(String, Py<PyField>)>,
    along: &Bound<'_, PyAny>,
    count: usize,
    quantities: Option<Vec<String>>,
    log: &str,
) -> PyResult<Curves> {
    let along = read_data::<ProfileCurve>(along)?;
    let jumps = quantities.is_none() && matches!(along, ProfileCurve::Crack { .. });
    let mut all = Profiles::new(along.variable(), jumps, named.len() > 1);
    for (name, field) in &named {
        let (this, field) = (field.get(), field.get().field());
        let wanted = match (&quantities, jumps) {
            (Some(wanted), _) => wanted.clone(),
            (None, true) => Vec::new(),
            (None, false) => vec![plots::usual(field).to_owned()],
        };
        let wanted: Vec<_> =
            wanted.iter().map(|name| this.spelled(name)).zip(this.quantities(&wanted)?).collect();
        let drawn = |watcher: &dyn Watcher| along.drawn(field, &wanted, count, watcher);
        let profile = long(py, None, None, drawn)?.map_err(no_profile)?;
        let dataset = this.dataset();
        all.add(NamedDataset { name, dataset }, field, &wanted, &profile.table);
    }
    let plot = all.plot();
    finished(plot, named.into_iter().map(|(name, _)| name).collect(), log)
}

/// The kind of plot of datasets.
#[derive(serde::Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
enum PlotKind {
    Convergence { step: Option<usize> },
    History { what: SolverWork, step: Option<usize> },
    Series { numbers: Vec<String>, over: SeriesAxis },
}

/// Plots data of the solver and of the steps of datasets.
#[pyfunction]
pub(crate) fn reports(
    py: Python<'_>,
    named: Vec<(String, Py<PyDataset>)>,
    kind: &Bound<'_, PyAny>,
    log: &str,
) -> PyResult<Curves> {
    let kind = read_data::<PlotKind>(kind)?;
    // errors follow from the fields, all else from what the solver tells
    let is_whole = matches!(kind, PlotKind::Convergence { .. });
    let data = |dataset: &PyDataset| if is_whole { dataset.whole() } else { dataset.results() };
    let datasets = named.iter().map(|(_, dataset)| data(dataset.get()));
    let datasets = datasets.collect::<PyResult<Vec<Arc<Data>>>>()?;
    let names: Vec<String> = named.into_iter().map(|(name, _)| name).collect();
    let pairs = names.iter().zip(&datasets);
    let named: Vec<_> = pairs.map(|(name, dataset)| NamedDataset { name, dataset }).collect();
    let plot = match kind {
        PlotKind::Convergence { step } => {
            long(py, None, None, |_| plots::convergence(&named, step))?
        }
        PlotKind::History { what, step } => plots::history(&named, what, step),
        PlotKind::Series { numbers, over } => {
            let numbers: Result<Vec<SeriesNumber>, _> = numbers.iter().map(|n| n.parse()).collect();
            numbers.and_then(|numbers| plots::series(&named, &numbers, over))
        }
    };
    finished(plot.map_err(unplotted)?, names, log)
}
