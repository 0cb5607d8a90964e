//! Rules along the rims of holes.

use super::adapt::Subregion;
use super::cell::{CoveredCell, Quadrature, straight_cut};
use super::gauss::{MAX_POINTS, Rules1d};
use super::geometry::Singularity;
use super::roots::{clamp_non_finite, sign_changes};
use super::rule::EdgeRule;
use super::split::{TOLERANCE, breaks, component, divided, kinks};
use ppum::domain::Hole;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::geometry::wider;
use std::cell::Cell;
use std::f64::consts::TAU;

/// Longest part of an arc that gets one rule, in radians. A polynomial of degree 2p of the position
/// is smooth there: with the points added below its integral is exact to rounding.
const LONGEST: f64 = 0.4;

/// Gauss points more than along a straight line, for sines and cosines.
const EXTRA_POINTS: usize = 3;

/// Most bisections of an arc toward a singular point.
const DEPTH: usize = 40;

impl Quadrature<'_> {
    /// Rules on the part of a hole's rim that belongs to a cell, of a polygon on the sides that are
    /// wanted; empty if there is none. Normals point into the hole.
    #[must_use]
    pub(crate) fn rim(
        &self,
        cell: CoveredCell<'_>,
        hole: &Hole,
        is_wanted: impl Fn(usize) -> bool,
    ) -> Vec<EdgeRule> {
        // a side on a line of cells may be beside it by rounding
        let near = wider(cell.rect, TOLERANCE * cell.rect.size().length());
        if !closed_meet(&near, &hole.rim_bounds()) {
            return Vec::new();
        }
        match *hole {
            Hole::Circle { center, radius } => self.arcs(cell, &RoundRim { center, radius }),
            Hole::Polygon { .. } => {
                let turn = hole.orientation();
                let side = |(_, [a, b]): (usize, [Vec2; 2])| {
                    self.edge(cell, [a, b], (b - a).unit().left() * turn)
                };
                let here = |(k, [a, b]): &(usize, [Vec2; 2])| {
                    is_wanted(*k) && closed_meet(&near, &Rect::new(a.min(*b), a.max(*b)))
                };
                hole.sides().enumerate().filter(here).flat_map(side).collect()
            }
        }
    }

    fn arcs(&self, cell: CoveredCell<'_>, circle: &RoundRim) -> Vec<EdgeRule> {
        let mut rules = Vec::new();
        let all = self.turns(cell, circle);
        for ends in all.windows(2).filter(|ends| ends[1] - ends[0] > TOLERANCE) {
            let normal = circle.normal(0.5 * (ends[0] + ends[1]));
            let middle = circle.center - normal * circle.radius;
            if !cell.rect.contains(middle) || !self.is_solid(cell.rect, middle, normal) {
                continue;
            }
            let support = |i: &u32| self.geometry.partition.support(*i as usize);
            let covers = |i: &u32| support(i).contains(middle);
            let mut patches: Vec<u32> = cell.patches.iter().copied().filter(covers).collect();
            patches.sort_unstable();
            let mut rule = EdgeRule::empty(cell.rect.center(), &patches);
            let parts = ((ends[1] - ends[0]) / LONGEST).ceil() as usize;
            let parts = if patches.len() > 1 { parts * self.orders.parts } else { parts };
            let singular = self.singular_points(&patches, cell.rect);
            for part in divided(ends.to_vec(), parts).windows(2) {
                let arc = RoundArc { circle, anchor: rule.anchor, turns: [part[0], part[1]] };
                self.add_arc(arc, &singular, (DEPTH, cell.rect), &mut rule);
            }
            rules.push(rule);
        }
        rules
    }

    /// Angles at which something happens in a cell, from 0 to 2π.
    fn turns(&self, cell: CoveredCell<'_>, circle: &RoundRim) -> Vec<f64> {
        let geometry = &self.geometry;
        let supports = cell.patches.iter().map(|&i| geometry.partition.support(i as usize));
        let boxes: Vec<Rect> = supports.chain([*cell.rect]).collect();
        let mut turns = Vec::new();
        for axis in 0..2 {
            let boundaries = boxes.iter().flat_map(|b| [b.min, b.max].map(|p| component(p, axis)));
            let kinks = kinks(geometry.partition, cell.patches, axis);
            for at in boundaries.chain(kinks) {
                turns.extend(circle.turns_at(axis, at));
            }
        }
        let active = geometry.active_kinks(cell.patches);
        let straight = active.iter().filter_map(|kink| straight_cut(kink, cell.rect));
        for cut in self.cuts_near(cell.rect).chain(straight) {
            turns.extend(circle.turns_on(cut.ends[0], cut.ends[1]));
        }
        turns.sort_by(f64::total_cmp);
        let known = breaks(0.0, TAU, turns.clone(), TOLERANCE);
        for level in self.levels(&active) {
            // Its own rim is zero except for rounding.
            let size = circle.radius * circle.radius;
            let at = |turn: f64| {
                let value = clamp_non_finite(level(circle.at(turn)));
                if value.abs() <= TOLERANCE * size { 0.0 } else { value }
            };
            turns.extend(known.windows(2).flat_map(|ends| sign_changes(&at, ends[0], ends[1])));
        }
        breaks(0.0, TAU, turns, TOLERANCE)
    }

    fn add_arc(
        &self,
        arc: RoundArc<'_>,
        singular: &[Singularity],
        (depth, cell): (usize, &Rect),
        rule: &mut EdgeRule,
    ) {
        let RoundArc { circle, turns: [from, to], .. } = arc;
        let middle = 0.5 * (from + to);
        let length = circle.radius * (to - from);
        let distance = |at: &Singularity| (circle.at(middle) - at.point).length() - 0.5 * length;
        let nearest = singular.iter().map(distance).fold(f64::INFINITY, f64::min);
        if nearest < length && depth > 0 {
            for half in arc.halves() {
                self.add_arc(half, singular, (depth - 1, cell), rule);
            }
            return;
        }
        let order = self.order_along(&rule.patches, nearest / length);
        let to_center = circle.center - rule.anchor;
        let normal = |offset: Vec2| (to_center - offset).unit();
        self.add_parts(vec![arc], order, (cell, &Cell::new(self.divisions)), normal, rule);
    }
}

