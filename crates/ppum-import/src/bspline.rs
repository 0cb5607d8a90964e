//! B-splines and Bézier curves, made splines of the problem file as finely as a tolerance asks.

use ppum::segment;
use ppum::spline::Spline;
use ppum::vec2::Vec2;

use crate::affine::PlaneMap;
use crate::curve::PlaneCurve;

/// Most spans of the spline that stands for a smooth curve.
const MOST_SPANS: usize = 1024;

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

    /// The point at a parameter (de Boor 1972), in the span that begins with knot number `span`.
    fn at(&self, span: usize, t: f64) -> Vec2 {
        let first = span - self.degree;
        let weighted = |k: usize| (self.points[k] * self.weights[k], self.weights[k]);
        let mut row: Vec<_> = (first..=span).map(weighted).collect();
        for level in 1..=self.degree {
            for k in (level..=self.degree).rev() {
                let [from, to] =
                    [self.knots[first + k], self.knots[first + k + self.degree + 1 - level]];
                let s = (t - from) / (to - from);
                let ((a, v), (b, w)) = (row[k - 1], row[k]);
                row[k] = (a * (1.0 - s) + b * s, v * (1.0 - s) + w * s);
            }
        }
        let (point, weight) = row[self.degree];
        point / weight
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

    /// Points of a run of spans, `parts` by span.
    fn sampled(&self, run: &[usize], parts: usize) -> Vec<Vec2> {
        let points = run.iter().flat_map(|&span| {
            let [from, to] = [self.knots[span], self.knots[span + 1]];
            (0..parts).map(move |k| self.at(span, from + (to - from) * (k as f64 / parts as f64)))
        });
        let end = run.last().map(|&span| self.at(span, self.knots[span + 1]));
        points.chain(end).collect()
    }

    /// The curves of the problem file that stand for it, and their largest distance to it, which
    /// is below the tolerance unless the curve has a cusp.
    pub(crate) fn fitted(&self, tolerance: f64) -> (Vec<PlaneCurve>, f64) {
        let fits = self.smooth_runs().into_iter().map(|run| self.fitted_run(&run, tolerance));
        let (curves, distances): (Vec<_>, Vec<f64>) = fits.unzip();
        (curves, distances.into_iter().fold(0.0, f64::max))
    }

    /// Halves the parts of the spans until points between those of the spline lie on it. A curve
    /// that stops somewhere becomes a polyline.
    fn fitted_run(&self, run: &[usize], tolerance: f64) -> (PlaneCurve, f64) {
        let fine = self.sampled(run, 16);
        let ends = [fine[0], fine[fine.len() - 1]];
        if fine.iter().all(|p| segment::distance(ends, *p) < 1e-3 * tolerance) {
            return (PlaneCurve::Polyline(ends.to_vec()), 0.0);
        }
        let mut parts = 4;
        loop {
            let (points, between) = (self.sampled(run, parts), self.sampled(run, 4 * parts));
            let distance = distance_of_spline(&points, &between);
            if distance <= tolerance {
                return (PlaneCurve::Spline(points), distance);
            }
            parts *= 2;
            if parts * run.len() > MOST_SPANS {
                return polyline(points, &between);
            }
        }
    }
}

/// The polyline through points, and the largest distance of the points amid its segments, three
/// each.
fn polyline(mut points: Vec<Vec2>, between: &[Vec2]) -> (PlaneCurve, f64) {
    let chords = points.windows(2).zip(between.chunks(4));
    let distances = chords
        .flat_map(|(chord, of)| of.iter().map(|p| segment::distance([chord[0], chord[1]], *p)));
    let largest = distances.fold(0.0, f64::max);
    points.dedup();
    (PlaneCurve::Polyline(points), largest)
}

/// Largest distance of points, four by span, to the spline through every fourth of them, by
/// Newton's method; infinite where the spline does not exist.
fn distance_of_spline(points: &[Vec2], between: &[Vec2]) -> f64 {
    if points.windows(2).any(|p| p[0] == p[1]) {
        return f64::INFINITY;
    }
    let spline = Spline::open(points);
    let distance = |(k, p): (usize, &Vec2)| {
        let mut t = k as f64 / 4.0;
        for _ in 0..3 {
            let [at, slope, _] = spline.at(t);
            t += (*p - at).dot(slope) / slope.dot(slope);
        }
        (*p - spline.at(t)[0]).length()
    };
    let largest = between
        .iter()
        .enumerate()
        .map(distance)
        .fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a });
    if largest.is_nan() { f64::INFINITY } else { largest }
}
