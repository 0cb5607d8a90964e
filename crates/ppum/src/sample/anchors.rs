//! Anchors that follow from places alone.
//!
//! The last digits of a value depend on the anchor that it is seen from. Where anchors belong to
//! lists of points, so do these digits; here they belong to the plane, and a point has the same
//! value alone and amid others. An anchor is the tip that is near if the way from it is an f64
//! number, else the nearest point of a lattice of powers of two,
//!
//! ```text
//! a = h round(p / h)        h = 2ᵏ, about the size of the largest patch
//! ```
//!
//! from which p − a is exact, too: a is zero, or the difference no longer than p. So smaller
//! patches lose nothing by a lattice that is wider than they are.

use super::place::{SidedPoint, settle};
use crate::box_tree::BoxTree;
use crate::compensated::difference;
use crate::crack::{Side, TipId, tips};
use crate::domain::{Domain, Hole};
use crate::field::Field;
use crate::sides::{ROUNDING, Segments};
use crate::vec2::{Rect, Vec2, vec2};

/// Exponent of the widest lattice, of which some multiples are finite.
const WIDEST: f64 = 1000.0;

/// Anchors of points in the plane of a field, and the cracks that the points lie on.
///
/// ```
/// # use ppum::prelude::*;
/// # fn look(field: &Field<'_>) {
/// use ppum::sample::{AnchorMap, SampledQuantity, evaluate_each};
///
/// let anchors = AnchorMap::new(field);
/// let points = (0..9).map(|k| vec2(0.1 * f64::from(k), 0.2));
/// let places: Vec<_> = points.map(|point| anchors.at(point, Side::Above)).collect();
/// let wanted = [Quantity::Component(0)];
/// let all = evaluate_each(field, SampledQuantity::Values(&wanted), &places);
/// for (place, value) in places.iter().zip(all) {
///     assert_eq!(evaluate_each(field, SampledQuantity::Values(&wanted), &[*place]), [value]);
/// }
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct AnchorMap<'d> {
    domain: &'d Domain,
    segments: Segments<'d>,
    tips: Vec<Vec2>,
    /// Finds the tips by their places.
    tree: BoxTree,
    holes: Vec<Rect>,
    /// Spacing of the lattice.
    spacing: f64,
    /// The least distance up to which a point counts as on the boundary.
    reach: f64,
}

impl<'d> AnchorMap<'d> {
    /// The anchors of a field.
    #[must_use]
    pub fn new(field: &Field<'d>) -> Self {
        let (domain, cracks, step) = (field.domain, &field.step.cracks, field.step);
        let at = |tip: TipId| cracks[tip.crack as usize].end_point(tip.end);
        let tips: Vec<Vec2> = tips(cracks).map(at).collect();
        let boxes: Vec<_> = tips.iter().map(|&tip| Rect::new(tip, tip)).collect();
        let half = (0..step.partition.len()).map(|patch| step.partition.half(patch));
        let largest_half = half.fold(f64::MIN_POSITIVE, |most, h| most.max(h.x).max(h.y));
        Self {
            domain,
            segments: Segments::new(cracks),
            tree: BoxTree::new(&boxes),
            tips,
            holes: domain.holes.iter().flat_map(Hole::boxes).collect(),
            spacing: (1.0 + largest_half.log2()).ceil().min(WIDEST).exp2(),
            reach: 2.0 * ROUNDING * domain.bounds.max_norm(),
        }
    }

    /// The place of a point, on a side of the crack that it lies on. A point that lies on the
    /// boundary of the domain up to rounding belongs to the domain.
    #[must_use]
    pub fn at(&self, point: Vec2, side: Side) -> SidedPoint {
        let mut place = self.offset(point, Vec2::ZERO, side);
        if place.on.is_none() {
            place.anchor = self.anchor(point);
            place.offset = point - place.anchor;
        }
        if self.is_near_border(point) {
            settle(self.domain, std::slice::from_mut(&mut place));
        }
        place
    }

    /// The place of `anchor + offset`, which means what it says.
    #[must_use]
    pub fn offset(&self, anchor: Vec2, offset: Vec2, side: Side) -> SidedPoint {
        let on = self.segments.at(anchor, offset);
        let side = if on.is_some() { side } else { Side::Above };
        SidedPoint { point: anchor + offset, anchor, offset, on, side }
    }

    fn anchor(&self, point: Vec2) -> Vec2 {
        let nearest = |x: f64| (x / self.spacing).round() * self.spacing;
        self.tip_near(point).unwrap_or_else(|| vec2(nearest(point.x), nearest(point.y)))
    }

    /// The nearest tip, none of those farther away than the lattice's spacing in x or y or by a way
    /// that has to be rounded; of several the first.
    fn tip_near(&self, point: Vec2) -> Option<Vec2> {
        let mut near = Vec::new();
        let reach = vec2(self.spacing, self.spacing);
        self.tree.query_box(&Rect::around(point, reach), &mut near);
        let exact = |a: f64, b: f64| difference(a, b).1 == 0.0;
        let found = near.into_iter().map(|index| self.tips[index as usize]);
        let found = found.filter(|tip| exact(point.x, tip.x) && exact(point.y, tip.y));
        let away = |tip: &Vec2| (point - *tip).length();
        found.min_by(|a, b| away(a).total_cmp(&away(b)))
    }

    /// True if rounding may decide whether the point is of the domain.
    fn is_near_border(&self, point: Vec2) -> bool {
        let Rect { min, max } = self.domain.bounds;
        let reach = self.reach.max(2.0 * ROUNDING * point.max_norm());
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
