//! The cracks of a step as functions see them.

use crate::crack::{Crack, LocalCrack, LocalSegment, LocalTip, SegmentId, TipId};
use crate::edge::Edge;
use crate::vec2::Vec2;

/// Distance of the ends of an edge from a line or circle, in parts of its length, within which it
/// lies there: ends meant to be there are rounded.
const COLLINEAR: f64 = 1e-9;

/// Cracks seen from an anchor.
#[derive(Clone, Debug)]
pub(super) struct AnchoredCracks<'a> {
    pub(super) cracks: &'a [Crack],
    pub(super) anchor: Vec2,
    /// The segment that all points lie on, if one is known.
    pub(super) on: Option<SegmentId>,
}

impl<'a> AnchoredCracks<'a> {
    pub(super) fn crack(&self, crack: u32) -> LocalCrack<'a> {
        let points = &self.cracks[crack as usize];
        match self.segment_of(crack) {
            Some(segment) => LocalCrack::on(points, segment, self.anchor),
            None => LocalCrack::new(points, self.anchor),
        }
    }

    pub(super) fn tip(&self, tip: TipId) -> LocalTip<'a> {
        let points = &self.cracks[tip.crack as usize];
        match self.segment_of(tip.crack) {
            Some(segment) => LocalTip::on(points, segment, tip.end, self.anchor),
            None => LocalTip::new(points, tip.end, self.anchor),
        }
    }

    /// The line or circle of an edge, and whether all points lie on it along an edge that runs the
    /// other way.
    pub(super) fn line(&self, id: SegmentId) -> (LocalSegment, bool) {
        let edge = self.edge(id);
        let line = LocalSegment::new(edge, self.anchor);
        match self.on.map(|on| self.edge(on)) {
            Some(on) if is_along(&edge, &on) => {
                let tangent = edge.tangent_towards(on.middle());
                (line.touched(), tangent.dot(on.chord()) < 0.0)
            }
            _ => (line, false),
        }
    }

    fn edge(&self, id: SegmentId) -> Edge {
        self.cracks[id.crack as usize].edge(id.segment as usize)
    }

    /// The segment that all points lie on, if it is one of this crack.
    fn segment_of(&self, crack: u32) -> Option<u32> {
        self.on.filter(|on| on.crack == crack).map(|on| on.segment)
    }
}

/// True if the edge `on` lies on the line or circle of another one.
fn is_along(edge: &Edge, on: &Edge) -> bool {
    let reach = COLLINEAR * on.length();
    [on.from, on.middle(), on.to].iter().all(|&p| edge.side(p).abs() <= reach)
}
