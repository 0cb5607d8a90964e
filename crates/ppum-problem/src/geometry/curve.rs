//! Curves of cracks and rims, divided into segments so finely that the division does not show in K.
//!
//! A polygon inscribed in a curve ends at half a segment's turn to its tangent, and K is off like
//! the first power of the segments' length. Here an open curve keeps its ends and its tangents
//! there: the first and the last segment lie on them. The other vertices lie beside the curve, on
//! the outer side of the bend by κ h²/12 where segments of length h would have κ h²/8 between chord
//! and curve, so that the segments enclose as much on one side of the curve as on the other. The
//! effect of the short pieces at the tips on K, of the order h^1.5, depends on the length of the
//! first and the last segment, and vanishes at about a quarter of h.

use ppum::spline::Spline;
use ppum::vec2::{Vec2, vec2};

/// Most segments of one curve.
pub(crate) const MOST_SEGMENTS: usize = 4096;

/// Turn of the curve from vertex to vertex, in radians: K of arcs is right to 4e-5
/// then (`tests/solver/curved.rs`).
const TURN: f64 = 1.0 / 32.0;

/// Least number of segments along a curve, however little it turns: K is off by less than that turn
/// times 2e-4.
const LEAST: f64 = 16.0;

/// Length of the first and the last segment in those of the others. K of an arc of 138° in 18 and
/// in 50 segments is off by 1.2e-3 and 2e-4 at 0.408, where the tangent meets the line of the other
/// vertices, by −1.2e-4 and −7e-5 at 0.2, by 4e-4 and 4e-5 at 0.28.
const END: f64 = 0.24;

/// Places at which a curve is looked at to divide it; at each joint of a spline in addition.
const LOOKS: usize = 4096;

/// A smooth curve without corners.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum SmoothCurve {
    /// A part of an ellipse: c + R(angle) (a cos t, b sin t), from ≤ t ≤ to or back; all angles
    /// in radians.
    Ellipse { center: Vec2, axes: Vec2, angle: f64, from: f64, to: f64 },
    /// A cubic spline.
    Spline(Spline),
}

/// A curve that cannot be divided: it has a cusp, or needs more than [`MOST_SEGMENTS`] segments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TooSharp {
    /// Where it turns the most.
    pub(crate) at: Vec2,
}

/// Position, tangent and curvature at a parameter of a curve.
#[derive(Clone, Copy)]
struct CurvePoint {
    at: Vec2,
    tangent: Vec2,
    /// Curvature, positive where the curve turns left.
    curvature: f64,
    /// Length by parameter.
    speed: f64,
}

impl SmoothCurve {
    /// An arc of a circle.
    pub(crate) fn arc(center: Vec2, radius: f64, from: f64, to: f64) -> Self {
        Self::Ellipse { center, axes: vec2(radius, radius), angle: 0.0, from, to }
    }

    /// Its begin and its end.
    pub(crate) fn ends(&self) -> [Vec2; 2] {
        let [from, to] = self.range();
        [self.point(from).at, self.point(to).at]
    }

    /// The vertices of an open curve from end to end, in so many segments if given, else in as many
    /// as it takes.
    ///
    /// # Errors
    /// It takes too many.
    pub(crate) fn divided(&self, segments: Option<usize>) -> Result<Vec<Vec2>, TooSharp> {
        let walk = SegmentCounts::new(self);
        let inner = match segments {
            Some(segments) => segments.saturating_sub(2).max(1),
            None => walk.segments(2.0 * END, 2)?,
        };
        let step = walk.total() / (inner as f64 + 2.0 * END);
        let [first, last] = self.ends();
        let mut points = vec![first];
        points.extend((0..=inner).map(|k| match k {
            0 => first + walk.nodes[0].tangent * walk.length_of([0.0, END * step]),
            k if k == inner => {
                let reach = walk.length_of([walk.total() - END * step, walk.total()]);
                last - walk.last().tangent * reach
            }
            k => walk.beside((k as f64 + END) * step, step),
        }));
        points.push(last);
        Ok(points)
    }

    /// The corners of a closed curve.
    ///
    /// # Errors
    /// It takes too many.
    pub(crate) fn closed(&self, segments: Option<usize>) -> Result<Vec<Vec2>, TooSharp> {
        let walk = SegmentCounts::new(self);
        let count = match segments {
            Some(segments) => segments.max(3),
            None => walk.segments(0.0, 3)?,
        };
        let step = walk.total() / count as f64;
        Ok((0..count).map(|k| walk.beside(k as f64 * step, step)).collect())
    }

    /// The range of the parameter.
    fn range(&self) -> [f64; 2] {
        match self {
            Self::Ellipse { from, to, .. } => [*from, *to],
            Self::Spline(spline) => [0.0, spline.spans() as f64],
        }
    }

