//! The pieces of the plate: connected components of the domain without its cracks.
//!
//! A crack from border to border, or between two holes, cuts the plate. What holds one part says
//! nothing of the other, so supports, loads and free rigid motions are counted piece by piece.
//!
//! The border, the rims of holes and the cracks are edges of a constrained Delaunay triangulation;
//! triangles that meet across an edge that is none of these belong to one piece. Predicates are
//! exact, so a crack that ends on the border cuts it, however the cells lie.

use ppum::crack::{Crack, CrackEnd, End};
use ppum::domain::{Domain, Hole};
use ppum::vec2::{Rect, Vec2, vec2};
use spade::handles::{FaceHandle, InnerTag};
use spade::{ConstrainedDelaunayTriangulation, InsertionError, Point2, PositionInTriangulation};
use spade::{Triangulation as _, mitigate_underflow};
use std::f64::consts::TAU;

/// Parts of the box of less than this area are rounding.
const LEAST_AREA: f64 = 1e-12;

/// How far into the material a point of the border is moved to see whose it is, in sizes of the box.
const INWARD: f64 = 1e-9;

type Mesh = ConstrainedDelaunayTriangulation<Point2<f64>>;
type Face<'m> = FaceHandle<'m, InnerTag, Point2<f64>, (), spade::CdtEdge<()>, ()>;

/// The connected components of the domain without its cracks.
#[derive(Debug)]
pub(crate) struct Pieces {
    bounds: Rect,
    /// Of each piece, what is known of it.
    all: Vec<Piece>,
    /// Where there are several: the triangulation, and of each triangle its piece.
    map: Option<(Mesh, Vec<Option<usize>>)>,
}

/// The corners of a rim.
fn ring(hole: &Hole) -> Vec<Vec2> {
    let turn = |k: u32| TAU * f64::from(k) / f64::from(CORNERS);
    match hole {
        Hole::Circle { center, radius } => {
            (0..CORNERS).map(|k| *center + vec2(turn(k).cos(), turn(k).sin()) * *radius).collect()
        }
        Hole::Polygon { points } => points.clone(),
    }
}

/// A crack whose ends at holes are continued into them.
fn into_holes(crack: &Crack, domain: &Domain) -> Crack {
    let size = INTO_POLYGON * domain.bounds.size().length();
    let mut points = crack.points.clone();
    for (end, at) in [(End::Start, 0), (End::Last, points.len() - 1)] {
        let p = points[at];
        let reached =
            domain.holes.iter().find(|hole| hole.contains(p) || hole.rim_distance(p) < size);
        let length = match reached {
            Some(Hole::Circle { radius, .. }) => INTO_CIRCLE * radius,
            Some(Hole::Polygon { .. }) => size,
            None => 0.0,
        };
        points[at] = p + crack.growth_direction(end) * length;
    }
    Crack { points, ends: crack.ends }
}

/// One connected component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    /// Area, rims of round holes replaced by polygons.
    pub(crate) area: f64,
    /// Centroid; it need not lie in the piece.
    pub(crate) centroid: Vec2,
    /// A point inside.
    pub(crate) inside: Vec2,
}

/// Corners of the polygon that stands for a round rim.
const CORNERS: u32 = 256;

/// How far a crack that ends on a rim is continued into the hole, so that it surely meets the
/// polygon: in radii of a round hole, and in sizes of the box.
const INTO_CIRCLE: f64 = 0.1;
const INTO_POLYGON: f64 = 1e-6;

impl Pieces {
    /// The pieces of a domain without its cracks. Round rims are replaced by inscribed polygons.
    pub(crate) fn of_domain(domain: &Domain, cracks: &[Crack]) -> Self {
        let rings: Vec<_> = domain.holes.iter().map(ring).collect();
        let cracks: Vec<_> = cracks.iter().map(|crack| into_holes(crack, domain)).collect();
        Self::new(domain.bounds, &rings, &cracks)
    }

    /// The pieces of a box without holes (polygons) and cracks.
    ///
    /// Cracks of which at most one end lies on the border do not cut anything.
    pub(crate) fn new(bounds: Rect, holes: &[Vec<Vec2>], cracks: &[Crack]) -> Self {
        let cuts = |crack: &Crack| !crack.ends.contains(&CrackEnd::Tip);
        let all_of_it = || Self { bounds, all: vec![Piece::of_box(&bounds)], map: None };
        if holes.is_empty() && !cracks.iter().any(cuts) {
            return all_of_it();
        }
        // A triangulation fails on coordinates that are not finite only, which no problem has.
        triangulate(&bounds, holes, cracks)
            .map_or_else(|_| all_of_it(), |mesh| Self::of_mesh(bounds, holes, mesh))
    }

