//! The integrals over the elements of a mesh.
//!
//! In an element the field is smooth in the element's own coordinate. So elements that meet the
//! disc are divided there into triangles: along the crack, where that cuts one with a linear map,
//! and in one with the tip, with a corner there. A triangle has the points
//!
//! ```text
//! a + ρ ((1 − s) (b − a) + s (c − a)),     0 ≤ ρ, s ≤ 1
//! ```
//!
//! with Gauss points in s and ρ, at the tip in √ρ, in which half powers of the distance are
//! polynomials. It is divided into four until that changes nothing.

use super::block::PointBlock;
use super::integral::Interaction;
use super::path::PathSegment;
use super::resolve::Integration;
use super::sums::Integrals;
use ppum::crack::{End, SegmentId, Side};
use ppum::edge::Edge;
use ppum::jet::Jet;
use ppum::mesh::ElementField;
use ppum::progress::Cancelled;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::geometry::around;
use ppum_solve::quadrature::{CrackFace, EdgeRule, QuadratureErrorEstimate, gauss};
use ppum_solve::watched::WorkPhase;
use rayon::prelude::*;

/// Gauss points in each direction.
const ORDER: usize = 12;

/// Most divisions of all triangles together; each may have some.
const MOST: usize = 50_000;
const LEAST: usize = 200;

/// Lengths that are rounding, in parts of the radius or of an element.
const SAME: f64 = 1e-9;

/// Distances from a face at which the field beside it is looked at, in radii.
const BESIDE: f64 = 1e-6;

/// A triangle in the coordinate of an element.
#[derive(Clone, Copy, Debug)]
struct CoordinateTriangle {
    corners: [Vec2; 3],
    /// True if the first corner is the tip.
    is_at_tip: bool,
}

/// An element with what it is divided into.
type ElementTriangles<'m, 'f> = (Vec<CoordinateTriangle>, ElementField<'m, 'f>);

impl CoordinateTriangle {
    /// The four triangles between its corners and the middles of its sides.
    fn quarters(&self) -> [Self; 4] {
        let [a, b, c] = self.corners;
        let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|[p, q]| (p + q) * 0.5);
        let at = |corners| Self { corners, is_at_tip: false };
        let first = Self { corners: [a, ab, ca], is_at_tip: self.is_at_tip };
        [first, at([b, bc, ab]), at([c, ca, bc]), at([bc, ca, ab])]
    }

    /// Points with their weights.
    fn points(&self) -> Vec<(Vec2, f64)> {
        let [a, b, c] = self.corners;
        let (to_b, to_c, rule) = (b - a, c - a, gauss(ORDER));
        let area = to_b.cross(to_c).abs();
        let row = |(t, dt): (f64, f64)| {
            let (rho, slope) = if self.is_at_tip { (t * t, 2.0 * t) } else { (t, 1.0) };
            let point = move |(s, ds): (f64, f64)| {
                (a + (to_b * (1.0 - s) + to_c * s) * rho, area * rho * slope * dt * ds)
            };
            rule.on(0.0, 1.0).map(point).collect::<Vec<_>>()
        };
        rule.on(0.0, 1.0).flat_map(row).collect()
    }
}

