//! Cracks as data: their vertices, ends, tips and sides.

use crate::vec2::Vec2;

/// A crack: a polyline of at least two points, both faces free unless loaded.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Crack {
    /// Vertices, in order; the left of this direction is [`Side::Above`].
    pub points: Vec<Vec2>,
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
}

/// A tip: one end of one crack.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TipId {
    /// Index of the crack.
    pub crack: u32,
    /// The end.
    pub end: End,
}

/// One segment of one crack, for points that are known to lie on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SegmentId {
    /// Index of the crack.
    pub crack: u32,
    /// Index of the segment, from the crack's start.
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
    /// Length along the crack.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.points.windows(2).map(|s| (s[1] - s[0]).length()).sum()
    }

    /// Position of an end.
    #[must_use]
    pub fn end_point(&self, end: End) -> Vec2 {
        match end {
            End::Start => self.points[0],
            End::Last => self.points[self.points.len() - 1],
        }
    }

    /// Unit direction of growth at an end: out of the crack, along its last segment.
    #[must_use]
    pub fn growth_direction(&self, end: End) -> Vec2 {
        let n = self.points.len();
        match end {
            End::Start => (self.points[0] - self.points[1]).unit(),
            End::Last => (self.points[n - 1] - self.points[n - 2]).unit(),
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

/// All tips of a set of cracks, in order of crack and end.
pub fn tips(cracks: &[Crack]) -> impl Iterator<Item = TipId> + '_ {
    (0u32..).zip(cracks).flat_map(|(crack, c)| c.tips().map(move |end| TipId { crack, end }))
}
