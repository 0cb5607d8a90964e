//! Smooth maps of rectangles onto pieces: what tensor Gauss rules and curves are laid out in.

use super::gauss::{MAX_POINTS, Rules1d};
use super::geometry::RayGrading;
use super::local_curve::LocalCurve;
use super::polygon::ConvexPolygon;
use super::roots::zero;
use super::split::component;
use ppum::vec2::{Rect, Vec2, vec2};
use std::rc::Rc;

/// The unit square.
pub(super) const UNIT: Rect = Rect::new(Vec2::ZERO, vec2(1.0, 1.0));

/// A map from coordinates (s, t) to offsets from an anchor, with a positive Jacobian.
#[derive(Clone)]
pub(super) enum CellChart<'c> {
    /// The bilinear map of the unit square; a triangle is the case of two equal corners.
    Quadrilateral([Vec2; 4]),
    /// A triangle seen from a singular point.
    Apex(ApexTriangle),
    /// A part of another chart on one side of a curve.
    Strip(CurveStrip<'c>),
}

/// The triangle between the anchor and an edge, with s = u along the edge, x = foot + d sinh u at
/// the distance d from the anchor, and r = t^power along the rays, 0 ≤ t ≤ 1.
#[derive(Clone, Copy)]
pub(super) struct ApexTriangle {
    pub(super) foot: Vec2,
    pub(super) tangent: Vec2,
    pub(super) height: f64,
    pub(super) grading: RayGrading,
}

/// The part of a chart's window below or above a curve. In one axis, the height, the unit interval
/// is the way from the window's boundary to the curve or on to the opposite boundary; the other
/// axis, the base, keeps its direction.
#[derive(Clone)]
pub(super) struct CurveStrip<'c> {
    pub(super) level: LevelOn<'c>,
    pub(super) window: Rect,
    pub(super) height: usize,
    pub(super) above: bool,
}

/// A curve seen through a chart.
#[derive(Clone)]
pub(super) struct LevelOn<'c> {
    pub(super) chart: Rc<CellChart<'c>>,
    pub(super) curve: LocalCurve<'c>,
}

impl LevelOn<'_> {
    /// The level function's value at coordinates of the chart.
    pub(super) fn at(&self, p: [f64; 2]) -> f64 {
        self.curve.value(self.chart.at(p).0)
    }

    /// The vector whose rounding makes that of the value, and the value.
    pub(super) fn sample(&self, p: [f64; 2]) -> (Vec2, f64) {
        let offset = self.chart.at(p).0;
        (self.curve.place(offset), self.curve.value(offset))
    }

    /// The least coordinate along an axis at which the curve is still resolved.
    fn least(&self, axis: usize) -> f64 {
        self.chart.least(axis, self.curve.least())
    }
}

impl CellChart<'_> {
    /// The offset of a point, and the Jacobian there.
    pub(super) fn at(&self, p: [f64; 2]) -> (Vec2, f64) {
        match self {
            Self::Quadrilateral(corners) => bilinear(corners, p),
            Self::Apex(apex) => apex.at(p),
            Self::Strip(strip) => {
                let (way, base) = (p[strip.height], p[1 - strip.height]);
                strip.at(way, strip.span(base), base)
            }
        }
    }

    /// Calls `push` with the offsets and weights of the tensor rule on a window, n points in each
    /// direction or more.
    pub(super) fn nodes(
        &self,
        window: &Rect,
        rules: Rules1d,
        n: usize,
        push: &mut dyn FnMut(Vec2, f64),
    ) {
        let slow = match self {
            Self::Quadrilateral(_) => 1,
            Self::Apex(_) => 0,
            Self::Strip(strip) => 1 - strip.height,
        };
        let rule = |axis: usize| {
            let (lo, hi) = range(window, axis);
            rules(self.points(axis, n)).on(lo, hi)
        };
        for (b, v) in rule(slow) {
            let span = if let Self::Strip(strip) = self { strip.span(b) } else { [0.0; 2] };
            for (a, w) in rule(1 - slow) {
                let (x, jacobian) = match self {
                    Self::Strip(strip) => strip.at(a, span, b),
                    _ => self.at(if slow == 0 { [b, a] } else { [a, b] }),
                };
                push(x, v * w * jacobian);
            }
        }
    }

    /// Number of Gauss points along an axis where `n` are wanted.
    fn points(&self, axis: usize, n: usize) -> usize {
        match self {
            Self::Apex(apex) if axis == 1 => (n + apex.grading.extra).min(MAX_POINTS),
            Self::Strip(strip) => strip.level.chart.points(axis, n),
            _ => n,
        }
    }

    /// The coordinate that divides a range of an axis so that parts have about the ratio of lengths
    /// in space.
    pub(super) fn between(&self, axis: usize, (lo, hi): (f64, f64), part: f64) -> f64 {
        match self {
            Self::Apex(ApexTriangle { grading: RayGrading { power, .. }, .. }) if axis == 1 => {
                let (from, to) = (lo.powf(*power), hi.powf(*power));
                (from + (to - from) * part).powf(1.0 / power).clamp(lo, hi)
            }
            _ => lo + (hi - lo) * part,
        }
    }

    /// The coordinate along an axis that is a part of the way from the anchor.
    fn least(&self, axis: usize, part: f64) -> f64 {
        match self {
            Self::Apex(apex) if axis == 1 => part.powf(1.0 / apex.grading.power),
            Self::Strip(strip) if axis != strip.height => {
                let (lo, hi) = range(&strip.window, axis);
                (strip.level.chart.least(axis, part) - lo) / (hi - lo)
            }
            _ => f64::NEG_INFINITY,
        }
    }
}

