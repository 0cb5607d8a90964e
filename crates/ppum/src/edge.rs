//! Edges: segments and arcs of circles between two points, of which cracks and rims consist.
//!
//! An arc has a *bulge* β = tan(φ/4), φ its sweep, positive where it turns left, as in DXF; a
//! segment has β = 0. All that follows from it is rational: with D = to − from
//!
//! ```text
//! κ = 4β / ((1 + β²) |D|)            the curvature
//! cos φ/2 = (1 − β²)/(1 + β²)        sin φ/2 = 2β/(1 + β²)
//! ```
//!
//! and D turned by ∓φ/2 is along the tangents at both ends. By the inscribed angle a point p is on
//! the left of the arc's circle where
//!
//! ```text
//! S(p) = (1 − β²) D × (p − from) + 2β (p − from)·(to − p)
//! ```
//!
//! is positive, and S/(|D| (1 + β²)) is its distance from the circle, but for terms of second
//! order. No centre is formed, so nothing cancels as β becomes small.

use crate::compensated;
use crate::segment;
use crate::vec2::{Rect, Vec2, vec2};
use std::f64::consts::TAU;

/// A segment or an arc of a circle with a direction, of less than a whole turn. Its ends differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// The first end.
    pub from: Vec2,
    /// The last end.
    pub to: Vec2,
    /// tan(sweep/4), positive where the edge turns left, zero of a segment.
    pub bulge: f64,
}

impl Edge {
    /// A segment.
    #[must_use]
    pub const fn segment([from, to]: [Vec2; 2]) -> Self {
        Self { from, to, bulge: 0.0 }
    }

    /// The arc that begins in a direction; a segment if it leads to the other end. The bulge is
    /// not finite if the direction leads away from it.
    #[must_use]
    pub fn tangent_to(from: Vec2, direction: Vec2, to: Vec2) -> Self {
        let chord = to - from;
        // half of the sweep, φ/2, is the angle from the direction to the chord
        let (sin, cos) = (direction.cross(chord), direction.dot(chord));
        Self { from, to, bulge: sin / (sin.hypot(cos) + cos) }
    }

    /// Two arcs with a common tangent where they meet that join two points with given directions:
    /// of all such pairs the one whose tangents to the joint are equally long (Bolton 1975).
    #[must_use]
    pub fn pair_between([a, start]: [Vec2; 2], [b, end]: [Vec2; 2]) -> [Self; 2] {
        let (way, both) = (b - a, start + end);
        let (square, along) = (way.dot(way), way.dot(both));
        let turn = 2.0 * (1.0 - start.dot(end));
        let reach = square / (along + (along * along + turn * square).sqrt());
        let joint = (a + b + (start - end) * reach) * 0.5;
        [Self::tangent_to(a, start, joint), Self::tangent_to(b, -end, joint).reversed()]
    }

    /// An arc of a circle from an angle to another one, in radians.
    #[must_use]
    pub fn around(center: Vec2, radius: f64, [from, to]: [f64; 2]) -> Self {
        let at = |angle: f64| center + vec2(angle.cos(), angle.sin()) * radius;
        Self { from: at(from), to: at(to), bulge: ((to - from) * 0.25).tan() }
    }

    /// The edge that leaves a point in a direction, a unit vector, and has a curvature and a
    /// length; it turns by less than a whole turn.
    #[must_use]
    pub fn leaving(from: Vec2, direction: Vec2, curvature: f64, length: f64) -> Self {
        let half = 0.5 * curvature * length;
        let chord = if half == 0.0 { 1.0 } else { half.sin() / half };
        let to = from + turned(direction, half) * (length * chord);
        Self { from, to, bulge: (0.5 * half).tan() }
    }

    /// True if it is not a segment.
    #[must_use]
    pub fn is_arc(&self) -> bool {
        self.bulge != 0.0
    }

    /// The angle by which the edge turns, positive to the left, in radians.
    #[must_use]
    pub fn sweep(&self) -> f64 {
        4.0 * self.bulge.atan()
    }

    /// The curvature κ, positive where the edge turns left: the reciprocal of the radius.
    #[must_use]
    pub fn curvature(&self) -> f64 {
        4.0 * self.bulge / (self.weight() * self.chord().length())
    }

