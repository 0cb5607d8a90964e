//! Triangles of the elements of a mesh.
//!
//! Elements are cut along level fields and cracks, and their pieces into triangles; between patches
//! all edges are torn. The middle of an edge is the image of the middle in ξ, so edges follow
//! curved elements; one whose ends lie on a level line has its middle there, too.

use std::collections::HashMap;

use ppum::field::Field;
use ppum::mesh::{ElementField, Mesh};
use ppum::vec2::Vec2;
use ppum_render::pieces::ElementCuts;

use super::super::borders::{BorderKind, SAME, longest};
use super::super::elements::{ElementPlace, ParentElements, weighted};
use super::super::lagrange::{BarycentricPoint, Lagrange};
use super::begin::{EdgeKinds, linked, sectors};
use super::{NONE, Torn, TornPoint, TornTriangle, ValueSide, centroid};

/// Largest distance of a corner from the tip that it stands for, in ξ.
const NEAR: f64 = 0.05;

/// Part of the way from the centroid of a triangle to an edge by which a point lies beyond it.
const BEYOND: f64 = 1e-6;

/// Halvings of the edges that are lines.
const HALVINGS: usize = 3;

/// A triangle of the beginning.
struct ElementTriangle {
    patch: u32,
    corners: [Vec2; 3],
    /// Edges on which the field jumps.
    faces: [bool; 3],
}

/// Moves the corner inside of an element that is nearest to a tip onto it: pieces end at chords,
/// which pass by it.
fn meet_tips(
    elements: &ParentElements<'_>,
    field: &Field<'_>,
    element: &ElementField<'_, '_>,
    pieces: &mut [Vec<Vec2>],
) {
    let patch = element.patch() as u32;
    let inner = pieces.iter().flatten().copied().filter(|&at| element.margin(at) > SAME);
    let pairs = inner.flat_map(|corner| {
        let tips = elements.tips_near(field, patch, corner).into_iter();
        tips.map(move |tip| (corner, tip))
    });
    let is_near = |(corner, tip): &(Vec2, Vec2)| {
        (*tip - *corner).length() < NEAR && element.margin(*tip) > 0.0
    };
    let mut near: Vec<(Vec2, Vec2)> = pairs.filter(is_near).collect();
    near.sort_by(|a, b| (a.1 - a.0).length().total_cmp(&(b.1 - b.0).length()));
    let mut met: Vec<Vec2> = Vec::new();
    for (corner, tip) in near {
        if met.iter().all(|known| (*known - tip).length() > NEAR) {
            for at in pieces.iter_mut().flatten() {
                *at = if (*at - corner).length() <= SAME { tip } else { *at };
            }
            met.push(tip);
        }
    }
}

/// Adds the triangles of a patch.
fn add_triangles(
    field: &Field<'_>,
    elements: &ParentElements<'_>,
    patch: usize,
    all: &mut Vec<ElementTriangle>,
) {
    let mesh = elements.mesh;
    let local = field.at(mesh.origin[patch]);
    let Some(element) = local.element(patch) else { return };
    let cuts = ElementCuts::new(field, mesh, &element, local.anchor);
    let corners = element.corners();
    let (mut pieces, faces): (Vec<Vec<Vec2>>, Vec<Vec<bool>>) = match cuts.is_empty() {
        true => (vec![corners.clone()], vec![vec![false; corners.len()]]),
        false => {
            let pieces = cuts.pieces(&element, &corners).into_iter();
            pieces.map(|piece| (piece.corners, piece.faces)).unzip()
        }
    };
    meet_tips(elements, field, &element, &mut pieces);
    for (corners, faces) in pieces.into_iter().zip(faces) {
        let number = corners.len();
        let next = |k: usize| corners[(k + 1) % number];
        let middle = corners.iter().fold(Vec2::ZERO, |sum, &c| sum + c) / number as f64;
        let is_turned = mesh.image(patch, middle.into()).1 < 0.0;
        let mut add = |[a, b, c]: [Vec2; 3], faces: [bool; 3]| {
            let [p, q, r] = faces;
            let (corners, faces) =
                if is_turned { ([b, a, c], [p, r, q]) } else { ([a, b, c], faces) };
            all.push(ElementTriangle { patch: patch as u32, corners, faces });
        };
        if let ([a, b, c], [p, q, r]) = (&corners[..], &faces[..]) {
            add([*a, *b, *c], [*p, *q, *r]);
            continue;
        }
        (0..number).for_each(|k| add([corners[k], next(k), middle], [faces[k], false, false]));
    }
}

