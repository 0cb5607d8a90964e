//! Cracks and tips seen from an anchor.
//!
//! Points are `anchor + offset`. The distances of the anchor to the crack's lines and tips are
//! formed once, in f64, without cancellation; evaluation adds the offset only. So a view
//! 10⁻¹² of the domain wide has no noise, at a tip, at a kink or in the middle of an oblique crack.
//!
//! Points that are known to lie on a segment are seen [on it](LocalCrack::on): there the distance
//! is zero however their coordinates were rounded, and the [`Side`] that is asked for is the one
//! that is met.

use super::local_chain::{EdgeGroup, LocalChain};
use super::local_edge::{LocalSegment, LocalVertex};
use super::{Crack, End, Side};
use crate::vec2::Vec2;
use ppum_formula::elementary::Atan;
use ppum_formula::real::Real;
use std::borrow::Cow;

/// A crack seen from an anchor.
#[derive(Clone, Debug)]
pub struct LocalCrack<'c> {
    /// The edges of a polyline; empty of a crack with arcs.
    segments: Vec<LocalSegment>,
    /// A crack with arcs.
    chain: Option<Box<LocalChain<'c>>>,
}

impl<'c> LocalCrack<'c> {
    /// The crack seen from `anchor`.
    #[must_use]
    pub fn new(crack: &'c Crack, anchor: Vec2) -> Self {
        if crack.is_curved() {
            return Self {
                segments: Vec::new(),
                chain: Some(Box::new(LocalChain::new(crack, anchor))),
            };
        }
        Self { segments: LocalSegment::all(crack, anchor), chain: None }
    }

    /// The crack seen from `anchor` for points that lie on one of its edges: this one is the
    /// nearest to all of them, and its distance is zero.
    ///
    /// # Panics
    /// If there is no such edge.
    #[must_use]
    pub fn on(crack: &Crack, segment: u32, anchor: Vec2) -> Self {
        let touched = LocalSegment::new(crack.edge(segment as usize), anchor).touched();
        Self { segments: vec![touched], chain: None }
    }

    /// The edges, in order: one at least. Those of a crack with arcs are formed anew.
    #[must_use]
    pub fn segments(&self) -> Cow<'_, [LocalSegment]> {
        self.chain.as_ref().map_or((&self.segments).into(), |chain| chain.segments().into())
    }

    /// The vertices of a crack with arcs, formed anew; none of a polyline.
    #[must_use]
    pub fn vertices(&self) -> Vec<LocalVertex> {
        self.chain.as_ref().map_or_else(Vec::new, |chain| chain.vertices())
    }

    /// The groups of edges of a crack with arcs, in order; none of a polyline.
    #[must_use]
    pub fn groups(&self) -> &[EdgeGroup] {
        self.chain.as_ref().map_or(&[], |chain| &chain.groups)
    }

    /// The line on which the crack goes on beyond an end.
    fn ray(&self, end: End) -> LocalSegment {
        match (&self.chain, end) {
            (Some(chain), _) => chain.rays[usize::from(end == End::Last)],
            (None, End::Start) => self.segments[0],
            (None, End::Last) => self.segments[self.segments.len() - 1],
        }
    }

    /// +1 on the left of the crack, −1 on its right; `side` decides on the crack itself.
    ///
    /// The first and the last edge are extended to infinity along their tangents. The line or
    /// circle of the nearest edge decides; where its nearest point is a vertex (the sector behind a
    /// kink), that of the two tangents there with the larger distance.
    #[inline(always)]
    pub fn side<R: Real>(&self, offset: [R; 2], side: Side) -> R {
        sign(self.nearest_distance(offset), side)
    }

    /// Both segments at a vertex name the same line behind it, and the one that is nearest beside
    /// that sector, so it does not matter which of the two rounding takes for the nearer one.
    #[inline(always)]
    fn nearest_distance<R: Real>(&self, offset: [R; 2]) -> R {
        if let Some(chain) = &self.chain {
            return chain.nearest_distance(offset);
        }
        let mut own = self.segments[0].distance_of(offset);
        let last = self.segments.len() - 1;
        if last == 0 {
            return own;
        }
        let zero = own.broadcast(0.0);
        let (mut before, mut nearest, mut least) = (own, own, own.broadcast(f64::INFINITY));
        let mut k = 0;
        while k <= last {
            let after = self.segments[(k + 1).min(last)].distance_of(offset);
            let beyond = self.segments[k].beyond(offset);
            let other = R::select(beyond.gt(zero), after, R::select(zero.gt(beyond), before, own));
            let decides = R::select(other.abs().gt(own.abs()), other, own);
            let square = beyond.mul_add(beyond, own * own);
            nearest = R::select(least.gt(square), decides, nearest);
            least = least.min(square);
            (before, own, k) = (own, after, k + 1);
        }
        nearest
    }
}

