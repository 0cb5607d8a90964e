//! The pieces of the body: connected components of the domain without its cracks.
//!
//! A crack from boundary to boundary, or between two holes, cuts the body. A restraint of one part
//! does not hold the other, so restraints, loads and free rigid-body modes are counted piece by
//! piece.
//!
//! The boundary, the rims of holes and the cracks, arcs by their chords, are edges of a
//! constrained Delaunay triangulation; triangles that meet across an edge that is none of these
//! belong to one piece. Predicates are exact, so a crack that ends on the boundary cuts it, however
//! the cells lie. A point on a face of a crack belongs to the triangle on that side of the edge.

use crate::law::RigidModes;
use crate::quadrature::{CrackFace, EdgeRule};
use chords::{ChordParts, INWARD, beyond_chord};
use ppum::crack::{Crack, CrackEnd, End, SegmentId, Side};
use ppum::domain::Domain;
use ppum::edge::Edge;
use ppum::equation::Equation;
use ppum::segment;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::geometry::{BoxList, is_on_rim};
use spade::handles::{FaceHandle, FixedVertexHandle, InnerTag};
use spade::{ConstrainedDelaunayTriangulation, InsertionError, Point2, PositionInTriangulation};
use spade::{Triangulation as _, mitigate_underflow};

/// Parts of the box of less than this area are rounding.
const LEAST_AREA: f64 = 1e-12;

/// Points in units of a size that is about 1.
pub(crate) type SegmentMesh = ConstrainedDelaunayTriangulation<Point2<f64>>;
type PieceTriangle<'m> = FaceHandle<'m, InnerTag, Point2<f64>, (), spade::CdtEdge<()>, ()>;

/// The connected components of the domain without its cracks.
#[derive(Debug)]
pub struct BodyPieces {
    bounds: Rect,
    /// The facts about each piece.
    all: Vec<BodyPiece>,
    map: Option<PieceMap>,
}

/// The places of the pieces.
#[derive(Debug)]
struct PieceMap {
    mesh: SegmentMesh,
    /// The piece of each triangle; none in a hole.
    piece_of: Vec<Option<usize>>,
    /// For each edge of each crack, the ends of the edges of triangles along it, in its direction.
    along: EdgesAlong,
    /// The parts of arcs that edges of triangles stand for.
    arcs: BoxList<Edge>,
}

/// For each edge of each crack, ends of edges of triangles.
type EdgesAlong = Vec<Vec<Vec<[FixedVertexHandle; 2]>>>;

/// One connected component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyPiece {
    /// Area, arcs replaced by chords.
    pub(crate) area: f64,
    /// Centroid; it need not lie in the piece.
    pub(crate) centroid: Vec2,
    /// A point inside.
    pub(crate) inside: Vec2,
}

impl BodyPieces {
    /// The pieces of a domain without cracks.
    ///
    /// In a box one crack with a tip does not cut anything.
    pub fn new(domain: &Domain, cracks: &[Crack]) -> Self {
        let bounds = domain.bounds;
        let all_of_it = || Self { bounds, all: vec![BodyPiece::of_box(&bounds)], map: None };
        let has_tip = cracks.iter().all(|crack| crack.ends.contains(&CrackEnd::Tip));
        if domain.holes.is_empty() && cracks.len() < 2 && has_tip {
            return all_of_it();
        }
        let gap_edges = gap_edges(cracks, &bounds);
        let edges = |crack: &Crack| match is_on_rim(crack, &domain.holes) {
            true => Vec::new(),
            false => into_holes(crack, &bounds).edges().collect(),
        };
        let cracks: Vec<Vec<Edge>> = cracks.iter().map(edges).collect();
        let parts = ChordParts::new(domain, &cracks);
        // A triangulation fails on coordinates that are not finite only, which no problem has.
        let Ok((mesh, along)) = triangulate(&bounds, &parts, &gap_edges) else {
            return all_of_it();
        };
        let found = Self::of_mesh(&parts.with_polygons(domain), mesh, along, parts.arcs());
        if domain.holes.is_empty() && found.all.len() == 1 { all_of_it() } else { found }
    }

