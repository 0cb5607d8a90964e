//! B-splines and Bézier curves, made arcs as finely as a tolerance asks.

use ppum::arc_spline::arc_spline;
use ppum::segment;
use ppum::smooth_curve::MOST_ARCS;
use ppum::vec2::Vec2;

use crate::affine::PlaneMap;
use crate::curve::PlaneCurve;

/// Points by span of the polyline that stands for a curve with a cusp.
const BY_SPAN: usize = 64;

/// Part of a span beside which a curve that stops has its tangent: in an end of a Bézier curve of
/// two equal points.
const BESIDE: f64 = 1e-6;

/// Highest degree that is read.
const HIGHEST: usize = 15;

/// A rational B-spline: Σ N_i w_i p_i / Σ N_i w_i.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct BSpline {
    degree: usize,
    knots: Vec<f64>,
    points: Vec<Vec2>,
    weights: Vec<f64>,
}

impl BSpline {
    /// Nothing if the numbers of knots, points and weights do not fit, knots fall, or a weight
    /// is not positive. Without weights all are 1.
    pub(crate) fn new(
        degree: usize,
        knots: Vec<f64>,
        points: Vec<Vec2>,
        weights: Vec<f64>,
    ) -> Option<Self> {
        let weights = if weights.is_empty() { vec![1.0; points.len()] } else { weights };
        let is_valid = (1..=HIGHEST).contains(&degree)
            && points.len() > degree
            && knots.len() == points.len() + degree + 1
            && weights.len() == points.len()
            && knots.windows(2).all(|k| k[0] <= k[1])
            && knots[degree] < knots[points.len()]
            && knots.iter().all(|k| k.is_finite())
            && weights.iter().all(|w| *w > 0.0 && w.is_finite());
        is_valid.then_some(Self { degree, knots, points, weights })
    }

    /// A Bézier curve of any degree from 1.
    pub(crate) fn bezier(points: &[Vec2]) -> Option<Self> {
        let knots = [vec![0.0; points.len()], vec![1.0; points.len()]].concat();
        Self::new(points.len().checked_sub(1)?, knots, points.to_vec(), Vec::new())
    }

    /// A B-spline with equal knots that begins and ends in its first and last point.
    pub(crate) fn clamped(degree: usize, points: &[Vec2]) -> Option<Self> {
        let spans = points.len().checked_sub(degree)?;
        let knot = |k: usize| k.saturating_sub(degree).min(spans) as f64;
        let knots = (0..=points.len() + degree).map(knot).collect();
        Self::new(degree, knots, points.to_vec(), Vec::new())
    }

    pub(crate) fn mapped(mut self, map: &PlaneMap) -> Self {
        self.points.iter_mut().for_each(|p| *p = map.point(*p));
        self
    }

    pub(crate) fn points(&self) -> &[Vec2] {
        &self.points
    }

    /// The point at a parameter and the derivative there (de Boor 1972), in the span that begins
    /// with knot number `span`.
    fn at(&self, span: usize, t: f64) -> [Vec2; 2] {
        let first = span - self.degree;
        let weighted = |k: usize| (self.points[k] * self.weights[k], self.weights[k]);
        let mut row: Vec<_> = (first..=span).map(weighted).collect();
        let mut slope = (Vec2::ZERO, 0.0);
        for level in 1..=self.degree {
            for k in (level..=self.degree).rev() {
                let [from, to] =
                    [self.knots[first + k], self.knots[first + k + self.degree + 1 - level]];
                let s = (t - from) / (to - from);
                let ((a, v), (b, w)) = (row[k - 1], row[k]);
                let rate = self.degree as f64 / (to - from);
                slope = ((b - a) * rate, (w - v) * rate);
                row[k] = (a * (1.0 - s) + b * s, v * (1.0 - s) + w * s);
            }
        }
        let (point, weight) = row[self.degree];
        let at = point / weight;
        [at, (slope.0 - at * slope.1) / weight]
    }

    /// The point and the unit tangent at a part of a span.
    fn tangent_at(&self, span: usize, part: f64) -> [Vec2; 2] {
        let [from, to] = [self.knots[span], self.knots[span + 1]];
        let at = |part: f64| self.at(span, from + (to - from) * part);
        let size = self.points.iter().map(|p| (*p - self.points[0]).length()).fold(0.0, f64::max);
        let [point, slope] = at(part);
        let stops = slope.length() * (to - from) <= BESIDE * size;
        let inner = part + BESIDE * (0.5 - part);
        [point, if stops { at(inner)[1].unit() } else { slope.unit() }]
    }

    /// The spans that are no points, by the numbers of their knots; those apart where the curve
    /// may have a corner.
    fn smooth_runs(&self) -> Vec<Vec<usize>> {
        let mut runs: Vec<Vec<usize>> = Vec::new();
        for span in (self.degree..self.points.len()).filter(|k| self.knots[*k] < self.knots[k + 1])
        {
            let before = self.knots.partition_point(|k| *k < self.knots[span]);
            let multiplicity = span + 1 - before;
            match runs.last_mut() {
                Some(run) if multiplicity < self.degree => run.push(span),
                _ => runs.push(vec![span]),
            }
        }
        runs
    }

    /// The curves that stand for it, and whether one has a cusp.
    pub(crate) fn fitted(&self, tolerance: f64) -> (Vec<PlaneCurve>, bool) {
        let fits = self.smooth_runs().into_iter().map(|run| self.fitted_run(&run, tolerance));
        let (curves, cusps): (Vec<_>, Vec<bool>) = fits.unzip();
        (curves, cusps.contains(&true))
    }

    /// The arcs that stand for a run of spans, or the segment that it is. A curve that stops
    /// somewhere becomes a polyline.
    fn fitted_run(&self, run: &[usize], tolerance: f64) -> (PlaneCurve, bool) {
        let at = |t: f64| {
            let k = (t as usize).min(run.len() - 1);
            self.tangent_at(run[k], t - k as f64)
        };
        let point = |k: usize, by: usize| at(k as f64 / by as f64)[0];
        let ends = [point(0, 1), point(run.len(), 1)];
        if (0..16 * run.len()).all(|k| segment::distance(ends, point(k, 16)) < 0.1 * tolerance) {
            return (PlaneCurve::Polyline(ends.to_vec()), false);
        }
        match arc_spline(at, [0.0, run.len() as f64], tolerance, MOST_ARCS) {
            Ok(edges) => (PlaneCurve::Edges(edges), false),
            Err(_) => {
                let points = (0..=BY_SPAN * run.len()).map(|k| point(k, BY_SPAN));
                let mut points: Vec<Vec2> = points.collect();
                points.dedup();
                (PlaneCurve::Polyline(points), true)
            }
        }
    }
}