/// +1 or −1 by a signed distance; zero counts as the given side.
#[inline(always)]
fn sign<R: Real>(distance: R, side: Side) -> R {
    let (zero, one) = (distance.broadcast(0.0), distance.broadcast(1.0));
    match side {
        Side::Above => R::sign(distance.ge(zero), one),
        Side::Below => R::sign(distance.gt(zero), one),
    }
}

/// A crack tip seen from an anchor.
#[derive(Clone, Debug)]
pub struct LocalTip<'c> {
    /// Anchor minus tip.
    pub from_tip: Vec2,
    /// Unit direction of growth.
    pub axis: Vec2,
    crack: LocalCrack<'c>,
    /// Index of the edge that ends at the tip.
    pub segment: usize,
    /// That segment; of an arc the tangent at the tip.
    line: LocalSegment,
    /// True of a crack of more than one segment, or of an arc.
    bends: bool,
    /// +1 at the last vertex, −1 at the first, where the crack's left is the tip's right.
    pub orientation: f64,
}

/// A point in the frame of a tip.
#[derive(Clone, Copy, Debug)]
pub struct TipPoint<R> {
    /// Distance ahead of the tip along the direction of growth.
    pub x: R,
    /// Distance to its left.
    pub y: R,
    /// Sign of the polar angle before the branch is taken: that of `y`, decided on the crack's line
    /// by the chosen side.
    pub sign: R,
    /// −1 where the point lies between a kinked crack and the straight extension of its last
    /// segment, so that θ must be shifted by ∓2π; else +1.
    pub branch: R,
}

impl<'c> LocalTip<'c> {
    /// The tip at `end` of `crack`, seen from `anchor`.
    #[must_use]
    pub fn new(crack: &'c Crack, end: End, anchor: Vec2) -> Self {
        let local = LocalCrack::new(crack, anchor);
        let last = crack.points.len() - 2;
        let (segment, orientation) = match end {
            End::Start => (0, -1.0),
            End::Last => (last, 1.0),
        };
        let (line, bends) = (local.ray(end), last > 0 || crack.is_curved());
        let (from_tip, axis) = (anchor - crack.end_point(end), line.tangent * orientation);
        Self { from_tip, axis, crack: local, segment, line, bends, orientation }
    }

    /// The tip at `end` of `crack`, seen from `anchor`, for points that lie on one of the crack's
    /// edges: there θ is that of the side which is asked for, ±π behind a straight crack's tip.
    ///
    /// # Panics
    /// If there is no such edge.
    #[must_use]
    pub fn on(crack: &'c Crack, segment: u32, end: End, anchor: Vec2) -> Self {
        let tip = Self::new(crack, end, anchor);
        let is_line = tip.segment == segment as usize && !crack.edge(tip.segment).is_arc();
        let line = if is_line { tip.line.touched() } else { tip.line };
        Self { crack: LocalCrack::on(crack, segment, anchor), line, ..tip }
    }

    /// Distance of the anchor from the crack's tangent at the tip, positive on its left.
    #[must_use]
    pub fn distance(&self) -> f64 {
        self.line.distance
    }