/// The interval of a window along an axis.
pub(super) fn range(window: &Rect, axis: usize) -> (f64, f64) {
    (component(window.min, axis), component(window.max, axis))
}

fn bilinear(&[a, b, c, d]: &[Vec2; 4], [xi, eta]: [f64; 2]) -> (Vec2, f64) {
    let (left, right) = (a + (d - a) * eta, b + (c - b) * eta);
    let along = right - left;
    let across = (d - a) * (1.0 - xi) + (c - b) * xi;
    (left + along * xi, along.cross(across))
}

impl ApexTriangle {
    fn at(&self, [u, t]: [f64; 2]) -> (Vec2, f64) {
        let power = self.grading.power;
        let r = t.powf(power);
        let far = self.foot + self.tangent * (self.height * u.sinh());
        let area = self.height * self.height * u.cosh();
        (far * r, power * r * t.powf(power - 1.0) * area)
    }
}

impl CurveStrip<'_> {
    /// The interval of the height at a place of the base.
    fn span(&self, base: f64) -> [f64; 2] {
        let (lo, hi) = range(&self.window, self.height);
        let at = self.base(base).max(self.level.least(1 - self.height));
        let sample = |h: f64| [h, self.level.at(self.ordered(h, at))];
        let ends = [sample(lo), sample(hi)];
        let curve = if ends[0][1] * ends[1][1] < 0.0 {
            zero(&|h| sample(h)[1], ends[0], ends[1])
        } else if ends[0][1].abs() <= ends[1][1].abs() {
            lo
        } else {
            hi
        };
        if self.above { [curve, hi] } else { [lo, curve] }
    }

    fn at(&self, way: f64, [lo, hi]: [f64; 2], base: f64) -> (Vec2, f64) {
        let p = self.ordered(lo + (hi - lo) * way, self.base(base));
        let (x, jacobian) = self.level.chart.at(p);
        let (from, to) = range(&self.window, 1 - self.height);
        (x, jacobian * (hi - lo) * (to - from))
    }

    fn base(&self, part: f64) -> f64 {
        let (lo, hi) = range(&self.window, 1 - self.height);
        lo + (hi - lo) * part
    }

    fn ordered(&self, height: f64, base: f64) -> [f64; 2] {
        if self.height == 0 { [height, base] } else { [base, height] }
    }
}

/// Charts of a convex polygon on the unit square.
pub(super) fn quadrilaterals<'c>(
    polygon: &ConvexPolygon,
) -> impl Iterator<Item = CellChart<'c>> + '_ {
    let v = &polygon.0;
    (1..v.len() - 1)
        .step_by(2)
        .map(|k| CellChart::Quadrilateral([v[0], v[k], v[k + 1], v[(k + 2).min(v.len() - 1)]]))
}
