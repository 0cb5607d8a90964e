//! A mesh of triangles torn along cracks and kinks, refined by bisection.
//!
//! A vertex on a border has a point for each sector of triangles between borders, so a value on
//! one side of a crack and one on the other. A triangle is divided at the middle of its longest
//! edge, together with the neighbour across it, which is divided at its own longest edge first if
//! that is another one (Rivara, 1984): no vertex ever lies inside an edge, and angles stay above
//! half of the smallest one that the beginning has.
//!
//! On a mesh of elements each patch has points of its own (`of_elements`).

mod begin;
mod forest;
mod nodes;
mod of_elements;

use ppum::crack::{SegmentId, Side};
use ppum::edge::Edge;
use ppum::field::Field;
use ppum::sample::{AnchorMap, SidedPoint};
use ppum::vec2::Vec2;

use super::borders::BorderKind;
use super::elements::{ElementPlace, ParentElements, weighted};
use super::lagrange::{BarycentricPoint, Lagrange};

/// Part of the way to the centroid of a triangle at which its corner is seen from inside.
pub(super) use ppum_render::pieces::INSET;

/// No neighbour.
const NONE: u32 = u32::MAX;

/// A point of the mesh: a vertex as one sector sees it.
#[derive(Clone, Copy, Debug)]
pub(super) struct TornPoint {
    /// The vertex.
    pub(super) position: Vec2,
    /// Where values of the field are taken.
    pub(super) seen: ValueSide,
}

/// Where values of the field are taken.
#[derive(Clone, Copy, Debug)]
pub(super) enum ValueSide {
    /// In the plane.
    Plane {
        /// The place.
        place: SidedPoint,
        /// Where quantities are taken that jump across kinks: in the sector if a kink ends it.
        inside: SidedPoint,
    },
    /// In an element of a mesh.
    Element(ElementPlace),
}

impl TornPoint {
    fn new(position: Vec2, place: SidedPoint) -> Self {
        Self { position, seen: ValueSide::Plane { place, inside: place } }
    }

    /// The place in the plane.
    pub(super) fn place(&self) -> SidedPoint {
        match self.seen {
            ValueSide::Plane { place, .. } => place,
            ValueSide::Element(_) => SidedPoint {
                point: self.position,
                anchor: self.position,
                offset: Vec2::ZERO,
                on: None,
                side: Side::Above,
            },
        }
    }
}

/// A triangle; edge k leads from corner k to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct TornTriangle {
    /// Points, counter-clockwise.
    pub(super) corners: [u32; 3],
    /// The triangle across each edge.
    neighbours: [u32; 3],
    kinds: [BorderKind; 3],
    pub(super) convergence: MeshConvergence,
}

/// How the difference from the field falls from a triangle to those that it is divided into.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeshConvergence {
    /// A difference that none after it was twice as large as.
    first: f64,
    /// Divisions since.
    divisions: u8,
    last: f64,
}

/// Divisions, half as many halvings of edges, after which the difference must have fallen.
const LEAST_DIVISIONS: u8 = 12;

/// Divisions in which it must fall by half: those of smooth fields take one, and four where a
/// displacement is like r^½. As much as this it may fall by chance.
const TO_HALF: f64 = 24.0;

impl MeshConvergence {
    /// That of a triangle of which no difference is known.
    pub(super) const NEW: Self = Self { first: 0.0, divisions: 0, last: 0.0 };

    /// The difference of the triangle as it is now.
    pub(super) fn record(&mut self, difference: f64) {
        self.last = difference;
        if difference > 2.0 * self.first {
            *self = Self { first: difference, divisions: 0, last: difference };
        }
    }

    /// True if the difference does not fall: values jump in the triangle where no edge follows, and
    /// smaller ones are as wrong.
    pub(super) fn has_stalled(self) -> bool {
        let least = self.first * (-f64::from(self.divisions) / TO_HALF).exp2();
        self.divisions >= LEAST_DIVISIONS && self.last >= least && self.last > 0.0
    }

    fn divided(self) -> Self {
        Self { divisions: self.divisions.saturating_add(1), ..self }
    }
}

impl TornTriangle {
    /// Returns the triangle with another edge as the first.
    fn turned_to(self, edge: usize) -> Self {
        let turned = |k: usize| (k + edge) % 3;
        Self {
            corners: [0, 1, 2].map(|k| self.corners[turned(k)]),
            neighbours: [0, 1, 2].map(|k| self.neighbours[turned(k)]),
            kinds: [0, 1, 2].map(|k| self.kinds[turned(k)]),
            convergence: self.convergence,
        }
    }
}

