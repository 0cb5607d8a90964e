//! An edge in the coordinate s along it.

use super::geometry::LevelFunction;
use super::polygon::{SegmentCut, line_side};
use super::roots::{ZERO, clamp_non_finite, sign_changes};
use super::split::{TOLERANCE, component};
use ppum::border::{TOUCH, touch};
use ppum::edge::{Edge, EdgeFrame};
use ppum::segment::Segment;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::geometry::around;
use std::f64::consts::TAU;

/// Rounding of coordinates, as a part of them.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Arcs that turn by less than this are segments.
const STRAIGHT: f64 = 1e-20;

/// The part of an arc beyond its ends at which it may still be met.
const SLACK: f64 = 1e-6;

/// The points anchor + frame.at(s) of an edge.
pub(super) struct EdgeLine {
    pub(super) anchor: Vec2,
    pub(super) frame: EdgeFrame,
    pub(super) edge: Edge,
    /// s at its ends.
    pub(super) ends: [f64; 2],
    /// Distances that are rounding. They are those of the edge, not of a cell: cells of several
    /// sizes on both sides of it must agree whose it is.
    slack: f64,
    /// The edge seen from the anchor.
    seen: Edge,
    /// The box that holds it.
    bounds: Rect,
    /// Unit normal out of the material; of an arc that in its middle.
    normal: Vec2,
    /// +1 if the material is on its right.
    outside: f64,
}

/// The unit vector to the left in the middle of an edge.
fn left(edge: &Edge) -> Vec2 {
    edge.chord().unit().left()
}

impl EdgeLine {
    /// A part of an edge with the material on its right if `outside` is +1, on its left if that is
    /// −1.
    pub(super) fn new(anchor: Vec2, whole: &Edge, part: Edge, outside: f64) -> Self {
        let seen = Edge { from: part.from - anchor, to: part.to - anchor, ..part };
        let largest = [part.from, part.to].iter().fold(0.0f64, |m, p| m.max(p.max_norm()));
        let slack = TOLERANCE * part.chord().length() + ROUNDING * largest;
        let (from, to) = (part.from, part.to);
        let is_arc = part.sweep().abs() > STRAIGHT;
        let bounds = if is_arc { part.bounds() } else { Rect::new(from.min(to), from.max(to)) };
        let frame =
            if is_arc { arc_frame(&part, &seen, anchor) } else { straight_frame(&part, &seen) };
        let normal = left(whole) * outside;
        let line = Self {
            anchor,
            frame,
            edge: part,
            ends: [0.0; 2],
            slack,
            seen,
            bounds,
            normal,
            outside,
        };
        let ends = if is_arc {
            let (at, length) = (part.closest_part(anchor), part.length());
            [line.near(seen.from, -at * length), line.near(seen.to, (1.0 - at) * length)]
        } else {
            [seen.from, seen.to].map(|p| frame.tangent.dot(p))
        };
        Self { ends, ..line }
    }

    pub(super) fn is_arc(&self) -> bool {
        self.frame.curvature != 0.0
    }

    /// Unit normal out of the material at a point of the edge.
    pub(super) fn normal(&self, offset: Vec2) -> Vec2 {
        if self.is_arc() {
            self.seen.tangent_towards(offset).left() * self.outside
        } else {
            self.normal
        }
    }

    /// s of the point of the line or circle that is nearest to an offset; of an arc the one nearest
    /// to its middle of those that differ by whole turns.
    fn coordinate(&self, offset: Vec2) -> f64 {
        self.near(offset, 0.5 * (self.ends[0] + self.ends[1]))
    }

    fn near(&self, offset: Vec2, expected: f64) -> f64 {
        let (s, round) = (self.frame.place(offset), TAU / self.frame.curvature.abs());
        match ((expected - s) / round).round() {
            0.0 => s,
            turns => s + turns * round,
        }
    }

    /// s of a point's foot on the line or circle, and the point's distance from it.
    pub(super) fn seen_from(&self, point: Vec2) -> (f64, f64) {
        let way = point - self.anchor;
        (self.coordinate(way), self.frame.side(way).abs())
    }

    /// The point of the line or circle nearest to a point with that normal, from the point.
    pub(super) fn foot_from(&self, point: Vec2, normal: Vec2) -> Vec2 {
        let way = point - self.anchor;
        if self.is_arc() {
            normal * -self.frame.side(way)
        } else {
            normal * normal.dot(self.frame.foot - way)
        }
    }

    /// The parts of a range that belong to a cell, if they have a length, however short: boxes of
    /// different sizes must agree. A line along the cell's boundary belongs to it if the normal
    /// points out of it.
    pub(super) fn in_cell(&self, cell: &Rect) -> Vec<[f64; 2]> {
        let points_out = |axis: usize, sign: f64| component(self.normal, axis) * sign > 0.0;
        if self.is_arc() {
            return self.arc_inside(cell, self.ends, points_out);
        }
        let inside = self.line_inside(cell, self.ends, self.slack);
        inside.filter(|_| self.belongs_to(cell)).into_iter().collect()
    }