    /// The rigid-body modes of the pieces. Those of a body in one piece are about the centre of
    /// its box: they stay the same to the last bit where cracks grow.
    pub(crate) fn rigid_modes(&self, equation: &Equation) -> Vec<RigidModes> {
        let modes =
            |piece: &BodyPiece| RigidModes::new(piece.centroid, piece.area.sqrt(), equation);
        match self.all.as_slice() {
            [_] => vec![modes(&BodyPiece::of_box(&self.bounds))],
            several => several.iter().map(modes).collect(),
        }
    }

    /// All triangles of a component are material, or lie in holes.
    fn of_mesh(domain: &Domain, mesh: SegmentMesh, along: EdgesAlong, arcs: BoxList<Edge>) -> Self {
        let (bounds, count) = (domain.bounds, mesh.num_inner_faces());
        let least = LEAST_AREA * bounds.size().x * bounds.size().y;
        let (mut piece_of, mut seen) = (vec![None; count], vec![false; count]);
        let mut all = Vec::new();
        for face in mesh.inner_faces() {
            if !seen[index(&face)] {
                let found = flood(face, &mut seen);
                let piece = BodyPiece::of_faces(&bounds, &found);
                if piece.area > least && domain.contains(piece.inside) {
                    found.iter().for_each(|face| piece_of[index(face)] = Some(all.len()));
                    all.push(piece);
                }
            }
        }
        Self { bounds, all, map: Some(PieceMap { mesh, piece_of, along, arcs }) }
    }

    /// The pieces; at least one if anything is left of the box.
    pub fn all(&self) -> &[BodyPiece] {
        &self.all
    }

    /// The number of the piece that holds a point of the body, which must not lie on a crack. A
    /// point that rounding has put outside belongs to the piece next to it.
    pub(crate) fn of(&self, p: Vec2) -> usize {
        let Some(PieceMap { mesh, piece_of, arcs, .. }) = self.map() else { return 0 };
        let p = beyond_chord(arcs, p, INWARD * self.bounds.size().length());
        let face = match mesh.locate(to_unit(&self.bounds, p)) {
            PositionInTriangulation::OnFace(face) => Some(mesh.face(face)),
            PositionInTriangulation::OnEdge(edge)
            | PositionInTriangulation::OutsideOfConvexHull(edge) => {
                let edge = mesh.directed_edge(edge);
                edge.face().as_inner().or_else(|| edge.rev().face().as_inner())
            }
            PositionInTriangulation::OnVertex(vertex) => {
                mesh.vertex(vertex).out_edges().find_map(|edge| edge.face().as_inner())
            }
            PositionInTriangulation::NoTriangulation => None,
        };
        face.and_then(|face| nearest(mesh, face, piece_of)).unwrap_or(0)
    }

    /// The map, if there are several pieces.
    fn map(&self) -> Option<&PieceMap> {
        self.map.as_ref().filter(|_| self.all.len() > 1)
    }

    /// The piece that a point of a rule along an edge belongs to.
    pub(crate) fn of_boundary(&self, rule: &EdgeRule, point: usize) -> usize {
        let p = rule.anchor + rule.offsets[point];
        match rule.face.filter(|face| self.is_cut_by(face.segment.crack)) {
            Some(face) => self.beside(face, p),
            None => self.behind(p, rule.normals[point]),
        }
    }

    /// The piece that a point of the boundary belongs to, with the normal out of the material.
    fn behind(&self, p: Vec2, normal: Vec2) -> usize {
        self.of(p - normal * (INWARD * self.bounds.size().length()))
    }

    /// False for a crack on a side of a polygon.
    fn is_cut_by(&self, crack: u32) -> bool {
        self.map().is_none_or(|map| !map.along[crack as usize].is_empty())
    }

    /// The piece that a face of a crack belongs to at a point of it.
    fn beside(&self, face: CrackFace, p: Vec2) -> usize {
        let Some(PieceMap { mesh, piece_of, along, .. }) = self.map() else { return 0 };
        let SegmentId { crack, segment } = face.segment;
        let p = to_unit(&self.bounds, p);
        let way =
            |ends: &&[FixedVertexHandle; 2]| distance(ends.map(|v| mesh.vertex(v).position()), p);
        let edges = along[crack as usize][segment as usize].iter();
        let nearest_edge = edges.min_by(|a, b| way(a).total_cmp(&way(b)));
        let edge = nearest_edge.and_then(|&[from, to]| mesh.get_edge_from_neighbors(from, to));
        let edge = edge.map(|edge| if face.side == Side::Above { edge } else { edge.rev() });
        let triangle = edge.and_then(|edge| edge.face().as_inner());
        triangle.and_then(|triangle| nearest(mesh, triangle, piece_of)).unwrap_or(0)
    }
}

