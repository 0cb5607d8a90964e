//! Convex parts of a box, and the pieces of cracks in them.

use ppum::crack::SegmentId;
use ppum::domain::Hole;
use ppum::line::Line;
use ppum::segment::Segment;
use ppum::vec2::{Rect, Vec2};

/// A piece of a segment, and the line of the whole segment, on which t is a length.
#[derive(Clone, Copy, Debug)]
pub(super) struct SegmentPiece {
    pub(super) id: SegmentId,
    pub(super) line: Line,
    pub(super) ends: Segment,
}

impl SegmentPiece {
    /// The part of a segment in a box, if it is longer than rounding.
    pub(super) fn inside(id: SegmentId, ends: Segment, open: &Rect, thinnest: f64) -> Option<Self> {
        let [from, to] = crate::geometry::clipped(ends[0], ends[1], open)?;
        let at = |t: f64| if t == 1.0 { ends[1] } else { ends[0] + (ends[1] - ends[0]) * t };
        let piece = [at(from), at(to)];
        let line = Line { from: piece[0], along: (ends[1] - ends[0]).unit() };
        let piece = Self { id, line, ends: piece };
        (piece.length() > thinnest).then_some(piece)
    }

    fn length(&self) -> f64 {
        (self.ends[1] - self.ends[0]).length()
    }

    /// Returns the parts on the left and on the right of a line; a region that lies on it has none.
    pub(super) fn split(&self, line: &Line, thinnest: f64) -> [Option<Self>; 2] {
        let [a, b] = self.ends;
        let (da, db) = (line.side(a), line.side(b));
        let on = |p: f64| p.abs() <= thinnest;
        if on(da) && on(db) {
            return [None, None];
        }
        if !on(da) && !on(db) && (da > 0.0) != (db > 0.0) {
            let middle = a + (b - a) * (da / (da - db));
            let [first, second] =
                [[a, middle], [middle, b]].map(|ends| Some(Self { ends, ..*self }));
            return if da > 0.0 { [first, second] } else { [second, first] };
        }
        if da.max(db) > thinnest { [Some(*self), None] } else { [None, Some(*self)] }
    }
}

/// A corner of a region, and the cut that made the side from it to the next corner; none on the
/// boundary of the box.
type RegionCorner = (Vec2, Option<usize>);

/// A convex polygon, counter-clockwise.
#[derive(Clone, Debug)]
pub(super) struct ConvexRegion(Vec<RegionCorner>);

impl ConvexRegion {
    pub(super) fn of_box(open: &Rect) -> Self {
        Self(open.corners().map(|p| (p, None)).to_vec())
    }

    /// True if a line leaves something on both of its sides.
    pub(super) fn is_split_by(&self, line: &Line, thinnest: f64) -> bool {
        let distances = || self.0.iter().map(|(p, _)| line.side(*p));
        distances().any(|d| d > thinnest) && distances().any(|d| d < -thinnest)
    }

    /// The parts on the left and on the right of the line of a segment.
    ///
    /// A side that the segment ends on is divided there: the crossing of lines at a small angle is
    /// lost in rounding, and cracks that meet at a point would leave a way between them.
    pub(super) fn split(&self, line: &Line, ends: Segment, cut: usize, thinnest: f64) -> [Self; 2] {
        let (mut left, mut right) = (Vec::new(), Vec::new());
        for (k, &(p, side)) in self.0.iter().enumerate() {
            let next = self.0[(k + 1) % self.0.len()].0;
            let (d, dn) = (line.side(p), line.side(next));
            let [d, dn] = [d, dn].map(|d| if d.abs() <= thinnest { 0.0 } else { d });
            // a part leaves at the line along the cut
            if d >= 0.0 {
                left.push((p, if d == 0.0 && dn < 0.0 { Some(cut) } else { side }));
            }
            if d <= 0.0 {
                right.push((p, if d == 0.0 && dn > 0.0 { Some(cut) } else { side }));
            }
            if d * dn < 0.0 {
                let along = Line::through([p, next]).unit();
                let is_on = |end: &Vec2| {
                    let length = 0.0..=(next - p).length();
                    along.side(*end).abs() <= thinnest && length.contains(&along.foot(*end))
                };
                let crossing = || p + (next - p) * (d / (d - dn));
                let middle = ends.into_iter().find(is_on).unwrap_or_else(crossing);
                left.push((middle, if d > 0.0 { Some(cut) } else { side }));
                right.push((middle, if d < 0.0 { Some(cut) } else { side }));
            }
        }
        [Self(left), Self(right)]
    }

    fn ends(&self) -> impl Iterator<Item = (Segment, Option<usize>)> + '_ {
        let next = |k: usize| self.0[(k + 1) % self.0.len()].0;
        self.0.iter().enumerate().map(move |(k, (p, side))| ([*p, next(k)], *side))
    }

    /// The cuts along which a piece runs on the boundary of the region.
    pub(super) fn cuts_along(
        &self,
        piece: &SegmentPiece,
        thinnest: f64,
    ) -> impl Iterator<Item = usize> + '_ {
        let (line, ends) = (piece.line, piece.ends);
        let runs = move |side: &Segment| {
            let along = Line::through(*side).unit();
            let near = |d: f64| d.abs() <= 2.0 * thinnest;
            ends.iter().all(|p| near(along.side(*p))) || side.iter().all(|p| near(line.side(*p)))
        };
        self.ends().filter_map(move |(side, cut)| cut.filter(|_| runs(&side)))
    }

    /// The sides along cuts.
    pub(super) fn sides(&self) -> impl Iterator<Item = (usize, Segment)> + '_ {
        self.ends().filter_map(|(ends, cut)| cut.map(|cut| (cut, ends)))
    }

    /// The part in a box.
    pub(super) fn within(&self, part: &Rect, thinnest: f64) -> Self {
        part.sides().into_iter().fold(self.clone(), |region, side| {
            let line = Line::through(side).unit();
            region.split(&line, side, 0, thinnest).into_iter().next().unwrap_or(region)
        })
    }

    /// The mean of the corners.
    pub(super) fn center(&self) -> Vec2 {
        let sum = self.0.iter().fold(Vec2::ZERO, |sum, (p, _)| sum + *p);
        sum * (1.0 / self.0.len() as f64)
    }

    /// The area, about, of what holes leave.
    pub(super) fn area(&self, holes: &[&Hole]) -> f64 {
        let center = self.center();
        let triangle = |[a, b]: Segment| {
            let area = 0.5 * (a - center).cross(b - center);
            area * solid_part([center, a, b], holes)
        };
        self.ends().map(|(ends, _)| triangle(ends)).sum()
    }
}

/// Places in each direction of a triangle that are looked at.
const LOOKS: u32 = 4;

/// The part of a triangle outside of holes, about.
fn solid_part([a, b, c]: [Vec2; 3], holes: &[&Hole]) -> f64 {
    if holes.is_empty() {
        return 1.0;
    }
    let at = |k: u32| (f64::from(k) + 1.0 / 3.0) / f64::from(LOOKS);
    let places = (0..LOOKS).flat_map(|i| (0..LOOKS - i).map(move |j| (at(i), at(j))));
    let solid = |&(s, t): &(f64, f64)| {
        let p = a + (b - a) * s + (c - a) * t;
        !holes.iter().any(|hole| hole.contains(p))
    };
    let all = places.clone().count();
    places.filter(solid).count() as f64 / all as f64
}
