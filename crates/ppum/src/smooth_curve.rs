//! Curves of cracks and rims as arcs of circles.

use crate::arc_spline::{TooSharp, arc_spline};
use crate::edge::Edge;
use crate::spline::Spline;
use crate::vec2::{Rect, Vec2, vec2};

/// Most arcs of one curve: as many as the rims of a body may have.
pub const MOST_ARCS: usize = 1 << 14;

/// Largest distance of the arcs from the curve, in parts of its size: no more than the distance at
/// which things touch.
const TOLERANCE: f64 = 1e-9;

/// Largest sweep of one arc of a circle, in radians.
const LARGEST_SWEEP: f64 = 4.0;

/// A smooth curve without corners.
#[derive(Clone, Debug, PartialEq)]
pub enum SmoothCurve {
    /// A part of an ellipse: c + R(angle) (a cos t, b sin t), from ≤ t ≤ to or back; all angles
    /// in radians.
    Ellipse {
        /// The centre c.
        center: Vec2,
        /// The half axes a and b.
        axes: Vec2,
        /// The angle of the first axis.
        angle: f64,
        /// The parameter at its begin.
        from: f64,
        /// The parameter at its end.
        to: f64,
    },
    /// A cubic spline.
    Spline(Spline),
}

impl SmoothCurve {
    /// An arc of a circle.
    #[must_use]
    pub fn arc(center: Vec2, radius: f64, from: f64, to: f64) -> Self {
        Self::Ellipse { center, axes: vec2(radius, radius), angle: 0.0, from, to }
    }

    /// The edges of the curve: arcs of a circle as they are, of other curves as many as it takes.
    ///
    /// # Errors
    /// The place where it is too sharp for arcs.
    pub fn edges(&self) -> Result<Vec<Edge>, Vec2> {
        if let Self::Ellipse { center, axes, angle, from, to } = *self
            && axes.x == axes.y
        {
            return Ok(arcs(center, axes.x, [from + angle, to + angle]));
        }
        let range = match self {
            Self::Ellipse { from, to, .. } => [*from, *to],
            Self::Spline(spline) => [0.0, spline.spans() as f64],
        };
        let way = if range[1] < range[0] { -1.0 } else { 1.0 };
        let at = |t: f64| {
            let [at, slope] = self.at(t);
            [at, slope.unit() * way]
        };
        let sharp = |TooSharp { parameter }| self.at(parameter)[0];
        arc_spline(at, range, TOLERANCE * self.size(), MOST_ARCS).map_err(sharp)
    }

    /// The point at a parameter, and the derivative there.
    fn at(&self, t: f64) -> [Vec2; 2] {
        match self {
            Self::Ellipse { center, axes, angle, .. } => {
                let ((sin, cos), across) = (t.sin_cos(), vec2(angle.cos(), angle.sin()));
                let turned = |x: f64, y: f64| across * x + across.left() * y;
                [*center + turned(axes.x * cos, axes.y * sin), turned(-axes.x * sin, axes.y * cos)]
            }
            Self::Spline(spline) => {
                let [at, slope, _] = spline.at(t);
                [at, slope]
            }
        }
    }

    /// The longer half axis, or the size of the box around the points of a spline.
    fn size(&self) -> f64 {
        match self {
            Self::Ellipse { axes, .. } => axes.x.max(axes.y),
            Self::Spline(spline) => {
                let points = (0..=spline.spans()).map(|k| spline.at(k as f64)[0]);
                let around = |all: Rect, p| all.union(&Rect::new(p, p));
                let size = points.fold(Rect::EMPTY, around).size();
                size.x.max(size.y)
            }
        }
    }
}

/// An arc of a circle, in equal parts if it is longer than one edge may be.
fn arcs(center: Vec2, radius: f64, [from, to]: [f64; 2]) -> Vec<Edge> {
    let count = ((to - from).abs() / LARGEST_SWEEP).ceil().max(1.0) as u32;
    let at = |k: u32| from + (to - from) * (f64::from(k) / f64::from(count));
    (0..count).map(|k| Edge::around(center, radius, [at(k), at(k + 1)])).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;
    use crate::domain::Hole;
    use ppum_testkit::random::Random;

    /// Closed chains of arcs have the area of the ellipse, π a b.
    #[test]
    fn areas_of_ellipses() {
        let mut random = Random(5);
        for _ in 0..20 {
            let mut number = || random.between(0.2, 1.0);
            let (axes, angle) = (vec2(number(), number()), 7.0 * number());
            let curve =
                SmoothCurve::Ellipse { center: vec2(0.3, -0.2), axes, angle, from: 0.0, to: TAU };
            let edges = curve.edges().expect("smooth");
            let area: f64 = edges.iter().map(|edge| edge.area_from(Vec2::ZERO)).sum();
            assert!((area / (PI * axes.x * axes.y) - 1.0).abs() < 5e-9, "{area}");
        }
    }

    /// Arcs of circles are one edge or two, with the circle's ends, whichever way they run.
    #[test]
    fn arcs_are_arcs() {
        let mut random = Random(6);
        for _ in 0..200 {
            let (from, sweep) = (random.between(-4.0, 4.0), random.between(-6.2, 6.2));
            let edges = SmoothCurve::arc(vec2(1.0, 2.0), 0.5, from, from + sweep).edges();
            let edges = edges.expect("smooth");
            assert_eq!(edges.len(), 1 + usize::from(sweep.abs() > LARGEST_SWEEP));
            let whole: f64 = edges.iter().map(Edge::sweep).sum();
            assert!((whole - sweep).abs() < 1e-13);
            for edge in &edges {
                assert!((edge.curvature() * sweep.signum() - 2.0).abs() < 1e-12);
            }
            let last = edges[edges.len() - 1].to - vec2(1.0, 2.0);
            let angle = from + sweep;
            assert!((last - vec2(angle.cos(), angle.sin()) * 0.5).length() < 1e-14);
        }
    }

    /// A spline moved by 10⁻¹³ takes as many arcs and ends where it did; its rim holds the same
    /// points.
    #[test]
    fn splines_do_not_hang_on_rounding() {
        let mut random = Random(7);
        for _ in 0..10 {
            let turn = |k: u32| f64::from(k) * TAU / 7.0;
            let radius: Vec<f64> = (0..7).map(|_| random.between(0.8, 1.2)).collect();
            let points = |shift: f64| -> Vec<Vec2> {
                let at = |k: u32| vec2(turn(k).cos(), turn(k).sin()) * radius[k as usize];
                (0..7).map(|k| at(k) + vec2(shift, -shift)).collect()
            };
            let rim = |shift: f64| {
                let edges = SmoothCurve::Spline(Spline::closed(&points(shift))).edges();
                let edges = edges.expect("smooth");
                Hole::enclosed(&edges)
            };
            let (one, other) = (rim(0.0), rim(1e-13));
            assert!(one.edges().count().abs_diff(other.edges().count()) < 10);
            for p in one.edges().map(|edge| edge.at(0.3)) {
                assert!(other.rim_distance(p) < 5e-9);
            }
        }
    }

    /// A curve that stops and turns back is no crack.
    #[test]
    fn cusps_are_refused() {
        let (center, axes) = (Vec2::ZERO, vec2(1.0, 1e-8));
        let flat = SmoothCurve::Ellipse { center, axes, angle: 0.0, from: -1.0, to: 1.0 };
        let at = flat.edges().expect_err("too sharp");
        assert!((at - vec2(1.0, 0.0)).length() < 1e-3, "{at:?}");
    }
}