/// An edge along a crack, with the pieces above and below it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SharedEdge {
    pub(super) ends: [Vec2; 2],
    pub(super) pieces: [usize; 2],
    /// The number of the crack's edge that it is a part of.
    pub(super) of: usize,
}

impl BodyPieces {
    /// The edges along a crack that different pieces share, in its direction.
    pub(super) fn shared_edges(&self, crack: usize) -> Vec<SharedEdge> {
        let Some(PieceMap { mesh, piece_of, along, .. }) = self.map() else { return Vec::new() };
        let shared = |(of, &[from, to]): (usize, &[FixedVertexHandle; 2])| {
            let edge = mesh.get_edge_from_neighbors(from, to)?;
            let [above, below] = [edge, edge.rev()]
                .map(|edge| edge.face().as_inner().and_then(|triangle| piece_of[index(&triangle)]));
            let ends = [from, to].map(|v| from_unit(&self.bounds, mesh.vertex(v).position()));
            let pieces = [above?, below?];
            (pieces[0] != pieces[1]).then_some(SharedEdge { ends, pieces, of })
        };
        let chains = along[crack].iter().enumerate();
        let all = chains.flat_map(|(of, chain)| chain.iter().map(move |ends| (of, ends)));
        all.filter_map(shared).collect()
    }
}

impl BodyPiece {
    fn of_box(bounds: &Rect) -> Self {
        let center = bounds.center();
        Self { area: bounds.size().x * bounds.size().y, centroid: center, inside: center }
    }

