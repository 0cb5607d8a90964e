//! Singular points in a view: where a quantity grows without bound.

use std::collections::BTreeSet;

use ppum::crack::{Crack, Side, TipId, tips};
use ppum::domain::Hole;
use ppum::field::Field;
use ppum::function::{Frame, FunctionKind};
use ppum::quantity::Quantity;
use ppum::vec2::{Rect, Vec2, vec2};
use rayon::prelude::*;

use super::region::{BodyRegion, smallest_patch};

/// Radii, in parts of the smallest patch there or of what is seen, between which a quantity is seen
/// to grow.
const RADII: [f64; 2] = [1e-2, 1e-12];

/// Growth between the radii that counts as without bound: r^(λ−1) with λ < 0.95 grows more.
const GROWTH: f64 = 3.0;

/// Directions in which it is looked at.
const DIRECTIONS: u32 = 48;

/// A point where a quantity may be infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SingularPoint {
    /// Its offset from [`Extrema::center`](super::Extrema::center).
    pub offset: Vec2,
    /// The kind of point.
    pub kind: SingularKind,
    /// True if the quantity grows to +∞ towards it, inside the view.
    pub max_infinite: bool,
    /// True if it falls to −∞.
    pub min_infinite: bool,
}

/// The kinds of singular points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SingularKind {
    /// A crack tip.
    Tip(TipId),
    /// A vertex inside a crack of this index.
    Kink(u32),
    /// A corner of the polygonal hole or outline of this index, at which a function is singular.
    Corner(usize),
    /// The origin of an enrichment's frame.
    Origin,
}

/// The points in a region in which a quantity is not finite because a function of the field is
/// singular there; those towards which it does not grow, with a factor that is zero except for
/// rounding, too.
pub(super) fn singular_points(
    field: &Field<'_>,
    region: &BodyRegion,
    quantity: &Quantity,
) -> Vec<SingularPoint> {
    let BodyRegion { anchor, rect } = *region;
    let points: Vec<_> = known_points(field).into_iter().collect();
    let looked = points.into_par_iter().filter_map(|p| {
        let offset = p - anchor;
        let is_singular = rect.contains(offset) && {
            let mut local = field.at(p);
            local.contains(Vec2::ZERO)
                && !quantity.at(&mut local, Vec2::ZERO, Side::Above).is_finite()
        };
        is_singular.then(|| {
            let rect = Rect::new(rect.min - offset, rect.max - offset);
            let [min_infinite, max_infinite] = grows(field, p, &rect, quantity);
            SingularPoint { offset, kind: kind(field, p), max_infinite, min_infinite }
        })
    });
    looked.collect()
}

/// The points that a step knows to be singular if any are: tips, origins of the frames of formulas,
/// and points that functions declare; each once, in their order.
fn known_points(field: &Field<'_>) -> Vec<Vec2> {
    let cracks = &field.step.cracks;
    let tip = |id: TipId| cracks[id.crack as usize].end_point(id.end);
    let mut all: Vec<Vec2> = tips(cracks).map(tip).collect();
    for function in &field.step.functions {
        let FunctionKind::Formula { frame, declared, .. } = &function.kind else { continue };
        let (origin, axis) = match *frame {
            Frame::Fixed { origin, angle } => (origin, vec2(angle.cos(), angle.sin())),
            Frame::Tip(id) => (tip(id), cracks[id.crack as usize].growth_direction(id.end)),
            Frame::World => (Vec2::ZERO, vec2(1.0, 0.0)),
            // places of an element's level fields are known to the element alone
            _ => continue,
        };
        let place = |p: &Vec2| origin + axis * p.x + axis.left() * p.y;
        all.push(origin);
        all.extend(declared.singular.iter().map(place));
    }
    let mut known = BTreeSet::new();
    all.retain(|p| known.insert([p.x.to_bits(), p.y.to_bits()]));
    all
}

/// Returns the kind of a singular point.
fn kind(field: &Field<'_>, p: Vec2) -> SingularKind {
    let cracks = &field.step.cracks;
    let is_tip = |id: &TipId| cracks[id.crack as usize].end_point(id.end) == p;
    if let Some(id) = tips(cracks).find(is_tip) {
        return SingularKind::Tip(id);
    }
    let is_inside = |crack: &Crack| crack.points[1..crack.points.len() - 1].contains(&p);
    if let Some((index, _)) = (0..).zip(cracks).find(|(_, crack)| is_inside(crack)) {
        return SingularKind::Kink(index);
    }
    let has_corner = |hole: &Hole| hole.sides().any(|[a, _]| a == p);
    let corner = field.domain.holes.iter().position(has_corner);
    corner.map_or(SingularKind::Origin, SingularKind::Corner)
}

/// Whether a quantity falls to −∞ and grows to +∞ towards a point, as seen in a rectangle
/// around it.
fn grows(field: &Field<'_>, p: Vec2, rect: &Rect, quantity: &Quantity) -> [bool; 2] {
    let reach = -rect.min.min(-rect.max);
    let size = reach.x.max(reach.y).min(smallest_patch(field, p));
    let mut local = field.at(p);
    let mut range = |r: f64| {
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for k in 0..DIRECTIONS {
            let angle = (f64::from(k) + 0.4142) / f64::from(DIRECTIONS) * std::f64::consts::TAU;
            let offset = vec2(angle.cos(), angle.sin()) * r;
            let value = if rect.contains(offset) {
                quantity.at(&mut local, offset, Side::Above)
            } else {
                f64::NAN
            };
            // NaN stays out
            range = [range[0].min(value), range[1].max(value)];
        }
        range
    };
    let [far, near] = RADII.map(|part| range(part * size));
    let level = far[0].abs().max(far[1].abs());
    [near[0] < -GROWTH * level, near[1] > GROWTH * level]
}
