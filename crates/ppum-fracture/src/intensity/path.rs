//! The path of a tip's own crack through the discs around it.

use ppum::crack::{Crack, End, LocalTip, SegmentId, TipId};
use ppum::edge::Edge;
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

/// One edge of a path, as far as it lies in the disc.
#[derive(Clone, Copy, Debug)]
pub(super) struct PathSegment {
    /// Its number in the path, and in the whole crack.
    local: u32,
    pub(super) segment: u32,
    /// The edge, which leads away from the tip.
    pub(super) edge: Edge,
    /// True of the edge that ends at the tip.
    pub(super) is_first: bool,
}

/// A piece of the crack in a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct CrackPiece {
    pub(super) part: PathSegment,
    pub(super) edge: Edge,
    pub(super) cell: usize,
}

impl TipPath {
    /// The path through a disc inside the [clearance](super::TipClearance) of the tip.
    pub(super) fn new(own: &Crack, tip: TipId, radius: f64) -> Self {
        let center = own.end_point(tip.end);
        let inside = from_tip(own, tip.end).take_while(|edge| (edge.to - center).length() < radius);
        let n = own.points.len();
        let count = (inside.count() + 2).min(n);
        let first = match tip.end {
            End::Start => 0,
            End::Last => n - count,
        };
        let points = own.points[first..first + count].to_vec();
        let bulges = own.bulges.get(first..first + count - 1).unwrap_or_default().to_vec();
        Self { crack: Crack { points, bulges, ends: own.ends }, tip, first, radius }
    }

    /// The tip.
    pub(super) fn tip(&self) -> TipId {
        self.tip
    }

    /// Its position.
    pub(super) fn center(&self) -> Vec2 {
        self.crack.end_point(self.tip.end)
    }

    /// The curvature at the tip, positive where the crack turns left there.
    pub(super) fn curvature(&self) -> f64 {
        self.crack.edge_to(self.tip.end).curvature()
    }

    /// The tip as seen from an anchor.
    pub(super) fn at(&self, anchor: Vec2) -> LocalTip<'_> {
        LocalTip::new(&self.crack, self.tip.end, anchor)
    }

    /// Returns the tip as seen from an anchor, for points that lie on a part of the path.
    pub(super) fn on(&self, part: &PathSegment, anchor: Vec2) -> LocalTip<'_> {
        LocalTip::on(&self.crack, part.local, self.tip.end, anchor)
    }

    /// The edges, from the tip on, up to the boundary of the disc.
    pub(super) fn parts(&self) -> impl Iterator<Item = PathSegment> {
        from_tip(&self.crack, self.tip.end).zip(0..).map(move |(whole, k)| {
            let local = if self.tip.end == End::Start { k } else { self.last() - k };
            let to = reached(&whole, self.center(), self.radius);
            let (segment, edge) = (self.first as u32 + local, between(&whole, [whole.from, to]));
            PathSegment { local, segment, edge, is_first: k == 0 }
        })
    }

    /// A point of the edge at the tip, at a distance from it but not nearer than just behind it.
    pub(super) fn behind_tip(&self, distance: f64) -> (SegmentId, Vec2) {
        let segment = self.first as u32 + if self.tip.end == End::Start { 0 } else { self.last() };
        let edge = self.crack.edge_to(self.tip.end).reversed();
        let part = (distance / edge.length()).clamp(FIRST, 1.0 - FIRST);
        (SegmentId { crack: self.tip.crack, segment }, edge.at(part))
    }

    /// The number of the last edge of the path.
    fn last(&self) -> u32 {
        self.crack.points.len() as u32 - 2
    }

    /// The pieces of a part between which its distance to the tip takes the given values, or
    /// doubles. Those of the edge at the tip begin with one from there, on which only the field
    /// itself is singular.
    pub(super) fn pieces(&self, part: &PathSegment, at: &[f64]) -> Vec<Edge> {
        let (center, edge) = (self.center(), &part.edge);
        let [from, to] = [edge.from, edge.to].map(|p| (p - center).length());
        let from = from.max(to * FIRST);
        let mut breaks: Vec<f64> = at.iter().copied().filter(|r| *r > from && *r < to).collect();
        let mut r = to / RATIO;
        while r > from {
            breaks.push(r);
            r /= RATIO;
        }
        breaks.sort_by(f64::total_cmp);
        let inner = breaks.into_iter().map(|r| reached(edge, center, r));
        let points: Vec<_> = [edge.from].into_iter().chain(inner).chain([edge.to]).collect();
        let pieces = points.windows(2).filter(|p| p[0] != p[1]);
        pieces.map(|p| between(edge, [p[0], p[1]])).collect()
    }
}