/// The mesh.
#[derive(Debug)]
pub(super) struct Torn<'d> {
    seats: AnchorMap<'d>,
    cracks: &'d [ppum::crack::Crack],
    elements: Option<ParentElements<'d>>,
    pub(super) points: Vec<TornPoint>,
    pub(super) triangles: Vec<TornTriangle>,
}

impl<'d> Torn<'d> {
    fn empty(field: &Field<'d>) -> Self {
        Self {
            seats: AnchorMap::new(field),
            cracks: &field.step.cracks,
            elements: None,
            points: Vec::new(),
            triangles: Vec::new(),
        }
    }
}

impl Torn<'_> {
    /// The place of a point that lies on no border.
    pub(super) fn place(&self, point: Vec2) -> SidedPoint {
        self.seats.at(point, Side::Above)
    }

    pub(super) fn corners(&self, triangle: u32) -> [Vec2; 3] {
        let corners = self.triangles[triangle as usize].corners;
        corners.map(|corner| self.points[corner as usize].position)
    }

    /// A point of a triangle, interpolated between its nodes as values are.
    pub(super) fn position(&self, triangle: u32, b: BarycentricPoint, cell: &Lagrange) -> Vec2 {
        if cell.order == 1 || self.elements.is_none() {
            return weighted(self.corners(triangle), b);
        }
        let inner = self.inner_nodes(triangle, cell).map(|point| point.position);
        let nodes = self.corners(triangle).into_iter().chain(inner);
        let weights = cell.weights(b);
        nodes.zip(weights).fold(Vec2::ZERO, |sum, (node, weight)| sum + node * weight)
    }

    /// A place inside a triangle, a part of the way from a corner to the centroid.
    fn seen_from_inside(&self, corner: Vec2, triangle: [Vec2; 3], part: f64) -> SidedPoint {
        self.place(corner + (centroid(triangle) - corner) * part)
    }

    /// Longest edge of a triangle; of several the one that is first by its coordinates, so that
    /// neighbours agree.
    fn longest(&self, triangle: u32) -> usize {
        let p = self.corners(triangle);
        let key = |k: usize| key(p[k], p[(k + 1) % 3]);
        let longer = |a: usize, b: usize| if key(b) > key(a) { b } else { a };
        longer(longer(0, 1), 2)
    }

    /// Divides a triangle at the middle of its longest edge, others before it where they have to
    /// be. The triangles that have changed, and those that are new, are added to a list.
    pub(super) fn bisect(&mut self, triangle: u32, changed: &mut Vec<u32>) {
        let mut path = vec![(triangle, self.triangles[triangle as usize].corners)];
        while let Some(&(last, corners)) = path.last() {
            if self.triangles[last as usize].corners != corners {
                path.pop();
                continue;
            }
            let edge = self.longest(last);
            let next = self.triangles[last as usize].neighbours[edge];
            let is_shared =
                |next: u32| self.triangles[next as usize].neighbours[self.longest(next)] == last;
            if next == NONE || is_shared(next) {
                self.divide(last, edge, changed);
            } else {
                path.push((next, self.triangles[next as usize].corners));
            }
        }
    }

    /// Divides the triangles on both sides of an edge at its middle.
    fn divide(&mut self, triangle: u32, edge: usize, changed: &mut Vec<u32>) {
        let other = self.triangles[triangle as usize].neighbours[edge];
        let [a, b] = [edge, (edge + 1) % 3].map(|k| self.corners(triangle)[k]);
        let kind = self.triangles[triangle as usize].kinds[edge];
        let middle = self.middle(kind, [a, b]);
        let point = self.add_middle(middle, triangle, edge);
        if other == NONE {
            self.split(triangle, edge, point, changed);
            return;
        }
        let across = self.edge_to(other, triangle);
        let beyond = if kind.is_torn() { self.add_middle(middle, other, across) } else { point };
        // those of two elements may differ by rounding, and edges are compared by their ends
        self.points[beyond as usize].position = self.points[point as usize].position;
        let new = self.split(triangle, edge, point, changed);
        let new_other = self.split(other, across, beyond, changed);
        self.join((triangle, new_other), (new, other));
    }

    /// The middle of an edge; on the arc of a crack that it is a chord of, unless rounding has put
    /// its ends beside the arc.
    fn middle(&self, kind: BorderKind, [a, b]: [Vec2; 2]) -> Vec2 {
        let middle = (a + b) * 0.5;
        let arc = kind.crack.map(|id| self.cracks[id.crack as usize].edge(id.segment as usize));
        let on_arc = arc.filter(Edge::is_arc).map(|arc| arc.closest_point(middle));
        on_arc.filter(|p| (*p - middle).length() < 0.25 * (b - a).length()).unwrap_or(middle)
    }

    fn edge_to(&self, triangle: u32, neighbour: u32) -> usize {
        let neighbours = &self.triangles[triangle as usize].neighbours;
        neighbours.iter().position(|&n| n == neighbour).expect("neighbours know each other")
    }

    fn add_middle(&mut self, middle: Vec2, triangle: u32, edge: usize) -> u32 {
        let of_element = self.element_middle(triangle, edge);
        self.points.push(of_element.unwrap_or_else(|| self.on_edge(middle, triangle, edge)));
        self.points.len() as u32 - 1
    }

    /// A point inside of an edge as a triangle sees it.
    fn on_edge(&self, point: Vec2, triangle: u32, edge: usize) -> TornPoint {
        let corners = self.corners(triangle);
        let kind = self.triangles[triangle as usize].kinds[edge];
        let ends = [corners[edge], corners[(edge + 1) % 3]];
        let place = match kind.crack {
            Some(segment) => on_crack(segment, point, self.side(segment, ends)),
            None => self.place(point),
        };
        let inside = if kind.kink { self.seen_from_inside(point, corners, INSET) } else { place };
        TornPoint { position: point, seen: ValueSide::Plane { place, inside } }
    }

    /// The side of a crack that a triangle is on, from its edge along the crack.
    fn side(&self, SegmentId { crack, segment }: SegmentId, [a, b]: [Vec2; 2]) -> Side {
        let edge = self.cracks[crack as usize].edge(segment as usize);
        if edge.tangent_towards((a + b) * 0.5).dot(b - a) > 0.0 { Side::Above } else { Side::Below }
    }

    /// Splits one triangle; its half with the first end of the edge keeps its number. The number of
    /// the other half.
    fn split(&mut self, triangle: u32, edge: usize, point: u32, changed: &mut Vec<u32>) -> u32 {
        let new = self.triangles.len() as u32;
        let turned = self.triangles[triangle as usize].turned_to(edge);
        let ([a, b, c], [_, after, before]) = (turned.corners, turned.neighbours);
        let [kind, kind_after, kind_before] = turned.kinds;
        let inner = BorderKind::default();
        self.triangles[triangle as usize] = TornTriangle {
            corners: [a, point, c],
            neighbours: [NONE, new, before],
            kinds: [kind, inner, kind_before],
            convergence: turned.convergence.divided(),
        };
        self.triangles.push(TornTriangle {
            corners: [point, b, c],
            neighbours: [NONE, after, triangle],
            kinds: [kind, kind_after, inner],
            convergence: turned.convergence.divided(),
        });
        if after != NONE {
            let edge = self.edge_to(after, triangle);
            self.triangles[after as usize].neighbours[edge] = new;
        }
        changed.extend([triangle, new]);
        new
    }

    /// Joins pairs of halves at their first edges.
    fn join(&mut self, first: (u32, u32), second: (u32, u32)) {
        for (a, b) in [first, second] {
            self.triangles[a as usize].neighbours[0] = b;
            self.triangles[b as usize].neighbours[0] = a;
        }
    }
}

/// Orders edges by their length and then by their ends, alike from both sides.
fn key(a: Vec2, b: Vec2) -> [f64; 5] {
    let [a, b] = if (a.x, a.y) < (b.x, b.y) { [a, b] } else { [b, a] };
    [(b - a).dot(b - a), a.x, a.y, b.x, b.y]
}

pub(super) fn centroid([a, b, c]: [Vec2; 3]) -> Vec2 {
    a + ((b - a) + (c - a)) / 3.0
}

/// A point that lies on a segment of a crack, wherever rounding has put it.
fn on_crack(segment: SegmentId, point: Vec2, side: Side) -> SidedPoint {
    SidedPoint { point, anchor: point, offset: Vec2::ZERO, on: Some(segment), side }
}