    fn point(&self, t: f64) -> CurvePoint {
        let [at, first, second] = match *self {
            Self::Ellipse { center, axes, angle, .. } => {
                let turned = |x: f64, y: f64| {
                    let (sin, cos) = angle.sin_cos();
                    vec2(cos * x - sin * y, sin * x + cos * y)
                };
                let (sin, cos) = t.sin_cos();
                let out = turned(axes.x * cos, axes.y * sin);
                [center + out, turned(-axes.x * sin, axes.y * cos), -out]
            }
            Self::Spline(ref spline) => spline.at(t),
        };
        let [from, to] = self.range();
        let way = if to < from { -1.0 } else { 1.0 };
        let speed = first.length();
        let curvature = way * first.cross(second) / (speed * speed * speed);
        CurvePoint { at, tangent: first * (way / speed), curvature, speed }
    }
}

/// A curve with the number of segments that it takes from its begin up to each of many places.
struct SegmentCounts<'c> {
    curve: &'c SmoothCurve,
    parameters: Vec<f64>,
    nodes: Vec<CurvePoint>,
    /// Length up to each place.
    lengths: Vec<f64>,
    /// Segments up to each place.
    counts: Vec<f64>,
    /// Segments by length that any part of the curve has.
    least: f64,
}

impl<'c> SegmentCounts<'c> {
    fn new(curve: &'c SmoothCurve) -> Self {
        let [from, to] = curve.range();
        let looks = match curve {
            SmoothCurve::Ellipse { .. } => LOOKS,
            // joints are among the places
            SmoothCurve::Spline(spline) => spline.spans() * LOOKS.div_ceil(spline.spans()),
        };
        let at = |k: usize| from + (to - from) * (k as f64 / looks as f64);
        let parameters: Vec<f64> = (0..=looks).map(at).collect();
        let nodes: Vec<_> = parameters.iter().map(|t| curve.point(*t)).collect();
        let step = (to - from).abs() / looks as f64;
        let lengths = summed(nodes.iter().map(|point| point.speed), step);
        let least = LEAST / lengths.last().copied().unwrap_or(1.0);
        let mut walk = Self { curve, parameters, nodes, lengths, counts: Vec::new(), least };
        walk.counts = summed(walk.nodes.iter().map(|p| walk.density(p) * p.speed), step);
        walk
    }

    /// Segments by length at a place.
    fn density(&self, point: &CurvePoint) -> f64 {
        (point.curvature / TURN).hypot(self.least)
    }

    fn total(&self) -> f64 {
        self.counts.last().copied().unwrap_or(0.0)
    }

    fn last(&self) -> &CurvePoint {
        &self.nodes[self.nodes.len() - 1]
    }

    /// The number of whole segments, and of `ends` more, that the curve takes.
    fn segments(&self, ends: f64, least: usize) -> Result<usize, TooSharp> {
        let count = (self.total() - ends).ceil();
        if count < MOST_SEGMENTS as f64 {
            return Ok((count.max(0.0) as usize).max(least));
        }
        let turns =
            |a: &&CurvePoint, b: &&CurvePoint| a.curvature.abs().total_cmp(&b.curvature.abs());
        Err(TooSharp { at: self.nodes.iter().max_by(turns).map_or(Vec2::ZERO, |point| point.at) })
    }

