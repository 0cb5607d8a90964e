//! Anchors that follow from places alone.
//!
//! The last digits of a value depend on the anchor that it is seen from. Where anchors belong to lists of points, so do
//! these digits; here they belong to the plane, and a point has the same value alone and amid others. An anchor is
//! the tip that is near, else the nearest point of a lattice of powers of two,
//!
//! ```text
//! a = h round(p / h)        h = 2ᵏ, about the size of the patch
//! ```
//!
//! from which p − a is exact: a is zero, or the difference no longer than p.

use super::{Place, ROUNDING, largest, settle};
use crate::box_tree::BoxTree;
use crate::crack::{Side, TipId, tips};
use crate::domain::{Domain, Hole};
use crate::field::Field;
use crate::sides::Segments;
use crate::vec2::{Rect, Vec2, vec2};

/// As many tips are asked one by one in less time than a tree takes.
const FEW: usize = 16;

/// Seats of points in the plane of a field: their anchors, and the cracks that they lie on.
///
/// ```
/// # use ppum::prelude::*;
/// # fn look(field: &Field<'_>) {
/// use ppum::sample::{Seats, Wanted, evaluate_each};
///
/// let seats = Seats::new(field);
/// let places: Vec<_> = (0..9).map(|k| seats.at(field, vec2(0.1 * f64::from(k), 0.2), Side::Above)).collect();
/// let wanted = [Quantity::Component(0)];
/// let all = evaluate_each(field, Wanted::Values(&wanted), &places);
/// for (place, value) in places.iter().zip(all) {
///     assert_eq!(evaluate_each(field, Wanted::Values(&wanted), &[*place]), [value]);
/// }
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Seats<'d> {
    domain: &'d Domain,
    segments: Segments<'d>,
    tips: Vec<Vec2>,
    /// Finds the tips by their places.
    tree: BoxTree,
    holes: Vec<Rect>,
    /// Spacing of the lattice, if it is the same everywhere.
    spacing: Option<f64>,
    /// What counts as on the border, at least.
    reach: f64,
}

impl<'d> Seats<'d> {
    /// The seats of a field.
    #[must_use]
    pub fn new(field: &Field<'d>) -> Self {
        let (domain, cracks, half) = (field.domain, &field.step.cracks, &field.step.partition.half);
        let at = |tip: TipId| cracks[tip.crack as usize].end_point(tip.end);
        let tips: Vec<Vec2> = tips(cracks).map(at).collect();
        let boxes: Vec<_> = tips.iter().map(|&tip| Rect::new(tip, tip)).collect();
        let mut spacings = half.iter().map(|&half| spacing(half));
        let first = spacings.next();
        let Rect { min, max } = domain.bounds;
        Self {
            domain,
            segments: Segments::new(cracks),
            tree: BoxTree::new(&boxes),
            tips,
            holes: domain.holes.iter().map(Hole::bounds).collect(),
            spacing: first.filter(|&first| spacings.all(|other| other == first)),
            reach: 2.0 * ROUNDING * [min.x, min.y, max.x, max.y].into_iter().fold(0.0, largest),
        }
    }

    /// The place of a point, on a side of the crack that it lies on. A point on a border of the domain, but for rounding,
    /// is of the domain.
    #[must_use]
    pub fn at(&self, field: &Field<'_>, point: Vec2, side: Side) -> Place {
        let mut place = self.offset(point, Vec2::ZERO, side);
        if place.on.is_none() {
            place.anchor = self.anchor(field, point);
            place.offset = point - place.anchor;
        }
        if self.is_near_border(point) {
            settle(self.domain, std::slice::from_mut(&mut place));
        }
        place
    }

    /// The place of `anchor + offset`, which means what it says.
    #[must_use]
    pub fn offset(&self, anchor: Vec2, offset: Vec2, side: Side) -> Place {
        let on = self.segments.at(anchor, offset);
        let side = if on.is_some() { side } else { Side::Above };
        Place { point: anchor + offset, anchor, offset, on, side }
    }

    fn anchor(&self, field: &Field<'_>, point: Vec2) -> Vec2 {
        let Some(h) = self.spacing.or_else(|| own_spacing(field, point)) else { return point };
        if let Some(tip) = self.tip_near(point, h) {
            return tip;
        }
        let nearest = |x: f64| (x / h).round() * h;
        vec2(nearest(point.x), nearest(point.y))
    }

    /// The nearest tip, none of those farther away than h in x or y; of several the first.
    fn tip_near(&self, point: Vec2, h: f64) -> Option<Vec2> {
        let window = Rect::around(point, vec2(h, h));
        if self.tips.len() <= FEW {
            let is_near = |&tip: &Vec2| Rect::new(tip, tip).overlaps(&window);
            return nearest(point, self.tips.iter().copied().filter(is_near));
        }
        let mut near = Vec::new();
        self.tree.query_box(&window, &mut near);
        nearest(point, near.into_iter().map(|index| self.tips[index as usize]))
    }

    /// True if rounding may decide whether the point is of the domain.
    fn is_near_border(&self, point: Vec2) -> bool {
        let Rect { min, max } = self.domain.bounds;
        let reach = self.reach.max(2.0 * ROUNDING * largest(point.x, point.y));
        let is_near = |a: f64, b: f64| (a - b).abs() <= reach;
        let inflated = |b: &Rect| {
            Rect::new(b.min - vec2(reach, reach), b.max + vec2(reach, reach)).contains(point)
        };
        is_near(point.x, min.x)
            || is_near(point.x, max.x)
            || is_near(point.y, min.y)
            || is_near(point.y, max.y)
            || self.holes.iter().any(inflated)
    }
}

/// The first of those that are nearest to a point.
fn nearest(point: Vec2, all: impl Iterator<Item = Vec2>) -> Option<Vec2> {
    let away = |tip: &Vec2| (point - *tip).length();
    all.min_by(|a, b| away(a).total_cmp(&away(b)))
}

/// The spacing that belongs to a patch: the power of two at or above its extent.
fn spacing(half: Vec2) -> f64 {
    (2.0 * half.x.max(half.y)).log2().ceil().exp2()
}

/// The spacing at a point, that of the first patch that covers it.
fn own_spacing(field: &Field<'_>, point: Vec2) -> Option<f64> {
    let mut patches = Vec::new();
    field.tree.query_point(point, &mut patches);
    patches.first().map(|&patch| spacing(field.step.partition.half[patch as usize]))
}
