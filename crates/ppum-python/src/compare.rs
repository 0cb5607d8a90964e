//! Comparisons: of two fields, and of a field with what resampling makes of it.

use numpy::{PyArray1, PyArray2, PyArrayMethods as _};
use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use ppum_render::RenderError as Undrawn;
use ppum_render::raster::Raster;
use ppum_render::resample::need::{Convergence, ResamplingSetup, converge};
use ppum_render::resample::norms::{Norms, difference};
use ppum_render::resample::{Grid, Interpolation, representation_bytes};
use ppum_render::scatter::render;
use ppum_render::view::View;
use ppum_scene::compare::{NeededGrid, Resampled};
use ppum_scene::drawing::{RasterValues, Shown};
use ppum_scene::minus::{Minus, Side};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::{RenderError, rendering};
use crate::field::Field;
use crate::picture::{Spot, view};
use crate::watch::long;

/// How far one picture is from another.
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
    fn new(norms: &Norms) -> Self {
        let Norms { absolute, compared, infinite, lost, invented, .. } = *norms;
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
    this: &Field,
    py: Python<'py>,
    other: &Field,
    name: &str,
    spot: Spot,
    size: [u32; 2],
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(PyRows<'py>, NormsFacts, Vec<String>)> {
    let both = |_: &dyn Watcher| PyResult::Ok((this.shown(name)?, other.shown(name)?));
    let ((own, its), view) = (long(py, None, None, both)??, view(spot, size)?);
    let right = Side { field: this.owned.field(), shown: &own };
    let minus = Minus { right, left: Side { field: other.owned.field(), shown: &its } };
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
pub(crate) struct Way {
    #[pyo3(item)]
    method: String,
    #[pyo3(item)]
    grid: [u32; 2],
    /// True if the grid lies over the view, false if over the plate.
    #[pyo3(item)]
    over_view: bool,
    /// The relative error that a grid is looked for with.
    #[pyo3(item)]
    error: Option<f64>,
}

impl Way {
    /// The grid, and what is done between its points; none for the cells of the cover.
    fn of(&self, field: &Field, view: &View) -> PyResult<Option<(Grid, Interpolation)>> {
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
            true => Grid::over_view(view, self.grid),
            false => Grid::over_domain(field.owned.field(), self.grid),
        };
        let grid = grid.map_err(|error| RenderError::new_err(error.to_string()))?;
        Ok(Some((grid, interpolation)))
    }
}

/// A resampled picture beside the direct one, and how errors fall with finer grids.
struct ResampledPicture {
    direct: Raster,
    resampled: Resampled,
    convergence: Option<Convergence>,
}

/// What is told of the grid for an error, in one norm.
#[derive(IntoPyObject)]
struct NeededFacts {
    kind: &'static str,
    grid: Option<[f64; 2]>,
    reason: Option<&'static str>,
}

/// What is told of a resampled picture.
#[derive(IntoPyObject)]
pub(crate) struct ResampledFacts {
    /// Memory of the values that it is made of, and of all that the field is made of.
    bytes: u64,
    direct_bytes: u64,
    needed: Option<Vec<NeededFacts>>,
}

impl ResampledFacts {
    fn new(field: &Field, way: &Way, found: &ResampledPicture) -> Self {
        let one = |found: &Convergence, error: f64| {
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

impl Field {
    fn resampled(
        &self,
        quantity: &Quantity,
        view: &View,
        grid: Option<(Grid, Interpolation)>,
        error: Option<f64>,
        watcher: &dyn Watcher,
    ) -> Result<ResampledPicture, Undrawn> {
        let field = self.owned.field();
        let direct = render::<f64>(field, view, quantity, watcher)?;
        let Some((grid, interpolation)) = grid else {
            let resampled = Resampled::on_cells(field, quantity, view, &direct, watcher)?;
            return Ok(ResampledPicture { direct, resampled, convergence: None });
        };
        let samples = grid.sample(field, quantity, watcher)?;
        let resampled = Resampled::on_grid(&samples, interpolation, view, &direct);
        let subject = ResamplingSetup { field, view, quantity, grid, interpolation };
        let convergence = error.map(|error| converge(&subject, error, watcher)).transpose()?;
        Ok(ResampledPicture { direct, resampled, convergence })
    }
}

/// What resampling makes of a quantity at the pixels of a view: its values, minus the exact ones
/// too, norms of these.
#[pyfunction]
pub(crate) fn resample<'py>(
    this: &Field,
    py: Python<'py>,
    name: &str,
    way: Way,
    spot: Spot,
    size: [u32; 2],
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(PyRows<'py>, PyRows<'py>, NormsFacts, ResampledFacts)> {
    let (what, view) = (long(py, None, None, |_| this.shown(name))??, view(spot, size)?);
    let Shown::Quantity(quantity) = what else {
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
