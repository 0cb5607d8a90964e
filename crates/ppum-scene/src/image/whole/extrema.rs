//! Extreme values of what is seen of a body and of its images.

use ppum::crack::{SegmentId, Side};
use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::{Quantity, ReflectedQuantity, Reflection, ValueChange};
use ppum::vec2::Vec2;
use ppum_render::RasterError;
use ppum_render::extrema::{
    BodyRegion, Extrema, Extremum, ExtremumSite, SingularPoint, extrema as extrema_of_body,
};

use crate::image::mirror_lines::MirrorLines;

/// Distance from a line of symmetry, in parts of the body, on which a place lies on it.
const ON_LINE: f64 = 1e-12;

/// The direction of σ₂, in (−π/2, π/2].
const SECOND_DIRECTION: &str = "if(direction > 0, direction - pi/2, direction + pi/2)";

/// Minimum and maximum of a quantity over parts of a body and of its images, which lie beyond some
/// lines: each part by the reflection that makes it of the body. Places are those of the
/// undeformed body and its images.
pub(crate) fn extrema(
    field: &Field<'_>,
    (parts, lines): (&[(Reflection, BodyRegion)], &MirrorLines),
    quantity: &Quantity,
    watcher: &dyn Watcher,
) -> Result<Option<Extrema>, RasterError> {
    let mut known: Vec<(Quantity, BodyRegion, Option<Extrema>)> = Vec::new();
    let mut all: Option<Extrema> = None;
    for (reflection, region) in parts {
        let ReflectedQuantity { quantity, change } =
            unturned(quantity.reflected(reflection, field)?, field)?;
        let is_same = |one: &&(Quantity, BodyRegion, _)| one.0 == quantity && one.1 == *region;
        let found = match known.iter().find(is_same) {
            Some((_, _, found)) => found.clone(),
            None => extrema_of_body(field, region, &quantity, watcher)?,
        };
        let image = BodyImage { field, lines, reflection };
        if let Some(found) = found.clone().map(|found| image.extrema(found, change)) {
            all = Some(match all {
                Some(all) => all.united(&found),
                None => found,
            });
        }
        known.push((quantity, *region, found));
    }
    Ok(all)
}

/// Returns the values as those of a quantity whose change keeps or reverses their order, except at
/// the ends of angles.
fn unturned(
    reflected: ReflectedQuantity,
    field: &Field<'_>,
) -> Result<ReflectedQuantity, RasterError> {
    Ok(match reflected.change {
        ValueChange::Turned { is_reversed, is_quarter } => ReflectedQuantity {
            quantity: match is_quarter {
                true => Quantity::parse(SECOND_DIRECTION, field)?,
                false => reflected.quantity,
            },
            change: if is_reversed { ValueChange::Negated } else { ValueChange::Same },
        },
        _ => reflected,
    })
}

/// An image of the body.
struct BodyImage<'a> {
    field: &'a Field<'a>,
    lines: &'a MirrorLines,
    reflection: &'a Reflection,
}

impl BodyImage<'_> {
    /// Extreme values of the body as those of the image.
    fn extrema(&self, found: Extrema, change: ValueChange) -> Extrema {
        let Extrema { center, min, max, singular } = found;
        let center = self.reflection.point(center);
        let is_negated = change == ValueChange::Negated;
        let [least, most] = if is_negated { [max, min] } else { [min, max] };
        let sign = |extremum: Extremum| {
            let value = if is_negated { -extremum.value } else { extremum.value };
            self.extremum(Extremum { value, ..extremum }, center)
        };
        let point = |point: SingularPoint| {
            let (max, min) = (point.max_infinite, point.min_infinite);
            let (max_infinite, min_infinite) = if is_negated { (min, max) } else { (max, min) };
            let offset = self.reflection.vector(point.offset);
            SingularPoint { offset, max_infinite, min_infinite, ..point }
        };
        let singular = singular.into_iter().map(point).collect();
        Extrema { center, min: sign(least), max: sign(most), singular }
    }

    fn extremum(&self, found: Extremum, center: Vec2) -> Extremum {
        let offset = self.reflection.vector(found.offset);
        let on = match found.on {
            ExtremumSite::Face(segment, side) => {
                let at = self.reflection.point(center + offset);
                ExtremumSite::Face(segment, self.side(segment, side, at))
            }
            ExtremumSite::Border if self.is_on_line(center + offset) => ExtremumSite::Inside,
            on => on,
        };
        Extremum { offset, on, ..found }
    }

    /// The side of the reflected crack that lies as the given one does to the crack at a point.
    fn side(&self, SegmentId { crack, segment }: SegmentId, side: Side, at: Vec2) -> Side {
        let edge = self.field.step.cracks[crack as usize].edge(segment as usize);
        let normal = edge.tangent_towards(at).left();
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