/// Returns the kind of the edge of a triangle that another one shares; `None` if they only touch
/// there.
fn kind(
    elements: &ParentElements<'_>,
    triangles: [&ElementTriangle; 2],
    edges: [usize; 2],
    near: f64,
) -> Option<BorderKind> {
    let [own, other] = triangles;
    let kink = BorderKind { kink: true, ..BorderKind::default() };
    if own.patch == other.patch {
        let is_face = own.faces[edges[0]] || other.faces[edges[1]];
        return Some(if is_face {
            BorderKind { is_interface: true, ..kink }
        } else {
            BorderKind::default()
        });
    }
    let middles = [0, 1].map(|side| {
        let (triangle, edge) = (triangles[side], edges[side]);
        let ends = [edge, (edge + 1) % 3].map(|k| triangle.corners[k]);
        elements.image(triangle.patch, elements.middle(triangle.patch, ends))
    });
    let element = |triangle: &ElementTriangle| elements.mesh.element[triangle.patch as usize];
    let is_interface = element(own) == element(other);
    let is_shared = (middles[0] - middles[1]).length() <= near;
    is_shared.then_some(BorderKind { is_interface, ..kink })
}

impl<'d> Torn<'d> {
    /// The triangles of all elements, as few as there may be.
    pub(in super::super) fn of_elements(field: &Field<'d>, mesh: &'d Mesh) -> Self {
        let elements = ParentElements::new(field, mesh);
        let mut all = Vec::new();
        (0..mesh.len()).for_each(|patch| add_triangles(field, &elements, patch, &mut all));
        let near = SAME * longest(&field.domain.bounds);
        let corners = all.iter().flat_map(|t| t.corners.map(|at| elements.image(t.patch, at)));
        let (vertices, numbers) = unified(corners, near);
        let corners: Vec<[u32; 3]> = numbers.as_chunks().0.to_vec();
        let mut triangles = linked(&corners, &EdgeKinds::new());
        let links: Vec<_> = (0..triangles.len())
            .map(|t| {
                [0, 1, 2].map(|edge| link(&elements, (&triangles, &all), (t, edge), 10.0 * near))
            })
            .collect();
        for (triangle, links) in triangles.iter_mut().zip(links) {
            triangle.neighbours = links.map(|(other, _)| other);
            triangle.kinds = links.map(|(_, kind)| kind);
        }
        let mut torn = Self::empty(field);
        torn.triangles = triangles;
        torn.tear_elements(&all, &vertices);
        torn.elements = Some(elements);
        torn
    }

    fn tear_elements(&mut self, all: &[ElementTriangle], vertices: &[Vec2]) {
        let sectors = sectors(&self.triangles, BorderKind::is_torn);
        let mut numbers = vec![NONE; 3 * all.len()];
        for (t, own) in all.iter().enumerate() {
            let inner = centroid(own.corners);
            self.triangles[t].corners = [0, 1, 2].map(|k| {
                let root = sectors.root(3 * t + k);
                if numbers[root] == NONE {
                    numbers[root] = self.points.len() as u32;
                    let position = vertices[self.triangles[t].corners[k] as usize];
                    let (patch, at) = (own.patch, own.corners[k]);
                    let seen = ValueSide::Element(ElementPlace { patch, at, inner, target: None });
                    self.points.push(TornPoint { position, seen });
                }
                numbers[root]
            });
        }
    }

    /// The patch of a triangle and the ξ of its corners.
    pub(super) fn element_of(&self, triangle: u32) -> Option<(u32, [Vec2; 3])> {
        let places =
            self.triangles[triangle as usize].corners.map(|k| self.points[k as usize].seen);
        let [ValueSide::Element(a), ValueSide::Element(b), ValueSide::Element(c)] = places else {
            return None;
        };
        Some((a.patch, [a.at, b.at, c.at]))
    }

    /// The middle of an edge of an element.
    pub(super) fn element_middle(&self, triangle: u32, edge: usize) -> Option<TornPoint> {
        let (elements, (patch, corners)) = (self.elements.as_ref()?, self.element_of(triangle)?);
        let at = elements.middle(patch, [corners[edge], corners[(edge + 1) % 3]]);
        Some(point(elements, patch, at, centroid(corners)))
    }

    /// A point of an element by its barycentric coordinates in ξ.
    pub(super) fn element_point(&self, triangle: u32, b: BarycentricPoint) -> Option<TornPoint> {
        let (elements, (patch, corners)) = (self.elements.as_ref()?, self.element_of(triangle)?);
        Some(point(elements, patch, weighted(corners, b), centroid(corners)))
    }

    /// The place of a point of a triangle, whose ξ is near that of these coordinates.
    pub(in super::super) fn element_place(
        &self,
        triangle: u32,
        b: BarycentricPoint,
        position: Vec2,
    ) -> Option<ElementPlace> {
        let (patch, corners) = self.element_of(triangle)?;
        let at = weighted(corners, b);
        Some(ElementPlace { patch, at, inner: centroid(corners), target: Some(position) })
    }

