//! Curves of a drawing that the problem file knows: polylines, arcs of ellipses, splines, chains of
//! arcs.

use ppum::edge::Edge;
use ppum::smooth_curve::SmoothCurve;
use ppum::spline::Spline;
use ppum::vec2::{Vec2, vec2};

use crate::affine::PlaneMap;

/// A curve from its begin to its end.
#[derive(Clone, Debug, PartialEq)]
pub enum PlaneCurve {
    /// Straight segments; two points at least.
    Polyline(Vec<Vec2>),
    /// A part of an ellipse.
    Arc(EllipseArc),
    /// The cubic spline of the problem file through three points or more.
    Spline(Vec<Vec2>),
    /// Arcs and segments, each from where the one before ends.
    Edges(Vec<Edge>),
}

/// The points c + p cos t + q sin t for t between two parameters; p and q are conjugate radii.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipseArc {
    /// The centre c.
    pub center: Vec2,
    /// The conjugate radii p and q.
    pub radii: [Vec2; 2],
    /// The parameters of begin and end, in radians; a whole turn is a closed ellipse.
    pub range: [f64; 2],
}

/// An ellipse by its axes; all angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EllipseAxes {
    pub(crate) axes: [f64; 2],
    /// Angle of the first axis.
    pub(crate) angle: f64,
    pub(crate) range: [f64; 2],
}

impl EllipseArc {
    /// An arc of a circle, between angles in radians.
    pub(crate) fn circle(center: Vec2, radius: f64, range: [f64; 2]) -> Self {
        Self { center, radii: [vec2(radius, 0.0), vec2(0.0, radius)], range }
    }

    /// An arc of a circle from `a` to `b`; `bulge` is the tangent of a quarter of its turn.
    pub(crate) fn bulged(a: Vec2, b: Vec2, bulge: f64) -> Self {
        let arc = Edge { from: a, to: b, bulge };
        let (center, p) = (arc.center(), a - arc.center());
        Self { center, radii: [p, p.left()], range: [0.0, arc.sweep()] }
    }

    pub(crate) fn point(&self, t: f64) -> Vec2 {
        let (sin, cos) = t.sin_cos();
        self.center + self.radii[0] * cos + self.radii[1] * sin
    }

    pub(crate) fn is_closed(&self) -> bool {
        (self.range[1] - self.range[0]).abs() >= std::f64::consts::TAU * (1.0 - 1e-12)
    }

    /// True if it is no arc: it has no length, or no area.
    pub(crate) fn is_empty(&self) -> bool {
        self.radii[0].cross(self.radii[1]) == 0.0 || self.range[0] == self.range[1]
    }

    fn mapped(&self, map: &PlaneMap) -> Self {
        let radii = self.radii.map(|r| map.vector(r));
        Self { center: map.point(self.center), radii, range: self.range }
    }

    /// The axes, by the parameter t₀ at which the radii are at right angles:
    /// tan 2t₀ = 2 p·q / (p² − q²). A mirrored ellipse runs back.
    pub(crate) fn axes(&self) -> EllipseAxes {
        let [p, q] = self.radii;
        let (mixed, apart) = (2.0 * p.dot(q), p.dot(p) - q.dot(q));
        let is_circle = mixed.hypot(apart) < 1e-12 * (p.dot(p) + q.dot(q));
        let start = if is_circle { 0.0 } else { 0.5 * mixed.atan2(apart) };
        let (sin, cos) = start.sin_cos();
        let [first, second] = [p * cos + q * sin, q * cos - p * sin];
        let way = first.cross(second).signum();
        let (axes, turn) = ([first.length(), second.length()], first.y.atan2(first.x));
        let range = self.range.map(|t| way * (t - start));
        if !is_circle {
            return EllipseAxes { axes, angle: turn, range };
        }
        let radius = 0.5 * (axes[0] + axes[1]);
        EllipseAxes { axes: [radius; 2], angle: 0.0, range: range.map(|t| t + turn) }
    }

    pub(crate) fn is_circle(&self) -> bool {
        let EllipseAxes { axes: [a, b], .. } = self.axes();
        a == b
    }

