//! Comparisons: of two fields, and of a field with what resampling makes of it.

use numpy::{PyArray1, PyArray2, PyArrayMethods as _};
use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use ppum_render::RasterError as Undrawn;
use ppum_render::raster::Raster;
use ppum_render::resample::need::{GridConvergence, ResamplingSetup, converge};
use ppum_render::resample::norms::{DifferenceNorms, difference};
use ppum_render::resample::{Interpolation, SampleGrid, representation_bytes};
use ppum_render::scatter::render;
use ppum_render::view::View;
use ppum_scene::compare::{NeededGrid, ResampledImage};
use ppum_scene::difference::{DifferenceSide, FieldDifference};
use ppum_scene::drawing::{DisplayedQuantity, RasterValues};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::{RenderError, rendering};
use crate::field::PyField;
use crate::picture::{CenterAndWidth, view};
use crate::watch::long;

/// How far one image is from another.
#[derive(IntoPyObject)]
pub(crate) struct NormsFacts {
    absolute: [f64; 3],
    relative: [f64; 3],
    compared: usize,
    infinite: usize,
    lost: usize,
    invented: usize,
}

impl NormsFacts {
    fn new(norms: &DifferenceNorms) -> Self {
        let DifferenceNorms { absolute, compared, infinite, lost, invented, .. } = *norms;
        Self { absolute, relative: norms.relative(), compared, infinite, lost, invented }
    }
}

type PyRows<'py> = Bound<'py, PyArray2<f64>>;

/// The values of a raster, rows from the top.
fn rows<'py>(py: Python<'py>, raster: Raster) -> PyResult<PyRows<'py>> {
    let shape = raster.size.map(|n| n as usize);
    PyArray1::from_vec(py, raster.values).reshape([shape[1], shape[0]])
}

/// A quantity of one field minus that of another at the pixels of a view: values, norms, what makes
/// it less than it seems.
#[pyfunction]
pub(crate) fn compare<'py>(
    this: &PyField,
    py: Python<'py>,
    other: &PyField,
    name: &str,
    spot: CenterAndWidth,
    size: [u32; 2],
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(PyRows<'py>, NormsFacts, Vec<String>)> {
    let both = |_: &dyn Watcher| PyResult::Ok((this.shown(name)?, other.shown(name)?));
    let ((own, its), view) = (long(py, None, None, both)??, view(spot, size)?);
    let right = DifferenceSide { field: this.owned.field(), shown: &own };
    let minus =
        FieldDifference { right, left: DifferenceSide { field: other.owned.field(), shown: &its } };
    let drawn = |watcher: &dyn Watcher| minus.draw(&view, watcher);
    let drawn = long(py, None, progress.as_ref(), drawn)?.map_err(rendering)?;
    let norms = NormsFacts::new(&drawn.norms.unwrap_or_default());
    let RasterValues::Double(raster) = drawn.values else {
        unreachable!("differences are of double precision")
    };
    Ok((rows(py, raster)?, norms, minus.warnings()))
}

/// A way of resampling, as Python's layer says it.
#[derive(FromPyObject)]
pub(crate) struct ResamplingChoice {
    #[pyo3(item)]
    method: String,
    #[pyo3(item)]
    grid: [u32; 2],
    /// True if the grid lies over the view, false if over the body.
    #[pyo3(item)]
    over_view: bool,
    /// The relative error that a grid is looked for with.
    #[pyo3(item)]
    error: Option<f64>,
}

impl ResamplingChoice {
    /// The grid, and what is done between its points; none for the cells of the cover.
    fn of(&self, field: &PyField, view: &View) -> PyResult<Option<(SampleGrid, Interpolation)>> {
        if self.method == "cells" {
            return Ok(None);
        }
        let Ok(interpolation) = self.method.parse() else {
            let known = "there are nearest, bilinear, bicubic, cells";
            return Err(PyValueError::new_err(format!(
                "method: `{}` is none; {known}",
                self.method
            )));
        };
        let grid = match self.over_view {
            true => SampleGrid::over_view(view, self.grid),
            false => SampleGrid::over_domain(field.owned.field(), self.grid),
        };
        let grid = grid.map_err(|error| RenderError::new_err(error.to_string()))?;
        Ok(Some((grid, interpolation)))
    }
}

