//! The lines and circles by which a box is cut.

use std::f64::consts::{PI, TAU};

use ppum::edge::Edge;
use ppum::line::Line;
use ppum::vec2::Vec2;

/// An interval of places on a line or circle.
pub(super) type CurveInterval = [f64; 2];

/// The whole line or circle of an edge, in its direction. Places on it are lengths, on a circle
/// from the middle of the edge on, up to half a turn in both directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct CutCurve {
    pub(super) edge: Edge,
    line: Line,
}

impl CutCurve {
    /// The curve of an edge; lengths along a line begin where a piece of the edge does.
    pub(super) fn new(edge: Edge, piece: Edge) -> Self {
        Self { edge, line: Line { from: piece.from, along: edge.chord().unit() } }
    }

    pub(super) fn is_arc(&self) -> bool {
        self.edge.is_arc()
    }

    pub(super) fn reversed(&self) -> Self {
        let line = Line { along: -self.line.along, ..self.line };
        Self { edge: self.edge.reversed(), line }
    }

    /// Distance of a point, positive on the left.
    pub(super) fn side(&self, p: Vec2) -> f64 {
        if self.is_arc() { self.edge.side(p) } else { self.line.side(p) }
    }

    /// True if an edge on the curve has its direction.
    pub(super) fn is_along(&self, edge: &Edge) -> bool {
        let direction =
            if self.is_arc() { self.edge.tangent_towards(edge.middle()) } else { self.line.along };
        direction.dot(edge.chord()) > 0.0
    }

    /// The place of a point on the curve.
    fn place(&self, p: Vec2) -> f64 {
        if !self.is_arc() {
            return self.line.foot(p);
        }
        let (middle, own) = (self.edge.tangent(0.5), self.edge.tangent_towards(p));
        middle.cross(own).atan2(middle.dot(own)) / self.edge.curvature()
    }

    /// The length once around.
    fn turn(&self) -> f64 {
        TAU / self.edge.curvature().abs()
    }

    /// The intervals of an edge on the curve: two where it passes the place opposite to the middle.
    pub(super) fn intervals(&self, edge: &Edge) -> Vec<CurveInterval> {
        let [a, b] = [edge.from, edge.to].map(|p| self.place(p));
        if !self.is_arc() {
            return vec![[a.min(b), a.max(b)]];
        }
        let from = if self.is_along(edge) { a } else { b };
        let (to, end) = (from + edge.length(), 0.5 * self.turn());
        if to <= end { vec![[from, to]] } else { vec![[from, end], [-end, to - 2.0 * end]] }
    }

    /// The edge of an interval.
    pub(super) fn of_interval(&self, interval: CurveInterval) -> Edge {
        if self.is_arc() {
            self.edge.part(interval.map(|place| 0.5 + place / self.edge.length()))
        } else {
            Edge::segment(interval.map(|place| self.line.at(place)))
        }
    }

    /// The length from a point of the curve in its direction to another one; backwards on a line it
    /// is infinite.
    pub(super) fn way(&self, from: Vec2, to: Vec2, thinnest: f64) -> f64 {
        let way = self.place(to) - self.place(from);
        match () {
            () if (to - from).length() <= thinnest => 0.0,
            () if way >= 0.0 => way,
            () if self.is_arc() => way + self.turn(),
            () => f64::INFINITY,
        }
    }

    /// The edge from a point of the curve in its direction to another one. For points that are one
    /// up to rounding the tangent does not say the arc.
    pub(super) fn between(&self, from: Vec2, to: Vec2, thinnest: f64) -> Edge {
        if self.is_arc() && (to - from).length() > thinnest {
            Edge::tangent_to(from, self.edge.tangent_towards(from), to)
        } else {
            Edge::segment([from, to])
        }
    }

    /// A circle as two edges.
    pub(super) fn whole(&self) -> [Edge; 2] {
        let half = PI / self.edge.curvature().abs();
        [[0.0, half], [half, 2.0 * half]].map(|interval| self.of_interval(interval))
    }
}