    /// The parts of a range inside a support.
    pub(super) fn in_support(&self, support: &Rect, range: [f64; 2]) -> Vec<[f64; 2]> {
        if self.is_arc() {
            return self.arc_inside(support, range, |_, _| false);
        }
        self.line_inside(support, range, -self.slack).into_iter().collect()
    }

    /// The part of a line inside a box. A line along a boundary is inside for a positive `slack`.
    fn line_inside(&self, rect: &Rect, ends: [f64; 2], slack: f64) -> Option<[f64; 2]> {
        let [mut lo, mut hi] = ends;
        let tangent = self.frame.tangent;
        let main = usize::from(tangent.y.abs() > tangent.x.abs());
        for axis in [main, 1 - main] {
            let (min, max) = self.boundaries(rect, axis);
            if let Some(at) = self.level(axis) {
                if at < min - slack || at > max + slack {
                    return None;
                }
            } else {
                let [a, b] = [rect.min, rect.max].map(|p| self.crossing(axis, component(p, axis)));
                (lo, hi) = (lo.max(a.min(b)), hi.min(a.max(b)));
            }
        }
        (hi > lo).then_some([lo, hi])
    }

    /// The lower and the upper end of a box along an axis, relative to the anchor.
    fn boundaries(&self, rect: &Rect, axis: usize) -> (f64, f64) {
        (component(rect.min - self.anchor, axis), component(rect.max - self.anchor, axis))
    }

    /// Coordinate of the edge along an axis, relative to the anchor, if that is one place but
    /// for rounding.
    fn level(&self, axis: usize) -> Option<f64> {
        let [from, to] = [self.edge.from, self.edge.to].map(|p| component(p, axis));
        let middle = 0.5 * (from + to) - component(self.anchor, axis);
        ((to - from).abs() <= self.slack).then_some(middle)
    }

    /// False if the line runs along a boundary of the box and the normal points into it.
    fn belongs_to(&self, rect: &Rect) -> bool {
        let points_in = |axis: usize| {
            let Some(at) = self.level(axis) else { return false };
            let ((min, max), normal) = (self.boundaries(rect, axis), component(self.normal, axis));
            (at <= min + self.slack && normal > 0.0) || (at >= max - self.slack && normal < 0.0)
        };
        !points_in(0) && !points_in(1)
    }

    /// The parts of a range of an arc inside a box. `is_in` says whether an arc that is a line
    /// along a boundary of the box is inside of it, by the axis and the direction out of the box.
    fn arc_inside(
        &self,
        rect: &Rect,
        range: [f64; 2],
        is_in: impl Fn(usize, f64) -> bool,
    ) -> Vec<[f64; 2]> {
        let sides = [(rect.min, -1.0), (rect.max, 1.0)];
        let sides = (0..2).flat_map(|axis| sides.map(|(p, sign)| (axis, component(p, axis), sign)));
        sides.fold(vec![range], |ranges, (axis, at, sign)| {
            let inside = self.on_side(axis, at, sign, is_in(axis, sign));
            let common = |a: &[f64; 2], b: &[f64; 2]| [a[0].max(b[0]), a[1].min(b[1])];
            let all = ranges.iter().flat_map(|a| inside.iter().map(move |b| common(a, b)));
            all.filter(|[lo, hi]| lo < hi).collect()
        })
    }

    /// The parts of an arc where sign × (coordinate − at) is negative; all of it or nothing if it
    /// is zero but for rounding. The parts do not depend on the cell: boxes on both sides of a
    /// line, which the arc may touch, share it without a gap.
    fn on_side(&self, axis: usize, at: f64, sign: f64, is_in: bool) -> Vec<[f64; 2]> {
        let [min, max] = [self.bounds.min, self.bounds.max].map(|p| component(p, axis) - at);
        let is_inside = match [min >= -self.slack, max <= self.slack] {
            [true, true] => Some(is_in),
            [is_above, is_below] => (is_above || is_below).then_some(is_above != (sign > 0.0)),
        };
        if let Some(is_inside) = is_inside {
            return if is_inside { vec![self.ends] } else { Vec::new() };
        }
        let mut parts = vec![0.0];
        parts.extend(self.parts_at(axis, at));
        parts.push(1.0);
        let is_below = |part: &&[f64]| {
            (component(self.edge.at(0.5 * (part[0] + part[1])), axis) > at) != (sign > 0.0)
        };
        let below = parts.windows(2).filter(is_below);
        below.map(|part| [part[0], part[1]].map(|part| self.coordinate_at(part))).collect()
    }

    /// The parts of the length at which a coordinate has a value.
    fn parts_at(&self, axis: usize, at: f64) -> impl Iterator<Item = f64> + use<> {
        let Edge { from, .. } = self.edge;
        let size = self.edge.chord().length();
        let ends = match axis {
            0 => [vec2(at, from.y), vec2(at, from.y + size)],
            _ => [vec2(from.x, at), vec2(from.x + size, at)],
        };
        let parts = self.edge.meets_curve(&Edge::segment(ends)).into_iter();
        parts.filter(|part| *part > 0.0 && *part < 1.0)
    }

