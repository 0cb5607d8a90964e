//! Indicator functions of connected components of what cracks leave of a patch.
//!
//! Cracks that meet cut a patch into more parts than their sides tell apart: behind a branch, or
//! beyond a crack's end on another one, the side of a crack jumps where the field does not. The
//! indicator function of a component jumps on the component's own faces only. It is a tree of cuts,
//! each by the line, or the circle, of one edge of a crack:
//!
//! ```text
//!              segment 0 of crack 0
//!              left /        \ right
//!   segment 2 of crack 1      outside
//!     left /     \ right
//!      inside   outside
//! ```

use super::anchored::AnchoredCracks;
use crate::crack::{LocalSegment, SegmentId, Side};
use ppum_formula::real::Real;

/// One cut of a component's tree, by the whole line or circle of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cut {
    /// The segment.
    pub segment: SegmentId,
    /// The part on the left of the segment's direction, and on the line itself.
    pub left: CutBranch,
    /// The part on the right.
    pub right: CutBranch,
}

/// A part of the plane behind a cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CutBranch {
    /// Not in the component: the function is 0.
    Outside,
    /// In the component: the function is 1.
    Inside,
    /// Cut further, by a cut that stands behind this one in the tree.
    Cut(u32),
}

/// Numbers of the parts that are not cut, beside those of cuts.
const OUTSIDE: f64 = -1.0;
const INSIDE: f64 = -2.0;

impl CutBranch {
    /// The number of a part: that of a cut, −1 outside, −2 inside.
    #[must_use]
    pub fn number(self) -> i64 {
        match self {
            Self::Outside => OUTSIDE as i64,
            Self::Inside => INSIDE as i64,
            Self::Cut(cut) => cut.into(),
        }
    }

    /// The part of a number; none if there is no such part.
    #[must_use]
    pub fn of_number(number: i64) -> Option<Self> {
        match number {
            -1 => Some(Self::Outside),
            -2 => Some(Self::Inside),
            _ => u32::try_from(number).ok().map(Self::Cut),
        }
    }
}

/// The indicator of a component, seen from an anchor.
#[derive(Clone, Debug)]
pub(super) struct LocalIndicator {
    cuts: Vec<LocalCut>,
}

#[derive(Clone, Copy, Debug)]
struct LocalCut {
    line: LocalSegment,
    /// True if points are known to lie on the line, of a segment that runs the other way.
    reversed: bool,
    left: f64,
    right: f64,
}

impl LocalIndicator {
    pub(super) fn new(cuts: &[Cut], seen: &AnchoredCracks<'_>) -> Self {
        let cut = |cut: &Cut| {
            let (line, reversed) = seen.line(cut.segment);
            let [left, right] = [cut.left, cut.right].map(|part| part.number() as f64);
            LocalCut { line, reversed, left, right }
        };
        Self { cuts: cuts.iter().map(cut).collect() }
    }

    /// 1 in the component, 0 elsewhere; `side` decides on the lines of the cuts.
    ///
    /// A cut stands before those that follow from it, so one pass over the tree brings every lane
    /// to its part.
    #[inline(always)]
    pub(super) fn value<R: Real>(&self, offset: [R; 2], side: Side) -> R {
        let (zero, one) = (offset[0].broadcast(0.0), offset[0].broadcast(1.0));
        let (half, mut at, mut k) = (one.broadcast(0.5), zero, 0);
        while k < self.cuts.len() {
            let cut = &self.cuts[k];
            let next = cut.next(offset, side);
            let is_here = half.gt((at - one.broadcast(k as f64)).abs());
            at = R::select(is_here, next, at);
            k += 1;
        }
        let is_inside = half.gt((at - one.broadcast(INSIDE)).abs());
        R::select(is_inside, one, zero)
    }
}

impl LocalCut {
    /// Number of the part that a point lies in.
    #[inline(always)]
    fn next<R: Real>(&self, offset: [R; 2], side: Side) -> R {
        let distance = self.line.curved_distance_of(offset);
        let (zero, left, right) = (
            distance.broadcast(0.0),
            distance.broadcast(self.left),
            distance.broadcast(self.right),
        );
        // on the line the left is what lies above a segment, and below one that runs the other way
        let is_left = if (side == Side::Above) == self.reversed {
            distance.gt(zero)
        } else {
            distance.ge(zero)
        };
        R::select(is_left, left, right)
    }
}