    /// The point `anchor + offset` in the tip's frame.
    ///
    /// In the region nearest to the tip's own segment, and ahead of a tip on an arc, the branch is
    /// +1 by construction: both signs come from the same number.
    #[inline(always)]
    pub fn point<R: Real>(&self, offset: [R; 2], side: Side) -> TipPoint<R> {
        let one = offset[0].broadcast(1.0);
        let dx = offset[0] + one.broadcast(self.from_tip.x);
        let dy = offset[1] + one.broadcast(self.from_tip.y);
        let distance = self.line.distance_of(offset);
        let line_side = sign(distance, side);
        let branch = if self.bends {
            line_side * sign(self.crack.nearest_distance(offset), side)
        } else {
            one
        };
        let orientation = one.broadcast(self.orientation);
        TipPoint {
            x: one.broadcast(self.axis.x).mul_add(dx, one.broadcast(self.axis.y) * dy),
            y: orientation * distance,
            sign: orientation * line_side,
            branch,
        }
    }
}

impl<R: Real> TipPoint<R> {
    /// r = √(x² + y²), without overflow or underflow.
    #[inline(always)]
    pub fn radius(&self) -> R {
        let (x, y, zero, one) =
            (self.x.abs(), self.y.abs(), self.x.broadcast(0.0), self.x.broadcast(1.0));
        let large = x.max(y);
        let slope = x.min(y) / large;
        R::select(large.gt(zero), large * slope.mul_add(slope, one).sqrt(), large)
    }

    /// √r cos(θ/2) and √r sin(θ/2), the parts of √z, for `r` = |z|: no trigonometry.
    ///
    /// The larger of the two magnitudes is a root, the smaller follows by division, so nothing
    /// cancels near θ = ±π. Both are zero at r = 0.
    #[inline(always)]
    pub fn half_root(&self, r: R) -> [R; 2] {
        let (zero, half) = (r.broadcast(0.0), r.broadcast(0.5));
        let large = ((r + self.x.abs()) * half).sqrt();
        let small = R::select(r.gt(zero), half * self.y.abs() / large, zero);
        let ahead = self.x.ge(zero);
        [
            self.branch * R::select(ahead, large, small),
            self.branch * self.sign * R::select(ahead, small, large),
        ]
    }

    /// cos(θ/2) and sin(θ/2), from [`TipPoint::half_root`]; those of θ = 0 on the branch at
    /// `r` = 0.
    #[inline(always)]
    pub fn half_angle(&self, r: R) -> [R; 2] {
        let [c, s] = self.half_root(r);
        let (apart, root) = (r.gt(r.broadcast(0.0)), r.sqrt());
        [R::select(apart, c / root, self.branch), R::select(apart, s / root, s)]
    }

    /// θ on the branch that jumps on the crack itself, from its [half angle](TipPoint::half_angle):
    /// 4 arctan(tan(θ/4)).
    #[inline(always)]
    pub fn theta([cos_half, sin_half]: [R; 2]) -> R {
        let one = cos_half.broadcast(1.0);
        R::via_f64([sin_half / (one + cos_half)], Atan) * one.broadcast(4.0)
    }
}

impl TipPoint<f64> {
    /// Distance to the tip and polar angle on the branch that jumps on the crack itself.
    #[must_use]
    pub fn polar(&self) -> (f64, f64) {
        let angle = self.sign * self.y.abs().atan2(self.x);
        let shift = if self.branch < 0.0 { -2.0 * std::f64::consts::PI * self.sign } else { 0.0 };
        (self.x.hypot(self.y), angle + shift)
    }
}

#[cfg(test)]
mod tests {
    use super::super::CrackEnd;
    use super::*;
    use crate::compensated::cross;
    use crate::vec2::vec2;

    fn crack(points: &[(f64, f64)]) -> Crack {
        let vertices = points.iter().map(|&(x, y)| vec2(x, y)).collect();
        Crack::polyline(vertices, [CrackEnd::Tip; 2])
    }

