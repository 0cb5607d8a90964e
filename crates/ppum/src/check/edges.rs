//! The rules for chains of edges: cracks, and rims of polygons.

use super::errors::{CheckResult, check_all, check_each, check_points, require};
use crate::edge::Edge;
use crate::vec2::Vec2;

/// The bulge of an arc of 356°: beyond it the arc's chord is a small difference of its ends.
const LARGEST_BULGE: f64 = 64.0;

/// Distance of an edge from the one before, in parts of its length, within which it lies on it.
const ROUNDING: f64 = 1e-9;

/// Checks points and bulges of a crack, or of a polygon, whose last point is joined to the first.
pub(super) fn check_edges(points: &[Vec2], bulges: &[f64], is_closed: bool) -> CheckResult {
    check_points("points", points)?;
    let count = if is_closed { points.len() } else { points.len() - 1 };
    require(bulges.is_empty() || bulges.len() == count, "bulges", || {
        format!("has {} numbers, not one for each of {count} edges", bulges.len())
    })?;
    check_all(
        "bulges",
        bulges,
        |bulge| bulge.abs() <= LARGEST_BULGE,
        |bulge| format!("is {bulge}, not a number of at most {LARGEST_BULGE}: divide the arc"),
    )?;
    let edge = |k: usize| {
        let bulge = bulges.get(k).copied().unwrap_or(0.0);
        Edge { from: points[k], to: points[(k + 1) % points.len()], bulge }
    };
    let has_length =
        |k: usize| edge(k).chord().length() > 0.0 && edge(k).chord().unit().is_finite();
    check_each("segment", count, has_length, |_| "its two points are equal; leave one out".into())?;
    let runs_back = |k: usize| {
        let before = if k > 0 { Some(k - 1) } else { is_closed.then_some(count - 1) };
        before.is_some_and(|before| runs_back(edge(before), edge(k)))
    };
    let message = |_| "runs back on the edge before it; leave one of them out".into();
    check_each("segment", count, |k| !runs_back(k), message)
}

/// True if an edge returns along the one before it and one of them is an arc. Segments may do so,
/// as in files without arcs.
fn runs_back(before: Edge, edge: Edge) -> bool {
    let reach = before.length().min(edge.length());
    let near = edge.at(0.5 * reach / edge.length());
    (before.is_arc() || edge.is_arc()) && before.distance(near) <= ROUNDING * reach
}
