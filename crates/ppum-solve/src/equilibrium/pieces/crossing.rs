//! Edges of a triangulation that cross: both are divided at the crossing.

use super::{SegmentMesh, distance};
use ppum::vec2::vec2;
use spade::handles::{FixedDirectedEdgeHandle, FixedVertexHandle};
use spade::{InsertionError, Point2, Triangulation as _, mitigate_underflow};

/// Distance, in sizes of the box, within which a crossing is an end of one of the edges.
const SAME: f64 = 1e-13;

/// Edges that are divided for one that is divided: more than rounding may ask for.
const DEEPEST: usize = 16;

/// Joins two vertices by edges that stay; the ends of the edges on the way.
///
/// # Errors
/// A crossing that is not finite.
pub(crate) fn connect(
    mesh: &mut SegmentMesh,
    from: FixedVertexHandle,
    to: FixedVertexHandle,
) -> Result<Vec<[FixedVertexHandle; 2]>, InsertionError> {
    joined(mesh, from, to, 0)
}

fn joined(
    mesh: &mut SegmentMesh,
    from: FixedVertexHandle,
    to: FixedVertexHandle,
    depth: usize,
) -> Result<Vec<[FixedVertexHandle; 2]>, InsertionError> {
    let (mut found, mut at) = (Vec::new(), from);
    while at != to {
        let middle = match first_in_the_way(mesh, at, to) {
            Some(edge) if depth < DEEPEST => divide(mesh, edge, [at, to], depth)?,
            _ => to,
        };
        if middle != at {
            let edges = mesh.try_add_constraint(at, middle);
            found.extend(edges.into_iter().map(|edge| ends(mesh, edge)));
        }
        at = middle;
    }
    Ok(found)
}

/// Divides an edge where another one crosses it; the vertex there.
fn divide(
    mesh: &mut SegmentMesh,
    edge: FixedDirectedEdgeHandle,
    other: [FixedVertexHandle; 2],
    depth: usize,
) -> Result<FixedVertexHandle, InsertionError> {
    let [a, b] = ends(mesh, edge);
    let middle = crossing(mesh, other, [a, b])?;
    if middle != a && middle != b {
        mesh.remove_constraint_edge(edge.as_undirected());
        joined(mesh, a, middle, depth + 1)?;
        joined(mesh, middle, b, depth + 1)?;
    }
    Ok(middle)
}

fn ends(mesh: &SegmentMesh, edge: FixedDirectedEdgeHandle) -> [FixedVertexHandle; 2] {
    mesh.directed_edge(edge).vertices().map(|vertex| vertex.fix())
}

/// The first edge that stays between two vertices.
fn first_in_the_way(
    mesh: &SegmentMesh,
    from: FixedVertexHandle,
    to: FixedVertexHandle,
) -> Option<FixedDirectedEdgeHandle> {
    let mut edges = mesh.get_conflicting_edges_between_vertices(from, to);
    edges.next().map(|edge| edge.fix())
}

/// The vertex at which two edges cross: one of their ends if it lies there, else a new one.
fn crossing(
    mesh: &mut SegmentMesh,
    [from, to]: [FixedVertexHandle; 2],
    [a, b]: [FixedVertexHandle; 2],
) -> Result<FixedVertexHandle, InsertionError> {
    let place = |v: FixedVertexHandle| mesh.vertex(v).position();
    let [p, q, r, s] = [from, to, a, b].map(|v| vec2(place(v).x, place(v).y));
    let at = (r - p).cross(s - r) / (q - p).cross(s - r);
    let middle = p + (q - p) * at.clamp(0.0, 1.0);
    let middle = mitigate_underflow(Point2::new(middle.x, middle.y));
    let near = |v: &FixedVertexHandle| distance([place(*v); 2], middle) <= SAME;
    match [a, b, from, to].into_iter().find(near) {
        Some(known) => Ok(known),
        None => mesh.insert(middle),
    }
}
