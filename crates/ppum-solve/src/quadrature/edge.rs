//! Rules along segments: parts of the boundary, faces of cracks.

use super::adapt::{IntegrandDemand, Subregion, refined};
use super::cell::{CoveredCell, Quadrature, SAME_POINT, distinct, straight_cut};
use super::geometry::{CrackFace, KinkLine, LevelFunction, Singularity};
use super::graded_interval::{GradedInterval, LineParameter};
use super::orders::ActiveFunctions;
use super::polygon::SegmentCut;
use super::polygon::line_side;
use super::roots::{ZERO, clamp_non_finite, sign_changes};
use super::rule::EdgeRule;
use super::singular::panels;
use super::split::{TOLERANCE, breaks, component, divided, kinks, varies};
use ppum::border::{TOUCH, touch};
use ppum::crack::Side;
use ppum::segment::Segment;
use ppum::vec2::{Rect, Vec2};
use ppum_problem::geometry::{around, without};
use std::cell::Cell;

/// Distances from the line of a segment below this part of its length count as zero.
const ON_LINE: f64 = 1e-14;

/// Rounding of coordinates, as a part of them.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Distance behind a boundary, in units of a cell, at which it is asked whether there is a hole.
const INWARD: f64 = 1e-9;

impl Quadrature<'_> {
    /// False if behind a point of a boundary, where the normal comes from, there is a hole.
    pub(super) fn is_solid(&self, cell: &Rect, p: Vec2, normal: Vec2) -> bool {
        let behind = p - normal * (INWARD * cell.size().length());
        !self.geometry.holes.iter().any(|hole| hole.contains(behind))
    }

    /// [`edge`](Self::edge) along a face of a crack of the geometry.
    ///
    /// # Panics
    /// If there is no such segment.
    #[must_use]
    pub(crate) fn face(&self, cell: CoveredCell<'_>, face: CrackFace) -> Vec<EdgeRule> {
        self.part_of_face(cell, face.ends(self.geometry.cracks), face)
    }

    /// Returns the rule along the part of a face between two points of its segment.
    #[must_use]
    pub fn part_of_face(
        &self,
        cell: CoveredCell<'_>,
        part: [Vec2; 2],
        face: CrackFace,
    ) -> Vec<EdgeRule> {
        let ends = face.ends(self.geometry.cracks);
        let left = (ends[1] - ends[0]).unit().left();
        let normal = if face.side == Side::Above { -left } else { left };
        self.along(cell, part, normal, Some(face))
    }

    /// Rules on the part of a straight segment that belongs to a cell; empty if none does.
    ///
    /// `normal` is the segment's unit normal out of the material. Parts without material behind
    /// them count for nothing, and neither do faces of cracks on it. A segment along a cell's
    /// boundary belongs to the cell that `normal` points out of.
    #[must_use]
    pub(crate) fn edge(
        &self,
        cell: CoveredCell<'_>,
        ends: [Vec2; 2],
        normal: Vec2,
    ) -> Vec<EdgeRule> {
        self.along(cell, ends, normal, None)
    }

    fn along(
        &self,
        cell: CoveredCell<'_>,
        ends: [Vec2; 2],
        normal: Vec2,
        face: Option<CrackFace>,
    ) -> Vec<EdgeRule> {
        let line = EdgeLine::new(cell.rect.center(), ends, normal);
        let tolerance = TOLERANCE * cell.rect.size().length();
        let counts = |(lo, hi): &(f64, f64)| hi - lo > tolerance && line.belongs_to(cell.rect);
        let inside = line.inside(cell.rect, line.ends, line.slack).filter(counts);
        let Some((lo, hi)) = inside else { return Vec::new() };
        let (left, rules, quadrature) = (Cell::new(self.divisions), Vec::new(), self);
        let mut run = LineIntegration { quadrature, line, face, tolerance, cell, rules, left };
        let faces: Vec<_> = match face {
            None => self.faces.iter().filter_map(|face| run.line.range_of(*face)).collect(),
            Some(_) => Vec::new(),
        };
        without([lo, hi], &faces).into_iter().for_each(|[lo, hi]| run.add(lo, hi));
        run.rules
    }

    /// Adds parts of a curve with normals out of the material, divided until they resolve what they
    /// have to, to a rule with the anchor that the parts have. Some divisions are left for the
    /// cell.
    pub(super) fn add_parts<P: Subregion>(
        &self,
        parts: Vec<P>,
        order: usize,
        (cell, left): (&Rect, &Cell<usize>),
        normal: impl Fn(Vec2) -> Vec2,
        rule: &mut EdgeRule,
    ) {
        let active = self.geometry.active_probes(&rule.patches);
        let demand = self.geometry.demand(&active, order, self.orders, (cell, left));
        let demand = IntegrandDemand { anchor: rule.anchor, face: rule.face, ..demand };
        let doubt = refined(parts, &demand, &mut |x, w| rule.push(x, w, normal(x)));
        rule.doubt.add(&doubt);
    }

    /// The number of Gauss points on a part of a curve that is so far from singular points, in
    /// parts of its length.
    pub(super) fn order_along(&self, patches: &[u32], distance: f64) -> usize {
        self.orders.choose(&ActiveFunctions {
            patches: patches.len(),
            distance,
            kinks: self.geometry.has_kinks(patches),
            probes: !self.geometry.active_probes(patches).is_empty(),
        })
    }

    /// The distinct singular points of some patches.
    pub(super) fn singular_points(&self, patches: &[u32], cell: &Rect) -> Vec<Singularity> {
        distinct(self.geometry.singular_points(patches), SAME_POINT * cell.size().length())
    }

    /// The level functions of round rims, and of the curves among some kinks.
    pub(super) fn levels<'k>(
        &'k self,
        kinks: &'k [&KinkLine],
    ) -> impl Iterator<Item = &'k LevelFunction> {
        let curved = kinks.iter().filter_map(|kink| match kink {
            KinkLine::Curve(level) => Some(level),
            _ => None,
        });
        curved.chain(&self.circles).map(|level| level.as_ref())
    }
}