/// A part of a round rim.
#[derive(Clone)]
struct RoundArc<'c> {
    circle: &'c RoundRim,
    anchor: Vec2,
    turns: [f64; 2],
}

impl RoundArc<'_> {
    fn halves(&self) -> [Self; 2] {
        let [from, to] = self.turns;
        let middle = 0.5 * (from + to);
        [[from, middle], [middle, to]].map(|turns| Self { turns, ..self.clone() })
    }
}

impl Subregion for RoundArc<'_> {
    fn nodes(&self, rules: Rules1d, n: usize, push: &mut dyn FnMut(Vec2, f64)) {
        let [from, to] = self.turns;
        for (turn, weight) in rules((n + EXTRA_POINTS).min(MAX_POINTS)).on(from, to) {
            let to_center = self.circle.center - self.anchor;
            let offset = to_center - self.circle.normal(turn) * self.circle.radius;
            push(offset, weight * self.circle.radius);
        }
    }

    fn divisions(&self, _: &[Vec2]) -> Vec<[Self; 2]> {
        vec![self.halves()]
    }
}

/// True if two closed boxes have a point in common.
pub(crate) fn closed_meet(a: &Rect, b: &Rect) -> bool {
    let common = a.intersection(b);
    common.min.x <= common.max.x && common.min.y <= common.max.y
}

/// A round rim.
struct RoundRim {
    center: Vec2,
    radius: f64,
}

impl RoundRim {
    /// Out of the material: to the centre.
    fn normal(&self, turn: f64) -> Vec2 {
        -vec2(turn.cos(), turn.sin())
    }

    fn at(&self, turn: f64) -> Vec2 {
        self.center - self.normal(turn) * self.radius
    }

    /// The angles at which a coordinate has a value.
    fn turns_at(&self, axis: usize, at: f64) -> impl Iterator<Item = f64> + use<> {
        let part = (at - component(self.center, axis)) / self.radius;
        let turns = match axis {
            0 => [part.acos(), -part.acos()],
            _ => [part.asin(), 0.5 * TAU - part.asin()],
        };
        turns.into_iter().filter(|turn| turn.is_finite()).map(positive)
    }

    /// The angles at which the line through two points is met.
    fn turns_on(&self, a: Vec2, b: Vec2) -> impl Iterator<Item = f64> + use<> {
        let along = (b - a).unit();
        let height = along.left().dot(a - self.center) / self.radius;
        let foot = along.left().y.atan2(along.left().x);
        let turns = [foot + height.acos(), foot - height.acos()];
        turns.into_iter().filter(|turn| turn.is_finite()).map(positive)
    }
}

/// Reduces an angle to 0 ≤ θ < 2π.
fn positive(turn: f64) -> f64 {
    turn.rem_euclid(TAU)
}
