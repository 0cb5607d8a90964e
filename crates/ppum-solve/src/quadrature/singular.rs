//! Rules on convex pieces, regular or near singular points.
//!
//! With an integrand r^{k/2} g(θ) around a singular point, k ≥ −2: a piece farther from the point
//! than its diameter gets plain Gauss rules; one that touches the point is cut into triangles with
//! their apex there, and with s = t² along the rays and x = foot + d sinh u along the far edge (at
//! distance d) the integrand is a polynomial in t and smooth in u; any other piece is bisected.
//! With other exponents the rays get another power of t and more points ([`SingularGrowth`]). After
//! Duffy, "Quadrature over a pyramid or cube of integrands with a singularity at a vertex", SIAM J.
//! Numer. Anal. 19 (1982), and Johnston & Elliott, "A sinh transformation for evaluating nearly
//! singular boundary element integrals", Int. J. Numer. Meth. Engng 62 (2005).
//!
//! [`SingularGrowth`]: super::SingularGrowth

use super::adapt::{IntegrandDemand, refined};
use super::arcs::ArcRun;
use super::chart::{ApexTriangle, CellChart, quadrilaterals};
use super::curve::{ChartWindow, cut_all};
use super::geometry::{BranchCoordinate, LevelFunction, Singularity};
use super::holes::{self, PlacedHole};
use super::local_curve::LocalCurve;
use super::piece::SmoothPiece;
use super::polygon::ConvexPolygon;
use super::rule::Rules;
use ppum::vec2::{Rect, Vec2, vec2};
use std::rc::Rc;

/// Longest panel in u. The integrand's nearest singularities lie at u = ±iπ/2, so that n points
/// converge like 6.4^(−2n).
const PANEL: f64 = 1.0;

/// Triangles lower than this part of their edge are rounding of a point on the edge.
const FLAT: f64 = 1e-14;

/// Integrates over pieces of one rectangle.
pub(super) struct PieceQuadrature<'r, 'c> {
    /// Receives the points.
    pub(super) rules: &'r mut Rules,
    /// The patches that cover the rectangle.
    pub(super) patches: &'r [u32],
    /// The number of points, and the functions that have to be resolved.
    pub(super) demand: IntegrandDemand<'r>,
    /// Pieces smaller than this are dropped.
    pub(super) least: f64,
    /// Curves across which integrands have kinks.
    pub(super) levels: &'r [&'c LevelFunction],
    /// Arcs across which integrands jump.
    pub(super) runs: &'r [&'r ArcRun],
    /// The rectangle, and the holes that may meet it.
    pub(super) rect: &'r Rect,
    pub(super) holes: &'r [&'r PlacedHole<'r>],
}

impl<'c> PieceQuadrature<'_, 'c> {
    /// Adds the rule of a polygon given relative to `anchor`, with the `singular` points that may
    /// be near it.
    pub(super) fn add(&mut self, anchor: Vec2, polygon: &ConvexPolygon, singular: &[Singularity]) {
        if polygon.area() <= self.least {
            return;
        }
        match *near(anchor, polygon, singular) {
            [] => self.add_regular(anchor, polygon),
            [at] if polygon.touches(at.point - anchor) => {
                self.add_fan(&at, &polygon.seen_from(at.point - anchor));
            }
            ref points => {
                for part in polygon.parts() {
                    self.add(anchor, &part, points);
                }
            }
        }
    }

    fn add_regular(&mut self, anchor: Vec2, polygon: &ConvexPolygon) {
        let curves = self.curves(anchor, polygon);
        if !curves.is_empty() {
            let windows = quadrilaterals(polygon).map(ChartWindow::whole).collect();
            let (windows, cut) = cut_all(windows, &curves);
            if cut {
                return self.add_windows(anchor, windows, true);
            }
        }
        self.add_parts(anchor, vec![SmoothPiece::Polygon(polygon.clone())], false);
    }

    /// The curves that may cut a polygon.
    fn curves(&self, anchor: Vec2, polygon: &ConvexPolygon) -> Vec<LocalCurve<'c>> {
        let levels = self.levels.iter().map(|&level| LocalCurve::Level(level, anchor));
        levels.chain(self.runs.iter().flat_map(|run| run.through(anchor, polygon))).collect()
    }

    /// Adds triangles with their apex at the singular point, one for each edge of the polygon.
    fn add_fan(&mut self, at: &Singularity, polygon: &ConvexPolygon) {
        let has_area = |(a, b): &(Vec2, Vec2)| 0.5 * a.cross(*b) > self.least;
        let edges = polygon.edges().filter(has_area);
        let triangles = edges.map(|(a, b)| apex_triangle(at, a, b, self.demand.order));
        let (windows, cut) =
            cut_all(triangles.flatten().collect(), &self.curves(at.point, polygon));
        self.add_windows(at.point, windows, cut);
    }

    fn add_windows(&mut self, anchor: Vec2, windows: Vec<ChartWindow<'_>>, curved: bool) {
        self.add_parts(anchor, windows.into_iter().map(SmoothPiece::Window).collect(), curved);
    }

    /// Adds the rules of pieces, divided until they resolve what they have to.
    fn add_parts(&mut self, anchor: Vec2, mut parts: Vec<SmoothPiece<'_>>, curved: bool) {
        let heights = [self.rect.min, self.rect.max].map(|p| p.y - anchor.y);
        let holes = self.holes.iter().map(|placed| placed.hole.between(anchor, heights));
        holes::remove(&holes.collect::<Vec<_>>(), &mut parts);
        let demand = IntegrandDemand { anchor, curved, ..self.demand };
        let rule = self.rules.rule(self.patches, anchor);
        let doubt = refined(parts, &demand, &mut |x, w| rule.push(x, w));
        rule.doubt.add(&doubt);
    }
}