    /// The centre of its circle; not finite of a segment.
    #[must_use]
    pub fn center(&self) -> Vec2 {
        let height = (1.0 - self.bulge * self.bulge) / (4.0 * self.bulge);
        (self.from + self.to) * 0.5 + self.chord().left() * height
    }

    /// Its length: |D| (1 + β²) atan(β)/β.
    #[must_use]
    pub fn length(&self) -> f64 {
        let stretch = if self.is_arc() { self.bulge.atan() / self.bulge } else { 1.0 };
        self.chord().length() * (self.weight() * stretch)
    }

    /// The point at a part of the length, from 0 to 1; the ends are met exactly.
    #[must_use]
    pub fn at(&self, part: f64) -> Vec2 {
        if part == 1.0 { self.to } else { self.from + self.way(part) }
    }

    /// at(part) − from, which keeps its digits near the first end.
    #[must_use]
    pub fn way(&self, part: f64) -> Vec2 {
        if !self.is_arc() {
            return self.chord() * part;
        }
        // the chord of a part of the arc is turned by half of what the arc turns less
        let (half, turn) = (0.5 * self.sweep() * part, 0.5 * self.sweep() * (part - 1.0));
        turned(self.chord(), turn) * (half.sin() / (2.0 * self.bulge / self.weight()))
    }

    /// The unit tangent at a part of the length, in the edge's direction.
    #[must_use]
    pub fn tangent(&self, part: f64) -> Vec2 {
        let chord = self.chord().unit();
        if self.is_arc() { turned(chord, self.sweep() * (part - 0.5)) } else { chord }
    }

    /// The unit tangent at the point of the line or circle that is closest to another point.
    #[must_use]
    pub fn tangent_towards(&self, p: Vec2) -> Vec2 {
        let normal = self.gradient(p).unit();
        if self.is_arc() && normal.is_finite() { -normal.left() } else { self.chord().unit() }
    }

    /// The unit tangents at both ends, by rational functions of the bulge.
    #[must_use]
    pub fn end_tangents(&self) -> [Vec2; 2] {
        let (along, b) = (self.chord().unit(), self.bulge);
        let cos = along * ((1.0 - b * b) / self.weight());
        let sin = along.left() * (2.0 * b / self.weight());
        [cos - sin, cos + sin]
    }

