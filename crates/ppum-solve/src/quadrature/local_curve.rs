//! Curves that cut pieces, seen from an anchor.

use super::geometry::LevelFunction;
use super::roots::clamp_non_finite;
use ppum::edge::{Edge, EdgeFrame};
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
    Circle(EdgeFrame),
    /// Arcs one behind the other that go on smoothly and do not turn much, between their tangents
    /// at both ends.
    Run(Rc<[LocalArc]>),
}

/// A circle seen from an anchor, and the begin of an arc on it with its unit tangent.
#[derive(Clone, Copy)]
pub(super) struct LocalArc {
    circle: EdgeFrame,
    begin: [Vec2; 2],
}

impl LocalCurve<'_> {
    /// Arcs of a run, one behind the other.
    pub(super) fn arcs(edges: &[Edge], anchor: Vec2) -> Self {
        let (first, last) = (&edges[0], &edges[edges.len() - 1]);
        if edges.len() == 1 {
            return Self::Circle(EdgeFrame::nearest(first, anchor));
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
            Self::Circle(circle) => circle.power(offset),
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
    fn new(edge: &Edge, anchor: Vec2) -> Self {
        let begin = [edge.from - anchor, edge.end_tangents()[0]];
        Self { circle: EdgeFrame::nearest(edge, anchor), begin }
    }

    /// Distance of a point beside the arc. Beyond the centre, where another arc is the nearest, it
    /// keeps its sign.
    fn distance_beside(&self, offset: Vec2) -> f64 {
        let across = self.begin[1].cross(offset - self.begin[0]);
        if self.circle.curvature * across < 1.0 { self.circle.side(offset) } else { across }
    }
}
