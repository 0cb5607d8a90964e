//! Cracks as data: their vertices, edges, ends, tips and sides.

use crate::edge::Edge;
use crate::vec2::{Rect, Vec2};

/// A crack: segments and arcs that join two points or more, both faces free unless loaded.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Crack {
    /// Vertices, in order; the left of this direction is [`Side::Above`].
    pub points: Vec<Vec2>,
    /// The [bulge](Edge::bulge) of the edge after each vertex but the last; empty if all edges are
    /// segments.
    pub bulges: Vec<f64>,
    /// Kind of the first and of the last vertex.
    pub ends: [CrackEnd; 2],
}

/// The kind of an end of a crack.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CrackEnd {
    /// A tip: the field is singular there.
    #[default]
    Tip,
    /// On the boundary of the domain.
    Mouth,
    /// On another crack.
    Junction,
}

/// First or last vertex of a crack.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum End {
    /// The first vertex.
    #[default]
    Start,
    /// The last vertex.
    Last,
}

impl End {
    /// `start` or `end`, as in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Last => "end",
        }
    }

    /// The other end.
    #[must_use]
    pub fn opposite(self) -> Self {
        if self == Self::Start { Self::Last } else { Self::Start }
    }
}

/// A tip: one end of one crack.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TipId {
    /// Index of the crack.
    pub crack: u32,
    /// The end.
    pub end: End,
}

/// One edge of one crack, for points that are known to lie on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SegmentId {
    /// Index of the crack.
    pub crack: u32,
    /// Index of the edge, from the crack's start.
    pub segment: u32,
}

/// The side of a crack, seen along its direction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Side {
    /// Left of the crack's direction; what an evaluation on the crack takes if nothing is said.
    #[default]
    Above,
    /// Right of the crack's direction.
    Below,
}

impl Side {
    /// The side's word: `above` or `below`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Above => "above",
            Self::Below => "below",
        }
    }
}

impl Crack {
    /// A crack of segments.
    #[must_use]
    pub fn polyline(points: Vec<Vec2>, ends: [CrackEnd; 2]) -> Self {
        Self { points, bulges: Vec::new(), ends }
    }

    /// A crack along edges each of which begins where the one before ends, between tips.
    #[must_use]
    pub fn along(edges: &[Edge]) -> Self {
        let ends = edges.iter().map(|edge| edge.to);
        let points = edges.first().map(|edge| edge.from).into_iter().chain(ends).collect();
        let bulges = edges.iter().map(|edge| edge.bulge).collect();
        Self { points, bulges, ends: [CrackEnd::Tip; 2] }.plain()
    }

    /// The crack without a list of bulges that are all zero.
    #[must_use]
    pub fn plain(mut self) -> Self {
        if !self.is_curved() {
            self.bulges.clear();
        }
        self
    }

    /// The edges, in order.
    pub fn edges(&self) -> impl Iterator<Item = Edge> + '_ {
        (0..self.points.len().saturating_sub(1)).map(|k| self.edge(k))
    }

    /// The edge of an index.
    ///
    /// # Panics
    /// If there is no such edge.
    #[must_use]
    pub fn edge(&self, k: usize) -> Edge {
        let bulge = self.bulges.get(k).copied().unwrap_or(0.0);
        Edge { from: self.points[k], to: self.points[k + 1], bulge }
    }

    /// True if some edge is an arc.
    #[must_use]
    pub fn is_curved(&self) -> bool {
        self.bulges.iter().any(|bulge| *bulge != 0.0)
    }

    /// Length along the crack.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.edges().map(|edge| edge.length()).sum()
    }

    /// Distance of a point to the crack; ∞ if it has no edges.
    #[must_use]
    pub fn distance(&self, p: Vec2) -> f64 {
        self.edges().map(|edge| edge.distance(p)).fold(f64::INFINITY, f64::min)
    }

    /// The smallest box that holds the crack.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        self.edges().fold(Rect::EMPTY, |all, edge| all.union(&edge.bounds()))
    }

    /// The crack in the opposite direction.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let edges: Vec<Edge> = self.edges().map(|edge| edge.reversed()).collect();
        let [start, last] = self.ends;
        Self { ends: [last, start], ..Self::along(&edges.into_iter().rev().collect::<Vec<_>>()) }
    }

    /// Position of an end.
    #[must_use]
    pub fn end_point(&self, end: End) -> Vec2 {
        match end {
            End::Start => self.points[0],
            End::Last => self.points[self.points.len() - 1],
        }
    }

    /// Unit direction of growth at an end: out of the crack, along the tangent of its last edge.
    #[must_use]
    pub fn growth_direction(&self, end: End) -> Vec2 {
        self.edge_to(end).end_tangents()[1]
    }

    /// The edge at an end, directed to that end.
    #[must_use]
    pub fn edge_to(&self, end: End) -> Edge {
        match end {
            End::Start => self.edge(0).reversed(),
            End::Last => self.edge(self.points.len() - 2),
        }
    }

    /// The ends that are tips.
    pub fn tips(&self) -> impl Iterator<Item = End> + '_ {
        [End::Start, End::Last]
            .into_iter()
            .zip(self.ends)
            .filter_map(|(end, kind)| (kind == CrackEnd::Tip).then_some(end))
    }
}

impl From<Vec<Vec2>> for Crack {
    /// A crack of segments between tips.
    fn from(points: Vec<Vec2>) -> Self {
        Self::polyline(points, [CrackEnd::Tip; 2])
    }
}

/// All tips of a set of cracks, in order of crack and end.
pub fn tips(cracks: &[Crack]) -> impl Iterator<Item = TipId> + '_ {
    (0u32..).zip(cracks).flat_map(|(crack, c)| c.tips().map(move |end| TipId { crack, end }))
}
