//! The two sides of a cut: the parts along it, and what lies between them.

use ppum::domain::Hole;
use ppum::edge::Edge;

use super::curve::{CurveInterval, CutCurve};
use super::region::SegmentPiece;
use crate::geometry::rim_crossings;

/// A cut, with the cracks along it and the parts on its sides.
#[derive(Debug)]
pub(super) struct CutSides {
    curve: CutCurve,
    /// Where cracks lie on it.
    covered: Vec<CurveInterval>,
    /// The parts along it on the left and on the right.
    parts: [Vec<(usize, CurveInterval)>; 2],
}

impl CutSides {
    pub(super) fn new(curve: CutCurve) -> Self {
        Self { curve, covered: Vec::new(), parts: [Vec::new(), Vec::new()] }
    }

    /// A piece of a crack lies on the curve.
    pub(super) fn cover(&mut self, piece: &SegmentPiece) {
        self.covered.extend(self.curve.intervals(&piece.edge));
    }

    /// A part has a side on the curve, with the part on its left.
    pub(super) fn add(&mut self, part: usize, side: &Edge) {
        let own = &mut self.parts[usize::from(!self.curve.is_along(side))];
        own.extend(self.curve.intervals(side).into_iter().map(|interval| (part, interval)));
    }

    /// The pairs of parts, on the left and on the right, between which the way is open for longer
    /// than `gap`.
    pub(super) fn open(&self, holes: &[&Hole], gap: f64) -> Vec<[usize; 2]> {
        let [left, right] = &self.parts;
        let pairs = left.iter().flat_map(|a| right.iter().map(move |b| (a, b)));
        let is_open = |((_, a), (_, b)): &(&(usize, CurveInterval), &(usize, CurveInterval))| {
            self.is_open([a[0].max(b[0]), a[1].min(b[1])], holes, gap)
        };
        pairs.filter(is_open).map(|(a, b)| [a.0, b.0]).collect()
    }

    /// The pairs of parts that touch each other along the curve.
    pub(super) fn beside(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let [left, right] = &self.parts;
        let pairs = left.iter().flat_map(move |a| right.iter().map(move |b| (a, b)));
        let touch = |((_, a), (_, b)): &(&(usize, CurveInterval), &(usize, CurveInterval))| {
            a[0].max(b[0]) < a[1].min(b[1])
        };
        pairs.filter(touch).map(|(a, b)| [a.0, b.0])
    }

    fn is_open(&self, [from, to]: CurveInterval, holes: &[&Hole], gap: f64) -> bool {
        if to - from <= gap {
            return false;
        }
        let mut closed = self.covered.clone();
        closed.extend(holes.iter().flat_map(|hole| self.in_hole([from, to], hole)));
        closed.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut at = from;
        for [begin, end] in closed {
            if begin.min(to) - at > gap {
                return true;
            }
            at = at.max(end);
        }
        to - at > gap
    }

    /// The parts of an interval that lie in a hole.
    fn in_hole(&self, [from, to]: CurveInterval, hole: &Hole) -> Vec<CurveInterval> {
        let edge = self.curve.of_interval([from, to]);
        let crossings = rim_crossings(edge, hole);
        let mut breaks: Vec<f64> = crossings.into_iter().filter(|t| *t > 0.0 && *t < 1.0).collect();
        breaks.extend([0.0, 1.0]);
        breaks.sort_by(f64::total_cmp);
        let is_in = |t: &&[f64]| hole.contains(edge.at(0.5 * (t[0] + t[1])));
        let place = |t: f64| from + (to - from) * t;
        breaks.windows(2).filter(is_in).map(|t| [place(t[0]), place(t[1])]).collect()
    }
}
