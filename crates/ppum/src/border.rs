//! Straight lines of the boundary, on which cracks of half models lie, and at which bodies are
//! mirrored.

use crate::crack::{Crack, Side};
use crate::domain::{Domain, Hole};
use crate::edge::Edge;
use crate::segment::{self, Segment};
use crate::vec2::{Rect, Vec2};

/// Lengths below this part of the longer side of the box around a body count as zero: nearer things
/// are meant to touch, and no cover resolves them.
pub const TOUCH: f64 = 1e-9;

/// The length below which things touch: 10⁻⁹ of the longer side of a box.
#[must_use]
pub fn touch(bounds: &Rect) -> f64 {
    let size = bounds.size();
    TOUCH * size.x.max(size.y)
}

/// True for a side on one of the lines x = a and y = b at which a body is mirrored: there it has no
/// boundary.
#[must_use]
pub fn is_mirrored_side([a, b]: Segment, [x, y]: [Option<f64>; 2], touch: f64) -> bool {
    let is_at = |line: Option<f64>, ends: [f64; 2]| {
        line.is_some_and(|line| ends.iter().all(|end| (end - line).abs() <= touch))
    };
    is_at(x, [a.x, b.x]) || is_at(y, [a.y, b.y])
}

/// A straight line of the boundary from corner to corner: an edge of the box, or sides of a polygon
/// that go straight on. The body lies on its left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BorderLine {
    /// Its ends.
    pub ends: Segment,
    /// The index of the hole whose rim it is part of; none for an edge of the box.
    pub hole: Option<usize>,
}

impl BorderLine {
    /// Unit vector from its first to its second end.
    #[must_use]
    pub fn direction(&self) -> Vec2 {
        (self.ends[1] - self.ends[0]).unit()
    }

    /// Unit normal out of the body.
    #[must_use]
    pub fn outward(&self) -> Vec2 {
        -self.direction().left()
    }

    /// Distance of a point from the infinite line, positive on the side of the body.
    #[must_use]
    pub fn depth(&self, p: Vec2) -> f64 {
        self.direction().cross(p - self.ends[0])
    }

    /// Length along the line from its first end to the foot of a point.
    #[must_use]
    pub fn coordinate(&self, p: Vec2) -> f64 {
        self.direction().dot(p - self.ends[0])
    }

    /// Its length.
    #[must_use]
    pub fn length(&self) -> f64 {
        (self.ends[1] - self.ends[0]).length()
    }

    /// True if a point is no farther from it than `touch`.
    #[must_use]
    pub fn holds(&self, p: Vec2, touch: f64) -> bool {
        segment::distance(self.ends, p) <= touch
    }

    /// The side of a segment on it that lies outside of the body.
    #[must_use]
    pub fn outer_side(&self, [a, b]: Segment) -> Side {
        if self.direction().dot(b - a) > 0.0 { Side::Below } else { Side::Above }
    }

    /// The foot of a point, or the end that is no farther from it than `touch`.
    #[must_use]
    pub fn foot(&self, p: Vec2, touch: f64) -> Vec2 {
        let end = self.ends.into_iter().find(|end| (p - *end).length() <= touch);
        end.unwrap_or(p + self.outward() * self.depth(p))
    }
}

impl Domain {
    /// The straight lines of the boundary: edges of the box, and sides of polygons.
    pub fn border_lines(&self) -> impl Iterator<Item = BorderLine> + '_ {
        let of_rim = |(k, hole): (usize, &Hole)| {
            let line = move |ends| BorderLine { ends, hole: Some(k) };
            hole.straight_lines().into_iter().map(line)
        };
        self.edge_lines().chain(self.holes.iter().enumerate().flat_map(of_rim))
    }

    fn edge_lines(&self) -> impl Iterator<Item = BorderLine> + use<> {
        self.bounds.sides().into_iter().map(|ends| BorderLine { ends, hole: None })
    }

    /// The straight line of the boundary that holds all of a crack, which has no arcs then.
    #[must_use]
    pub fn line_along(&self, crack: &Crack) -> Option<BorderLine> {
        if crack.is_curved() { None } else { self.line_through(&crack.points) }
    }

    /// The straight line of the boundary that holds some points.
    fn line_through(&self, points: &[Vec2]) -> Option<BorderLine> {
        let touch = touch(&self.bounds);
        let holds =
            |line: &BorderLine| points.len() > 1 && points.iter().all(|p| line.holds(*p, touch));
        let on_rim = |(k, hole): (usize, &Hole)| {
            Some(BorderLine { ends: hole.line_through(points)?, hole: Some(k) })
        };
        let mut holes = self.holes.iter().enumerate();
        self.edge_lines().find(holds).or_else(|| holes.find_map(on_rim))
    }

    /// The straight line of the boundary that holds an edge, which is no arc then.
    #[must_use]
    pub fn line_of(&self, edge: Edge) -> Option<BorderLine> {
        if edge.is_arc() { None } else { self.line_through(&[edge.from, edge.to]) }
    }

    /// The side of an edge on a straight line of the boundary that lies outside of the body: of a
    /// crack on a line of symmetry one face is in the body.
    #[must_use]
    pub fn outer_side(&self, edge: Edge) -> Option<Side> {
        self.line_of(edge).map(|line| line.outer_side([edge.from, edge.to]))
    }
}

impl Hole {
    /// The straight lines of a polygon from corner to corner, with the hole on their right.
    fn straight_lines(&self) -> Vec<Segment> {
        let (sides, touch): (Vec<Edge>, _) = (self.edges().collect(), touch(&self.rim_bounds()));
        let n = sides.len();
        let goes_on = |[a, b]: Segment, c: Vec2| {
            let way = c - a;
            (b - a).dot(c - b) > 0.0 && (b - a).cross(way).abs() <= touch * way.length()
        };
        let is_corner = |k: &usize| {
            let (before, own) = (sides[(*k + n - 1) % n], sides[*k]);
            before.is_arc() || own.is_arc() || !goes_on([before.from, before.to], own.to)
        };
        let first = (0..n).find(is_corner).unwrap_or(0);
        let mut lines: Vec<Segment> = Vec::new();
        for Edge { from, to, .. } in
            sides.iter().cycle().skip(first).take(n).filter(|side| !side.is_arc())
        {
            match lines.last_mut() {
                Some(line) if line[1] == *from && goes_on(*line, *to) => line[1] = *to,
                _ => lines.push([*from, *to]),
            }
        }
        if self.orientation() > 0.0 {
            lines.iter_mut().for_each(|line| line.reverse());
        }
        lines
    }

    /// The straight line of the rim of a polygon that holds all of a crack, which has no arcs then.
    #[must_use]
    pub fn line_along(&self, crack: &Crack) -> Option<Segment> {
        if crack.is_curved() { None } else { self.line_through(&crack.points) }
    }

    fn line_through(&self, points: &[Vec2]) -> Option<Segment> {
        let touch = touch(&self.rim_bounds());
        let (Self::Polygon { .. }, [first, _, ..]) = (self, points) else { return None };
        if self.rim_distance(*first) > touch {
            return None;
        }
        let holds = |line: &Segment| points.iter().all(|p| segment::distance(*line, *p) <= touch);
        self.straight_lines().into_iter().find(holds)
    }
}
