//! Extreme values of the whole: the least and the largest of those of the body and its images.

use ppum::crack::{SegmentId, Side};
use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::{Quantity, Reflection, ValueChange};
use ppum::vec2::Vec2;
use ppum_render::RenderError;
use ppum_render::extrema::{Extrema, Extremum, On, Singular, extrema as extrema_of_body};
use ppum_render::raster::{Raster, Sample};
use ppum_render::view::View;

use super::drawn::restricted;
use crate::mirror::{MirrorImage, MirrorLines};

/// Distance from a line of symmetry, in parts of the body, on which a place lies on it.
const ON_LINE: f64 = 1e-12;

/// Minimum and maximum of a quantity over what a view shows of the whole, whose values at the
/// pixels are given. Of the direction of σ₁, turned in the images of antisymmetric fields, they
/// are those of the pixels.
pub(crate) fn extrema<T: Sample>(
    field: &Field<'_>,
    (view, lines): (&View, &MirrorLines),
    quantity: &Quantity,
    raster: &Raster<T>,
    watcher: &dyn Watcher,
) -> Result<Option<Extrema>, RenderError> {
    let mut all: Option<Extrema> = None;
    let own = MirrorImage { reflection: Reflection::NONE, view: *view };
    for image in [own].into_iter().chain(lines.images(view, &field.domain.body_bounds())) {
        let reflected = quantity.reflected(&image.reflection, field)?;
        if matches!(reflected.change, ValueChange::Turned { is_quarter: true, .. }) {
            return Ok(Extrema::of_pixels(raster, view));
        }
        let part = restricted(raster, &image, reflected.change, field);
        let found = extrema_of_body(field, &image.view, &reflected.quantity, &part, watcher)?;
        let whole = Whole { field, lines, reflection: &image.reflection, center: view.center };
        if let Some(found) = found {
            let found = whole.extrema(found, reflected.change);
            all = Some(match all {
                Some(all) => united(all, found),
                None => found,
            });
        }
    }
    Ok(all)
}

fn united(all: Extrema, other: Extrema) -> Extrema {
    let min = if other.min.value < all.min.value { other.min } else { all.min };
    let max = if other.max.value > all.max.value { other.max } else { all.max };
    // what is constant in each half need not be so in the whole
    let place = |extremum: Extremum| match extremum.on {
        On::Everywhere if min.value != max.value => Extremum { on: On::Inside, ..extremum },
        _ => extremum,
    };
    let (min, max) = (place(min), place(max));
    Extrema { center: all.center, min, max, singular: [all.singular, other.singular].concat() }
}

/// The whole, where an image of the body lies in it.
struct Whole<'a> {
    field: &'a Field<'a>,
    lines: &'a MirrorLines,
    reflection: &'a Reflection,
    center: Vec2,
}

impl Whole<'_> {
    /// Extreme values of the body as those of the image.
    fn extrema(&self, found: Extrema, change: ValueChange) -> Extrema {
        let Extrema { min, max, singular, .. } = found;
        let is_negated = change == ValueChange::Negated;
        let [least, most] = if is_negated { [max, min] } else { [min, max] };
        let sign = |extremum: Extremum| {
            let value = if is_negated { -extremum.value } else { extremum.value };
            self.extremum(Extremum { value, ..extremum })
        };
        let point = |point: Singular| {
            let (max, min) = (point.max_infinite, point.min_infinite);
            let (max_infinite, min_infinite) = if is_negated { (min, max) } else { (max, min) };
            let offset = self.reflection.vector(point.offset);
            Singular { offset, max_infinite, min_infinite, ..point }
        };
        let singular = singular.into_iter().map(point).collect();
        Extrema { center: self.center, min: sign(least), max: sign(most), singular }
    }

    fn extremum(&self, found: Extremum) -> Extremum {
        let offset = self.reflection.vector(found.offset);
        let on = match found.on {
            On::Face(segment, side) => On::Face(segment, self.side(segment, side)),
            On::Border if self.is_on_line(self.center + offset) => On::Inside,
            on => on,
        };
        Extremum { offset, on, ..found }
    }

    /// The side of the reflected crack that lies as the given one does to the crack.
    fn side(&self, SegmentId { crack, segment }: SegmentId, side: Side) -> Side {
        let points = &self.field.step.cracks[crack as usize].points[segment as usize..];
        let normal = (points[1] - points[0]).left();
        match (self.reflection.vector(normal).dot(normal) < 0.0, side) {
            (false, side) => side,
            (true, Side::Above) => Side::Below,
            (true, Side::Below) => Side::Above,
        }
    }

    fn is_on_line(&self, p: Vec2) -> bool {
        let size = self.field.domain.bounds.size();
        let reach = ON_LINE * size.x.max(size.y);
        self.lines.reflections().any(|reflection| {
            let [x, y] = reflection.lines;
            let is_on = |line: Option<f64>, at: f64| line.is_some_and(|l| (l - at).abs() <= reach);
            is_on(x, p.x) || is_on(y, p.y)
        })
    }
}