    /// s at a part of the length, counted from the nearer end.
    fn coordinate_at(&self, part: f64) -> f64 {
        let length = self.ends[1] - self.ends[0];
        if part < 0.5 { self.ends[0] + length * part } else { self.ends[1] - length * (1.0 - part) }
    }

    /// True if a coordinate changes along it.
    pub(super) fn varies(&self, axis: usize) -> bool {
        self.is_arc() || component(self.frame.tangent, axis) != 0.0
    }

    /// s of the points whose coordinate along an axis is `at`; none on a line across the axis.
    pub(super) fn parameters(&self, axis: usize, at: f64) -> Vec<f64> {
        if self.is_arc() {
            return self.parts_at(axis, at).map(|part| self.coordinate_at(part)).collect();
        }
        self.varies(axis).then(|| self.crossing(axis, at)).into_iter().collect()
    }

    /// Returns the arc length at which a segment that is not across the axis crosses a line. It is
    /// counted from the nearer end of the segment, so that all cells find the same point, however
    /// small the angle to their boundary.
    fn crossing(&self, axis: usize, at: f64) -> f64 {
        let ways = [self.edge.from, self.edge.to].map(|end| at - component(end, axis));
        let k = usize::from(ways[1].abs() < ways[0].abs());
        self.ends[k] + ways[k] / component(self.frame.tangent, axis)
    }

    /// s where a range crosses a straight cut.
    pub(super) fn meets_cut(&self, [lo, hi]: [f64; 2], cut: SegmentCut) -> Vec<f64> {
        let cut = cut.seen_from(self.anchor);
        if self.is_arc() {
            let points = self.seen.meets_near_origin(&Edge::segment(cut.ends)).into_iter();
            return points.filter(|p| cut.passes(*p)).map(|p| self.coordinate(p)).collect();
        }
        let [from, to] = [lo, hi].map(|s| line_side(cut.ends[0], cut.ends[1], self.frame.at(s)));
        let at = (from != to).then(|| lo + (hi - lo) * (from / (from - to)));
        at.filter(|at| cut.passes(self.frame.at(*at))).into_iter().collect()
    }

    /// s where it crosses an arc that does not lie on it.
    pub(super) fn meets_arc(&self, arc: &Edge) -> Vec<f64> {
        let is_on = |part: f64| arc.side(self.edge.at(part)).abs() <= self.slack;
        if is_on(0.3) && is_on(0.7) {
            return Vec::new();
        }
        let arc = Edge { from: arc.from - self.anchor, to: arc.to - self.anchor, ..*arc };
        let near = SLACK * arc.length();
        let points = self.seen.meets_near_origin(&arc).into_iter();
        points.filter(|p| arc.distance(*p) <= near).map(|p| self.coordinate(p)).collect()
    }

    /// s where a level function changes its sign in a range.
    pub(super) fn meets_level(&self, [lo, hi]: [f64; 2], level: &LevelFunction) -> Vec<f64> {
        let at = |s: f64| {
            let place = if self.is_arc() {
                self.anchor + self.frame.at(s)
            } else {
                (self.anchor + self.frame.foot) + self.frame.tangent * s
            };
            clamp_non_finite(level(place))
        };
        let size =
            [lo, 0.5 * (lo + hi), hi].map(at).into_iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let snapped = |s: f64| {
            let value = at(s);
            if value.abs() <= ZERO * size { 0.0 } else { value }
        };
        sign_changes(&snapped, lo, hi)
    }

    /// s at the ends of a segment that lies on the line; none of an arc.
    pub(super) fn range_of(&self, segment: Segment) -> Option<[f64; 2]> {
        let [from, to] = self.ends;
        let near = touch(&around(&segment)).max(TOUCH * (to - from).abs());
        let seen = segment.map(|p| self.seen_from(p));
        let is_on = seen.iter().all(|(_, distance)| *distance <= 2.0 * near) && !self.is_arc();
        is_on.then_some(seen.map(|(s, _)| s))
    }
}

/// The line of a segment, with the foot nearest to the anchor.
fn straight_frame(segment: &Edge, seen: &Edge) -> EdgeFrame {
    let (Edge { from, to, .. }, tangent) = (*seen, segment.chord().unit());
    // the nearer end: the line passes through it except for the rounding of a short way
    let near = if from.length() < to.length() { from } else { to };
    EdgeFrame { foot: tangent.left() * tangent.left().dot(near), tangent, curvature: 0.0 }
}

/// The circle of an arc, with the foot at the point of the arc that is nearest to the anchor.
fn arc_frame(arc: &Edge, seen: &Edge, anchor: Vec2) -> EdgeFrame {
    let (curvature, [start, end]) = (arc.curvature(), arc.end_tangents());
    match arc.closest_part(anchor) {
        0.0 => EdgeFrame { foot: seen.from, tangent: start, curvature },
        1.0 => EdgeFrame { foot: seen.to, tangent: end, curvature },
        _ => EdgeFrame::nearest(arc, anchor),
    }
}