    fn of_faces(bounds: &Rect, faces: &[PieceTriangle<'_>]) -> Self {
        let (mut area, mut moment) = (0.0, Vec2::ZERO);
        let mut largest = (0.0, Vec2::ZERO);
        for face in faces {
            let part =
                (face.area() * bounds.size().x * bounds.size().y, from_unit(bounds, face.center()));
            area += part.0;
            moment = moment + part.1 * part.0;
            largest = if part.0 > largest.0 { part } else { largest };
        }
        Self { area, centroid: moment / area, inside: largest.1 }
    }
}

/// A crack with its mouths on rims moved into their holes by more than rounding.
fn into_holes(crack: &Crack, bounds: &Rect) -> Crack {
    let on_boundary = |p: Vec2| {
        p.x == bounds.min.x || p.x == bounds.max.x || p.y == bounds.min.y || p.y == bounds.max.y
    };
    let mut points = crack.points.clone();
    let last = points.len() - 1;
    for (end, at, kind) in [(End::Start, 0, crack.ends[0]), (End::Last, last, crack.ends[1])] {
        if kind == CrackEnd::Mouth && !on_boundary(points[at]) {
            let farther = crack.growth_direction(end) * (INWARD * bounds.size().length());
            points[at] = points[at] + farther;
        }
    }
    Crack { points, ..crack.clone() }
}

/// Returns edges that close the gaps of rounding between ends of cracks and the cracks that they
/// lie on: from each such end to the nearest place, and a little farther.
fn gap_edges(cracks: &[Crack], bounds: &Rect) -> Vec<[Vec2; 2]> {
    let far = INWARD * bounds.size().length();
    let mut found = Vec::new();
    for (k, crack) in cracks.iter().enumerate() {
        let ends = [End::Start, End::Last].into_iter().zip(crack.ends);
        for (end, _) in ends.filter(|(_, kind)| *kind == CrackEnd::Junction) {
            let p = crack.end_point(end);
            let others = cracks.iter().enumerate().filter(|(other, _)| *other != k);
            let foot = |edge: Edge| edge.at(edge.closest_part(p));
            let places = others.flat_map(|(_, other)| other.edges()).map(foot);
            let near = places.filter(|q| (*q - p).length() <= 4.0 * far);
            for q in near {
                let gap = q - p;
                // a direction that is more than rounding
                let is_apart = gap.length() > 1e-3 * far;
                let way = if is_apart { gap.unit() } else { crack.growth_direction(end) };
                found.extend([[p, q], [q, q + way * far]].into_iter().filter(|[a, b]| a != b));
            }
        }
    }
    found
}

/// The triangulation of the box in units of its sides, so that its boundary stays straight. Where
/// the cracks lie is asked last: nothing divides their edges any more.
fn triangulate(
    bounds: &Rect,
    parts: &ChordParts,
    gap_edges: &[[Vec2; 2]],
) -> Result<(SegmentMesh, EdgesAlong), InsertionError> {
    let mut mesh = SegmentMesh::new();
    let chord = |part: &Edge| [part.from, part.to];
    let rims = parts.rims.iter().flatten().map(chord);
    let of_cracks = parts.cracks.iter().flatten().flatten().map(chord);
    let all = bounds.sides().into_iter().chain(rims).chain(of_cracks);
    for segment in all.chain(gap_edges.iter().copied()) {
        add_edges(&mut mesh, bounds, segment)?;
    }
    let mut along = Vec::new();
    for crack in &parts.cracks {
        let mut of_crack = Vec::new();
        for edge in crack {
            let chains = edge.iter().map(|part| add_edges(&mut mesh, bounds, chord(part)));
            of_crack.push(chains.collect::<Result<Vec<_>, _>>()?.concat());
        }
        along.push(of_crack);
    }
    Ok((mesh, along))
}

/// Adds a segment; the ends of the edges along it, in its direction.
fn add_edges(
    mesh: &mut SegmentMesh,
    bounds: &Rect,
    ends: [Vec2; 2],
) -> Result<Vec<[FixedVertexHandle; 2]>, InsertionError> {
    let [from, to] = ends.map(|p| mesh.insert(to_unit(bounds, p)));
    crossing::connect(mesh, from?, to?)
}

fn distance([a, b]: [Point2<f64>; 2], p: Point2<f64>) -> f64 {
    let [a, b, p] = [a, b, p].map(|p| vec2(p.x, p.y));
    segment::distance([a, b], p)
}

/// The faces that are connected with one, ascending.
fn flood<'m>(start: PieceTriangle<'m>, seen: &mut [bool]) -> Vec<PieceTriangle<'m>> {
    let (mut found, mut next) = (vec![start], 0);
    seen[index(&start)] = true;
    while let Some(&face) = found.get(next) {
        for edge in face.adjacent_edges() {
            let other = edge.rev().face().as_inner().filter(|_| !edge.is_constraint_edge());
            if let Some(other) = other.filter(|other| !seen[index(other)]) {
                seen[index(&other)] = true;
                found.push(other);
            }
        }
        next += 1;
    }
    found.sort_unstable_by_key(index);
    found
}

/// The piece of a face, or of the one nearest to it across edges.
fn nearest(
    mesh: &SegmentMesh,
    start: PieceTriangle<'_>,
    piece_of: &[Option<usize>],
) -> Option<usize> {
    let mut seen = vec![start.fix()];
    let mut next = 0;
    while let Some(&face) = seen.get(next) {
        let face = mesh.face(face);
        if let Some(piece) = piece_of[index(&face)] {
            return Some(piece);
        }
        let around = face.adjacent_edges().into_iter().filter_map(|e| e.rev().face().as_inner());
        for other in around {
            if !seen.contains(&other.fix()) {
                seen.push(other.fix());
            }
        }
        next += 1;
    }
    None
}

/// Inner faces count from 0.
fn index(face: &PieceTriangle<'_>) -> usize {
    face.index() - 1
}

fn to_unit(bounds: &Rect, p: Vec2) -> Point2<f64> {
    let (d, size) = (p - bounds.min, bounds.size());
    mitigate_underflow(Point2::new(d.x / size.x, d.y / size.y))
}

fn from_unit(bounds: &Rect, p: Point2<f64>) -> Vec2 {
    bounds.min + vec2(p.x * bounds.size().x, p.y * bounds.size().y)
}

mod chords;
pub(crate) mod crossing;
#[cfg(test)]
mod tests;
