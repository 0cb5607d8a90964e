//! The cracks of a step as functions see them.

use crate::crack::{Crack, LocalCrack, LocalTip, SegmentId, TipId};
use crate::vec2::Vec2;

/// Cracks seen from an anchor.
#[derive(Clone, Debug)]
pub(super) struct Seen<'a> {
    pub(super) cracks: &'a [Crack],
    pub(super) anchor: Vec2,
    /// The segment that all points lie on, if one is known.
    pub(super) on: Option<SegmentId>,
}

impl Seen<'_> {
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

    /// The segment that all points lie on, if it is one of this crack.
    fn segment_of(&self, crack: u32) -> Option<u32> {
        self.on.filter(|on| on.crack == crack).map(|on| on.segment)
    }
}
