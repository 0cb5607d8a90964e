//! The line of symmetry as an isoline of level 0.
//!
//! A quantity that changes its sign in a reflection is zero on the line. Each half ends there, and
//! has no values of the other sign beyond it, so that marching through its squares finds no line,
//! or pieces of one where errors of the solution have both signs.

use ppum::crack::Side;
use ppum::edge::Edge;
use ppum::field::{Field, LocalField};
use ppum::quantity::{Quantity, Reflection, ValueChange};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_render::RasterError;
use ppum_render::isoline::Isoline;
use ppum_render::view::View;

use crate::image::mirror_lines::MirrorLines;

/// Distance from the line within which isolines of level 0 are replaced by it, pixels.
const NEAR: f64 = 0.5;
/// Points at which it is checked that a quantity is odd, along each axis, and the difference that
/// rounding makes of its values.
const CHECKS: u32 = 7;
const ROUNDING: f64 = 1e-9;
/// Distance from the line, in parts of the body, on which a crack lies on it.
const ON_LINE: f64 = 1e-9;
/// Halvings of a pixel at the ends of the line.
const HALVINGS: u32 = 40;

/// Replaces isolines of level 0 along lines of symmetry of a quantity that is odd there.
pub(super) fn complete(
    field: &Field<'_>,
    (view, lines): (&View, &MirrorLines),
    quantity: &Quantity,
    isolines: &mut Vec<Isoline>,
) -> Result<(), RasterError> {
    let single = lines.reflections().filter(|one| one.lines.iter().flatten().count() == 1);
    for reflection in single {
        if !is_odd(field, quantity, &reflection)? {
            continue;
        }
        let symmetry = SymmetryLine { field, view, lines, quantity, reflection };
        let near = NEAR * view.pixel_size();
        let is_on = |p: &Vec2| symmetry.distance(*p) <= near;
        isolines.retain(|line| line.level != 0.0 || !line.points.iter().all(is_on));
        isolines.extend(symmetry.isolines());
    }
    Ok(())
}

/// True if the values in the image are those of the body with the other sign, wherever it is
/// asked. Angles are not: they jump by π on the line too.
fn is_odd(
    field: &Field<'_>,
    quantity: &Quantity,
    reflection: &Reflection,
) -> Result<bool, RasterError> {
    let reflected = quantity.reflected(reflection, field)?;
    if matches!(reflected.change, ValueChange::Turned { .. }) {
        return Ok(false);
    }
    let Rect { min, max } = field.domain.bounds;
    let mut local = field.at((min + max) * 0.5);
    let part = |k: u32| (f64::from(k) + 0.41) / f64::from(CHECKS) - 0.5;
    let (mut largest, mut difference) = (0.0f64, 0.0f64);
    for k in 0..CHECKS * CHECKS {
        let size = max - min;
        let at = vec2(size.x * part(k % CHECKS), size.y * part(k / CHECKS));
        let own = quantity.at(&mut local, at, Side::Above);
        let image = reflected.quantity.at(&mut local, at, Side::Above);
        let sum = own + reflected.change.apply(image);
        if sum.is_finite() {
            largest = largest.max(own.abs());
            difference = difference.max(sum.abs());
        }
    }
    Ok(largest > 0.0 && difference <= ROUNDING * largest)
}

/// A line of symmetry of an odd quantity, in a view. Points are offsets from the view's centre.
struct SymmetryLine<'a> {
    field: &'a Field<'a>,
    view: &'a View,
    lines: &'a MirrorLines,
    quantity: &'a Quantity,
    /// At this line alone.
    reflection: Reflection,
}

