//! The deformed body: how much, and what of the plane is seen of it.

use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::Reflection;
use ppum::vec2::{Rect, Vec2};
use ppum_render::deform::{DeformError, Deformation, DeformedPoints};
use ppum_render::extrema::BodyRegion;
use ppum_render::raster::Raster;
use ppum_render::view::View;

use crate::image::body::BodyView;
use crate::image::quantity::DisplayedQuantity;
use crate::image::values::{PROCESSOR, PixelValues};

/// A box around the deformed body, and around the undeformed one if its border is drawn, with
/// some room around it.
///
/// # Errors
/// A field that is no displacement, or a factor that is too large.
pub fn bounds(field: &Field<'_>, factor: f64, with_outline: bool) -> Result<Rect, DeformError> {
    let moved = moved_box(field, factor)?;
    let shown = if with_outline { moved.union(&field.domain.bounds) } else { moved };
    Ok(grown(shown, ROOM))
}

/// The box of the deformed body.
fn moved_box(field: &Field<'_>, factor: f64) -> Result<Rect, DeformError> {
    let deformation = Deformation::new(field, factor)?;
    let whole = field.domain.bounds;
    let mut view = View::fit(whole, [256, 256])?;
    // edges of elements are drawn where they are seen
    if let Some(elements) = deformation.seen(&view).element_bounds() {
        view = View::fit(grown(elements.union(&whole), BEYOND), [256, 256])?;
    }
    let seen = deformation.seen(&view);
    let lines = [seen.outline([None; 2]), seen.cut_faces()];
    let place = |offset: &Vec2| view.center + *offset;
    let all = lines.iter().flatten().flatten().map(place).map(|p| Rect::new(p, p));
    Ok(all.reduce(|a, b| a.union(&b)).unwrap_or(whole))
}

/// The part of the undeformed body that a view of the deformed one shows: the whole body, or the
/// smallest rectangle that holds all points that are seen. `None` if nothing is.
///
/// # Errors
/// A field that is no displacement.
pub(crate) fn region(points: &DeformedPoints<'_>) -> Result<Option<BodyRegion>, DeformError> {
    let (seen, field) = (&points.view, points.view.field());
    if seen.factor() == 0.0 {
        return Ok(BodyRegion::seen(field, &seen.view));
    }
    let (window, body) = (seen.view.rect(), moved_box(field, seen.factor())?);
    if window.contains(body.min) && window.contains(body.max) {
        return Ok(Some(BodyRegion::whole(field)));
    }
    Ok(points.material_box().and_then(|rect| BodyRegion::new(field, seen.anchor, rect)))
}

impl BodyView<'_> {
    /// The parts of the undeformed body that are seen, of its images by their reflections.
    ///
    /// # Errors
    /// A field that is no displacement.
    pub(crate) fn regions(
        &self,
        field: &Field<'_>,
    ) -> Result<Vec<(Reflection, BodyRegion)>, DeformError> {
        let regions = self.parts().map(|part| {
            let region = match &part.points {
                Some(points) => region(points)?,
                None => BodyRegion::seen(field, &part.view),
            };
            Ok(region.map(|region| (part.reflection, region)))
        });
        regions.filter_map(Result::transpose).collect()
    }
}

/// A box with room around it, in parts of its size.
fn grown(Rect { min, max }: Rect, part: f64) -> Rect {
    let room = (max - min) * part;
    Rect::new(min - room, max + room)
}

/// Room around what is known of the places of a mesh's elements, for what bends between them.
const BEYOND: f64 = 0.25;

/// Room around the body, in parts of its size: the outline is known to a tenth of a pixel of a
/// small image.
const ROOM: f64 = 0.01;

/// The values of an image of the deformed body.
///
/// # Errors
/// A quantity without meaning for the field; a watcher that stops it.
pub fn draw(
    points: &DeformedPoints<'_>,
    shown: &DisplayedQuantity,
    watcher: &dyn Watcher,
) -> Result<PixelValues, DeformError> {
    let raster = match shown {
        DisplayedQuantity::Quantity(quantity) => points.raster(quantity, watcher)?,
        DisplayedQuantity::Cells(_, values) => points.cells(values),
    };
    let without = undefined(points, &raster.values);
    let overlap = (0..).zip(&raster.overlap).filter(|(_, is)| **is).map(|(pixel, _)| pixel);
    let (view, overlap, by) = (points.view.view, overlap.collect(), PROCESSOR.into());
    let values = raster.values.into();
    Ok(PixelValues { view, values, by, without, overlap, opacity: None, norms: None })
}

/// The pixels of the body without a value.
fn undefined(points: &DeformedPoints<'_>, values: &Raster) -> Vec<u32> {
    let [columns, rows] = values.size;
    let all = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
    let without = all.filter(|&(i, j)| values.value(i, j).is_nan() && !points.at(i, j).is_empty());
    without.map(|(i, j)| j * columns + i).collect()
}