    /// How far a triangle is from the part of its element that it stands for, and its edges from
    /// the level lines that they stand for, in parts of the element's size.
    pub(in super::super) fn deviation(&self, triangle: u32, cell: &Lagrange) -> f64 {
        let Some((patch, corners)) = self.element_of(triangle) else { return 0.0 };
        let Some(elements) = &self.elements else { return 0.0 };
        let image = |at: Vec2| elements.image(patch, at);
        let inside = cell
            .tests
            .iter()
            .map(|&b| (self.position(triangle, b, cell) - image(weighted(corners, b))).length());
        let edges = (0..3).map(|k| {
            let ends = [corners[k], corners[(k + 1) % 3]];
            let straight = (ends[0] + ends[1]) * 0.5;
            (image(elements.middle(patch, ends)) - image(straight)).length()
        });
        let largest = inside.chain(edges).fold(0.0, f64::max);
        largest / longest(&elements.mesh.bounds(patch as usize))
    }
}

impl Torn<'_> {
    /// The edges on the border of the body, and those on cuts of elements, as points along them;
    /// true for cuts. Nothing of covers.
    pub(in super::super) fn element_lines(&self, field: &Field<'_>) -> Vec<(bool, Vec<Vec2>)> {
        let edges = (0..self.triangles.len() as u32).flat_map(|t| [0, 1, 2].map(|edge| (t, edge)));
        edges.filter_map(|(t, edge)| self.element_line(field, t, edge)).collect()
    }

    fn element_line(&self, field: &Field<'_>, t: u32, edge: usize) -> Option<(bool, Vec<Vec2>)> {
        let (elements, (patch, corners)) = (self.elements.as_ref()?, self.element_of(t)?);
        let ends = [corners[edge], corners[(edge + 1) % 3]];
        let middle = elements.middle(patch, ends);
        // a vertex of a neighbour may lie inside of the edge
        let beyond = || elements.image(patch, middle + (middle - centroid(corners)) * BEYOND);
        let other = self.triangles[t as usize].neighbours[edge];
        let is_border = other == NONE && !field.at(beyond()).contains(Vec2::ZERO);
        let is_cut = other < t && self.triangles[t as usize].kinds[edge].is_interface;
        (is_border || is_cut).then(|| {
            let mut places = ends.to_vec();
            for _ in 0..HALVINGS {
                let halves =
                    places.windows(2).flat_map(|p| [p[0], elements.middle(patch, [p[0], p[1]])]);
                places = halves.chain([ends[1]]).collect();
            }
            (is_cut, places.into_iter().map(|at| elements.image(patch, at)).collect())
        })
    }
}

fn point(elements: &ParentElements<'_>, patch: u32, at: Vec2, inner: Vec2) -> TornPoint {
    let seen = ValueSide::Element(ElementPlace { patch, at, inner, target: None });
    TornPoint { position: elements.image(patch, at), seen }
}

/// The triangle across an edge and what is on it, none if it does not know of this one.
fn link(
    elements: &ParentElements<'_>,
    (triangles, all): (&[TornTriangle], &[ElementTriangle]),
    (own, edge): (usize, usize),
    near: f64,
) -> (u32, BorderKind) {
    let none = (NONE, BorderKind::default());
    let other = triangles[own].neighbours[edge];
    if other == NONE {
        return none;
    }
    let across = triangles[other as usize].neighbours.iter().position(|&n| n as usize == own);
    let Some(across) = across else { return none };
    let kind = kind(elements, [&all[own], &all[other as usize]], [edge, across], near);
    kind.map_or(none, |kind| (other, kind))
}

/// Points that are nearer to each other than `near` become one: the points, and the number of each.
fn unified(points: impl Iterator<Item = Vec2>, near: f64) -> (Vec<Vec2>, Vec<u32>) {
    let mut kept: Vec<Vec2> = Vec::new();
    let mut boxes: HashMap<[i64; 2], Vec<u32>> = HashMap::new();
    let index = |p: Vec2| [p.x, p.y].map(|v| (v / (2.0 * near)).floor() as i64);
    let numbers = points.map(|p| {
        let [i, j] = index(p);
        let around = (-1..=1).flat_map(|k| (-1..=1).map(move |l| [i + k, j + l]));
        let beside = around.filter_map(|index| boxes.get(&index)).flatten().copied();
        let known = beside.into_iter().find(|&k| (kept[k as usize] - p).length() <= near);
        known.unwrap_or_else(|| {
            let number = kept.len() as u32;
            kept.push(p);
            boxes.entry([i, j]).or_default().push(number);
            number
        })
    });
    let numbers = numbers.collect();
    (kept, numbers)
}
