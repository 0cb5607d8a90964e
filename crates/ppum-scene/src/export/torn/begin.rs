//! The triangles that refinement begins with, and the sectors of their vertices.

use std::collections::HashMap;

use ppum::crack::{SegmentId, Side};
use ppum::domain::Domain;
use ppum::field::Field;
use ppum::sample::SidedPoint;
use ppum::vec2::Vec2;
use ppum_solve::triangulation::{NotFinite, Triangulation, triangulate};

use super::super::borders::{BorderKind, ExportSegment};
use super::forest::Forest;
use super::{
    INSET, MeshConvergence, NONE, Torn, TornPoint, TornTriangle, ValueSide, centroid, on_crack,
};

/// The kinds of edges, by their ends in ascending order.
pub(super) type EdgeKinds = HashMap<[u32; 2], BorderKind>;

impl<'d> Torn<'d> {
    /// Triangles between borders, with more points inside; what lies outside of the domain is
    /// left out. Round holes of the domain are polygons already.
    pub(in super::super) fn new(
        field: &Field<'d>,
        domain: &Domain,
        borders: &[ExportSegment],
        points: &[Vec2],
    ) -> Result<Self, NotFinite> {
        let segments: Vec<_> = borders.iter().map(|border| border.ends).collect();
        let mut found = triangulate(&segments, points)?;
        let kinds = kinds(borders, &found);
        let at = |k: u32| found.points[k as usize];
        let is_inside = |t: &[u32; 3]| domain.contains(centroid(t.map(at)));
        let inside: Vec<_> = found.triangles.iter().copied().filter(is_inside).collect();
        found.triangles = inside;
        let mut mesh = Self::empty(field);
        mesh.triangles = linked(&found.triangles, &kinds);
        mesh.tear(&found.points);
        Ok(mesh)
    }

    /// Gives each vertex a point for each of its sectors.
    fn tear(&mut self, vertices: &[Vec2]) {
        let by_cracks = sectors(&self.triangles, |kind| kind.crack.is_some());
        let all = sectors(&self.triangles, BorderKind::is_torn);
        let at = self.incidence(vertices.len());
        let sides = self.sides(&by_cracks, vertices);
        let mut points = Vec::new();
        let mut numbers = vec![NONE; 3 * self.triangles.len()];
        let mut corners: Vec<[u32; 3]> = Vec::with_capacity(self.triangles.len());
        for (t, triangle) in self.triangles.iter().enumerate() {
            corners.push([0, 1, 2].map(|k| {
                let root = all.root(3 * t + k);
                if numbers[root] == NONE {
                    numbers[root] = points.len() as u32;
                    let vertex = triangle.corners[k] as usize;
                    let side = sides[by_cracks.root(3 * t + k)];
                    let shape = triangle.corners.map(|corner| vertices[corner as usize]);
                    points.push(self.sector(vertices[vertex], shape, &at[vertex], side));
                }
                numbers[root]
            }));
        }
        self.points = points;
        for (triangle, corners) in self.triangles.iter_mut().zip(corners) {
            triangle.corners = corners;
        }
    }

    /// The point of a sector of a vertex, one of whose triangles is given.
    fn sector(
        &self,
        vertex: Vec2,
        shape: [Vec2; 3],
        at: &Incident,
        side: Option<Side>,
    ) -> TornPoint {
        let inside = || self.seen_from_inside(vertex, shape, INSET);
        let place = match (&at.segments[..], side) {
            ([], _) => self.place(vertex),
            ([only], Some(side)) => self.on_one(*only, vertex, side),
            ([a, b], Some(side)) if a.crack == b.crack => on_crack((*a).min(*b), vertex, side),
            _ => inside(),
        };
        let inside = if at.kink { inside() } else { place };
        TornPoint { position: vertex, seen: ValueSide::Plane { place, inside } }
    }

    /// A point that one segment ends at or passes; a tip has one side.
    fn on_one(&self, segment: SegmentId, vertex: Vec2, side: Side) -> SidedPoint {
        let place = self.seats.at(vertex, side);
        let crack = &self.cracks[segment.crack as usize];
        let is_tip = crack.tips().any(|end| crack.end_point(end) == vertex);
        if place.on.is_some() || is_tip { place } else { on_crack(segment, vertex, side) }
    }