/// The points anchor + foot + s · tangent.
struct EdgeLine {
    anchor: Vec2,
    tangent: Vec2,
    normal: Vec2,
    foot: Vec2,
    /// The segment that the points are on, and s at its ends.
    segment: [Vec2; 2],
    ends: [f64; 2],
    /// Distances that are rounding. They are those of the segment, not of a cell: cells of several
    /// sizes on both sides of it must agree whose it is.
    slack: f64,
}

impl EdgeLine {
    fn new(anchor: Vec2, segment: [Vec2; 2], normal: Vec2) -> Self {
        let [from, to] = segment.map(|p| p - anchor);
        let tangent = (segment[1] - segment[0]).unit();
        // the nearer end: the line passes through it except for the rounding of a short way
        let near = if from.length() < to.length() { from } else { to };
        let foot = tangent.left() * tangent.left().dot(near);
        let ends = [tangent.dot(from), tangent.dot(to)];
        let largest = segment.iter().fold(0.0f64, |m, p| m.max(p.x.abs()).max(p.y.abs()));
        let slack = TOLERANCE * (segment[1] - segment[0]).length() + ROUNDING * largest;
        Self { anchor, tangent, normal, foot, segment, ends, slack }
    }

    /// The part of \[ends\] inside a box, if it has a length, however short: boxes of different
    /// sizes must agree. A line along a boundary is inside for a positive `slack`, a distance.
    fn inside(&self, rect: &Rect, ends: [f64; 2], slack: f64) -> Option<(f64, f64)> {
        let [mut lo, mut hi] = ends;
        let main = usize::from(self.tangent.y.abs() > self.tangent.x.abs());
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
        (hi > lo).then_some((lo, hi))
    }

    /// The lower and the upper end of a box along an axis, relative to the anchor.
    fn boundaries(&self, rect: &Rect, axis: usize) -> (f64, f64) {
        (component(rect.min - self.anchor, axis), component(rect.max - self.anchor, axis))
    }