/// A resampled image beside the direct one, and how errors fall with finer grids.
struct ResampledPicture {
    direct: Raster,
    resampled: ResampledImage,
    convergence: Option<GridConvergence>,
}

/// The facts about the grid for an error, in one norm.
#[derive(IntoPyObject)]
struct NeededFacts {
    kind: &'static str,
    grid: Option<[f64; 2]>,
    reason: Option<&'static str>,
}

/// The facts about a resampled image.
#[derive(IntoPyObject)]
pub(crate) struct ResampledFacts {
    /// Memory of the values that it is made of, and of all that the field is made of.
    bytes: u64,
    direct_bytes: u64,
    needed: Option<Vec<NeededFacts>>,
}

impl ResampledFacts {
    fn new(field: &PyField, way: &ResamplingChoice, found: &ResampledPicture) -> Self {
        let one = |found: &GridConvergence, error: f64| {
            let needed = (0..3).map(|norm| NeededGrid::new(found.needed(norm, error)));
            needed
                .map(|NeededGrid { kind, size, reason }| NeededFacts { kind, grid: size, reason })
                .collect()
        };
        let needed =
            found.convergence.as_ref().zip(way.error).map(|(found, error)| one(found, error));
        let direct_bytes = representation_bytes(field.owned.field());
        Self { bytes: found.resampled.bytes, direct_bytes, needed }
    }
}

impl PyField {
    fn resampled(
        &self,
        quantity: &Quantity,
        view: &View,
        grid: Option<(SampleGrid, Interpolation)>,
        error: Option<f64>,
        watcher: &dyn Watcher,
    ) -> Result<ResampledPicture, Undrawn> {
        let field = self.owned.field();
        let direct = render::<f64>(field, view, quantity, watcher)?;
        let Some((grid, interpolation)) = grid else {
            let resampled = ResampledImage::on_cells(field, quantity, view, &direct, watcher)?;
            return Ok(ResampledPicture { direct, resampled, convergence: None });
        };
        let samples = grid.sample(field, quantity, watcher)?;
        let resampled = ResampledImage::on_grid(&samples, interpolation, view, &direct);
        let subject = ResamplingSetup { field, view, quantity, grid, interpolation };
        let convergence = error.map(|error| converge(&subject, error, watcher)).transpose()?;
        Ok(ResampledPicture { direct, resampled, convergence })
    }
}

/// Resamples a quantity at the pixels of a view: its values, minus the exact ones too, norms of
/// these.
#[pyfunction]
pub(crate) fn resample<'py>(
    this: &PyField,
    py: Python<'py>,
    name: &str,
    way: ResamplingChoice,
    spot: CenterAndWidth,
    size: [u32; 2],
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(PyRows<'py>, PyRows<'py>, NormsFacts, ResampledFacts)> {
    let (what, view) = (long(py, None, None, |_| this.shown(name))??, view(spot, size)?);
    let DisplayedQuantity::Quantity(quantity) = what else {
        return Err(RenderError::new_err(format!(
            "`{name}` is constant in each cell: nothing is lost by resampling"
        )));
    };
    let grid = way.of(this, &view)?;
    let drawn = |watcher: &dyn Watcher| this.resampled(&quantity, &view, grid, way.error, watcher);
    let found = long(py, None, progress.as_ref(), drawn)?.map_err(rendering)?;
    let facts = ResampledFacts::new(this, &way, &found);
    let norms = NormsFacts::new(&found.resampled.norms);
    let apart = difference(&found.direct, &found.resampled.raster);
    Ok((rows(py, apart)?, rows(py, found.resampled.raster)?, norms, facts))
}