    /// Number of the place before a count, and how far it lies beyond.
    fn find(&self, count: f64) -> (usize, f64) {
        let after = self.counts.partition_point(|c| *c <= count).clamp(1, self.counts.len() - 1);
        let [from, to] = [self.counts[after - 1], self.counts[after]];
        (after - 1, if to > from { ((count - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 })
    }

    fn length_of(&self, counts: [f64; 2]) -> f64 {
        let [from, to] = counts.map(|count| {
            let (k, part) = self.find(count);
            self.lengths[k] + (self.lengths[k + 1] - self.lengths[k]) * part
        });
        to - from
    }

    /// The vertex at a count, beside the curve on the outer side of its bend, of segments of `step`
    /// counts.
    fn beside(&self, count: f64, step: f64) -> Vec2 {
        let (k, part) = self.find(count);
        let t = self.parameters[k] + (self.parameters[k + 1] - self.parameters[k]) * part;
        let point = self.curve.point(t);
        let length = step / self.density(&point);
        point.at - point.tangent.left() * (point.curvature * length * length / 12.0)
    }
}

/// The integral up to each of equidistant places (trapezoidal rule).
fn summed(values: impl Iterator<Item = f64>, step: f64) -> Vec<f64> {
    let mut before = None;
    let mut sum = 0.0;
    let add = |value: f64| {
        sum += before.map_or(0.0, |before: f64| 0.5 * step * (before + value));
        before = Some(value);
        sum
    };
    values.map(add).collect()
}

/// Turn of an arc, in radians, below which it is straight: its height is an eighth of that.
const STRAIGHT: f64 = 1e-6;

/// The vertices of an arc that begins at a point in a direction (an angle to the x axis), with a
/// curvature, positive where it turns left; the point itself is none of them. It turns by less than
/// a whole turn.
pub fn arc_from(at: Vec2, direction: f64, curvature: f64, length: f64) -> Vec<Vec2> {
    let along = vec2(direction.cos(), direction.sin());
    let turn = curvature * length;
    if turn.abs() < STRAIGHT {
        return vec![at + along * length];
    }
    let radius = curvature.recip().abs();
    let center = at + along.left() * curvature.recip();
    let out = at - center;
    let from = out.y.atan2(out.x);
    let segments = (turn.abs() / TURN).ceil() as usize + 2;
    // it ends on its tangents, and has no cusp
    let points = SmoothCurve::arc(center, radius, from, from + turn).divided(Some(segments));
    points.map_or_else(|_| vec![at + along * length], |points| points[1..].to_vec())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use ppum_testkit::random::Random;

    fn area(points: &[Vec2]) -> f64 {
        let n = points.len();
        (0..n).map(|k| points[k].cross(points[(k + 1) % n])).sum::<f64>() * 0.5
    }

    /// Polygons of closed curves have their area: π a b, to fourth order.
    #[test]
    fn areas_of_ellipses() {
        let mut random = Random(5);
        for _ in 0..20 {
            let mut number = || random.between(0.2, 1.0);
            let (axes, angle) = (vec2(number(), number()), 7.0 * number());
            let [from, to] = [0.0, TAU];
            let curve = SmoothCurve::Ellipse { center: vec2(0.3, -0.2), axes, angle, from, to };
            let exact = std::f64::consts::PI * axes.x * axes.y;
            let error = |n| (area(&curve.closed(n).expect("smooth")) / exact - 1.0).abs();
            let (coarse, fine) = (error(Some(40)), error(Some(80)));
            assert!(error(None) < 2e-7 && fine < coarse / 10.0, "{coarse} {fine} {}", error(None));
        }
    }

    /// Ends and tangents there are those of the curve; the others turn by 1/32; whichever way
    /// it runs.
    #[test]
    fn arcs_end_on_their_tangents() {
        let mut random = Random(6);
        for _ in 0..50 {
            let (from, sweep) = (random.between(-4.0, 4.0), random.between(-3.0, 3.0));
            let curve = SmoothCurve::arc(vec2(1.0, 2.0), 0.5, from, from + sweep);
            let points = curve.divided(None).expect("smooth");
            let way = sweep.signum();
            for (end, first, angle) in [
                (points[0], points[1], from),
                (points[points.len() - 1], points[points.len() - 2], from + sweep),
            ] {
                let out = vec2(angle.cos(), angle.sin());
                assert!((end - vec2(1.0, 2.0) - out * 0.5).length() < 1e-15);
                assert!(out.dot(first - end).abs() < 1e-15, "on the tangent");
                let ahead = out.left() * if angle == from { way } else { -way };
                assert!(ahead.dot(first - end) > 0.0, "in its direction");
            }
            let turns = points.windows(3).map(|p| {
                let (a, b) = (p[1] - p[0], p[2] - p[1]);
                way * a.cross(b).atan2(a.dot(b))
            });
            assert!(turns.into_iter().all(|turn| turn > 0.0 && turn < 1.07 * TURN));
            let back = SmoothCurve::arc(vec2(1.0, 2.0), 0.5, from + sweep, from).divided(None);
            let back = back.expect("smooth");
            assert_eq!(back.len(), points.len());
            let apart = back.iter().rev().zip(&points).map(|(a, b)| (*a - *b).length());
            // sums of some thousand terms
            assert!(apart.fold(0.0, f64::max) < 1e-11);
        }
    }

    /// A straight spline is divided into a few segments on its line.
    #[test]
    fn straight_splines() {
        let points = [[0.0, 0.0], [1.0, 0.5], [1.5, 0.75], [4.0, 2.0]].map(Vec2::from);
        let curve = SmoothCurve::Spline(Spline::open(&points));
        let found = curve.divided(None).expect("smooth");
        assert!(found.len() <= 19, "{}", found.len());
        assert!(found.iter().all(|p| p.cross(vec2(4.0, 2.0)).abs() < 1e-14));
        assert_eq!((found[0], found[found.len() - 1]), (points[0], points[3]));
    }

    /// A curve that stops and turns back is no crack.
    #[test]
    fn cusps_are_refused() {
        let flat = SmoothCurve::Ellipse {
            center: Vec2::ZERO,
            axes: vec2(1.0, 1e-6),
            angle: 0.0,
            from: -1.0,
            to: 1.0,
        };
        let TooSharp { at } = flat.divided(None).expect_err("too sharp");
        assert!((at - vec2(1.0, 0.0)).length() < 1e-9, "{at:?}");
    }
}