    /// Coordinate of the segment along an axis, relative to the anchor, if that is one place but
    /// for rounding.
    fn level(&self, axis: usize) -> Option<f64> {
        let [from, to] = self.segment.map(|p| component(p, axis));
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

    /// s of the point whose coordinate along an axis is `at`; none on a line across the axis.
    fn parameter(&self, axis: usize, at: f64) -> Option<f64> {
        (component(self.tangent, axis) != 0.0).then(|| self.crossing(axis, at))
    }

    /// Returns the arc length at which a segment that is not across the axis crosses a line. It is
    /// counted from the nearer end of the segment, so that all cells find the same point, however
    /// small the angle to their boundary.
    fn crossing(&self, axis: usize, at: f64) -> f64 {
        let ways = self.segment.map(|end| at - component(end, axis));
        let k = usize::from(ways[1].abs() < ways[0].abs());
        self.ends[k] + ways[k] / component(self.tangent, axis)
    }

    /// s at the ends of a segment that lies on the line.
    fn range_of(&self, segment: Segment) -> Option<[f64; 2]> {
        let [from, to] = self.ends;
        let near = touch(&around(&segment)).max(TOUCH * (to - from).abs());
        let seen = segment.map(|p| self.seen_from(p));
        seen.iter().all(|(_, distance)| *distance <= 2.0 * near).then_some(seen.map(|(s, _)| s))
    }

    /// s of a point's foot on the line, and the point's distance to the line.
    fn seen_from(&self, point: Vec2) -> (f64, f64) {
        let way = point - self.anchor;
        (self.tangent.dot(way), self.tangent.left().dot(way - self.foot).abs())
    }
}

struct LineIntegration<'a> {
    quadrature: &'a Quadrature<'a>,
    line: EdgeLine,
    /// The face that the line lies on, if it is on one.
    face: Option<CrackFace>,
    tolerance: f64,
    cell: CoveredCell<'a>,
    rules: Vec<EdgeRule>,
    /// Divisions that are left.
    left: Cell<usize>,
}

