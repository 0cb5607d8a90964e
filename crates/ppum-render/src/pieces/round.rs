//! Round holes: tangents of their rims.

use std::f64::consts::{PI, TAU};

use super::cut::{AnchoredPolygon, PolygonCut};
use super::{SAGITTA, contains};
use ppum::domain::{Hole, LocalRim};
use ppum::vec2::{Rect, Vec2, vec2};

/// Fewest tangents that stand for a rim.
const LEAST: f64 = 12.0;

/// A round hole seen from the anchor.
#[derive(Debug)]
pub(crate) struct AnchoredCircle {
    /// Anchor minus centre: its length and its direction.
    pub(crate) away: f64,
    pub(crate) direction: Vec2,
    /// |anchor − centre|² − r², formed without cancellation.
    pub(crate) excess: f64,
    pub(crate) radius: f64,
}

impl AnchoredCircle {
    /// `None` for polygons.
    pub(crate) fn new(hole: &Hole, anchor: Vec2) -> Option<Self> {
        let local = hole.at(anchor);
        let (Hole::Circle { radius, .. }, LocalRim::Circle { d, excess }) = (hole, local.rim())
        else {
            return None;
        };
        let away = d.length();
        let direction = if away > 0.0 { *d / away } else { vec2(1.0, 0.0) };
        Some(Self { away, direction, excess: *excess, radius: *radius })
    }

    pub(crate) fn center(&self) -> Vec2 {
        self.direction * -self.away
    }

    /// |p − centre|² − r²
    fn power(&self, p: Vec2) -> f64 {
        self.excess + (self.direction * (2.0 * self.away) + p).dot(p)
    }

    /// True if a rectangle is partly inside.
    pub(super) fn meets(&self, rect: &Rect) -> bool {
        let nearest = self.center().max(rect.min).min(rect.max);
        self.power(nearest) < 0.0 && !rect.corners().iter().all(|&p| self.power(p) < 0.0)
    }

    /// The parts of a polygon outside tangents of the rim, in a square of a size.
    pub(super) fn outside(
        &self,
        polygon: AnchoredPolygon,
        size: f64,
        least: f64,
    ) -> Vec<AnchoredPolygon> {
        if polygon.corners.iter().all(|&p| self.power(p) < 0.0) {
            return Vec::new();
        }
        let (first, last, step) = self.tangents(&polygon.corners, size);
        let (mut parts, mut inner) = (Vec::new(), Some(polygon));
        for k in first..=last {
            let Some(polygon) = inner.take() else { break };
            let [outer, rest] = polygon.split(&self.tangent(k as f64 * step, step), least);
            parts.extend(outer);
            inner = rest;
        }
        // inside all tangents of a polygon's sector is inside the hole, or a sliver beside it
        parts
    }

    /// First and last tangent beside a polygon, and the angle between neighbours: tangents are the
    /// same for all squares of a size.
    fn tangents(&self, corners: &[Vec2], size: f64) -> (i64, i64, f64) {
        // the corner of two tangents is r (1/cos(step/2) − 1) ≈ r step²/8 away from the rim
        let step = (8.0 * SAGITTA * size / self.radius).sqrt();
        let count = (TAU / step).ceil().max(LEAST);
        let step = TAU / count;
        let angles: Vec<f64> = corners.iter().map(|&corner| self.angle(corner)).collect();
        let [lo, hi] = turns(&angles);
        if contains(corners, self.center()) {
            return (0, count as i64 - 1, step);
        }
        let at = |turn: f64| (angles[0] + turn) / step;
        (at(lo).floor() as i64, at(hi).ceil() as i64, step)
    }

    /// The angle of a point, seen from the centre, from the direction to the anchor.
    pub(crate) fn angle(&self, p: Vec2) -> f64 {
        self.direction.cross(p).atan2(self.away + self.direction.dot(p))
    }

    /// The tangent at an angle from the direction to the anchor; the hole is on its left.
    fn tangent(&self, angle: f64, step: f64) -> PolygonCut {
        let (sin, cos) = angle.sin_cos();
        let normal = self.direction * cos + self.direction.left() * sin;
        let beyond = self.excess / (self.away + self.radius);
        let fall = 2.0 * self.away * (0.5 * angle).sin().powi(2);
        // normal · (anchor − centre) − r, without cancellation where the angle is small
        let outward = beyond - fall;
        let tangent = normal.left();
        let (middle, half) = (self.away * sin, self.radius * (0.5 * step).tan());
        PolygonCut::along(tangent, -outward, [middle - half, middle + half])
    }
}

/// The range of the turns, each by half a circle at most, that lead from the first of some angles
/// to the others.
pub(crate) fn turns(angles: &[f64]) -> [f64; 2] {
    let turn = |angle: &f64| match angle - angles[0] {
        turn if turn > PI => turn - TAU,
        turn if turn < -PI => turn + TAU,
        turn => turn,
    };
    angles.iter().map(turn).fold([0.0f64; 2], |[a, b], turn| [a.min(turn), b.max(turn)])
}