    /// The edge in the opposite direction.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { from: self.to, to: self.from, bulge: -self.bulge }
    }

    /// The edge between two parts of its length.
    #[must_use]
    pub fn part(&self, [low, high]: [f64; 2]) -> Self {
        let bulge = if self.is_arc() { (self.bulge.atan() * (high - low)).tan() } else { 0.0 };
        Self { from: self.at(low), to: self.at(high), bulge }
    }

    /// Equal parts of the edge that turn by no more than an angle; a segment is one.
    pub fn divided(&self, turn: f64) -> impl Iterator<Item = Self> + use<> {
        let count = (self.sweep().abs() / turn).ceil().max(1.0) as usize;
        let (whole, at) = (*self, move |k: usize| k as f64 / count as f64);
        (0..count).map(move |k| if count == 1 { whole } else { whole.part([at(k), at(k + 1)]) })
    }

    /// Distance of a point from the line or the circle of the edge, positive on the left of it. The
    /// sign is exact but for a last bit of the distance.
    #[must_use]
    pub fn side(&self, p: Vec2) -> f64 {
        // (1 − κ|p − c|)/κ with κ²|p − c|² = 1 − κ power
        let power = self.power(p);
        power / (1.0 + (1.0 - self.curvature() * power).max(0.0).sqrt())
    }

    /// The part of the length, from 0 to 1, at which the edge is closest to a point.
    #[must_use]
    pub fn closest_part(&self, p: Vec2) -> f64 {
        match self.part_towards(p) {
            part if !self.is_arc() => part.clamp(0.0, 1.0),
            part if is_part(part) => part,
            _ if (p - self.from).length() <= (p - self.to).length() => 0.0,
            _ => 1.0,
        }
    }

    /// The part at which the line or circle of the edge is closest to a point, less than 0 and more
    /// than 1 beyond the ends; within half a turn of an arc's middle.
    fn part_towards(&self, p: Vec2) -> f64 {
        let (d, kappa) = (self.chord(), self.curvature());
        if !self.is_arc() {
            return (p - self.from).dot(d) / d.dot(d);
        }
        let (t, q) = (d.unit(), p - self.middle());
        let (along, across) = (kappa * t.dot(q), 1.0 - kappa * t.cross(q));
        0.5 + along.atan2(across) / self.sweep()
    }

    /// The point of the edge that is closest to another one.
    #[must_use]
    pub fn closest_point(&self, p: Vec2) -> Vec2 {
        self.from + self.way(self.closest_part(p))
    }

    /// Distance of a point to the edge.
    #[must_use]
    pub fn distance(&self, p: Vec2) -> f64 {
        let part = self.closest_part(p);
        if self.is_arc() && part > 0.0 && part < 1.0 {
            self.side(p).abs()
        } else {
            ((p - self.from) - self.way(part)).length()
        }
    }

    /// Distance of two edges from each other, zero if they cross.
    #[must_use]
    pub fn gap(&self, other: &Self) -> f64 {
        let (a, b) = ([self.from, self.to], [other.from, other.to]);
        if !self.is_arc() && !other.is_arc() {
            return segment::gap(a, b);
        }
        if !self.meets(other).is_empty() {
            return 0.0;
        }
        let ends = a.map(|p| other.distance(p)).into_iter().chain(b.map(|p| self.distance(p)));
        // where the common normal of both meets them
        let between = |one: &Self, other: &Self| {
            let parts = one.parts_towards_or_from(other).into_iter().flatten();
            let distances = parts.map(|part| other.distance(one.at(part)));
            distances.fold(f64::INFINITY, f64::min)
        };
        ends.chain([between(self, other), between(other, self)]).fold(f64::INFINITY, f64::min)
    }

    /// The parts of an arc's length, where they are on it, at which its normal is one of another
    /// edge, too; none of a segment.
    fn parts_towards_or_from(&self, other: &Self) -> [Option<f64>; 2] {
        if !self.is_arc() {
            return [None; 2];
        }
        let (tangent, kappa) = (self.chord().unit(), self.curvature());
        // the vector from this centre to the other one, times the curvature, or a segment's normal
        let across = if other.is_arc() {
            let q = other.center() - self.middle();
            q * kappa - tangent.left()
        } else {
            other.chord().left()
        };
        [across, -across].map(|out| {
            let part = 0.5 + tangent.dot(out).atan2(-tangent.cross(out)) / self.sweep();
            is_part(part).then_some(part)
        })
    }

    /// The smallest box that holds the edge.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        let ends = Rect::new(self.from.min(self.to), self.from.max(self.to));
        if !self.is_arc() {
            return ends;
        }
        let (start, sweep) = (self.end_tangents()[0], self.sweep());
        // the points at which the tangent is along an axis
        let part = |axis: Vec2| {
            let turn = start.cross(axis).atan2(start.dot(axis)) * sweep.signum();
            turn.rem_euclid(TAU) / sweep.abs()
        };
        let axes = [vec2(1.0, 0.0), vec2(0.0, 1.0), vec2(-1.0, 0.0), vec2(0.0, -1.0)];
        let parts = axes.map(part).into_iter().filter(|part| *part < 1.0);
        parts.map(|part| self.at(part)).fold(ends, |all, p| all.union(&Rect::new(p, p)))
    }

    /// Heights y between which the edge surely lies.
    pub(crate) fn heights(&self) -> [f64; 2] {
        let reach = self.reach();
        [reach.min.y, reach.max.y]
    }

    /// A box in which the edge surely lies.
    pub(crate) fn reach(&self) -> Rect {
        let (a, b, d) = (self.from, self.to, self.chord());
        // an arc stays as near to its chord as its middle: |D| |β|/2 or more, also after rounding
        let beside = 0.51 * self.bulge.abs() * (d.x.abs() + d.y.abs());
        Rect::new(a.min(b) - vec2(beside, beside), a.max(b) + vec2(beside, beside))
    }

    /// The signed area between chord and arc: positive where the arc turns left, and lies on the
    /// right of its chord; what an arc adds to the area of a polygon that runs counter-clockwise.
    fn area_beside_chord(&self) -> f64 {
        // |D|²/8 (φ − sin φ)/sin²(φ/2)
        let (d, sin) = (self.chord(), 2.0 * self.bulge / self.weight());
        if self.is_arc() { d.dot(d) * 0.125 * beside_sine(self.sweep()) / (sin * sin) } else { 0.0 }
    }

    /// Parts of the lengths of two edges at the points where they meet, in the order of this one;
    /// edges that touch, or that lie on one line or circle, do not meet.
    #[must_use]
    pub fn meets(&self, other: &Self) -> Vec<[f64; 2]> {
        let on_both = |part: f64| {
            let other = other.part_towards(self.at(part));
            is_part(other).then_some([part, other])
        };
        let parts = self.meets_curve(other).into_iter().filter(|part| is_part(*part));
        parts.filter_map(on_both).collect()
    }

    /// The point in which two edges meet: where they cross, else the end of one that is the nearest
    /// to the other.
    #[must_use]
    pub fn meeting_point(&self, other: &Self) -> Vec2 {
        let crossings = self.meets_curve(other).into_iter().map(|part| self.at(part));
        let all = [self.from, self.to, other.from, other.to].into_iter().chain(crossings);
        let off = |p: &Vec2| self.distance(*p).max(other.distance(*p));
        all.min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(self.from)
    }

    /// The parts, in order, at which the line or circle of this edge meets that of another one,
    /// less than 0 and more than 1 beyond the ends.
    #[must_use]
    pub fn meets_curve(&self, other: &Self) -> Vec<f64> {
        let (t, length) = (self.chord().unit(), self.chord().length());
        let part = |q: f64| {
            0.5 + if self.is_arc() {
                // ψ/φ
                0.5 * (0.5 * self.curvature() * q).atan() / self.bulge.atan()
            } else {
                q / length
            }
        };
        let mut parts: Vec<f64> =
            self.common(self.middle(), t, other).into_iter().map(part).collect();
        parts.sort_by(f64::total_cmp);
        parts
    }

    /// The points in which the line or circle of this edge meets that of another one, with all
    /// their digits near the origin.
    #[must_use]
    pub fn meets_near_origin(&self, other: &Self) -> Vec<Vec2> {
        let t = self.tangent_towards(Vec2::ZERO);
        let foot = t.left() * -self.side(Vec2::ZERO);
        let point = |q: f64| {
            let slope = 0.5 * self.curvature() * q;
            foot + (t + t.left() * slope) * (q / (1.0 + slope * slope))
        };
        self.common(foot, t, other).into_iter().map(point).collect()
    }

    /// The numbers q = 2 tan(ψ/2)/κ of the points that the line or circle of this edge has in
    /// common with that of another one, ψ the turn from a point M of this one with the unit tangent
    /// t.
    ///
    /// All points but the opposite one are M + q (t + (κ q/2) n)/(1 + (κ q/2)²). They lie on the
    /// other curve, 2 n'·(p − B) = κ' |p − B|², for two values of q.
    fn common(&self, middle: Vec2, t: Vec2, other: &Self) -> Vec<f64> {
        let (kappa, slope) = (self.curvature(), other.gradient(middle));
        let value = other.power(middle);
        let square =
            value * (0.25 * kappa * kappa) + kappa * slope.dot(t.left()) - other.curvature();
        quadratic_roots([value, 2.0 * slope.dot(t), square])
    }

    /// 2 n·(p − B) − κ |p − B|² with a point B and the normal n there: zero on the line or circle.
    fn power(&self, p: Vec2) -> f64 {
        2.0 * compensated::arc(self.from, self.to, self.bulge, p)
            / (self.weight() * self.chord().length())
    }

    /// Half of the gradient of [`Edge::power`]: n − κ (p − B).
    fn gradient(&self, p: Vec2) -> Vec2 {
        self.chord().unit().left() - (p - self.middle()) * self.curvature()
    }

    /// The centroid of its length: of an arc of the sweep φ it lies at the part sin(φ/2)/(φ/2) of
    /// the way from the centre to the middle.
    #[must_use]
    pub fn centroid(&self) -> Vec2 {
        let half = 0.5 * self.sweep();
        if half.abs() < 1e-4 {
            // by its series: the middle less a third of the height
            return self.middle() + self.chord().left() * (self.bulge / 6.0);
        }
        self.center() + (self.middle() - self.center()) * (half.sin() / half)
    }

    /// The point in the middle of the length.
    #[must_use]
    pub fn middle(&self) -> Vec2 {
        (self.from + self.to - self.chord().left() * self.bulge) * 0.5
    }

    /// The signed area between the edge and a point, positive if it runs counter-clockwise around
    /// it. Those of a closed chain are its area together.
    #[must_use]
    pub fn area_from(&self, p: Vec2) -> f64 {
        0.5 * (self.from - p).cross(self.to - p) + self.area_beside_chord()
    }

    /// The parts of the length that lie inside an open box, in order.
    #[must_use]
    pub fn within(&self, open: &Rect) -> Vec<[f64; 2]> {
        if self.is_arc() && !self.reach().overlaps(open) {
            return Vec::new();
        }
        let edges = open.sides().map(Self::segment);
        let mut breaks = vec![0.0, 1.0];
        breaks.extend(edges.iter().flat_map(|edge| self.meets(edge)).map(|[part, _]| part));
        breaks.sort_by(f64::total_cmp);
        let is_inside = |[low, high]: [f64; 2]| {
            let p = self.at(0.5 * (low + high));
            low < high
                && p.x > open.min.x
                && p.x < open.max.x
                && p.y > open.min.y
                && p.y < open.max.y
        };
        breaks.windows(2).map(|pair| [pair[0], pair[1]]).filter(|range| is_inside(*range)).collect()
    }

    /// The points of a polyline from the first end to the last that is nowhere farther from the
    /// edge than the tolerance: all lie on the edge.
    #[must_use]
    pub fn flattened(&self, tolerance: f64) -> Vec<Vec2> {
        // a chord of a sweep ψ is off by r (1 − cos ψ/2)
        let height = (tolerance * self.curvature().abs() * 0.5).sqrt().min(1.0);
        let least = 4.0 * height.asin();
        let count = (self.sweep().abs() / least).ceil().clamp(1.0, 65_536.0);
        let count = if self.is_arc() { count as usize } else { 1 };
        (0..=count).map(|k| self.at(k as f64 / count as f64)).collect()
    }

    /// D = to − from.
    #[must_use]
    pub fn chord(&self) -> Vec2 {
        self.to - self.from
    }

    /// 1 + β².
    fn weight(&self) -> f64 {
        1.0 + self.bulge * self.bulge
    }
}

