//! Triangles and pages of fields, for programs and people that have no `ppum`.

use numpy::{PyArray1, PyArray2, PyArrayMethods as _};
use ppum::vec2::Vec2;
use ppum_format::to_bytes;
use ppum_page::{LARGEST, PageStart, PageView, html};
use ppum_scene::export::vtkhdf::{ExportedStep, MOST_BYTES, file};
use ppum_scene::export::vtu::{FileNotes, write};
use ppum_scene::export::{Accuracy, ExportError, PointArray, resolve};
use ppum_scene::request::Request;
use ppum_scene::scene::Subject;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::dataset::PyDataset;
use crate::errors::{RenderError, cancelled, quantity, unwritable};
use crate::field::PyField;
use crate::picture::CenterAndWidth;
use crate::watch::long;

/// Columns and rows that give the first view of a page its shape.
const SHAPE: [u32; 2] = [1024, 768];

/// Triangles on which values are polynomials.
#[pyclass(frozen, module = "ppum._core")]
pub(crate) struct Triangles {
    step: ExportedStep,
}

/// How well an array is resolved.
#[derive(IntoPyObject)]
pub(crate) struct AccuracyFacts {
    name: String,
    range: f64,
    allowed: f64,
    largest: f64,
    share: f64,
    is_singular: bool,
}

#[pymethods]
impl Triangles {
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        rows(py, coordinates(&self.step.mesh.points), 2)
    }

    /// Points where arrays are infinite.
    fn singular<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        rows(py, coordinates(&self.step.mesh.singular), 2)
    }

    /// The numbers of the points of each.
    fn cells<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        let mesh = &self.step.mesh;
        rows(py, mesh.cells.clone(), mesh.cells.len() / mesh.triangles().len())
    }

    /// The values of an array, a row of components for each point.
    fn values<'py>(&self, py: Python<'py>, number: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let width = self.step.mesh.arrays[number].array.components.len();
        rows(py, self.step.mesh.values_of(number), width)
    }

    fn accuracy(&self) -> Vec<AccuracyFacts> {
        let facts = |a: &ppum_scene::export::MeasuredAccuracy| AccuracyFacts {
            name: a.array.name.clone(),
            range: a.range,
            allowed: a.allowed,
            largest: a.largest,
            share: a.share,
            is_singular: a.is_singular,
        };
        self.step.mesh.arrays.iter().map(facts).collect()
    }

    /// The radii about singular points within which the tolerance does not hold.
    fn radii<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.step.mesh.radii)
    }

    /// In words that the tolerance is not kept, if it is not.
    fn complaint(&self) -> Option<String> {
        self.step.mesh.complaint()
    }

    /// False if the limit of triangles ended the work.
    fn is_complete(&self) -> bool {
        self.step.mesh.is_complete
    }

    /// The bytes of a `.vtu` file.
    fn vtu<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = long(py, None, None, |_| {
            let mut bytes = Vec::new();
            write(&mut bytes, &self.step.mesh, &self.step.about).map(|()| bytes)
        })??;
        Ok(PyBytes::new(py, &bytes))
    }
}

/// The bytes of a `.vtkhdf` file with the triangles of some steps.
#[pyfunction]
pub(crate) fn vtkhdf(py: Python<'_>, steps: Vec<Py<Triangles>>) -> PyResult<Bound<'_, PyBytes>> {
    let steps: Vec<_> = steps.iter().map(|triangles| &triangles.get().step).collect();
    let bytes: usize = steps.iter().map(|step| step.mesh.bytes()).sum();
    if bytes > MOST_BYTES {
        let most = MOST_BYTES >> 30;
        let words = "take a larger tolerance, or save steps one by one";
        return Err(RenderError::new_err(format!("more than {most} GiB of triangles; {words}")));
    }
    let bytes = long(py, None, None, |_| file(&steps))?;
    Ok(PyBytes::new(py, &bytes.map_err(unwritable)?))
}

/// Triangles that resolve arrays of a field to a tolerance; without names those that suit.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "Python's layer names them")]
pub(crate) fn triangles(
    py: Python<'_>,
    this: &PyField,
    names: Option<Vec<String>>,
    tolerance: f64,
    radius: Option<f64>,
    most: usize,
    order: u8,
    average: bool,
    hash: String,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Triangles> {
    let (field, arrays) = (this.owned.field(), this.arrays(names)?);
    let accuracy = Accuracy { tolerance, radius, cells: most, order, average };
    let mesh = long(py, None, progress, |watcher| resolve(field, &arrays, &accuracy, watcher))?;
    let about = FileNotes::of(this.owned.dataset(), field, hash);
    let mesh = mesh.map_err(unexported)?;
    Ok(Triangles { step: ExportedStep { load: field.step.load, mesh, about } })
}

/// The page of a field, which shows first what is asked for, at a place if one is given.
#[pyfunction]
pub(crate) fn page(
    py: Python<'_>,
    this: &PyField,
    dataset: &PyDataset,
    request: &str,
    at: Option<CenterAndWidth>,
    file: String,
) -> PyResult<String> {
    let Request { mut scene, .. } = this.request(request)?;
    // parts and replaced functions are in the dataset already
    let (changed, step) = this.owned.place();
    let whole = if changed.steps.len() > 1 { Some(dataset.whole()?) } else { None };
    let dataset = whole.as_deref().unwrap_or(changed);
    scene.subject = Subject { step: Some(step), ..Subject::default() };
    let view = at.map(|((x, y), width)| PageView { center: [x, y], width, pixels: SHAPE });
    let start = PageStart::new(scene, this.source(), view, file);
    let start = start.map_err(|error| RenderError::new_err(error.to_string()))?;
    let bytes = long(py, None, None, |_| to_bytes(dataset))?.map_err(unwritable)?;
    if bytes.len() as u64 > LARGEST {
        let most = LARGEST >> 20;
        return Err(RenderError::new_err(format!("pages hold datasets of up to {most} MiB")));
    }
    let page = long(py, None, None, |_| html(&bytes, start.title(dataset), &start))?;
    page.map_err(|error| RenderError::new_err(error.to_string()))
}

impl PyField {
    /// The arrays of these names: of those that suit, else scalars.
    fn arrays(&self, names: Option<Vec<String>>) -> PyResult<Vec<PointArray>> {
        let suitable =
            PointArray::defaults(self.owned.field()).map_err(|error| quantity(&error))?;
        let Some(names) = names else { return Ok(suitable) };
        let array = |name: String| match suitable.iter().find(|array| array.name == name) {
            Some(known) => Ok(known.clone()),
            None => Ok(PointArray::scalar(&name, self.quantity(&name)?)),
        };
        names.into_iter().map(array).collect()
    }
}

fn unexported(error: ExportError) -> PyErr {
    match error {
        ExportError::Cancelled(error) => cancelled(error),
        error => RenderError::new_err(error.to_string()),
    }
}

fn coordinates(points: &[Vec2]) -> Vec<f64> {
    points.iter().flat_map(|p| [p.x, p.y]).collect()
}

/// Numbers in rows of so many.
fn rows<T: numpy::Element>(
    py: Python<'_>,
    numbers: Vec<T>,
    width: usize,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let shape = [numbers.len() / width, width];
    PyArray1::from_vec(py, numbers).reshape(shape)
}
