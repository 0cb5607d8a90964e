//! The two sides of a cut: the parts along it, and what lies between them.

use ppum::domain::Hole;
use ppum::line::Line;
use ppum::segment::Segment;
use ppum::vec2::Vec2;

use super::region::SegmentPiece;
use crate::geometry::rim_crossings;

/// An interval of places on a line.
type LineInterval = [f64; 2];

/// A cut, with the cracks along it and the parts on its sides.
#[derive(Debug)]
pub(super) struct CutSides {
    line: Line,
    /// Where cracks lie on it.
    covered: Vec<LineInterval>,
    /// The parts along it on the left and on the right.
    parts: [Vec<(usize, LineInterval)>; 2],
}

impl CutSides {
    pub(super) fn new(line: Line) -> Self {
        Self { line, covered: Vec::new(), parts: [Vec::new(), Vec::new()] }
    }

    fn interval(&self, ends: Segment) -> LineInterval {
        let [a, b] = ends.map(|p| self.line.foot(p));
        [a.min(b), a.max(b)]
    }

    /// A piece of a crack lies on the line.
    pub(super) fn cover(&mut self, piece: &SegmentPiece) {
        self.covered.push(self.interval(piece.ends));
    }

    /// A part with this centre has a side on the line.
    pub(super) fn add(&mut self, part: usize, ends: Segment, center: Vec2) {
        let side = usize::from(self.line.side(center) < 0.0);
        self.parts[side].push((part, self.interval(ends)));
    }

    /// The pairs of parts, on the left and on the right, between which the way is open for longer
    /// than `gap`.
    pub(super) fn open(&self, holes: &[&Hole], gap: f64) -> Vec<[usize; 2]> {
        let [left, right] = &self.parts;
        let pairs = left.iter().flat_map(|a| right.iter().map(move |b| (a, b)));
        let is_open = |((_, a), (_, b)): &(&(usize, LineInterval), &(usize, LineInterval))| {
            self.is_open([a[0].max(b[0]), a[1].min(b[1])], holes, gap)
        };
        pairs.filter(is_open).map(|(a, b)| [a.0, b.0]).collect()
    }

    /// The pairs of parts that touch each other along the line.
    pub(super) fn beside(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let [left, right] = &self.parts;
        let pairs = left.iter().flat_map(move |a| right.iter().map(move |b| (a, b)));
        let touch = |((_, a), (_, b)): &(&(usize, LineInterval), &(usize, LineInterval))| {
            a[0].max(b[0]) < a[1].min(b[1])
        };
        pairs.filter(touch).map(|(a, b)| [a.0, b.0])
    }

    fn is_open(&self, [from, to]: LineInterval, holes: &[&Hole], gap: f64) -> bool {
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
    fn in_hole(&self, [from, to]: LineInterval, hole: &Hole) -> Vec<LineInterval> {
        let crossings = rim_crossings(self.line.at(from), self.line.at(to), hole);
        let mut breaks: Vec<f64> = crossings.into_iter().filter(|t| *t > 0.0 && *t < 1.0).collect();
        breaks.extend([0.0, 1.0]);
        breaks.sort_by(f64::total_cmp);
        let place = |t: f64| from + (to - from) * t;
        let parts = breaks.windows(2).map(|t| [place(t[0]), place(t[1])]);
        parts.filter(|[a, b]| hole.contains(self.line.at(0.5 * (a + b)))).collect()
    }
}
