//! Parts of an edge, graded where it passes a singular point.

use super::adapt::Subregion;
use super::gauss::{MAX_POINTS, Rules1d};
use super::geometry::RayGrading;
use ppum::edge::EdgeFrame;
use ppum::vec2::Vec2;

/// Longest part of an arc that gets one rule, in radians. A polynomial of degree 2p of the position
/// is smooth there: with the points added below its integral is exact to rounding.
pub(super) const LONGEST: f64 = 0.4;

/// Gauss points more than along a straight line on the longest part, for sines and cosines.
const EXTRA_POINTS: f64 = 3.0;

/// Coordinate s along an edge as a function of the parameter that Gauss rules are laid out in.
#[derive(Clone, Copy)]
pub(super) enum LineParameter {
    /// The coordinate itself.
    Straight,
    /// s = d sinh u, for a singular point at the distance d.
    Beside(f64),
    /// s = sign t^power, for a singular point on the line.
    Through { sign: f64, grading: RayGrading },
}

/// The points of an edge, relative to an anchor, for an interval of the parameter.
#[derive(Clone)]
pub(super) struct GradedInterval {
    pub(super) path: LineParameter,
    pub(super) frame: EdgeFrame,
    pub(super) interval: (f64, f64),
}

impl LineParameter {
    /// s and |ds/du|.
    fn at(&self, u: f64) -> (f64, f64) {
        match *self {
            Self::Straight => (u, 1.0),
            Self::Beside(d) => (d * u.sinh(), d * u.cosh()),
            Self::Through { sign, grading: RayGrading { power, .. } } => {
                (sign * u.powf(power), power * u.powf(power - 1.0))
            }
        }
    }

    fn extra_points(&self) -> usize {
        if let Self::Through { grading, .. } = self { grading.extra } else { 0 }
    }
}

impl GradedInterval {
    fn part(&self, lo: f64, hi: f64) -> Self {
        Self { interval: (lo, hi), ..*self }
    }

    /// Gauss points where `n` are enough for polynomials of s.
    fn points(&self, n: usize) -> usize {
        let [from, to] = [self.interval.0, self.interval.1].map(|u| self.path.at(u).0);
        let turn = (self.frame.curvature * (to - from)).abs();
        let extra = (EXTRA_POINTS * (turn / LONGEST).min(1.0)).ceil() as usize;
        (n + self.path.extra_points() + extra).min(MAX_POINTS)
    }
}

impl Subregion for GradedInterval {
    fn nodes(&self, rules: Rules1d, n: usize, push: &mut dyn FnMut(Vec2, f64)) {
        let (lo, hi) = self.interval;
        for (u, w) in rules(self.points(n)).on(lo, hi) {
            let (s, slope) = self.path.at(u);
            push(self.frame.at(s), w * slope);
        }
    }

    fn divisions(&self, _: &[Vec2]) -> Vec<[Self; 2]> {
        let (lo, hi) = self.interval;
        let mid = 0.5 * (lo + hi);
        vec![[self.part(lo, mid), self.part(mid, hi)]]
    }
}