    /// The arcs of a circle, or arcs that follow the ellipse.
    fn edges(&self) -> Vec<Edge> {
        let (EllipseAxes { axes, angle, range: [from, to] }, center) = (self.axes(), self.center);
        let curve = SmoothCurve::Ellipse { center, axes: axes.into(), angle, from, to };
        // with a cusp it is an error of the problem file
        let [from, to] = self.range;
        let chord = |k: u32| self.point(from + (to - from) * (f64::from(k) / 64.0));
        let chords = |_| segments(&(0..=64).map(chord).collect::<Vec<_>>());
        curve.edges().unwrap_or_else(chords)
    }

    /// Its halves.
    pub(crate) fn halves(&self) -> [Self; 2] {
        let [from, to] = self.range;
        let middle = 0.5 * (from + to);
        [[from, middle], [middle, to]].map(|range| Self { range, ..*self })
    }
}

impl PlaneCurve {
    /// Begin and end.
    #[must_use]
    pub fn ends(&self) -> [Vec2; 2] {
        match self {
            Self::Polyline(points) | Self::Spline(points) => [points[0], points[points.len() - 1]],
            Self::Arc(arc) => arc.range.map(|t| arc.point(t)),
            Self::Edges(edges) => [edges[0].from, edges[edges.len() - 1].to],
        }
    }

    /// The curve from its end to its begin.
    #[must_use]
    pub fn reversed(mut self) -> Self {
        match &mut self {
            Self::Polyline(points) | Self::Spline(points) => points.reverse(),
            Self::Arc(arc) => arc.range.reverse(),
            Self::Edges(edges) => {
                edges.reverse();
                edges.iter_mut().for_each(|edge| *edge = edge.reversed());
            }
        }
        self
    }

    pub(crate) fn mapped(&self, map: &PlaneMap) -> Self {
        let all = |points: &[Vec2]| points.iter().map(|p| map.point(*p)).collect();
        match self {
            Self::Polyline(points) => Self::Polyline(all(points)),
            Self::Spline(points) => Self::Spline(all(points)),
            Self::Arc(arc) => Self::Arc(arc.mapped(map)),
            // only maps that keep shapes come this far
            Self::Edges(edges) => {
                let sign = map.x.cross(map.y).signum();
                let mapped = |edge: &Edge| {
                    let [from, to] = [edge.from, edge.to].map(|p| map.point(p));
                    Edge { from, to, bulge: sign * edge.bulge }
                };
                Self::Edges(edges.iter().map(mapped).collect())
            }
        }
    }

    /// The curve with other ends: those of polylines are replaced, others turned and scaled.
    pub(crate) fn moved(self, to: [Vec2; 2]) -> Self {
        let ends = self.ends();
        if ends == to {
            return self;
        }
        match self {
            Self::Polyline(mut points) => {
                let last = points.len() - 1;
                (points[0], points[last]) = (to[0], to[1]);
                Self::Polyline(points)
            }
            curve => curve.mapped(&PlaneMap::between(ends, to)),
        }
    }

    /// Its edges: segments, arcs of circles as they are, of ellipses and splines arcs that follow
    /// them.
    #[must_use]
    pub fn edges(&self) -> Vec<Edge> {
        match self {
            Self::Polyline(points) => segments(points),
            Self::Arc(arc) => arc.edges(),
            Self::Spline(points) => {
                let curve = SmoothCurve::Spline(Spline::open(points));
                // with a cusp it is an error of the problem file
                curve.edges().unwrap_or_else(|_| segments(points))
            }
            Self::Edges(edges) => edges.clone(),
        }
    }

    /// True if all numbers are finite, and so small that their squares are.
    pub(crate) fn is_finite(&self) -> bool {
        let is_small = |p: &Vec2| p.x.abs() < 1e100 && p.y.abs() < 1e100;
        match self {
            Self::Polyline(points) | Self::Spline(points) => points.iter().all(is_small),
            Self::Arc(arc) => {
                let [p, q] = arc.radii;
                [arc.center, p, q].iter().all(is_small) && arc.range.iter().all(|t| t.abs() < 1e3)
            }
            Self::Edges(edges) => edges.iter().all(|edge| is_small(&edge.from)),
        }
    }
}

fn segments(points: &[Vec2]) -> Vec<Edge> {
    points.windows(2).map(|p| Edge::segment([p[0], p[1]])).collect()
}
