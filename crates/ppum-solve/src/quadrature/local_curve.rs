//! Curves that cut pieces, seen from an anchor.

use super::geometry::LevelFunction;
use super::roots::clamp_non_finite;
use ppum::edge::Edge;
use ppum::vec2::Vec2;
use std::rc::Rc;

/// Nearer to a singular point than this part of a piece a level function of the position is drawn
/// as its tangent: what it says of sides there is rounding.
const NEAR_ANCHOR: f64 = 1e-8;

/// A curve seen from an anchor: the zeros of a function of the offset.
#[derive(Clone)]
pub(super) enum LocalCurve<'c> {
    /// A level function, and the anchor.
    Level(&'c LevelFunction, Vec2),
    /// A circle.
    Circle(LocalArc),
    /// Arcs one behind the other that go on smoothly and do not turn much, between their tangents
    /// at both ends.
    Run(Rc<[LocalArc]>),
}

/// A circle by its point Q nearest to an anchor, and the begin of an arc on it.
#[derive(Clone, Copy)]
pub(super) struct LocalArc {
    /// Unit tangent at Q, and the unit vector to its left.
    tangent: Vec2,
    normal: Vec2,
    /// Distance of the anchor from the circle, positive on its left.
    distance: f64,
    curvature: f64,
    /// The begin of the arc, and its unit tangent.
    begin: [Vec2; 2],
}

impl LocalCurve<'_> {
    /// Arcs of a run, one behind the other.
    pub(super) fn arcs(edges: &[Edge], anchor: Vec2) -> Self {
        let (first, last) = (&edges[0], &edges[edges.len() - 1]);
        if edges.len() == 1 {
            return Self::Circle(LocalArc::new(first, anchor));
        }
        let ways = [first, last].map(|edge| edge.end_tangents().map(|t| t * edge.length()));
        let before = Edge::segment([first.from - ways[0][0], first.from]);
        let after = Edge::segment([last.to, last.to + ways[1][1]]);
        let all = [&before].into_iter().chain(edges).chain([&after]);
        Self::Run(all.map(|edge| LocalArc::new(edge, anchor)).collect())
    }

    /// The function's value at an offset.
    pub(super) fn value(&self, offset: Vec2) -> f64 {
        match self {
            Self::Level(level, anchor) => clamp_non_finite(level(*anchor + offset)),
            // it is smooth at the centre, which the distance is not
            Self::Circle(arc) => arc.power(offset),
            Self::Run(arcs) => nearest(arcs, offset).distance_beside(offset),
        }
    }

    /// The vector whose rounding is that of the value.
    pub(super) fn place(&self, offset: Vec2) -> Vec2 {
        if let Self::Level(_, anchor) = self { *anchor + offset } else { offset }
    }

    /// The part of a piece around the anchor in which the values are rounding.
    pub(super) fn least(&self) -> f64 {
        if let Self::Level(..) = self { NEAR_ANCHOR } else { 0.0 }
    }
}

/// The arc of a run, or a tangent beyond its ends, with a point between the normals at its ends.
/// Beside a run that does not turn much it is the nearest.
fn nearest(arcs: &[LocalArc], offset: Vec2) -> &LocalArc {
    let is_beyond = |arc: &LocalArc| arc.begin[1].dot(offset - arc.begin[0]) >= 0.0;
    &arcs[arcs[1..].partition_point(is_beyond)]
}

impl LocalArc {
    pub(super) fn new(edge: &Edge, anchor: Vec2) -> Self {
        let tangent = edge.tangent_towards(anchor);
        let begin = [edge.from - anchor, edge.end_tangents()[0]];
        let (distance, curvature) = (edge.side(anchor), edge.curvature());
        Self { tangent, normal: tangent.left(), distance, curvature, begin }
    }

    /// p = 2 v − κ (u² + v²) with the coordinates u and v from Q: (1 − κ² |x − c|²)/κ for the
    /// centre c, without it.
    fn power(&self, offset: Vec2) -> f64 {
        let (u, v) = (self.tangent.dot(offset), self.distance + self.normal.dot(offset));
        2.0 * v - self.curvature * (u * u + v * v)
    }

    /// Distance from the circle, positive on its left.
    fn distance(&self, offset: Vec2) -> f64 {
        let power = self.power(offset);
        power / (1.0 + (1.0 - self.curvature * power).max(0.0).sqrt())
    }

    /// Distance of a point beside the arc. Beyond the centre, where another arc is the nearest, it
    /// keeps its sign.
    fn distance_beside(&self, offset: Vec2) -> f64 {
        let across = self.begin[1].cross(offset - self.begin[0]);
        if self.curvature * across < 1.0 { self.distance(offset) } else { across }
    }
}
