//! Singular points in a view: where a quantity grows without bound.

use ppum::crack::{Side, TipId, tips};
use ppum::domain::Hole;
use ppum::field::Field;
use ppum::function::{Frame, FunctionKind};
use ppum::quantity::Quantity;
use ppum::vec2::{Rect, Vec2, vec2};
use rayon::prelude::*;

/// Radii, in parts of the smallest patch there or of what is seen, between which a quantity is seen
/// to grow.
const RADII: [f64; 2] = [1e-2, 1e-12];

/// Growth between the radii that counts as without bound: r^(λ−1) with λ < 0.95 grows more.
const GROWTH: f64 = 3.0;

/// Directions in which it is looked at.
const DIRECTIONS: u32 = 48;

/// A point where a quantity may be infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Singular {
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
    /// A re-entrant corner: of the polygonal hole of this index. Stresses of the exact solution are
    /// infinite there; those of the represented field only if it has functions for it.
    Corner(usize),
    /// The origin of an enrichment's frame.
    Origin,
}

/// Evaluations that it takes to look at a point.
pub(super) const LOOK: usize = 2 * DIRECTIONS as usize;

/// The singular points among the given ones: those in which a quantity is infinite, as seen in a
/// rectangle of offsets from an anchor, and all re-entrant corners of holes.
pub(super) fn grown(
    field: &Field<'_>,
    anchor: Vec2,
    rect: &Rect,
    quantity: &Quantity,
    points: Vec<(Vec2, SingularKind)>,
) -> Vec<Singular> {
    let looked = points.into_par_iter().map(|(p, kind)| {
        let rect = Rect::new(rect.min - (p - anchor), rect.max - (p - anchor));
        let [min_infinite, max_infinite] = grows(field, p, &rect, quantity);
        Singular { offset: p - anchor, kind, max_infinite, min_infinite }
    });
    let is_corner = |kind| matches!(kind, SingularKind::Corner(_));
    looked.filter(|p| p.max_infinite || p.min_infinite || is_corner(p.kind)).collect()
}

/// The points in a rectangle of offsets from an anchor that may be singular.
pub(super) fn candidates(
    field: &Field<'_>,
    anchor: Vec2,
    rect: &Rect,
) -> Vec<(Vec2, SingularKind)> {
    let mut all = tips_kinks_and_corners(field);
    all.retain(|(p, _)| rect.contains(*p - anchor));
    for function in &field.step.functions {
        if let FunctionKind::Formula { frame: Frame::Fixed { origin, .. }, .. } = function.kind
            && rect.contains(origin - anchor)
            && all.iter().all(|(known, _)| *known != origin)
        {
            all.push((origin, SingularKind::Origin));
        }
    }
    all
}

/// Tips, kinks and corners.
fn tips_kinks_and_corners(field: &Field<'_>) -> Vec<(Vec2, SingularKind)> {
    let cracks = &field.step.cracks;
    let tip = |id: TipId| (cracks[id.crack as usize].end_point(id.end), SingularKind::Tip(id));
    let mut all: Vec<_> = tips(cracks).map(tip).collect();
    for (index, crack) in (0..).zip(cracks) {
        let inner = &crack.points[1..crack.points.len() - 1];
        all.extend(inner.iter().map(|&p| (p, SingularKind::Kink(index))));
    }
    for (index, hole) in field.domain.holes.iter().enumerate() {
        all.extend(corners(hole).into_iter().map(|p| (p, SingularKind::Corner(index))));
    }
    all
}

/// The corners of a polygon that are re-entrant for what is around it.
fn corners(hole: &Hole) -> Vec<Vec2> {
    let sides: Vec<_> = hole.sides().collect();
    let turns = |k: usize| {
        let (before, after) = (sides[(k + sides.len() - 1) % sides.len()], sides[k]);
        hole.orientation() * (before[1] - before[0]).cross(after[1] - after[0]) > 0.0
    };
    (0..sides.len()).filter(|&k| turns(k)).map(|k| sides[k][0]).collect()
}

/// Whether a quantity falls to −∞ and grows to +∞ towards a point, as seen in a rectangle
/// around it.
fn grows(field: &Field<'_>, p: Vec2, rect: &Rect, quantity: &Quantity) -> [bool; 2] {
    let mut patches = Vec::new();
    field.tree.query_point(p, &mut patches);
    let half = patches.iter().map(|&k| field.step.partition.half(k as usize));
    let sizes = half.map(|half| half.x.min(half.y));
    let reach = -rect.min.min(-rect.max);
    let size = sizes.fold(reach.x.max(reach.y), f64::min);
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