    /// Points of an integer lattice small enough for the cross product to be exact.
    #[test]
    fn cross_product_of_nearly_collinear_points() {
        let (a, b) = (vec2(0.1, 0.1), vec2(0.7, 0.7));
        assert_eq!(cross(a, b, vec2(0.3, 0.3)), 0.0);
        let up = vec2(0.3, 0.3 + f64::EPSILON / 4.0);
        assert!((cross(a, b, up) / (0.6 * (up.y - 0.3)) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn sides_of_a_sharp_kink() {
        let kinked = crack(&[(-1.0, 1.0), (0.0, 0.0), (1.0, 1.0)]);
        let v = LocalCrack::new(&kinked, Vec2::ZERO);
        for (p, expected) in
            [([0.0, 0.5], 1.0), ([0.0, -0.5], -1.0), ([-3.0, 0.0], -1.0), ([3.0, 4.0], 1.0)]
        {
            assert_eq!(v.side(p, Side::Above), expected, "{p:?}");
        }
        // the sector behind the kink, where both segments are equally near
        for k in -40..=40 {
            let angle = f64::from(k) / 40.0 * 0.7 - std::f64::consts::FRAC_PI_2;
            let p = [1e-9 * angle.cos(), 1e-9 * angle.sin()];
            assert_eq!(v.side(p, Side::Above), -1.0, "{p:?}");
        }
    }

    #[test]
    fn the_caller_chooses_the_side_on_the_crack() {
        let c = crack(&[(0.25, 0.5), (0.75, 0.5)]);
        let local = LocalCrack::new(&c, vec2(0.5, 0.5));
        assert_eq!(local.side([0.125, 0.0], Side::Above), 1.0);
        assert_eq!(local.side([0.125, 0.0], Side::Below), -1.0);
        let start = LocalTip::new(&c, End::Start, vec2(0.5, 0.5));
        let (r, theta) = start.point([0.0, 0.0], Side::Above).polar();
        assert_eq!((r, theta), (0.25, -std::f64::consts::PI));
        let (_, theta) = start.point([0.0, 0.0], Side::Below).polar();
        assert_eq!(theta, std::f64::consts::PI);
    }

    /// Walks round the tip of a kinked crack: θ is continuous except for one jump of 2π, on the
    /// crack.
    #[test]
    fn the_angle_jumps_on_the_crack_only() {
        let c = crack(&[(-1.0, 0.6), (-0.4, 0.3), (0.0, 0.0)]);
        let tip = LocalTip::new(&c, End::Last, Vec2::ZERO);
        for radius in [0.2, 0.8, 1.4] {
            let at = |k: i32| {
                let phi = f64::from(k) / 2000.0 * std::f64::consts::TAU;
                let p = [radius * phi.cos(), radius * phi.sin()];
                (p, tip.point(p, Side::Above).polar().1)
            };
            let jumps: Vec<_> =
                (0..2000).filter(|&k| (at(k + 1).1 - at(k).1).abs() > 1.0).map(at).collect();
            assert_eq!(jumps.len(), 1, "radius {radius}");
            let p = jumps[0].0;
            let local = LocalCrack::new(&c, Vec2::ZERO);
            assert!(local.nearest_distance(p).abs() < radius * 0.01, "jump at {p:?}");
        }
    }

    /// The distance of a point 1e-13 above an oblique crack, far from the origin.
    #[test]
    fn anchored_distances_do_not_cancel() {
        let c = crack(&[(3.1, 7.3), (5.7, 8.9)]);
        let anchor = vec2(4.4, 8.1);
        let normal = c.growth_direction(End::Last).left();
        let base = LocalCrack::new(&c, anchor).nearest_distance([0.0, 0.0]);
        let moved =
            LocalCrack::new(&c, anchor).nearest_distance([normal.x * 1e-13, normal.y * 1e-13]);
        assert!(((moved - base) / 1e-13 - 1.0).abs() < 1e-2);
        assert_eq!(LocalCrack::new(&c, c.points[1]).nearest_distance([0.0, 0.0]), 0.0);
    }
}
