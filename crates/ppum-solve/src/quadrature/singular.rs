//! Rules on convex pieces, regular or near singular points.
//!
//! With an integrand r^{k/2} g(θ) around a singular point, k ≥ −2: a piece farther from the point
//! than its diameter gets plain Gauss rules; one that touches the point is cut into triangles with
//! their apex there, and with s = t² along the rays and x = foot + d sinh u along the far edge (at
//! distance d) the integrand is a polynomial in t and smooth in u; any other piece is bisected.
//! After Duffy, "Quadrature over a pyramid or cube of integrands with a singularity at a vertex", SIAM
//! J. Numer. Anal. 19 (1982), and Johnston & Elliott, "A sinh transformation for evaluating nearly
//! singular boundary element integrals", Int. J. Numer. Meth. Engng 62 (2005).

use super::gauss::gauss;
use super::polygon::Polygon;
use super::{Rule, Rules};
use ppum::vec2::Vec2;

/// Longest panel in u. The integrand's nearest singularities lie at u = ±iπ/2, so that n points
/// converge like 6.4^(−2n).
const PANEL: f64 = 1.0;

/// Triangles lower than this part of their edge are rounding of a point on the edge.
const FLAT: f64 = 1e-14;

/// Integrates over pieces of one rectangle.
pub(super) struct Pieces<'r> {
    /// Receives the points.
    pub(super) rules: &'r mut Rules,
    /// The patches that cover the rectangle.
    pub(super) patches: &'r [u32],
    /// Gauss points in each direction.
    pub(super) order: usize,
    /// Pieces smaller than this are dropped.
    pub(super) least: f64,
}

impl Pieces<'_> {
    /// Adds the rule of a polygon given relative to `anchor`, with the `singular` points that may be
    /// near it.
    pub(super) fn add(&mut self, anchor: Vec2, polygon: &Polygon, singular: &[Vec2]) {
        if polygon.area() <= self.least {
            return;
        }
        match *near(anchor, polygon, singular) {
            [] => self.add_regular(anchor, polygon),
            [point] if polygon.touches(point - anchor) => {
                self.add_fan(point, &polygon.seen_from(point - anchor));
            }
            ref points => {
                for part in polygon.parts() {
                    self.add(anchor, &part, points);
                }
            }
        }
    }

    fn add_regular(&mut self, anchor: Vec2, polygon: &Polygon) {
        let rule = self.rules.rule(self.patches, anchor);
        let v = &polygon.0;
        for k in (1..v.len() - 1).step_by(2) {
            let last = v[(k + 2).min(v.len() - 1)];
            add_quadrilateral(rule, [v[0], v[k], v[k + 1], last], self.order);
        }
    }

    /// Adds triangles with their apex at the anchor, one for each edge of the polygon.
    fn add_fan(&mut self, anchor: Vec2, polygon: &Polygon) {
        let rule = self.rules.rule(self.patches, anchor);
        for (a, b) in polygon.edges() {
            add_apex_triangle(rule, a, b, self.order);
        }
    }
}

/// The singular points closer to the polygon than its diameter.
fn near(anchor: Vec2, polygon: &Polygon, singular: &[Vec2]) -> Vec<Vec2> {
    if singular.is_empty() {
        return Vec::new();
    }
    let diameter = polygon.diameter();
    let is_near = |p: &&Vec2| polygon.distance(**p - anchor) < diameter;
    singular.iter().filter(is_near).copied().collect()
}

/// Tensor Gauss rule on the bilinear image of \[0, 1\]²; a triangle is the case of two equal corners.
/// Exact for polynomials of total degree 2n − 2.
fn add_quadrilateral(rule: &mut Rule, [a, b, c, d]: [Vec2; 4], n: usize) {
    for (eta, v) in gauss(n).on(0.0, 1.0) {
        let (left, right) = (a + (d - a) * eta, b + (c - b) * eta);
        let along = right - left;
        for (xi, w) in gauss(n).on(0.0, 1.0) {
            let across = (d - a) * (1.0 - xi) + (c - b) * xi;
            rule.push(left + along * xi, v * w * along.cross(across));
        }
    }
}

/// Duffy rule on the triangle (0, a, b) for integrands singular at 0.
fn add_apex_triangle(rule: &mut Rule, a: Vec2, b: Vec2, n: usize) {
    let edge = b - a;
    if a.cross(edge) <= FLAT * edge.dot(edge) {
        return;
    }
    let tangent = edge.unit();
    let height = a.cross(tangent);
    let foot = -tangent.left() * height;
    for (x, w) in edge_nodes(tangent.dot(a), tangent.dot(b), height, n) {
        let far = foot + tangent * x;
        for (t, v) in gauss(n).on(0.0, 1.0) {
            rule.push(far * (t * t), 2.0 * t * t * t * v * w * height);
        }
    }
}

/// Gauss nodes in u on \[lo, hi\], where x = d sinh u is the coordinate along a line at distance
/// d > 0 from a singular point, measured from the foot of the perpendicular.
pub(super) fn edge_nodes(lo: f64, hi: f64, d: f64, n: usize) -> impl Iterator<Item = (f64, f64)> {
    let (from, to) = ((lo / d).asinh(), (hi / d).asinh());
    let panels = ((to - from) / PANEL).ceil().max(1.0);
    let step = (to - from) / panels;
    (0..panels as usize).flat_map(move |k| {
        let start = from + k as f64 * step;
        gauss(n).on(start, start + step).map(move |(u, w)| (d * u.sinh(), d * u.cosh() * w))
    })
}
