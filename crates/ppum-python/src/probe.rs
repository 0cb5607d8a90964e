//! The values that a pixel of a view shows.

use ppum::progress::Watcher;
use ppum::vec2::Vec2;
use ppum_render::deform::{DeformError, Deformation};
use ppum_render::view::View;
use ppum_scene::location::Location;
use ppum_scene::magnification::Magnification;
use ppum_scene::mirror_lines::MirrorLines;
use ppum_scene::probe::PointReader;
use ppum_scene::quantity::DisplayedQuantity;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::{picture, render_error};
use crate::field::PyField;
use crate::picture::PyView;
use crate::watch::long;

/// The point of the body that is read, its values, which are two on a crack, above and below it,
/// and the number of points that lie there.
type PointReading = ([f64; 2], Vec<f64>, usize);

/// Reads a quantity at a pixel, or at the tip or point of a crack within a reach of some pixels;
/// of a body that is deformed by a factor at the point that has moved there. Returns the place in
/// the image too, and nothing else where the body is not.
#[pyfunction]
pub(crate) fn probe(
    this: &PyField,
    py: Python<'_>,
    name: &str,
    view: PyView,
    pixel: [f64; 2],
    reach: f64,
    factor: Option<&str>,
) -> PyResult<([f64; 2], Option<PointReading>)> {
    let (what, view, field) = (this.displayed(py, name)?, view.checked()?, this.field());
    let there = Location::new(view.center, view.offset_at(pixel.into()));
    let side = view.pixel_size();
    let Some(factor) = factor else {
        let spot = there.snapped(&field.step.cracks, reach * side);
        return Ok((spot.point().into(), Some(read(this, &what, &spot, 1))));
    };
    let factor: Magnification = factor.parse().map_err(PyValueError::new_err)?;
    let place: Vec2 = there.point();
    let pixel = View::new(place, side, [1, 1]).map_err(render_error)?;
    let found = |watcher: &dyn Watcher| -> Result<_, DeformError> {
        let seen = Deformation::new(field, factor.number(&[field])?)?.seen(&pixel);
        let points = seen.points(watcher)?;
        let all = points.at(0, 0);
        Ok(all.first().map(|first| (Location::new(seen.anchor, first.offset), all.len())))
    };
    let found = long(py, None, None, found)?.map_err(|error| picture(error.into()))?;
    Ok((place.into(), found.map(|(spot, count)| read(this, &what, &spot, count))))
}

fn read(this: &PyField, what: &DisplayedQuantity, spot: &Location, count: usize) -> PointReading {
    let field = this.field();
    let read = PointReader::new(field, what, &MirrorLines::default()).read_own(field, spot);
    let faces = if what.quantity().is_some() { read.sides.len() } else { 1 };
    (spot.point().into(), read.sides[..faces].iter().map(|side| side.value).collect(), count)
}
