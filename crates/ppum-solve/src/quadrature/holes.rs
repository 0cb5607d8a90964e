//! Holes in cells: their rims cut, and what lies inside is dropped.

use super::adapt::Subregion as _;
use super::gauss::gauss;
use super::piece::SmoothPiece;
use ppum::domain::{Hole, LocalHole};
use ppum::edge::Edge;
use ppum::vec2::{Rect, Vec2};
use ppum_problem::geometry::BoxList;

/// A hole with what many cells ask of it.
pub(super) struct PlacedHole<'a> {
    pub(super) hole: &'a Hole,
    /// The box that holds it.
    pub(super) bounds: Rect,
    /// +1 if the material is on the right of its rim, −1 if it is on the left.
    pub(super) outside: f64,
    /// The edges of its rim, with their numbers.
    pub(super) edges: BoxList<(usize, Edge)>,
    /// True if one of them is an arc.
    pub(super) is_curved: bool,
}

impl<'a> PlacedHole<'a> {
    pub(super) fn new(hole: &'a Hole) -> Self {
        let (bounds, outside, edges) = (hole.bounds(), hole.orientation(), hole.rim_edges());
        let is_curved = edges.iter().any(Edge::is_arc);
        let edges = edges.into_iter().enumerate().map(|(k, edge)| (edge.bounds(), (k, edge)));
        Self { hole, bounds, outside, edges: BoxList::new(edges), is_curved }
    }
}

/// The holes whose bounding boxes meet a rectangle.
pub(super) fn near<'h>(holes: &[&'h PlacedHole<'h>], rect: &Rect) -> Vec<&'h PlacedHole<'h>> {
    holes.iter().copied().filter(|hole| hole.bounds.overlaps(rect)).collect()
}

/// Removes the pieces that lie in a hole; each lies on one side of every rim.
pub(super) fn remove(holes: &[LocalHole], pieces: &mut Vec<SmoothPiece<'_>>) {
    if !holes.is_empty() {
        pieces.retain(|part| {
            let inside = middle(part);
            !holes.iter().any(|hole| hole.contains(inside))
        });
    }
}

/// A point well inside a piece: that of the rule of fewest points with the largest weight.
fn middle(part: &SmoothPiece<'_>) -> Vec2 {
    let mut best = (Vec2::ZERO, 0.0);
    part.nodes(gauss, 1, &mut |x, w| {
        if w > best.1 {
            best = (x, w);
        }
    });
    best.0
}