/// A line or circle in the frame of one of its points, seen from an anchor. Places on it are
/// lengths s from that point. If it is the point nearest to the anchor, nothing cancels near the
/// anchor: an arc in a view 10⁻¹² of its radius wide has no noise.
#[derive(Clone, Copy, Debug)]
pub struct EdgeFrame {
    /// The offset of the point from the anchor.
    pub foot: Vec2,
    /// The unit tangent there.
    pub tangent: Vec2,
    /// The curvature, positive where it turns left.
    pub curvature: f64,
}

impl EdgeFrame {
    /// The line or circle of an edge in the frame of its point that is nearest to the anchor.
    #[must_use]
    pub fn nearest(edge: &Edge, anchor: Vec2) -> Self {
        let tangent = edge.tangent_towards(anchor);
        let foot = tangent.left() * -edge.side(anchor);
        Self { foot, tangent, curvature: edge.curvature() }
    }

    /// The offset of the point at a place: the chord is turned by half of the arc's turn.
    #[must_use]
    pub fn at(&self, s: f64) -> Vec2 {
        if self.curvature == 0.0 {
            return self.foot + self.tangent * s;
        }
        let half = 0.5 * self.curvature * s;
        self.foot + turned(self.tangent, half) * (2.0 * half.sin() / self.curvature)
    }

