//! The cracks of a step as functions see them.

use crate::crack::{Crack, LocalCrack, LocalSegment, LocalTip, SegmentId, TipId};
use crate::segment::Segment;
use crate::vec2::Vec2;

/// Distance of the ends of a segment from a line, in parts of its length, within which it lies on
/// the line: ends meant to be there are rounded.
const COLLINEAR: f64 = 1e-9;

/// Cracks seen from an anchor.
#[derive(Clone, Debug)]
pub(super) struct AnchoredCracks<'a> {
    pub(super) cracks: &'a [Crack],
    pub(super) anchor: Vec2,
    /// The segment that all points lie on, if one is known.
    pub(super) on: Option<SegmentId>,
}

impl AnchoredCracks<'_> {
    pub(super) fn crack(&self, crack: u32) -> LocalCrack {
        let points = &self.cracks[crack as usize];
        match self.segment_of(crack) {
            Some(segment) => LocalCrack::on(points, segment, self.anchor),
            None => LocalCrack::new(points, self.anchor),
        }
    }

    pub(super) fn tip(&self, tip: TipId) -> LocalTip {
        let points = &self.cracks[tip.crack as usize];
        match self.segment_of(tip.crack) {
            Some(segment) => LocalTip::on(points, segment, tip.end, self.anchor),
            None => LocalTip::new(points, tip.end, self.anchor),
        }
    }

    /// The line of a segment, and whether all points lie on it along a segment that runs the
    /// other way.
    pub(super) fn line(&self, id: SegmentId) -> (LocalSegment, bool) {
        let [a, b] = self.ends(id);
        let line = LocalSegment::new(a, b, self.anchor);
        match self.on.map(|on| self.ends(on)) {
            Some(on) if is_collinear([a, b], on) => {
                (line.touched(), (on[1] - on[0]).dot(b - a) < 0.0)
            }
            _ => (line, false),
        }
    }

    fn ends(&self, id: SegmentId) -> Segment {
        let (points, k) = (&self.cracks[id.crack as usize].points, id.segment as usize);
        [points[k], points[k + 1]]
    }

    /// The segment that all points lie on, if it is one of this crack.
    fn segment_of(&self, crack: u32) -> Option<u32> {
        self.on.filter(|on| on.crack == crack).map(|on| on.segment)
    }
}

/// True if the segment `on` lies on the line of another one.
fn is_collinear([a, b]: Segment, on: Segment) -> bool {
    let (along, reach) = ((b - a).unit(), COLLINEAR * (on[1] - on[0]).length());
    on.iter().all(|&p| along.cross(p - a).abs() <= reach)
}
