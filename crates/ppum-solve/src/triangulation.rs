//! Triangles between segments: a constrained Delaunay triangulation of the convex hull.
//!
//! Segments may cross, overlap and touch: a crossing becomes a point, and each segment is a chain
//! of edges. Predicates are exact; coordinates are scaled by a power of two, so points that are
//! given come back with all their digits.

use ppum::vec2::{Vec2, vec2};
use spade::handles::FixedVertexHandle;
use spade::{InsertionError, Point2, Triangulation as _, mitigate_underflow};

use crate::equilibrium::{SegmentMesh, crossing};

/// Triangles, and the edges that segments have become.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangulation {
    /// All points, crossings of segments too.
    pub points: Vec<Vec2>,
    /// Three points each, counter-clockwise.
    pub triangles: Vec<[u32; 3]>,
    /// For each segment its edges, in its direction.
    pub chains: Vec<Vec<[u32; 2]>>,
}

/// A coordinate that is not finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a coordinate is not finite")]
pub struct NotFinite;

/// Triangulates segments and points.
///
/// # Errors
/// [`NotFinite`].
pub fn triangulate(segments: &[[Vec2; 2]], points: &[Vec2]) -> Result<Triangulation, NotFinite> {
    let scale = CoordinateScale::new(segments.iter().flatten().chain(points));
    let mut mesh = SegmentMesh::new();
    insert(&mut mesh, scale, segments, points).map_err(|_| NotFinite)
}

/// The power of two that brings all coordinates into [−1, 1].
#[derive(Clone, Copy)]
struct CoordinateScale(f64);

impl CoordinateScale {
    fn new<'p>(points: impl Iterator<Item = &'p Vec2>) -> Self {
        let largest = points.fold(f64::MIN_POSITIVE, |most, p| most.max(p.x.abs()).max(p.y.abs()));
        Self(largest.log2().ceil().exp2())
    }

    fn unit(self, p: Vec2) -> Point2<f64> {
        mitigate_underflow(Point2::new(p.x / self.0, p.y / self.0))
    }

    fn world(self, p: Point2<f64>) -> Vec2 {
        vec2(p.x * self.0, p.y * self.0)
    }
}

/// Edges are asked for last: nothing divides them any more.
fn insert(
    mesh: &mut SegmentMesh,
    scale: CoordinateScale,
    segments: &[[Vec2; 2]],
    points: &[Vec2],
) -> Result<Triangulation, InsertionError> {
    for &point in points {
        mesh.insert(scale.unit(point))?;
    }
    for &segment in segments {
        chain(mesh, scale, segment)?;
    }
    let chains = segments.iter().map(|&segment| chain(mesh, scale, segment));
    let chains = chains.collect::<Result<_, _>>()?;
    let index = |vertex: FixedVertexHandle| vertex.index() as u32;
    Ok(Triangulation {
        points: mesh.vertices().map(|vertex| scale.world(vertex.position())).collect(),
        triangles: mesh
            .inner_faces()
            .map(|face| face.vertices().map(|vertex| index(vertex.fix())))
            .collect(),
        chains,
    })
}

fn chain(
    mesh: &mut SegmentMesh,
    scale: CoordinateScale,
    ends: [Vec2; 2],
) -> Result<Vec<[u32; 2]>, InsertionError> {
    let [from, to] = ends.map(|p| mesh.insert(scale.unit(p)));
    let edges = crossing::connect(mesh, from?, to?)?;
    let index = |vertex: FixedVertexHandle| vertex.index() as u32;
    Ok(edges.into_iter().map(|edge| edge.map(index)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    /// Random segments in a box: areas add up to the box, each chain leads from end to end along
    /// its segment, points come back as they were.
    #[test]
    fn random_segments_become_chains_of_edges() {
        let mut random = Random(3);
        let bounds = ppum::vec2::Rect::new(vec2(-3.0, 10.0), vec2(4.0, 11.0));
        for _ in 0..20 {
            let mut segments = bounds.sides().to_vec();
            segments.extend((0..12).map(|_| [random.point(&bounds), random.point(&bounds)]));
            let found = triangulate(&segments, &[random.point(&bounds)]).unwrap();
            let at = |k: u32| found.points[k as usize];
            let area = |t: &[u32; 3]| 0.5 * (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
            let total: f64 = found.triangles.iter().map(area).sum();
            assert!((total - 7.0).abs() < 1e-13, "{total}");
            for (chain, [a, b]) in found.chains.iter().zip(&segments) {
                assert_eq!([at(chain[0][0]), at(chain[chain.len() - 1][1])], [*a, *b]);
                assert!(chain.windows(2).all(|pair| pair[0][1] == pair[1][0]));
                // crossings are computed in numbers of size 16
                let off = |p: Vec2| (*b - *a).unit().cross(p - *a).abs();
                assert!(chain.iter().all(|edge| off(at(edge[1])) < 1e-13));
            }
        }
    }
}