    /// The unit tangent at a place.
    #[must_use]
    pub fn tangent_at(&self, s: f64) -> Vec2 {
        if self.curvature == 0.0 { self.tangent } else { turned(self.tangent, self.curvature * s) }
    }

    /// The place at which the line or circle is nearest to an offset, within half a turn.
    #[must_use]
    pub fn place(&self, offset: Vec2) -> f64 {
        if self.curvature == 0.0 {
            return self.tangent.dot(offset);
        }
        let (way, kappa) = (offset - self.foot, self.curvature);
        let (along, across) = (self.tangent.dot(way), self.tangent.cross(way));
        (kappa * along).atan2(1.0 - kappa * across) / kappa
    }

    /// p = 2 v − κ (u² + v²) with the coordinates u and v of an offset from the foot:
    /// (1 − κ² |x − c|²)/κ for the centre c, without it.
    #[must_use]
    pub fn power(&self, offset: Vec2) -> f64 {
        let way = offset - self.foot;
        2.0 * self.tangent.left().dot(way) - self.curvature * way.dot(way)
    }

    /// Distance of an offset from the line or circle, positive on its left.
    #[must_use]
    pub fn side(&self, offset: Vec2) -> f64 {
        let power = self.power(offset);
        power / (1.0 + (1.0 - self.curvature * power).max(0.0).sqrt())
    }
}

