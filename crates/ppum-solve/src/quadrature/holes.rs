//! Holes in cells: their rims cut, and what lies inside is dropped.

use super::adapt::Subregion as _;

use super::gauss::gauss;
use super::geometry::LevelFunction;
use super::piece::SmoothPiece;
use ppum::domain::{Hole, LocalHole};
use ppum::vec2::{Rect, Vec2};
use std::sync::Arc;

/// The rim of a round hole as the zero set of |x − center|² − radius², formed without cancellation
/// near the rim.
pub(super) fn level(hole: &Hole) -> Option<Arc<LevelFunction>> {
    let Hole::Circle { center, radius } = *hole else { return None };
    Some(Arc::new(move |p: Vec2| {
        let distance = (p - center).length();
        (distance - radius) * (distance + radius)
    }))
}

/// The holes whose bounding boxes meet a rectangle.
pub(super) fn near<'h>(holes: &[&'h Hole], rect: &Rect) -> Vec<&'h Hole> {
    holes.iter().copied().filter(|hole| hole.bounds().overlaps(rect)).collect()
}

/// True if a rectangle lies in one round hole.
pub(super) fn covered(holes: &[&Hole], rect: &Rect) -> bool {
    let holds = |hole: &Hole| {
        matches!(hole, Hole::Circle { .. }) && rect.corners().iter().all(|&p| hole.contains(p))
    };
    holes.iter().copied().any(holds)
}

/// Removes the pieces that lie in a hole; each lies on one side of every rim.
pub(super) fn remove(holes: &[&Hole], anchor: Vec2, pieces: &mut Vec<SmoothPiece<'_>>) {
    if holes.is_empty() {
        return;
    }
    let seen: Vec<LocalHole> = holes.iter().map(|hole| hole.at(anchor)).collect();
    pieces.retain(|part| {
        let inside = middle(part);
        !seen.iter().any(|hole| hole.contains(inside))
    });
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