    fn of_mesh(bounds: Rect, holes: &[Vec<Vec2>], mesh: Mesh) -> Self {
        let inside = |face: &Face<'_>| {
            let p = from_unit(&bounds, face.center());
            bounds.contains(p) && !holes.iter().any(|hole| holds(hole, p))
        };
        let material: Vec<bool> = mesh.inner_faces().map(|face| inside(&face)).collect();
        let mut piece_of = vec![None; material.len()];
        let mut all = Vec::new();
        for face in mesh.inner_faces() {
            if material[index(&face)] && piece_of[index(&face)].is_none() {
                let found = flood(&mesh, face, &material);
                let piece = Piece::of_faces(&bounds, &mesh, &found);
                if piece.area > LEAST_AREA * bounds.size().x * bounds.size().y {
                    found.iter().for_each(|&face| piece_of[face] = Some(all.len()));
                    all.push(piece);
                }
            }
        }
        Self { bounds, all, map: Some((mesh, piece_of)) }
    }

    /// The pieces; at least one if anything is left of the box.
    pub(crate) fn all(&self) -> &[Piece] {
        &self.all
    }

    /// The number of the piece that holds a point of the plate, which must not lie on a crack. A point
    /// that rounding has put outside belongs to the piece next to it.
    pub(crate) fn of(&self, p: Vec2) -> usize {
        let Some((mesh, piece_of)) = self.map.as_ref().filter(|_| self.all.len() > 1) else {
            return 0;
        };
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

    /// The piece that a point of the border belongs to, with the normal out of the material.
    pub(crate) fn behind(&self, p: Vec2, normal: Vec2) -> usize {
        self.of(p - normal * (INWARD * self.bounds.size().length()))
    }
}

impl Piece {
    fn of_box(bounds: &Rect) -> Self {
        let center = bounds.center();
        Self { area: bounds.size().x * bounds.size().y, centroid: center, inside: center }
    }

    fn of_faces(bounds: &Rect, mesh: &Mesh, faces: &[usize]) -> Self {
        let (mut area, mut moment) = (0.0, Vec2::ZERO);
        let mut largest = (0.0, Vec2::ZERO);
        for face in mesh.inner_faces().filter(|face| faces.binary_search(&index(face)).is_ok()) {
            let part =
                (face.area() * bounds.size().x * bounds.size().y, from_unit(bounds, face.center()));
            area += part.0;
            moment = moment + part.1 * part.0;
            largest = if part.0 > largest.0 { part } else { largest };
        }
        Self { area, centroid: moment / area, inside: largest.1 }
    }
}

/// The triangulation of the box in units of its sides, so that its border stays straight.
fn triangulate(
    bounds: &Rect,
    holes: &[Vec<Vec2>],
    cracks: &[Crack],
) -> Result<Mesh, InsertionError> {
    let mut mesh = Mesh::new();
    let (lo, hi) = (bounds.min, bounds.max);
    let border = [lo, vec2(hi.x, lo.y), hi, vec2(lo.x, hi.y)];
    for ring in std::iter::once(border.as_slice()).chain(holes.iter().map(Vec::as_slice)) {
        let sides = ring.iter().zip(ring.iter().cycle().skip(1));
        sides.into_iter().try_for_each(|(a, b)| add_edge(&mut mesh, bounds, *a, *b))?;
    }
    for segment in cracks.iter().flat_map(|crack| crack.points.windows(2)) {
        add_edge(&mut mesh, bounds, segment[0], segment[1])?;
    }
    Ok(mesh)
}

fn add_edge(mesh: &mut Mesh, bounds: &Rect, a: Vec2, b: Vec2) -> Result<(), InsertionError> {
    let from = mesh.insert(to_unit(bounds, a))?;
    let to = mesh.insert(to_unit(bounds, b))?;
    if from != to {
        mesh.add_constraint_and_split(from, to, |p| p);
    }
    Ok(())
}

/// The faces that are connected with one, ascending.
fn flood(mesh: &Mesh, start: Face<'_>, material: &[bool]) -> Vec<usize> {
    let mut seen = vec![false; material.len()];
    let mut waiting = vec![start.fix()];
    seen[index(&start)] = true;
    while let Some(face) = waiting.pop() {
        for edge in mesh.face(face).adjacent_edges() {
            let next = edge.rev().face().as_inner().filter(|_| !edge.is_constraint_edge());
            if let Some(next) = next.filter(|next| material[index(next)] && !seen[index(next)]) {
                seen[index(&next)] = true;
                waiting.push(next.fix());
            }
        }
    }
    (0..seen.len()).filter(|&face| seen[face]).collect()
}

/// The piece of a face, or of the one nearest to it across edges.
fn nearest(mesh: &Mesh, start: Face<'_>, piece_of: &[Option<usize>]) -> Option<usize> {
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
fn index(face: &Face<'_>) -> usize {
    face.index() - 1
}

fn to_unit(bounds: &Rect, p: Vec2) -> Point2<f64> {
    let (d, size) = (p - bounds.min, bounds.size());
    mitigate_underflow(Point2::new(d.x / size.x, d.y / size.y))
}

fn from_unit(bounds: &Rect, p: Point2<f64>) -> Vec2 {
    bounds.min + vec2(p.x * bounds.size().x, p.y * bounds.size().y)
}

/// True if a point lies in a polygon: a ray from it crosses the sides an odd number of times.
fn holds(polygon: &[Vec2], p: Vec2) -> bool {
    let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let crossed = |(a, b): &(&Vec2, &Vec2)| {
        (a.y > p.y) != (b.y > p.y) && (p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y))
    };
    sides.filter(crossed).count() % 2 == 1
}

#[cfg(test)]
mod tests;