/// The singular points closer to the polygon than its diameter.
fn near(anchor: Vec2, polygon: &ConvexPolygon, singular: &[Singularity]) -> Vec<Singularity> {
    if singular.is_empty() {
        return Vec::new();
    }
    let diameter = polygon.diameter();
    let is_near = |s: &&Singularity| {
        let own = || polygon.seen_from(s.point - anchor);
        // also as far as it is stretched in a coordinate of the functions
        let is_stretched = |z: &BranchCoordinate| {
            let seen = own().mapped(&|p| z.at(p));
            seen.distance(Vec2::ZERO) < seen.diameter()
        };
        polygon.distance(s.point - anchor) < diameter
            || s.branches.iter().flatten().any(is_stretched)
    };
    singular.iter().filter(is_near).copied().collect()
}

/// The triangle (0, a, b) in panels along its far edge, for integrands singular at 0.
fn apex_triangle<'c>(at: &Singularity, a: Vec2, b: Vec2, n: usize) -> Vec<ChartWindow<'c>> {
    let edge = b - a;
    if a.cross(edge) <= FLAT * edge.dot(edge) {
        return Vec::new();
    }
    let tangent = edge.unit();
    let height = a.cross(tangent);
    let foot = -tangent.left() * height;
    let apex = ApexTriangle { foot, tangent, height, grading: at.growth.over_areas(n) };
    let chart = Rc::new(CellChart::Apex(apex));
    let window = |(from, to)| ChartWindow {
        chart: Rc::clone(&chart),
        range: Rect::new(vec2(from, 0.0), vec2(to, 1.0)),
    };
    let branches = at.branches.iter().flatten();
    let zeros: Vec<_> = branches.map(|z| z.zero(foot, tangent * height)).collect();
    let ends = [tangent.dot(a), tangent.dot(b)];
    panels(ends[0], ends[1], height).flat_map(|panel| resolved(panel, &zeros)).map(window).collect()
}

/// Length of a panel in parts of its distance to a complex branch point: with it 8
/// points keep ten digits whatever the body.
const BRANCH_PANEL: f64 = 1.2;

/// Parts of a panel that are short against the distances to branch points re + i im.
pub(super) fn resolved((from, to): (f64, f64), zeros: &[[f64; 2]]) -> Vec<(f64, f64)> {
    let middle = 0.5 * (from + to);
    let apart = |[re, im]: &[f64; 2]| (re - re.clamp(from, to)).hypot(*im);
    let nearest = zeros.iter().map(apart).fold(f64::INFINITY, f64::min);
    if to - from <= BRANCH_PANEL * nearest || to - from < FLAT {
        return vec![(from, to)];
    }
    let halves = [(from, middle), (middle, to)];
    halves.into_iter().flat_map(|half| resolved(half, zeros)).collect()
}

/// Intervals of u for \[lo, hi\], where x = d sinh u is the coordinate along a line at distance d >
/// 0 from a singular point, measured from the foot of the perpendicular.
pub(super) fn panels(lo: f64, hi: f64, d: f64) -> impl Iterator<Item = (f64, f64)> {
    let (from, to) = ((lo / d).asinh(), (hi / d).asinh());
    let panels = ((to - from) / PANEL).ceil().max(1.0);
    let step = (to - from) / panels;
    (0..panels as usize).map(move |k| {
        let start = from + k as f64 * step;
        (start, start + step)
    })
}
