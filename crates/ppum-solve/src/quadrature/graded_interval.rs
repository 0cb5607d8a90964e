//! Parts of a segment, graded where it passes a singular point.

use super::adapt::Subregion;
use super::gauss::{MAX_POINTS, Rules1d};
use super::geometry::RayGrading;
use ppum::vec2::Vec2;

/// Coordinate s along a line as a function of the parameter that Gauss rules are laid out in.
#[derive(Clone, Copy)]
pub(super) enum LineParameter {
    /// The coordinate itself.
    Straight,
    /// s = d sinh u, for a singular point at the distance d.
    Beside(f64),
    /// s = sign t^power, for a singular point on the line.
    Through { sign: f64, grading: RayGrading },
}

/// The points foot + s · tangent, relative to an anchor, for an interval of the parameter.
#[derive(Clone)]
pub(super) struct GradedInterval {
    pub(super) path: LineParameter,
    pub(super) foot: Vec2,
    pub(super) tangent: Vec2,
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

    fn points(&self, n: usize) -> usize {
        match self {
            Self::Through { grading, .. } => (n + grading.extra).min(MAX_POINTS),
            _ => n,
        }
    }
}

impl GradedInterval {
    fn part(&self, lo: f64, hi: f64) -> Self {
        Self { interval: (lo, hi), ..*self }
    }
}

impl Subregion for GradedInterval {
    fn nodes(&self, rules: Rules1d, n: usize, push: &mut dyn FnMut(Vec2, f64)) {
        let (lo, hi) = self.interval;
        for (u, w) in rules(self.path.points(n)).on(lo, hi) {
            let (s, slope) = self.path.at(u);
            push(self.foot + self.tangent * s, w * slope);
        }
    }

    fn divisions(&self, _: &[Vec2]) -> Vec<[Self; 2]> {
        let (lo, hi) = self.interval;
        let mid = 0.5 * (lo + hi);
        vec![[self.part(lo, mid), self.part(mid, hi)]]
    }
}