impl LineIntegration<'_> {
    /// Splits at the boundaries of supports.
    fn add(&mut self, lo: f64, hi: f64) {
        let partition = self.quadrature.geometry.partition;
        let covered: Vec<(u32, (f64, f64))> = self
            .cell
            .patches
            .iter()
            .filter_map(|&i| {
                let support = partition.support(i as usize);
                Some((i, self.line.inside(&support, [lo, hi], -self.line.slack)?))
            })
            .collect();
        let boundaries = covered.iter().flat_map(|&(_, (a, b))| [a, b]).collect();
        for part in breaks(lo, hi, boundaries, self.tolerance).windows(2) {
            let mid = 0.5 * (part[0] + part[1]);
            let holds = |&(_, (a, b)): &(u32, (f64, f64))| a < mid && mid < b;
            let mut patches: Vec<u32> = covered.iter().filter(|c| holds(c)).map(|c| c.0).collect();
            patches.sort_unstable();
            self.add_constant_set(part[0], part[1], &patches);
        }
    }

    /// Splits at kinks of the partition functions, of functions and materials, and at cracks.
    fn add_constant_set(&mut self, lo: f64, hi: f64, patches: &[u32]) {
        let geometry = &self.quadrature.geometry;
        let (mut points, mut varying) = (Vec::new(), false);
        for axis in 0..2 {
            let kinks = kinks(geometry.partition, patches, axis);
            points.extend(kinks.into_iter().filter_map(|at| self.line.parameter(axis, at)));
            varying |= component(self.line.tangent, axis) != 0.0
                && varies(geometry.partition, patches, axis);
        }
        points.extend(self.crossings(lo, hi, &geometry.active_kinks(patches)));
        let singular = self.quadrature.singular_points(patches, self.cell.rect);
        let mut breaks = breaks(lo, hi, points, self.tolerance);
        if varying {
            breaks = divided(breaks, self.quadrature.orders.parts);
        }
        for part in breaks.windows(2) {
            let middle = self.line.foot + self.line.tangent * (0.5 * (part[0] + part[1]));
            if self.quadrature.is_solid(self.cell.rect, self.line.anchor + middle, self.line.normal)
            {
                self.add_smooth(part[0], part[1], patches, &singular);
            }
        }
    }

    /// Crossings of the line with crack segments that meet the cell, and with kinks.
    fn crossings(&self, lo: f64, hi: f64, kinks: &[&KinkLine]) -> Vec<f64> {
        let point = |s: f64| self.line.foot + self.line.tangent * s;
        let crossing = |cut: SegmentCut| {
            let cut = cut.seen_from(self.line.anchor);
            let [from, to] = [lo, hi].map(|s| line_side(cut.ends[0], cut.ends[1], point(s)));
            let at = (from != to).then(|| lo + (hi - lo) * (from / (from - to)))?;
            cut.passes(point(at)).then_some(at)
        };
        let straight = kinks.iter().filter_map(|kink| straight_cut(kink, self.cell.rect));
        let others = self.quadrature.cuts_near(self.cell.rect);
        let others = others.filter(|cut| cut.ends != self.line.segment);
        let lines = others.chain(straight);
        let levels = self.quadrature.levels(kinks);
        let curved = levels.flat_map(|level| self.curve_crossings(lo, hi, level));
        lines.filter_map(crossing).chain(curved).collect()
    }

    fn curve_crossings(&self, lo: f64, hi: f64, level: &LevelFunction) -> Vec<f64> {
        let start = self.line.anchor + self.line.foot;
        let at = |s: f64| clamp_non_finite(level(start + self.line.tangent * s));
        let size =
            [lo, 0.5 * (lo + hi), hi].map(at).into_iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let snapped = |s: f64| {
            let value = at(s);
            if value.abs() <= ZERO * size { 0.0 } else { value }
        };
        sign_changes(&snapped, lo, hi)
    }

    fn add_smooth(&mut self, lo: f64, hi: f64, patches: &[u32], singular: &[Singularity]) {
        let distance = |at: &Singularity| {
            let (s, d) = self.line.seen_from(at.point);
            (s - s.clamp(lo, hi)).hypot(d)
        };
        let near: Vec<Singularity> =
            singular.iter().copied().filter(|at| distance(at) < hi - lo).collect();
        let nearest = singular.iter().map(distance).fold(f64::INFINITY, f64::min);
        let order = self.quadrature.order_along(patches, nearest / (hi - lo));
        match near[..] {
            [] => {
                let (foot, tangent) = (self.line.foot, self.line.tangent);
                let stretch = GradedInterval {
                    path: LineParameter::Straight,
                    foot,
                    tangent,
                    interval: (lo, hi),
                };
                self.push(self.line.anchor, patches, order, vec![stretch]);
            }
            [at] => self.push(at.point, patches, order, self.graded(lo, hi, &at, order)),
            _ => {
                let mid = 0.5 * (lo + hi);
                self.add_smooth(lo, mid, patches, &near);
                self.add_smooth(mid, hi, patches, &near);
            }
        }
    }

    /// Graded toward a singular point, and relative to it: x = d sinh u at distance d, a power on
    /// the line itself.
    fn graded(&self, lo: f64, hi: f64, at: &Singularity, order: usize) -> Vec<GradedInterval> {
        let (s, d) = self.line.seen_from(at.point);
        // an end at the point itself is there exactly: what rounding would leave between
        // them counts
        let from_point = |x: f64| if (x - s).abs() > ON_LINE * (hi - lo) { x - s } else { 0.0 };
        let (lo, hi) = (from_point(lo), from_point(hi));
        let tangent = self.line.tangent;
        if d > ON_LINE * (hi - lo) {
            let normal = tangent.left();
            let foot = normal * normal.dot(self.line.foot - (at.point - self.line.anchor));
            let beside = |interval| GradedInterval {
                path: LineParameter::Beside(d),
                foot,
                tangent,
                interval,
            };
            return panels(lo, hi, d).map(beside).collect();
        }
        let grading = at.growth.along_lines(order);
        let root = |r: f64| r.powf(1.0 / grading.power);
        [(lo.max(0.0), hi, 1.0), ((-hi).max(0.0), -lo, -1.0)]
            .into_iter()
            .filter(|(from, to, _)| to > from)
            .map(|(from, to, sign)| GradedInterval {
                path: LineParameter::Through { sign, grading },
                foot: Vec2::ZERO,
                tangent,
                interval: (root(from), root(to)),
            })
            .collect()
    }

    fn push(
        &mut self,
        anchor: Vec2,
        patches: &[u32],
        order: usize,
        intervals: Vec<GradedInterval>,
    ) {
        let same = |r: &EdgeRule| r.anchor == anchor && r.patches == patches;
        let at = self.rules.iter().position(same).unwrap_or_else(|| {
            self.rules.push(EdgeRule { face: self.face, ..EdgeRule::empty(anchor, patches) });
            self.rules.len() - 1
        });
        let (within, normal) = ((self.cell.rect, &self.left), |_| self.line.normal);
        self.quadrature.add_parts(intervals, order, within, normal, &mut self.rules[at]);
    }
}
