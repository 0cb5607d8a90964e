//! A piece: a convex polygon on which a field is smooth.

use ppum::segment::sides;
use ppum::vec2::Vec2;

use super::cut::centroid;

/// Part of the way from a corner to its piece's centroid at which the corner's values are taken.
pub const INSET: f64 = 1e-6;

/// Sides shorter than this part of the square are what rounding leaves where several lines meet in
/// a point: they are none.
pub(super) const SHORTEST: f64 = 1e-9;

/// A convex part of a square, wholly on one side of everything that a field jumps on.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexPiece {
    /// Offsets from the anchor, counter-clockwise; three or more. Some may lie between their
    /// neighbours: a tip is a corner.
    pub corners: Vec<Vec2>,
    /// For the side from each corner to the next whether the field may jump there or ends: a face
    /// of a crack, a rim, an interface. The others lead on to a neighbour, in this square or
    /// the next.
    pub faces: Vec<bool>,
    /// Part of the way to the centroid for what is seen from inside: [`INSET`], or more at chords
    /// of curves.
    pub inset: f64,
}

impl ConvexPiece {
    /// A polygon that nothing cuts, by its corners, counter-clockwise.
    pub(crate) fn uncut(corners: impl Into<Vec<Vec2>>, inset: f64) -> Self {
        let corners = corners.into();
        Self { faces: vec![false; corners.len()], corners, inset }
    }

    /// The mean of the corners: inside, and well away from all sides.
    #[must_use]
    pub fn center(&self) -> Vec2 {
        centroid(&self.corners)
    }

    /// A point of the piece as it is seen from inside: moved by [`INSET`] of its way to the centre.
    #[must_use]
    pub fn seen_from_inside(&self, point: Vec2) -> Vec2 {
        point + (self.center() - point) * self.inset
    }
}

/// True if a point lies in a convex polygon, by its corners, counter-clockwise.
pub(crate) fn contains(corners: &[Vec2], p: Vec2) -> bool {
    sides(corners).all(|[a, b]| (b - a).cross(p - a) >= 0.0)
}
