//! Edges and vertices of cracks seen from an anchor.

use super::Crack;
use crate::compensated::cross;
use crate::edge::Edge;
use crate::vec2::Vec2;
use ppum_formula::real::Real;

/// One edge: coordinates of a point are `along` its line, from the anchor, and `distance` from
/// it, positive on the left. The ends of a segment are at `lo` and `hi` along it, each the small
/// number it is when the anchor is near that end.
///
/// The line of an arc is the tangent of its circle at the point Q nearest to the anchor. With
/// coordinates u and v = distance + normal·offset from Q a point is in the distance
///
/// ```text
/// d = p/(1 + √(1 − κ p))        p = 2 v − κ (u² + v²)
/// ```
///
/// from the circle, which is v of a segment, κ = 0.
#[derive(Clone, Copy, Debug)]
pub struct LocalSegment {
    /// Unit vector along the line.
    pub tangent: Vec2,
    /// Unit vector to its left; zero if all points lie on the edge.
    normal: Vec2,
    /// Distance of the anchor from the line, positive on its left.
    pub distance: f64,
    /// The curvature κ, positive of an edge that turns left; zero of a segment.
    pub curvature: f64,
    /// Begin of a segment, along it from the anchor; −∞ of a crack's first segment.
    pub lo: f64,
    /// End of a segment; +∞ of a crack's last segment.
    pub hi: f64,
    /// True of an arc of more than half a turn.
    pub is_major: bool,
}

/// A vertex of a crack with arcs.
#[derive(Clone, Copy, Debug)]
pub struct LocalVertex {
    /// The vertex minus the anchor.
    pub at: Vec2,
    /// Unit tangents of the edges before and behind; at an end of the crack that of its edge,
    /// twice.
    pub tangents: [Vec2; 2],
}

impl LocalSegment {
    /// The edge seen from `anchor`.
    pub(crate) fn new(edge: Edge, anchor: Vec2) -> Self {
        let Edge { from: a, to: b, bulge } = edge;
        let (tangent, distance) = if edge.is_arc() {
            (edge.tangent_towards(anchor), edge.side(anchor))
        } else {
            ((b - a).unit(), cross(a, b, anchor) / (b - a).length())
        };
        let [lo, hi] = [a, b].map(|end| tangent.dot(end - anchor));
        let (curvature, is_major) = (edge.curvature(), bulge.abs() > 1.0);
        Self { tangent, normal: tangent.left(), distance, curvature, lo, hi, is_major }
    }

    /// The edges of a crack, the first and the last one without end.
    pub(super) fn all(crack: &Crack, anchor: Vec2) -> Vec<Self> {
        let mut all: Vec<_> = crack.edges().map(|edge| Self::new(edge, anchor)).collect();
        if let Some(first) = all.first_mut() {
            first.lo = f64::NEG_INFINITY;
        }
        if let Some(last) = all.last_mut() {
            last.hi = f64::INFINITY;
        }
        all
    }

    /// The tangent at a tip seen from `anchor`, as a line that ends there.
    pub(super) fn at_tip(tip: Vec2, tangent: Vec2, anchor: Vec2) -> Self {
        let distance = tangent.cross(anchor - tip);
        let end = tangent.dot(tip - anchor);
        let normal = tangent.left();
        Self { tangent, normal, distance, curvature: 0.0, lo: end, hi: end, is_major: false }
    }

    /// Returns the edge for points that lie on it, whose distance is zero.
    pub(crate) fn touched(self) -> Self {
        Self { normal: Vec2::ZERO, distance: 0.0, curvature: 0.0, ..self }
    }

    /// Distance of a point from the line or the circle, positive on its left.
    #[inline(always)]
    pub(crate) fn curved_distance_of<R: Real>(&self, offset: [R; 2]) -> R {
        let v = self.distance_of(offset);
        if self.curvature == 0.0 {
            return v;
        }
        let (u, kappa) = (self.along(offset), v.broadcast(self.curvature));
        let (zero, one) = (v.broadcast(0.0), v.broadcast(1.0));
        let p = v + v - kappa * u.mul_add(u, v * v);
        p / (one + (one - kappa * p).max(zero).sqrt())
    }

    /// Distance of a point from the line, positive on its left.
    #[inline(always)]
    pub(crate) fn distance_of<R: Real>(&self, offset: [R; 2]) -> R {
        let [x, y] = offset;
        x.broadcast(self.normal.y)
            .mul_add(y, x.broadcast(self.normal.x).mul_add(x, x.broadcast(self.distance)))
    }

    #[inline(always)]
    fn along<R: Real>(&self, offset: [R; 2]) -> R {
        let [x, y] = offset;
        x.broadcast(self.tangent.x).mul_add(x, x.broadcast(self.tangent.y) * y)
    }

    /// How far a point lies beyond the end of the segment, along it; negative before its begin,
    /// zero between them.
    #[inline(always)]
    pub(super) fn beyond<R: Real>(&self, offset: [R; 2]) -> R {
        let along = self.along(offset);
        along - along.max(along.broadcast(self.lo)).min(along.broadcast(self.hi))
    }
}

impl LocalVertex {
    /// Where a point lies along one of the tangents, how far beside it, positive on the left, and
    /// the square of its distance from the vertex.
    #[inline(always)]
    pub(super) fn seen<R: Real>(&self, [x, y]: [R; 2], tangent: usize) -> (R, R, R) {
        let (dx, dy) = (x - x.broadcast(self.at.x), y - y.broadcast(self.at.y));
        let (tx, ty) =
            (x.broadcast(self.tangents[tangent].x), y.broadcast(self.tangents[tangent].y));
        (tx.mul_add(dx, ty * dy), tx * dy - ty * dx, dx.mul_add(dx, dy * dy))
    }

    /// The distance from that tangent from which it is larger.
    #[inline(always)]
    pub(super) fn larger<R: Real>(&self, offset: [R; 2]) -> R {
        let (_, before, _) = self.seen(offset, 0);
        let (_, after, _) = self.seen(offset, 1);
        R::select(after.abs().gt(before.abs()), after, before)
    }
}