impl SymmetryLine<'_> {
    /// True for x = a.
    fn is_upright(&self) -> bool {
        self.reflection.lines[0].is_some()
    }

    /// Distance of a point.
    fn distance(&self, p: Vec2) -> f64 {
        let beyond = self.reflection.point(self.view.center) - self.view.center;
        let to_line = beyond * 0.5 - p;
        if self.is_upright() { to_line.x.abs() } else { to_line.y.abs() }
    }

    /// The point at a coordinate along the line, so far from it on the side of the body.
    fn point(&self, along: f64, inward: f64) -> Vec2 {
        let Self { field, view, reflection, .. } = self;
        let on_line = (reflection.point(view.center) - view.center) * 0.5;
        let body = field.domain.bounds.center() - (view.center + on_line);
        match self.is_upright() {
            true => vec2(on_line.x + inward.copysign(body.x), along),
            false => vec2(along, on_line.y + inward.copysign(body.y)),
        }
    }

    /// The parts of the line that are in sight, in the body and on no crack.
    fn isolines(&self) -> Vec<Isoline> {
        let half = self.view.half();
        let (half, across) = if self.is_upright() { (half.y, half.x) } else { (half.x, half.y) };
        if self.distance(Vec2::ZERO) > across {
            return Vec::new();
        }
        let mut local = self.field.at(self.view.center);
        let count = (2.0 * half / self.view.pixel_size()).ceil() as u32;
        let place = |k: u32| half * (2.0 * f64::from(k) / f64::from(count) - 1.0);
        let mut parts: Vec<(f64, f64, bool)> = Vec::new();
        let mut last = (place(0), self.sign(&mut local, place(0)));
        let mut start = last.0;
        for k in 1..=count {
            let next = (place(k), self.sign(&mut local, place(k)));
            if next.1 != last.1 {
                let end = self.change([last.0, next.0], last.1, &mut local);
                parts.extend(last.1.map(|is_positive| (start, end, is_positive)));
                start = end;
            }
            last = next;
        }
        parts.extend(last.1.map(|is_positive| (start, last.0, is_positive)));
        parts.into_iter().map(|part| self.isoline(part)).collect()
    }

    /// A part of the line; larger values lie on its left.
    fn isoline(&self, (from, to, is_positive): (f64, f64, bool)) -> Isoline {
        let [a, b] = [from, to].map(|along| self.point(along, 0.0));
        let inward = self.point(from, 1.0) - a;
        let is_left = (b - a).left().dot(inward) > 0.0;
        let points = if is_left == is_positive { vec![a, b] } else { vec![b, a] };
        Isoline { level: 0.0, points, closed: false }
    }

    /// Where on the way from one place to another it is no longer as at the first.
    fn change(&self, ends: [f64; 2], first: Option<bool>, local: &mut LocalField<'_>) -> f64 {
        let [mut known, mut other] = ends;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (known + other);
            if self.sign(local, middle) == first { known = middle } else { other = middle }
        }
        0.5 * (known + other)
    }

    /// Whether values beside the line are positive in the body; none outside of it and on cracks.
    fn sign(&self, local: &mut LocalField<'_>, along: f64) -> Option<bool> {
        let inside = self.point(along, NEAR * self.view.pixel_size());
        let on_line = self.folded(self.point(along, 0.0));
        let value = self.value(local, inside)?;
        let is_drawn = local.contains(on_line) && !self.is_on_crack(on_line) && !value.is_nan();
        is_drawn.then_some(value > 0.0)
    }

    /// The value at a point of the body or of its image at the other line; none of a formula that
    /// is too large.
    fn value(&self, local: &mut LocalField<'_>, p: Vec2) -> Option<f64> {
        let at = self.folded(p);
        let Some(other) = self.beyond(p) else {
            return Some(self.quantity.at(local, at, Side::Above));
        };
        let image = self.quantity.reflected(&other, self.field).ok()?;
        Some(image.change.apply(image.quantity.at(local, at, Side::Above)))
    }

    /// The point of the body whose reflection at the other line a point is.
    fn folded(&self, p: Vec2) -> Vec2 {
        let center = self.view.center;
        self.beyond(p).map_or(p, |other| other.point(center + p) - center)
    }

    /// The reflection at the other line, of a point that lies beyond it.
    fn beyond(&self, p: Vec2) -> Option<Reflection> {
        let (bounds, center) = (self.field.domain.bounds, self.view.center);
        let is_upright = self.is_upright();
        let is_beside = |at: Vec2| match is_upright {
            true => at.y < bounds.min.y || at.y > bounds.max.y,
            false => at.x < bounds.min.x || at.x > bounds.max.x,
        };
        let other = self.lines.reflections().find(|one| {
            let [x, y] = one.lines.map(|line| line.is_some());
            if is_upright { y && !x } else { x && !y }
        });
        other.filter(|_| is_beside(center + p))
    }

    /// True on cracks that lie along the line.
    fn is_on_crack(&self, p: Vec2) -> bool {
        let at = self.view.center + p;
        let size = self.field.domain.bounds.size();
        let reach = ON_LINE * size.x.max(size.y);
        let is_on = |edge: Edge| {
            let is_near = |end: Vec2| self.distance(end - self.view.center) <= reach;
            let is_along = !edge.is_arc() && is_near(edge.from) && is_near(edge.to);
            is_along && (at - edge.from).dot(at - edge.to) < 0.0
        };
        let mut cracks = self.field.step.cracks.iter();
        cracks.any(|crack| crack.edges().any(is_on))
    }
}