    /// The borders that meet in each vertex.
    fn incidence(&self, vertices: usize) -> Vec<Incident> {
        let mut all = vec![Incident::default(); vertices];
        for triangle in &self.triangles {
            for (k, kind) in triangle.kinds.iter().enumerate() {
                for end in [triangle.corners[k], triangle.corners[(k + 1) % 3]] {
                    all[end as usize].add(*kind);
                }
            }
        }
        all
    }

    /// The side of the crack that each sector between cracks is on.
    fn sides(&self, sectors: &Forest, vertices: &[Vec2]) -> Vec<Option<Side>> {
        let mut sides = vec![None; 3 * self.triangles.len()];
        for (t, triangle) in self.triangles.iter().enumerate() {
            for (k, kind) in triangle.kinds.iter().enumerate() {
                let Some(segment) = kind.crack else { continue };
                let ends = [k, (k + 1) % 3];
                let [a, b] = ends.map(|k| vertices[triangle.corners[k] as usize]);
                let side = Some(self.side(segment, [a, b]));
                ends.iter().for_each(|end| sides[sectors.root(3 * t + end)] = side);
            }
        }
        sides
    }
}

/// The triangles that meet in a vertex.
#[derive(Clone, Debug, Default)]
struct Incident {
    /// Segments of cracks, those that end and those that pass.
    segments: Vec<SegmentId>,
    kink: bool,
}

impl Incident {
    fn add(&mut self, kind: BorderKind) {
        self.kink |= kind.kink;
        if let Some(segment) = kind.crack.filter(|segment| !self.segments.contains(segment)) {
            self.segments.push(segment);
        }
    }
}

/// Corners of triangles that no border parts at their vertex: joined at both ends of all edges that
/// are not torn.
pub(super) fn sectors(triangles: &[TornTriangle], is_torn: impl Fn(BorderKind) -> bool) -> Forest {
    let mut all = Forest::new(3 * triangles.len());
    for (t, triangle) in triangles.iter().enumerate() {
        for k in 0..3 {
            let other = triangle.neighbours[k];
            if other == NONE || is_torn(triangle.kinds[k]) {
                continue;
            }
            let across = &triangles[other as usize].corners;
            for end in [k, (k + 1) % 3] {
                let same = across.iter().position(|&v| v == triangle.corners[end]);
                let same = same.expect("neighbours share the ends of their edge");
                all.join(3 * t + end, 3 * other as usize + same);
            }
        }
    }
    all
}

fn kinds(borders: &[ExportSegment], found: &Triangulation) -> EdgeKinds {
    let mut kinds = EdgeKinds::new();
    for (border, chain) in borders.iter().zip(&found.chains) {
        for edge in chain {
            let kind = kinds.entry(sorted(*edge)).or_default();
            *kind = kind.and(border.kind);
        }
    }
    kinds
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Triangles that know their neighbours; their corners are vertices still.
pub(super) fn linked(triangles: &[[u32; 3]], kinds: &EdgeKinds) -> Vec<TornTriangle> {
    let mut owners: HashMap<[u32; 2], u32> = HashMap::new();
    let edge = |corners: &[u32; 3], k: usize| [corners[k], corners[(k + 1) % 3]];
    for (t, corners) in (0..).zip(triangles) {
        owners.extend((0..3).map(|k| (edge(corners, k), t)));
    }
    let link = |corners: &[u32; 3]| TornTriangle {
        corners: *corners,
        neighbours: [0, 1, 2].map(|k| {
            let [a, b] = edge(corners, k);
            owners.get(&[b, a]).copied().unwrap_or(NONE)
        }),
        kinds: [0, 1, 2].map(|k| kinds.get(&sorted(edge(corners, k))).copied().unwrap_or_default()),
        convergence: MeshConvergence::NEW,
    };
    triangles.iter().map(link).collect()
}