/// The piece between two points of an edge of less than half a turn.
fn between(edge: &Edge, [from, to]: [Vec2; 2]) -> Edge {
    // tan(φ/4) by sin(φ/2)
    let sin = 0.5 * edge.curvature() * (to - from).length();
    Edge { from, to, bulge: sin / (1.0 + (1.0 - sin * sin).max(0.0).sqrt()) }
}

/// The point of an edge that leads away from `center` at the distance `radius` from it; the end if
/// that is nearer.
fn reached(edge: &Edge, center: Vec2, radius: f64) -> Vec2 {
    let Edge { from, to, .. } = *edge;
    if (to - center).length() <= radius {
        return to;
    }
    if edge.is_arc() {
        let parts = edge.meets_curve(&Edge::around(center, radius, [0.0, 1.0]));
        return parts.into_iter().find(|part| *part > 0.0).map_or(to, |part| edge.at(part));
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
        Crack::polyline(points, [CrackEnd::Tip; 2])
    }

    #[test]
    fn the_path_ends_with_the_disc() {
        for (end, segments, center) in
            [(End::Start, [0, 1], vec2(0.0, 0.0)), (End::Last, [3, 2], vec2(4.0, 0.0))]
        {
            let path = TipPath::new(&crack(), TipId { crack: 0, end }, 1.4);
            let parts: Vec<_> = path.parts().collect();
            assert_eq!(parts.iter().map(|p| p.segment).collect::<Vec<_>>(), segments);
            assert_eq!((parts[0].edge.from, path.center()), (center, center));
            assert_eq!(parts[0].edge.to, parts[1].edge.from);
            assert!(((parts[1].edge.to - center).length() - 1.4).abs() < 1e-15);
            assert!(parts[0].is_first && !parts[1].is_first);
        }
    }

    /// Pieces follow each other on the edge, end at the circles that are asked for, and are no
    /// longer than their distance.
    #[test]
    fn pieces_of_a_part() {
        let bent = Crack { bulges: vec![0.1, 0.2, -0.3, 0.15], ..crack() };
        for crack in [crack(), bent] {
            let path = TipPath::new(&crack, TipId { crack: 0, end: End::Last }, 3.0);
            for part in path.parts() {
                let pieces = path.pieces(&part, &[0.5, 1.2, 2.9]);
                let ends = [pieces[0].from, pieces[pieces.len() - 1].to];
                assert_eq!(ends, [part.edge.from, part.edge.to]);
                assert!(pieces.windows(2).all(|p| p[0].to == p[1].from));
                let length: f64 = pieces.iter().map(Edge::length).sum();
                assert!((length / part.edge.length() - 1.0).abs() < 1e-13);
                let distance = |p: Vec2| (p - path.center()).length();
                for piece in &pieces {
                    let [r, s] = [distance(piece.from), distance(piece.to)];
                    assert!(part.edge.distance(piece.middle()) < 1e-14);
                    // rounding of places of size 4
                    assert!(s <= 2.0 * r + 1e-12 || r == 0.0, "{r} {s}");
                    let is_divided = |at: &f64| s <= at + 1e-12 || r >= at - 1e-12;
                    assert!([0.5, 1.2, 2.9].iter().all(is_divided));
                }
            }
        }
    }
}