/// φ − sin φ, by its series where the difference cancels.
fn beside_sine(angle: f64) -> f64 {
    let square = angle * angle;
    if square > 0.25 {
        return angle - angle.sin();
    }
    // φ³/3! − φ⁵/5! + …, from the last factor on
    let series = [156.0, 110.0, 72.0, 42.0, 20.0].iter().fold(1.0, |sum, n| 1.0 - sum * square / n);
    angle * square / 6.0 * series
}

fn is_part(part: f64) -> bool {
    (0.0..=1.0).contains(&part)
}

/// The real roots of c₀ + c₁ q + c₂ q², without the double ones; those beyond all numbers are left
/// out.
fn quadratic_roots([c0, c1, c2]: [f64; 3]) -> Vec<f64> {
    let (high, low) = compensated::discriminant(c0, c1, c2);
    let root = (high + low).sqrt();
    // nothing cancels in the sum, and the other root follows from the product of both
    let sum = -0.5 * (c1 + root.copysign(c1));
    let roots = if root > 0.0 { [sum / c2, c0 / sum] } else { [f64::NAN; 2] };
    roots.into_iter().filter(|q| q.is_finite()).collect()
}

/// A vector turned to the left by an angle.
fn turned(v: Vec2, angle: f64) -> Vec2 {
    let (sin, cos) = angle.sin_cos();
    v * cos + v.left() * sin
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;
    use std::f64::consts::PI;

    fn point(random: &mut Random) -> Vec2 {
        vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0))
    }

    /// Edges of every sweep up to 350°, at every scale, segments among them.
    fn edge(random: &mut Random) -> Edge {
        let sweep = match random.between(0.0, 4.0) {
            kind if kind < 1.0 => 0.0,
            kind if kind < 2.0 => 10f64.powf(random.between(-12.0, 0.0)),
            _ => random.between(-6.1, 6.1),
        };
        Edge { from: point(random), to: point(random), bulge: (0.25 * sweep).tan() }
    }

    /// 5000 points of an edge at equal parts.
    fn points(edge: &Edge) -> Vec<Vec2> {
        (0..=5000).map(|k| edge.at(f64::from(k) / 5000.0)).collect()
    }

    /// Length, sweep, tangents, curvature and area beside those of many chords.
    #[test]
    fn measures_agree_with_chords() {
        let mut random = Random(55);
        for _ in 0..300 {
            let edge = edge(&mut random);
            let (points, length) = (points(&edge), edge.length());
            let chords: f64 = points.windows(2).map(|p| (p[1] - p[0]).length()).sum();
            assert!((chords / length - 1.0).abs() < 1e-6, "{edge:?}");
            let area = segment::signed_area(&points);
            assert!((area - edge.area_beside_chord()).abs() < 1e-6 * length * length, "{edge:?}");
            let [start, end] = edge.end_tangents();
            let turn = edge.sweep();
            assert!((turned(start, turn) - end).length() < 1e-13);
            assert!((turn - edge.curvature() * length).abs() <= 1e-13 * turn.abs());
            for part in [0.0, 0.3, 1.0] {
                assert!((edge.tangent(part) - turned(start, turn * part)).length() < 1e-13);
            }
            assert_eq!([edge.at(0.0), edge.at(1.0)], [edge.from, edge.to]);
            let bounds = edge.bounds();
            let all = points
                .iter()
                .fold(Rect::new(points[0], points[0]), |all, &p| all.union(&Rect::new(p, p)));
            let apart = (bounds.min - all.min).length() + (bounds.max - all.max).length();
            assert!(apart < 1e-5 * length, "{edge:?}");
        }
    }

    /// An edge reversed, and put together of parts, is the same.
    #[test]
    fn reversal_and_parts() {
        let mut random = Random(56);
        for _ in 0..300 {
            let edge = edge(&mut random);
            let (back, cut) = (edge.reversed(), random.between(0.1, 0.9));
            let (part, near) = (edge.part([0.0, cut]), 1e-12 * (1.0 + edge.length()));
            for k in 0..=10 {
                let t = f64::from(k) / 10.0;
                assert!((edge.at(t) - back.at(1.0 - t)).length() < near, "{edge:?}");
                assert!((edge.at(t * cut) - part.at(t)).length() < near, "{edge:?}");
            }
            let p = point(&mut random);
            assert_eq!(edge.side(p), -back.side(p));
            assert!((edge.distance(p) - back.distance(p)).abs() < near);
            let both = [part, edge.part([cut, 1.0])];
            let least = both.iter().map(|e| e.distance(p)).fold(f64::INFINITY, f64::min);
            assert!((least - edge.distance(p)).abs() < near);
            assert!((both.iter().map(Edge::length).sum::<f64>() - edge.length()).abs() < near);
        }
    }

    #[test]
    fn distances_are_the_least() {
        let mut random = Random(57);
        for _ in 0..300 {
            let (edge, p) = (edge(&mut random), point(&mut random));
            let (found, way) = (edge.distance(p), edge.length() / 5000.0);
            let least =
                points(&edge).iter().map(|q| (*q - p).length()).fold(f64::INFINITY, f64::min);
            assert!(found < least + 1e-12 && least < found + way, "{edge:?} {p:?}");
            let off = ((edge.closest_point(p) - p).length() - found).abs();
            assert!(off < 1e-11 * (1.0 + found), "{edge:?} {p:?} {off:e}");
        }
    }

    /// The side of points beside an edge by 10⁻¹⁴ of its length, where coordinates round to 10⁻¹⁶;
    /// and of points of the plane beside the circle of centre and radius.
    #[test]
    fn sides_keep_their_digits() {
        let mut random = Random(58);
        for _ in 0..1000 {
            let (edge, part) = (edge(&mut random), random.between(0.0, 1.0));
            let (at, out) = (edge.at(part), edge.tangent(part).left());
            for step in [1e-3, -1e-6, 1e-14, -1e-14] {
                let step = step * edge.length();
                let off = (edge.side(at + out * step) - step).abs();
                assert!(off < 1e-15 * (1.0 + edge.length()), "{edge:?} {step:e} {off:e}");
            }
            if edge.sweep().abs() > 0.1 {
                let (p, radius) = (point(&mut random), edge.curvature().recip());
                let beside = radius - (p - edge.center()).length() * radius.signum();
                assert!((beside - edge.side(p)).abs() < 1e-12 * (1.0 + radius.abs()), "{edge:?}");
            }
        }
        let arc = Edge { from: vec2(-1.0, 0.0), to: vec2(1.0, 0.0), bulge: 1e-9 };
        assert!((arc.side(Vec2::ZERO) - 1e-9).abs() < 1e-24, "on the left by |D| β/2");
    }

    /// Points that two edges have in common lie on both, and their number has the parity that the
    /// sides of the ends say.
    #[test]
    fn common_points_lie_on_both() {
        let mut random = Random(59);
        let mut found = [0; 3];
        for _ in 0..2000 {
            let (a, b) = (edge(&mut random), edge(&mut random));
            let met = a.meets(&b);
            for [s, t] in &met {
                let near = 1e-9 * (1.0 + a.length() + b.length()).powi(2);
                assert!((a.at(*s) - b.at(*t)).length() < near, "{a:?} {b:?}");
            }
            assert_eq!(met.len(), b.meets(&a).len(), "{a:?} {b:?}");
            found[met.len()] += 1;
            let signs = |points: Vec<Vec2>| {
                points.windows(2).filter(|p| (b.side(p[0]) > 0.0) != (b.side(p[1]) > 0.0)).count()
            };
            // of a whole circle, or the line, of the other
            let whole = [b, Edge { from: b.to, to: b.from, bulge: b.bulge.recip() }];
            if b.sweep().abs() > 0.1 {
                let all: usize = whole.iter().map(|part| a.meets(part).len()).sum();
                assert_eq!(all, signs(points(&a)), "{a:?} {b:?}");
            }
        }
        assert!(found.iter().all(|n| *n > 30), "{found:?}");
    }

    /// The least distance of two edges is that of many points of them.
    #[test]
    fn gaps_are_the_least() {
        let mut random = Random(63);
        let mut apart = 0;
        for _ in 0..400 {
            let (a, b) = (edge(&mut random), edge(&mut random));
            let least = |a: &Edge, b: &Edge| {
                points(a).into_iter().map(|p| b.distance(p)).fold(f64::INFINITY, f64::min)
            };
            let (gap, least) = (a.gap(&b), least(&a, &b).min(least(&b, &a)));
            assert!(gap <= least + 1e-12 && least - gap < 5e-3, "{a:?} {b:?} {gap} {least}");
            assert!((gap - b.gap(&a)).abs() < 1e-12 && (gap - a.reversed().gap(&b)).abs() < 1e-11);
            apart += usize::from(gap > 0.0);
        }
        assert!(apart > 100, "{apart}");
    }

    #[test]
    fn parts_inside_a_box() {
        let mut random = Random(60);
        let mut several = 0;
        for _ in 0..2000 {
            let (edge, a, b) = (edge(&mut random), point(&mut random), point(&mut random));
            let open = Rect::new(a.min(b), a.max(b));
            let ranges = edge.within(&open);
            several += usize::from(ranges.len() > 1);
            for k in 0..=500 {
                let t = f64::from(k) / 500.0;
                let p = edge.at(t);
                let depth = (p.x - open.min.x)
                    .min(open.max.x - p.x)
                    .min((p.y - open.min.y).min(open.max.y - p.y));
                let is_inside = ranges.iter().any(|[low, high]| *low <= t && t <= *high);
                assert!(is_inside == (depth > 0.0) || depth.abs() < 1e-12, "{edge:?} {open:?}");
            }
        }
        assert!(several > 20, "{several}");
    }

    /// Polylines that stay within a tolerance, and need no more points than they must.
    #[test]
    fn polylines_within_a_tolerance() {
        let mut random = Random(61);
        for _ in 0..300 {
            let edge = edge(&mut random);
            let tolerance = 10f64.powf(random.between(-6.0, -1.0));
            let line = edge.flattened(tolerance);
            let off = points(&edge)
                .into_iter()
                .step_by(7)
                .map(|p| segment::polyline_distance(&line, p))
                .fold(0.0, f64::max);
            assert!(off <= tolerance * (1.0 + 1e-6) + 1e-15, "{edge:?} {off} {tolerance}");
            assert!(line.len() < 4 || off > 0.2 * tolerance, "{edge:?} {off} {tolerance}");
        }
    }

    #[test]
    fn arcs_by_centre_and_by_tangent() {
        let half = Edge::around(vec2(1.0, 2.0), 0.5, [0.0, PI]);
        assert!(
            (half.bulge - 1.0).abs() < 1e-15 && (half.center() - vec2(1.0, 2.0)).length() < 1e-15
        );
        assert!((half.curvature() - 2.0).abs() < 1e-14);
        let mut random = Random(62);
        for _ in 0..300 {
            let (center, radius) = (point(&mut random), random.between(0.1, 2.0));
            let from = random.between(-TAU, TAU);
            let arc = Edge::around(center, radius, [from, from + random.between(-6.0, 6.0)]);
            assert!((arc.center() - center).length() < 1e-12 * (1.0 + arc.bulge.abs()));
            let again = Edge::tangent_to(arc.from, arc.end_tangents()[0], arc.to);
            assert!((again.bulge / arc.bulge - 1.0).abs() < 1e-12 * (1.0 + arc.bulge.abs()));
        }
        for curvature in [-2.0, 0.0, 1e-9, 1.5] {
            let edge = Edge::leaving(vec2(0.3, 0.1), vec2(0.6, -0.8), curvature, 1.2);
            assert!((edge.length() - 1.2).abs() + (edge.curvature() - curvature).abs() < 1e-14);
            assert!((edge.end_tangents()[0] - vec2(0.6, -0.8)).length() < 1e-15);
        }
        for sweep in [0.0, 1e-7, 1.9e-4, 2.1e-4, -0.7, 5.0] {
            let arc =
                Edge { from: vec2(1.0, 2.0), to: vec2(1.5, 1.0), bulge: f64::tan(sweep / 4.0) };
            let points = points(&arc);
            let mean = points.windows(2).map(|p| (p[0] + p[1]) * 0.5);
            let mean = mean.fold(Vec2::ZERO, |sum, p| sum + p) / 5000.0;
            assert!((arc.centroid() - mean).length() < 1e-6 * sweep.abs() + 1e-13, "{sweep}");
        }
        let straight = Edge::tangent_to(vec2(0.0, 0.0), vec2(2.0, 0.0), vec2(3.0, 0.0));
        assert_eq!((straight.bulge, straight.is_arc()), (0.0, false));
    }
}