impl Interaction<'_> {
    /// True if the patches of the field are elements.
    pub(super) fn is_on_mesh(&self) -> bool {
        self.field.step.partition.mesh().is_some()
    }

    /// The integrals over the elements in the disc, and over the faces of the crack that are loaded
    /// or not along the axis.
    ///
    /// # Errors
    /// Cancelled.
    pub(super) fn mesh(&self, stage: &WorkPhase<'_>) -> Result<Integrals, Cancelled> {
        let local = self.field.at(self.center);
        let (mut patches, reach) = (Vec::new(), vec2(self.largest(), self.largest()));
        self.field.tree.query_box(&Rect::around(self.center, reach), &mut patches);
        patches.sort_unstable();
        let of_patch = |&patch: &u32| {
            let element = local.element(patch as usize);
            element.map(|element| (self.triangles(&element), element))
        };
        let elements: Vec<_> = patches.iter().filter_map(of_patch).collect();
        let rough = |(triangles, element): &ElementTriangles<'_, '_>| -> Result<Vec<_>, Cancelled> {
            stage.advance(0)?;
            Ok(triangles.iter().map(|triangle| self.triangle(element, triangle)).collect())
        };
        let wholes: Vec<Vec<Integrals>> =
            elements.par_iter().map(rough).collect::<Result<_, Cancelled>>()?;
        let triangles_in_all = wholes.iter().flatten().count();
        let sizes = wholes.iter().flatten().map(Integrals::sizes);
        let scale = sizes.fold(Integrals::default(), Integrals::plus);
        let (at, most) = (self.center, LEAST.max(MOST / triangles_in_all.max(1)));
        let resolved = |(parts, wholes): (&ElementTriangles<'_, '_>, &Vec<Integrals>)| {
            let (triangles, element) = parts;
            let integral = |triangle: &CoordinateTriangle| self.triangle(element, triangle);
            let mut sum = Integrals::default();
            for (triangle, whole) in triangles.iter().zip(wholes) {
                stage.advance(0)?;
                let integration = Integration { integral: &integral, scale: &scale, at, most };
                sum = sum
                    .plus(integration.resolve((*triangle, *whole), CoordinateTriangle::quarters));
            }
            Ok::<_, Cancelled>(sum)
        };
        let sums: Vec<_> = elements.par_iter().zip(&wholes).map(resolved).collect();
        let sums = sums.into_iter().collect::<Result<Vec<_>, Cancelled>>()?;
        let on_faces = self.faces_on_mesh(&scale);
        Ok(sums.into_iter().fold(on_faces, Integrals::plus))
    }

    /// The points of a triangle in the disc.
    fn triangle(&self, element: &ElementField<'_, '_>, triangle: &CoordinateTriangle) -> Integrals {
        let (mut offsets, mut weights, mut jets) = (Vec::new(), Vec::new(), Vec::new());
        for (delta, weight) in triangle.points() {
            let point = element.point(delta);
            let [x, y] = point.columns;
            if point.offset.length() < self.largest() && element.is_kept(delta, Side::Above) {
                let mut jet = vec![Jet::constant(0.0); self.field.components()];
                element.evaluate::<1>((delta, point.offset), Side::Above, &mut jet);
                jets.extend_from_slice(&jet[..2]);
                offsets.push(point.offset);
                weights.push(weight * x.cross(y).abs() * self.circle(point.offset));
            }
        }
        PointBlock::new(self, self.center, &offsets).integrals(&weights, &jets)
    }

    /// The triangles of an element.
    fn triangles(&self, element: &ElementField<'_, '_>) -> Vec<CoordinateTriangle> {
        let corners = element.corners();
        let columns = |corner: &Vec2| element.point(*corner).columns;
        let first = columns(&corners[0]);
        let size = first[0].length() + first[1].length();
        let is_first =
            |[x, y]: [Vec2; 2]| (x - first[0]).length() + (y - first[1]).length() <= SAME * size;
        let is_linear = corners.iter().map(columns).all(is_first);
        let mut polygons = vec![corners];
        // an arc follows sides of elements: nothing else has a slit that bends
        for PathSegment { edge, .. } in
            self.path.parts().filter(|part| is_linear && !part.edge.is_arc())
        {
            polygons = polygons
                .into_iter()
                .flat_map(|polygon| self.cut(element, polygon, [edge.from, edge.to]))
                .collect();
        }
        let is_tip = |p: &Vec2| element.point(*p).offset.length() <= SAME * self.largest();
        polygons.iter().flat_map(|polygon| fan(polygon, &is_tip)).collect()
    }

    /// A polygon of an element on both sides of the line of a segment that meets it.
    fn cut(
        &self,
        element: &ElementField<'_, '_>,
        polygon: Vec<Vec2>,
        ends: [Vec2; 2],
    ) -> Vec<Vec<Vec2>> {
        let [from, to] = ends.map(|p| p - self.center);
        let offsets: Vec<Vec2> = polygon.iter().map(|p| element.point(*p).offset).collect();
        let along = (to - from).unit();
        let depths: Vec<f64> = offsets.iter().map(|p| along.cross(*p - from)).collect();
        let size = depths.iter().fold(0.0f64, |m, d| m.max(d.abs()));
        let is_beyond = |sign: f64| depths.iter().any(|depth| sign * depth > SAME * size);
        let is_near = around(&offsets).overlaps(&around(&[from, to]));
        if !(is_beyond(1.0) && is_beyond(-1.0) && is_near) {
            return vec![polygon];
        }
        [1.0, -1.0].map(|sign| clipped(&polygon, &depths, sign)).to_vec()
    }

    /// The integrals over both faces of the crack behind its kinks, and of loaded ones.
    fn faces_on_mesh(&self, scale: &Integrals) -> Integrals {
        let mut sums = Integrals::default();
        for (part, edge) in self.pieces_of_faces() {
            let integral = |edge: &Edge| {
                let of_side = |side| {
                    let rule = self.face_rule(edge, part.segment, side);
                    self.on_face(&part, &rule, &self.beside(&rule, side), &[])
                };
                of_side(Side::Above).plus(of_side(Side::Below))
            };
            let whole = integral(&edge);
            let (at, most) = (self.center, LEAST);
            let integration = Integration { integral: &integral, scale, at, most };
            let halves = |edge: &Edge| [[0.0, 0.5], [0.5, 1.0]].map(|parts| edge.part(parts));
            sums = sums.plus(integration.resolve((edge, whole), halves));
        }
        sums
    }

    /// The rule on a part of a face, given by the edge that leads away from the tip.
    pub(super) fn face_rule(&self, edge: &Edge, segment: u32, side: Side) -> EdgeRule {
        let segment = SegmentId { crack: self.path.tip().crack, segment };
        // the left of the crack's direction is that of its last tip
        let left = if self.path.tip().end == End::Start { 1.0 } else { -1.0 };
        let out = if side == Side::Above { -left } else { left };
        let nodes = gauss(ORDER).on(0.0, 1.0);
        let node = |(t, dt): (f64, f64)| {
            let offset = (edge.from - self.center) + edge.way(t);
            let circle = self.circle(offset);
            (offset, (dt * edge.length() * circle, edge.tangent(t).left() * out))
        };
        let (offsets, others): (Vec<_>, Vec<_>) = nodes.map(node).unzip();
        let (weights, normals) = others.into_iter().unzip();
        EdgeRule {
            anchor: self.center,
            normals,
            offsets,
            weights,
            patches: Vec::new(),
            face: Some(CrackFace { segment, side }),
            doubt: QuadratureErrorEstimate::default(),
        }
    }

    /// The field beside points of a face, in the elements on its side: a linear extrapolation.
    fn beside(&self, rule: &EdgeRule, side: Side) -> Vec<Jet<f64>> {
        let (components, step) = (self.field.components(), BESIDE * self.largest());
        let mut local = self.field.at(self.center);
        let mut at = |offset: Vec2| {
            let mut jets = vec![Jet::constant(0.0); components];
            local.evaluate::<1>(offset, side, &mut jets);
            jets
        };
        let mut all = Vec::new();
        for (&offset, &normal) in rule.offsets.iter().zip(&rule.normals) {
            let [near, far] = [1.0, 2.0].map(|k| at(offset - normal * (k * step)));
            let both = near.into_iter().zip(far).take(2);
            all.extend(both.map(|(near, far)| near.scaled::<1>(2.0).minus::<1>(far)));
        }
        all
    }
}

