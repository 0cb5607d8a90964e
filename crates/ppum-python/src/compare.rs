//! Comparisons: of two fields, and of a field with what resampling makes of it.

use numpy::PyArray2;
use ppum::progress::Watcher;
use ppum_render::RasterError as Undrawn;
use ppum_render::resample::need::{GridConvergence, ResamplingSetup, converge};
use ppum_render::resample::norms::{DifferenceNorms, difference};
use ppum_render::resample::{Interpolation, SampleGrid, representation_bytes};
use ppum_render::scatter::render;
use ppum_render::view::View;
use ppum_scene::compare::{NeededGrid, ResampledImage};
use ppum_scene::difference::{DifferenceSide, FieldDifference};
use ppum_scene::quantity::DisplayedQuantity;
use ppum_scene::values::RasterValues;
use pyo3::prelude::*;

use crate::errors::{RenderError, render_error, rendering};
use crate::field::{PyField, read_data};
use crate::picture::PyView;
use crate::values::rows;
use crate::watch::long;

/// How far one image is from another: absolute and relative norms, and the pixels that are
/// compared, infinite, lost and invented.
type NormsFacts = ([f64; 3], [f64; 3], [usize; 4]);

fn facts(norms: &DifferenceNorms) -> NormsFacts {
    let DifferenceNorms { absolute, compared, infinite, lost, invented, .. } = *norms;
    (absolute, norms.relative(), [compared, infinite, lost, invented])
}

type PyRows<'py> = Bound<'py, PyArray2<f64>>;

/// A quantity of one field minus that of another at the pixels of a view: values, norms, what makes
/// it less than it seems.
#[pyfunction]
pub(crate) fn compare<'py>(
    this: &PyField,
    py: Python<'py>,
    other: &PyField,
    name: &str,
    view: PyView,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(PyRows<'py>, NormsFacts, Vec<String>)> {
    let both = |_: &dyn Watcher| PyResult::Ok((this.shown(name)?, other.shown(name)?));
    let ((own, its), view) = (long(py, None, None, both)??, view.checked()?);
    let right = DifferenceSide { field: this.field(), shown: &own };
    let minus =
        FieldDifference { right, left: DifferenceSide { field: other.field(), shown: &its } };
    let drawn = |watcher: &dyn Watcher| minus.draw(&view, watcher);
    let drawn = long(py, None, progress.as_ref(), drawn)?.map_err(rendering)?;
    let norms = facts(&drawn.norms.unwrap_or_default());
    let RasterValues::Double(raster) = drawn.values else {
        unreachable!("differences are of double precision")
    };
    Ok((rows(py, raster.values, view.pixels[0])?, norms, minus.warnings()))
}

/// A way of resampling.
#[derive(serde::Deserialize)]
struct ResamplingChoice {
    method: String,
    grid: [u32; 2],
    /// True if the grid lies over the view, false if over the body.
    over_view: bool,
    /// The relative error that a grid is looked for with.
    error: Option<f64>,
}

impl ResamplingChoice {
    /// The grid, and what is done between its points; none for the cells of the cover.
    fn of(&self, field: &PyField, view: &View) -> PyResult<Option<(SampleGrid, Interpolation)>> {
        let Ok(interpolation) = self.method.parse() else { return Ok(None) };
        let grid = match self.over_view {
            true => SampleGrid::over_view(view, self.grid),
            false => SampleGrid::over_domain(field.field(), self.grid),
        };
        Ok(Some((grid.map_err(render_error)?, interpolation)))
    }
}

/// Kind, size and reason of the grid for an error, in one norm.
type NeededFacts = (&'static str, Option<(f64, f64)>, Option<&'static str>);

fn needed(convergence: &GridConvergence, error: f64) -> Vec<NeededFacts> {
    let needed = (0..3).map(|norm| NeededGrid::new(convergence.needed(norm, error)));
    needed.map(|one| (one.kind, one.size.map(Into::into), one.reason)).collect()
}

/// The memory of a resampled image and that of the field, and the grid that an error needs.
type ResampledFacts = (u64, u64, Option<Vec<NeededFacts>>);

/// Resamples a quantity at the pixels of a view: its values, minus the exact ones too, norms of
/// these.
#[pyfunction]
pub(crate) fn resample<'py>(
    this: &PyField,
    py: Python<'py>,
    name: &str,
    way: &Bound<'_, PyAny>,
    view: PyView,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(PyRows<'py>, PyRows<'py>, NormsFacts, ResampledFacts)> {
    let (what, view) = (this.displayed(py, name)?, view.checked()?);
    let way = read_data::<ResamplingChoice>(way)?;
    let DisplayedQuantity::Quantity(quantity) = what else {
        return Err(RenderError::new_err(format!(
            "`{name}` is constant in each cell: nothing is lost by resampling"
        )));
    };
    let (field, grid) = (this.field(), way.of(this, &view)?);
    let drawn = |watcher: &dyn Watcher| -> Result<_, Undrawn> {
        let direct = render::<f64>(field, &view, &quantity, watcher)?;
        let Some((grid, interpolation)) = grid else {
            let resampled = ResampledImage::on_cells(field, &quantity, &view, &direct, watcher)?;
            return Ok((direct, resampled, None));
        };
        let samples = grid.sample(field, &quantity, watcher)?;
        let resampled = ResampledImage::on_grid(&samples, interpolation, &view, &direct);
        let (view, quantity) = (&view, &quantity);
        let subject = ResamplingSetup { field, view, quantity, grid, interpolation };
        let error = way.error.map(|error| converge(&subject, error, watcher));
        Ok((direct, resampled, error.transpose()?))
    };
    let (direct, resampled, convergence) =
        long(py, None, progress.as_ref(), drawn)?.map_err(rendering)?;
    let needed = convergence.zip(way.error).map(|(found, error)| needed(&found, error));
    let memory = (resampled.bytes, representation_bytes(this.field()), needed);
    let apart = difference(&direct, &resampled.raster);
    let [apart, values] =
        [apart, resampled.raster].map(|raster| rows(py, raster.values, view.pixels[0]));
    Ok((apart?, values?, facts(&resampled.norms), memory))
}
