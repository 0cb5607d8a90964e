//! The points of the body that a place of the deformed one shows.

use ppum::progress::Watcher;
use ppum_render::deform::{DeformError, Deformation, MaterialPoint};
use ppum_scene::deformed::Magnification;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::picture;
use crate::field::PyField;
use crate::picture::{CenterAndWidth, view};
use crate::watch::long;

/// A point of the body that is seen at a place, by an offset from an anchor, on its side of any
/// crack.
#[derive(IntoPyObject)]
pub(crate) struct MaterialFacts {
    anchor: [f64; 2],
    offset: [f64; 2],
    /// True if the body lies there with its back up.
    folded: bool,
    /// The number of points that lie there; the others are covered by this one.
    count: usize,
}

/// The material point in the middle of a pixel of the deformed body, which is `spot`; nothing where
/// the body is not.
#[pyfunction]
pub(crate) fn material(
    this: &PyField,
    py: Python<'_>,
    factor: &str,
    spot: CenterAndWidth,
) -> PyResult<Option<MaterialFacts>> {
    let factor: Magnification = factor.parse().map_err(PyValueError::new_err)?;
    let (field, view) = (this.owned.field(), view(spot, [1, 1])?);
    let found = |watcher: &dyn Watcher| -> Result<_, DeformError> {
        let seen = Deformation::new(field, factor.number(&[field])?)?.seen(&view);
        let points = seen.points(watcher)?;
        let facts = |first: &MaterialPoint| MaterialFacts {
            anchor: seen.anchor.into(),
            offset: first.offset.into(),
            folded: first.folded,
            count: points.at(0, 0).len(),
        };
        Ok(points.at(0, 0).first().map(facts))
    };
    long(py, None, None, found)?.map_err(|error| picture(error.into()))
}
