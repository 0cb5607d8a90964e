//! The path of a tip's own crack through the discs around it.

use ppum::crack::{Crack, End, LocalTip, SegmentId, TipId};
use ppum::vec2::Vec2;
use ppum_problem::geometry::from_tip;

/// Ratio of the distances to the tip at the ends of a [piece](TipPath::pieces). Auxiliary fields
/// are powers of the distance: on an interval from r to 2r twelve Gauss points leave an error of
/// 1e-15.
const RATIO: f64 = 2.0;

/// Length of the piece at the tip, in parts of its segment.
const FIRST: f64 = 1e-3;

/// The part of a crack from its tip to the first vertex outside of a disc.
///
/// The auxiliary fields jump on it and on its straight continuation, not on the rest of the crack:
/// what that does far away must not decide on which side a point of the disc lies.
#[derive(Debug)]
pub(super) struct TipPath {
    crack: Crack,
    tip: TipId,
    /// The whole crack's segment that is the first of this part.
    first: usize,
    radius: f64,
}

/// One segment of a path, as far as it lies in the disc.
#[derive(Clone, Copy, Debug)]
pub(super) struct PathSegment {
    /// Its number in the path, and in the whole crack.
    local: u32,
    pub(super) segment: u32,
    /// Its ends, the one nearer to the tip first.
    pub(super) ends: [Vec2; 2],
    /// True of the segment that ends at the tip.
    pub(super) is_first: bool,
}

/// A piece of the crack in a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct CrackPiece {
    pub(super) part: PathSegment,
    pub(super) ends: [Vec2; 2],
    pub(super) cell: usize,
}

impl TipPath {
    /// The path through a disc inside the [clearance](super::TipClearance) of the tip.
    pub(super) fn new(own: &Crack, tip: TipId, radius: f64) -> Self {
        let center = own.end_point(tip.end);
        let inside = from_tip(own, tip.end).take_while(|p| (*p - center).length() < radius);
        let n = own.points.len();
        let count = (inside.count() + 1).clamp(2, n);
        let first = match tip.end {
            End::Start => 0,
            End::Last => n - count,
        };
        let points = own.points[first..first + count].to_vec();
        Self { crack: Crack { points, ends: own.ends }, tip, first, radius }
    }

    /// The tip.
    pub(super) fn tip(&self) -> TipId {
        self.tip
    }

    /// Its position.
    pub(super) fn center(&self) -> Vec2 {
        self.crack.end_point(self.tip.end)
    }

    /// The tip as seen from an anchor.
    pub(super) fn at(&self, anchor: Vec2) -> LocalTip {
        LocalTip::new(&self.crack, self.tip.end, anchor)
    }

    /// Returns the tip as seen from an anchor, for points that lie on a part of the path.
    pub(super) fn on(&self, part: &PathSegment, anchor: Vec2) -> LocalTip {
        LocalTip::on(&self.crack, part.local, self.tip.end, anchor)
    }

    /// The segments, from the tip on, up to the boundary of the disc.
    pub(super) fn parts(&self) -> impl Iterator<Item = PathSegment> {
        let points: Vec<Vec2> = from_tip(&self.crack, self.tip.end).collect();
        let last = points.len() - 2;
        (0..=last).map(move |k| {
            let local = match self.tip.end {
                End::Start => k,
                End::Last => last - k,
            };
            let (segment, whole) = ((self.first + local) as u32, [points[k], points[k + 1]]);
            let to = reached(whole, points[0], self.radius);
            PathSegment { local: local as u32, segment, ends: [whole[0], to], is_first: k == 0 }
        })
    }

    /// A point of the segment at the tip, at a distance from it but not nearer than just behind it.
    pub(super) fn behind_tip(&self, distance: f64) -> (SegmentId, Vec2) {
        let segment = self.first as u32 + if self.tip.end == End::Start { 0 } else { self.last() };
        let mut from = from_tip(&self.crack, self.tip.end);
        let (tip, next) = (from.next(), from.next());
        let [tip, next] = [tip, next].map(|p| p.unwrap_or(self.center()));
        let part = (distance / (next - tip).length()).clamp(FIRST, 1.0 - FIRST);
        (SegmentId { crack: self.tip.crack, segment }, tip + (next - tip) * part)
    }

