//! Places: points with the side of a crack that is meant.

use crate::crack::{SegmentId, Side};
use crate::domain::Domain;
use crate::field::{Field, LocalField};
use crate::sides::{ROUNDING, Segments};
use crate::vec2::Vec2;

/// A point with the side of a crack that is meant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SidedPoint {
    /// The point as it was meant: `anchor + offset` may round to its neighbour.
    pub point: Vec2,
    /// The anchor that the field is seen from; places near each other share theirs.
    pub anchor: Vec2,
    /// The way from the anchor.
    pub offset: Vec2,
    /// The segment that the point lies on, if it lies on a crack.
    pub on: Option<SegmentId>,
    /// The side of that crack; `Above` on none.
    pub side: Side,
}

impl SidedPoint {
    /// The places of the point `anchor + offset`: above and below where it lies on a crack, else
    /// one alone.
    #[must_use]
    pub fn sides(segments: &Segments<'_>, anchor: Vec2, offset: Vec2) -> Vec<Self> {
        let on = segments.at(anchor, offset);
        let on_side = |side| Self { point: anchor + offset, anchor, offset, on, side };
        let sides = if on.is_some() { &[Side::Above, Side::Below][..] } else { &[Side::Above] };
        sides.iter().map(|&side| on_side(side)).collect()
    }

    /// The field as seen from the anchor, on the segment if the place lies on one.
    #[must_use]
    pub fn seen<'f>(&self, field: &'f Field<'_>) -> LocalField<'f> {
        match self.on {
            Some(segment) => field.on(segment, self.anchor),
            None => field.at(self.anchor),
        }
    }

    /// 1 above a crack, −1 below, 0 if the point is on none.
    #[must_use]
    pub fn mark(&self) -> f64 {
        match (self.on, self.side) {
            (None, _) => 0.0,
            (Some(_), Side::Above) => 1.0,
            (Some(_), Side::Below) => -1.0,
        }
    }
}

/// Makes places that lie on the boundary of the domain or on the rim of a hole, up to the rounding
/// of their coordinates, belong to the domain: they are evaluated a few roundings beside it, on its
/// side, and keep their `point`. Places that are not given by their coordinates do not need this:
/// their offsets are exact.
pub fn settle(domain: &Domain, places: &mut [SidedPoint]) {
    let extent = domain.bounds.max_norm();
    for group in places.chunk_by_mut(|a, b| a.anchor == b.anchor) {
        let (local, anchor) = (domain.at(group[0].anchor), group[0].anchor);
        for place in group {
            let away = place.offset.max_norm();
            let size = extent.max(anchor.max_norm()).max(away);
            // an offset that is tiny itself has no rounding of that size
            let finest = if away > 0.0 { 1e-3 * away } else { f64::INFINITY };
            if let Some(offset) = local.settled(place.offset, (ROUNDING * size).min(finest)) {
                place.offset = offset;
            }
        }
    }
}
