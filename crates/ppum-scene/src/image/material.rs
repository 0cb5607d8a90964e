//! The point of the body that the displacement has moved to a place: x + s u(x) = y, by Newton's
//! method.
//!
//! Every result is such a point, whichever start led to it; where the body folds over itself it is
//! one of several.

use ppum::crack::{Side, tips};
use ppum::field::{Field, LocalField};
use ppum::jet::Jet;
use ppum::quantity::Reflection;
use ppum::vec2::{Vec2, vec2};
use ppum_render::deform::Deformation;
use ppum_render::view::View;

use crate::image::mirror_lines::MirrorLines;
use crate::report::location::Location;

/// Steps from one start, and halvings of a step.
const STEPS: usize = 25;
const HALVINGS: usize = 8;
/// Starts around the first one, for places near cracks.
const AROUND: u32 = 8;
/// Points nearer to a tip than this part of the body are counted from it.
const NEAR: f64 = 1e-3;
/// The largest distance of a result from the place, in pixels.
const MISS: f64 = 1e-3;

/// A body that is deformed by a factor, and its images at lines of symmetry: points of the
/// undeformed whole and where they are seen.
#[derive(Clone, Copy)]
pub struct DeformedWhole<'a> {
    /// The field.
    pub field: &'a Field<'a>,
    /// How many times its displacement it is drawn with.
    pub factor: f64,
    /// The lines at which it is mirrored.
    pub lines: MirrorLines,
}

impl DeformedWhole<'_> {
    /// The point that is seen at an offset from the centre of a view; none where no part is.
    #[must_use]
    pub fn spot(&self, view: &View, offset: Vec2) -> Option<Location> {
        let point = |by: Reflection| {
            let there = [by.point(view.center), by.vector(offset)];
            let factor = self.factor * by.sign();
            let spot = material(self.field, factor, there, view.pixel_size())?;
            Some(Location::new(by.point(spot.anchor()), by.vector(spot.offset())))
        };
        point(Reflection::NONE).or_else(|| self.lines.reflections().find_map(point))
    }

    /// The offset from the centre of a view at which a point is seen.
    #[must_use]
    pub fn offset(&self, view: &View, spot: &Location) -> Vec2 {
        let (point, body) = (spot.point(), self.field.domain.body_bounds());
        let is_there = |by: &Reflection| body.contains(by.point(point));
        let image = self.lines.reflections().find(is_there).filter(|_| !body.contains(point));
        let by = image.unwrap_or(Reflection::NONE);
        match Deformation::new(self.field, self.factor * by.sign()) {
            Ok(map) => by.point(map.place(by.point(point))) - view.center,
            Err(_) => spot.from(view.center),
        }
    }
}

/// The point that `factor` times its displacement moves to `center + offset`, to a thousandth of a
/// pixel; none if no point of the body lies there.
fn material(
    field: &Field<'_>,
    factor: f64,
    [center, offset]: [Vec2; 2],
    pixel: f64,
) -> Option<Location> {
    let place = center + offset;
    let bounds = field.domain.bounds;
    let within = |p: Vec2| p.max(bounds.min).min(bounds.max);
    let first = within(place);
    let moved = map(&mut field.at(first), Vec2::ZERO, factor).map_or(Vec2::ZERO, |at| at.shift);
    let start = within(place - moved);
    let reach = moved.length().max(4.0 * pixel);
    let around = (0..AROUND).map(|k| {
        let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / f64::from(AROUND)).sin_cos();
        within(start + vec2(cos, sin) * reach)
    });
    let tolerance = (MISS * pixel).max(4.0 * f64::EPSILON * place.length());
    let solved = |start: Vec2| {
        // coarsely first, which says from where the point should be counted
        let coarse = solve(field, factor, start, place - start, tolerance.max(1e-9 * reach))?;
        let near = start + coarse;
        let anchor = tip_near(field, near).unwrap_or(near);
        let rest = [(center - anchor) + offset, near - anchor];
        newton(&mut field.at(anchor), factor, rest, tolerance).map(|o| Location::new(anchor, o))
    };
    [start, first].into_iter().chain(around).find_map(solved)
}

fn solve(field: &Field<'_>, factor: f64, start: Vec2, goal: Vec2, miss: f64) -> Option<Vec2> {
    newton(&mut field.at(start), factor, [goal, Vec2::ZERO], miss)
}

/// The tip beside a point.
fn tip_near(field: &Field<'_>, point: Vec2) -> Option<Vec2> {
    let (size, cracks) = (field.domain.bounds.size(), &field.step.cracks);
    let all = tips(cracks).map(|tip| cracks[tip.crack as usize].end_point(tip.end));
    let distance = |tip: &Vec2| (*tip - point).length();
    let nearest = all.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    (distance(&nearest) < NEAR * size.x.max(size.y)).then_some(nearest)
}

/// s u and its gradient at a point.
struct DisplacedPoint {
    shift: Vec2,
    /// The columns of I + s ∇u.
    columns: [Vec2; 2],
}

fn map(local: &mut LocalField<'_>, offset: Vec2, factor: f64) -> Option<DisplacedPoint> {
    let mut jets = [Jet::constant(0.0); 3];
    if !local.field.is_displacement() || !local.evaluate::<1>(offset, Side::Above, &mut jets) {
        return None;
    }
    let [u, v, _] = jets;
    let shift = vec2(u.v, v.v) * factor;
    let columns = [vec2(1.0 + factor * u.x, factor * v.x), vec2(factor * u.y, 1.0 + factor * v.y)];
    shift.is_finite().then_some(DisplacedPoint { shift, columns })
}

/// The offset that is moved to a goal, both counted from the field's anchor.
fn newton(
    local: &mut LocalField<'_>,
    factor: f64,
    [goal, start]: [Vec2; 2],
    tolerance: f64,
) -> Option<Vec2> {
    let (mut at, mut here) = (start, map(local, start, factor)?);
    let mut miss = goal - at - here.shift;
    for _ in 0..STEPS {
        if miss.length() <= tolerance {
            return Some(at);
        }
        let [a, b] = here.columns;
        let newton = vec2(miss.cross(b), a.cross(miss)) / a.cross(b);
        let step = if newton.is_finite() { newton } else { miss };
        let nearer = (0..HALVINGS).find_map(|k| {
            let next = at + step * 0.5f64.powi(k as i32);
            let there = map(local, next, factor)?;
            let left = goal - next - there.shift;
            (left.length() < miss.length()).then_some((next, there, left))
        });
        (at, here, miss) = nearer?;
    }
    None
}