    /// The number of the last segment of the path.
    fn last(&self) -> u32 {
        self.crack.points.len() as u32 - 2
    }

    /// The pieces of a part between which its distance to the tip takes the given values, or
    /// doubles. Those of the segment at the tip begin with one from there, on which only the field
    /// itself is singular.
    pub(super) fn pieces(&self, part: &PathSegment, at: &[f64]) -> Vec<[Vec2; 2]> {
        let center = self.center();
        let [from, to] = part.ends.map(|p| (p - center).length());
        let from = from.max(to * FIRST);
        let mut breaks: Vec<f64> = at.iter().copied().filter(|r| *r > from && *r < to).collect();
        let mut r = to / RATIO;
        while r > from {
            breaks.push(r);
            r /= RATIO;
        }
        breaks.sort_by(f64::total_cmp);
        let inner = breaks.into_iter().map(|r| reached(part.ends, center, r));
        let points: Vec<_> =
            [part.ends[0]].into_iter().chain(inner).chain([part.ends[1]]).collect();
        points.windows(2).filter(|p| p[0] != p[1]).map(|p| [p[0], p[1]]).collect()
    }
}

/// The point of a segment that leads away from `center` at the distance `radius` from it; the end
/// if that is nearer.
fn reached([from, to]: [Vec2; 2], center: Vec2, radius: f64) -> Vec2 {
    if (to - center).length() <= radius {
        return to;
    }
    let along = (to - from).unit();
    let (way, height) = (along.dot(from - center), along.cross(from - center));
    from + along * (((radius - height) * (radius + height)).max(0.0).sqrt() - way)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::crack::CrackEnd;
    use ppum::vec2::vec2;

    fn crack() -> Crack {
        let points =
            vec![vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(2.0, 0.5), vec2(3.0, 0.5), vec2(4.0, 0.0)];
        Crack { points, ends: [CrackEnd::Tip; 2] }
    }

    #[test]
    fn the_course_ends_with_the_disc() {
        for (end, segments, center) in
            [(End::Start, [0, 1], vec2(0.0, 0.0)), (End::Last, [3, 2], vec2(4.0, 0.0))]
        {
            let path = TipPath::new(&crack(), TipId { crack: 0, end }, 1.4);
            let parts: Vec<_> = path.parts().collect();
            assert_eq!(parts.iter().map(|p| p.segment).collect::<Vec<_>>(), segments);
            assert_eq!((parts[0].ends[0], path.center()), (center, center));
            assert_eq!(parts[0].ends[1], parts[1].ends[0]);
            assert!(((parts[1].ends[1] - center).length() - 1.4).abs() < 1e-15);
            assert!(parts[0].is_first && !parts[1].is_first);
        }
    }

    /// Pieces follow each other, end at the circles that are asked for, and are no longer than
    /// their distance.
    #[test]
    fn pieces_of_a_part() {
        let path = TipPath::new(&crack(), TipId { crack: 0, end: End::Last }, 3.0);
        for part in path.parts() {
            let pieces = path.pieces(&part, &[0.5, 1.2, 2.9]);
            assert_eq!([pieces[0][0], pieces[pieces.len() - 1][1]], part.ends);
            assert!(pieces.windows(2).all(|p| p[0][1] == p[1][0]));
            let distance = |p: Vec2| (p - path.center()).length();
            for [a, b] in &pieces {
                let [r, s] = [distance(*a), distance(*b)];
                assert!(s <= 2.0 * r * (1.0 + 1e-12) || r == 0.0, "{r} {s}");
                assert!([0.5, 1.2, 2.9].iter().all(|at| s <= at + 1e-12 || r >= at - 1e-12));
            }
        }
    }
}
