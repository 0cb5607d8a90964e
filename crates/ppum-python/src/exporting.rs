//! Triangles and pages of fields, for programs and people that have no `ppum`.

use std::path::PathBuf;

use numpy::{PyArray1, PyArray2};
use ppum::vec2::Vec2;
use ppum_format::{WriteError, to_bytes};
use ppum_page::{LARGEST, PageStart, PageView, html};
use ppum_scene::export::vtkhdf::{ExportedStep, MOST_BYTES, file};
use ppum_scene::export::vtu::{FileNotes, write};
use ppum_scene::export::{
    Accuracy, ExportError, ExportMesh, MeasuredAccuracy, PointArray, resolve,
};
use ppum_scene::request::Request;
use ppum_scene::scene::Subject;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors::{RenderError, cancelled, quantity, render_error, unwritable};
use crate::field::PyField;
use crate::picture::PyView;
use crate::values::rows;
use crate::watch::long;

/// Triangles on which values are polynomials.
#[pyclass(frozen, module = "ppum._core")]
pub(crate) struct Triangles {
    step: ExportedStep,
}

/// The name of an array, its range, the allowed and the largest difference, the share of points
/// within the tolerance, and whether the array is singular.
type AccuracyFacts = (String, [f64; 4], bool);

type TriangleArrays<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<u32>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<f64>>,
    bool,
);

#[pymethods]
impl Triangles {
    /// Points, cells, singular points, the radii about them within which the tolerance does not
    /// hold, and whether the work was complete.
    fn mesh<'py>(&self, py: Python<'py>) -> PyResult<TriangleArrays<'py>> {
        let ExportMesh { points, cells, singular, radii, is_complete, .. } = &self.step.mesh;
        let width = (cells.len() / self.step.mesh.triangles().len()) as u32;
        Ok((
            rows(py, coordinates(points), 2)?,
            rows(py, cells.clone(), width)?,
            rows(py, coordinates(singular), 2)?,
            PyArray1::from_slice(py, radii),
            *is_complete,
        ))
    }

    /// The values of an array, a row of components for each point.
    fn values<'py>(&self, py: Python<'py>, number: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let width = self.step.mesh.arrays[number].array.components.len();
        rows(py, self.step.mesh.values_of(number), width as u32)
    }

    fn accuracy(&self) -> Vec<AccuracyFacts> {
        let facts = |a: &MeasuredAccuracy| {
            (a.array.name.clone(), [a.range, a.allowed, a.largest, a.share], a.is_singular)
        };
        self.step.mesh.arrays.iter().map(facts).collect()
    }

    /// The message that the tolerance is not kept, if it is not.
    fn complaint(&self) -> Option<String> {
        self.step.mesh.complaint()
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
    let (field, arrays) = (this.field(), this.arrays(names)?);
    let accuracy = Accuracy { tolerance, radius, cells: most, order, average };
    let mesh = long(py, None, progress, |watcher| resolve(field, &arrays, &accuracy, watcher))?;
    let about = FileNotes::of(this.dataset(), field, hash);
    let mesh = mesh.map_err(unexported)?;
    Ok(Triangles { step: ExportedStep { load: field.step.load, mesh, about } })
}

/// The page of a field, which shows first what is asked for, at a place if one is given.
#[pyfunction]
pub(crate) fn page(
    py: Python<'_>,
    this: &PyField,
    request: &Bound<'_, PyAny>,
    at: Option<PyView>,
    file: String,
) -> PyResult<String> {
    let Request { mut scene, .. } = this.request(request)?;
    // parts and replaced functions are in the dataset already
    let (changed, step) = this.place();
    let whole = if changed.steps.len() > 1 { Some(this.series.get().whole()?) } else { None };
    let dataset = whole.as_deref().unwrap_or(changed);
    scene.subject = Subject { step: Some(step), ..Subject::default() };
    let view = at.map(|PyView { center, width, size: pixels }| PageView {
        center: center.into(),
        width,
        pixels,
    });
    let start = PageStart::new(scene, (changed, this.field()), view, file).map_err(render_error)?;
    let bytes = long(py, None, None, |_| to_bytes(dataset))?.map_err(unwritable)?;
    if bytes.len() as u64 > LARGEST {
        let most = LARGEST >> 20;
        return Err(RenderError::new_err(format!("pages hold datasets of up to {most} MiB")));
    }
    long(py, None, None, |_| html(&bytes, start.title(dataset), &start))?.map_err(render_error)
}

/// Writes a file, completely or not at all.
#[pyfunction]
pub(crate) fn replace(py: Python<'_>, path: PathBuf, bytes: &[u8]) -> PyResult<()> {
    let written = long(py, None, None, |_| ppum_file::replace(&path, |out| out.write_all(bytes)))?;
    written.map_err(|source| unwritable(WriteError::Io { path, source }))
}

/// Raises if `replace` could not write a file.
#[pyfunction]
pub(crate) fn check_target(path: PathBuf) -> PyResult<()> {
    ppum_file::check(&path).map_err(|source| unwritable(WriteError::Io { path, source }))
}

impl PyField {
    /// The arrays of these names: of those that suit, else scalars.
    fn arrays(&self, names: Option<Vec<String>>) -> PyResult<Vec<PointArray>> {
        let suitable = PointArray::defaults(self.field()).map_err(quantity)?;
        let Some(names) = names else { return Ok(suitable) };
        let array = |name: String| match suitable.iter().find(|array| array.name == name) {
            Some(known) => Ok(known.clone()),
            None => {
                let wanted = self.quantity(&name)?;
                wanted.check(self.field()).map_err(quantity)?;
                Ok(PointArray::scalar(&name, wanted))
            }
        };
        names.into_iter().map(array).collect()
    }
}

fn unexported(error: ExportError) -> PyErr {
    match error {
        ExportError::Cancelled(error) => cancelled(error),
        error => render_error(error),
    }
}

fn coordinates(points: &[Vec2]) -> Vec<f64> {
    points.iter().flat_map(|p| [p.x, p.y]).collect()
}
