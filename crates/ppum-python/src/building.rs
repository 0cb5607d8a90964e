//! Datasets from numpy arrays, and covers for them.

use numpy::{Element, PyArray1, PyReadonlyArray1};
use ppum::cover::Cover;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;
use ppum_format::{ArrayValues, Arrays, ReadError};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::dataset::PyDataset;
use crate::errors::unbuilt;
use crate::watch::long;

/// The values of an array, row-major, or texts.
#[derive(FromPyObject)]
pub(crate) enum ArrayInput<'py> {
    F64(PyReadonlyArray1<'py, f64>),
    U8(PyReadonlyArray1<'py, u8>),
    U32(PyReadonlyArray1<'py, u32>),
    U64(PyReadonlyArray1<'py, u64>),
    I64(PyReadonlyArray1<'py, i64>),
    Text(Vec<String>),
}

impl ArrayInput<'_> {
    fn values(self) -> ArrayValues {
        match self {
            Self::F64(array) => ArrayValues::F64(list(&array)),
            Self::U8(array) => ArrayValues::U8(list(&array)),
            Self::U32(array) => ArrayValues::U32(list(&array)),
            Self::U64(array) => ArrayValues::U64(list(&array)),
            Self::I64(array) => ArrayValues::I64(list(&array)),
            Self::Text(texts) => ArrayValues::Text(texts),
        }
    }
}

fn list<T: Element + Copy>(array: &PyReadonlyArray1<'_, T>) -> Vec<T> {
    array.as_array().iter().copied().collect()
}

/// The dataset of arrays and attributes by their paths in the file format, with their shapes.
#[pyfunction]
pub(crate) fn build(
    py: Python<'_>,
    given: Vec<(String, Vec<u64>, ArrayInput<'_>)>,
) -> PyResult<PyDataset> {
    let mut arrays = Arrays::default();
    for (path, shape, values) in given {
        arrays.insert(&path, shape, values.values());
    }
    let built = long(py, None, None, |_| arrays.dataset())?;
    built.map(PyDataset::new).map_err(|errors: Vec<ReadError>| unbuilt(&errors))
}

/// Cells, their levels, and the point of each, -1 for none, of the quadtrees that scattered
/// points make.
type QuadtreeCells<'py> =
    (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<u8>>, Bound<'py, PyArray1<i64>>);

/// The cells that are halved until each holds at most one point, beginning with a grid.
#[pyfunction]
pub(crate) fn scattered<'py>(
    py: Python<'py>,
    domain: [f64; 4],
    cells: [u32; 2],
    points: Vec<[f64; 2]>,
) -> PyResult<QuadtreeCells<'py>> {
    let [x0, y0, x1, y1] = domain;
    let points: Vec<Vec2> = points.into_iter().map(Vec2::from).collect();
    let bounds = Rect::new(vec2(x0, y0), vec2(x1, y1));
    let made = long(py, None, None, |_| {
        Cover::scattered(bounds, cells, points)?.partition(1.5, WeightFunction::Linear)
    })?;
    let made = made.map_err(|error| PyValueError::new_err(error.to_string()))?;
    let cells = made.cell.iter().flat_map(|c| [c.min.x, c.min.y, c.max.x, c.max.y]);
    let point = made.point.iter().map(|point| point.map_or(-1, i64::from));
    Ok((
        PyArray1::from_iter(py, cells),
        PyArray1::from_vec(py, made.level),
        PyArray1::from_iter(py, point),
    ))
}