/// The triangles of a convex polygon, all with a corner at the tip if that lies in it.
fn fan(polygon: &[Vec2], is_tip: &dyn Fn(&Vec2) -> bool) -> Vec<CoordinateTriangle> {
    let n = polygon.len();
    let area = |a: Vec2, b: Vec2, c: Vec2| (b - a).cross(c - a);
    let whole: f64 = (2..n).map(|k| area(polygon[0], polygon[k - 1], polygon[k])).sum();
    let side = |k: usize| [polygon[k], polygon[(k + 1) % n]];
    let holds = |p: Vec2| (0..n).all(|k| area(side(k)[0], side(k)[1], p) >= -SAME * whole);
    let inner = [Vec2::ZERO].into_iter().filter(|p| holds(*p));
    let tip = inner.chain(polygon.iter().copied()).find(is_tip);
    let apex = tip.unwrap_or(polygon[0]);
    let all = (0..n).map(|k| [apex, side(k)[0], side(k)[1]]);
    let whole_ones = all.filter(|[a, b, c]| area(*a, *b, *c) > SAME * whole);
    whole_ones.map(|corners| CoordinateTriangle { corners, is_at_tip: tip.is_some() }).collect()
}

/// The part of a convex polygon where depths, which are linear, have a sign.
fn clipped(polygon: &[Vec2], depths: &[f64], sign: f64) -> Vec<Vec2> {
    let n = polygon.len();
    let mut points = Vec::new();
    for k in 0..n {
        let next = (k + 1) % n;
        let [a, b] = [k, next].map(|k| sign * depths[k]);
        if a >= 0.0 {
            points.push(polygon[k]);
        }
        if a * b < 0.0 {
            points.push(polygon[k] + (polygon[next] - polygon[k]) * (a / (a - b)));
        }
    }
    points
}
