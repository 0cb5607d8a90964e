//! Rules along the rims of holes.

use super::adapt::{IntegrandDemand, RefinedParts, Subregion, refined};
use super::cell::{Quadrature, SAME_POINT, distinct, straight_cut};
use super::edge::EdgeRule;
use super::gauss::{MAX_POINTS, Rules1d, gauss};
use super::geometry::{KinkLine, Singularity};
use super::orders::ActiveFunctions;
use super::roots::{clamp_non_finite, sign_changes};
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
        cell: &Rect,
        covering_patches: &[u32],
        hole: &Hole,
        is_wanted: impl Fn(usize) -> bool,
    ) -> Vec<EdgeRule> {
        // a side on a line of cells may be beside it by rounding
        let near = wider(cell, TOLERANCE * cell.size().length());
        if !closed_meet(&near, &hole.rim_bounds()) {
            return Vec::new();
        }
        match *hole {
            Hole::Circle { center, radius } => {
                self.arcs(cell, covering_patches, &RoundRim { center, radius })
            }
            Hole::Polygon { .. } => {
                let turn = hole.orientation();
                let side = |(_, [a, b]): (usize, [Vec2; 2])| {
                    self.edge(cell, covering_patches, [a, b], (b - a).unit().left() * turn)
                };
                let here = |(k, [a, b]): &(usize, [Vec2; 2])| {
                    is_wanted(*k) && closed_meet(&near, &Rect::new(a.min(*b), a.max(*b)))
                };
                hole.sides().enumerate().filter(here).flat_map(side).collect()
            }
        }
    }

    fn arcs(&self, cell: &Rect, covering_patches: &[u32], circle: &RoundRim) -> Vec<EdgeRule> {
        let mut rules = Vec::new();
        let all = self.turns(cell, covering_patches, circle);
        for ends in all.windows(2).filter(|ends| ends[1] - ends[0] > TOLERANCE) {
            let normal = circle.normal(0.5 * (ends[0] + ends[1]));
            let middle = circle.center - normal * circle.radius;
            if !cell.contains(middle) || !self.is_solid(cell, middle, normal) {
                continue;
            }
            let support = |i: &u32| self.geometry.partition.support(*i as usize);
            let covers = |i: &u32| support(i).contains(middle);
            let mut patches: Vec<u32> = covering_patches.iter().copied().filter(covers).collect();
            patches.sort_unstable();
            let mut rule = EdgeRule::empty(cell.center(), &patches);
            let parts = ((ends[1] - ends[0]) / LONGEST).ceil() as usize;
            let parts = if patches.len() > 1 { parts * self.orders.parts } else { parts };
            let apart = SAME_POINT * cell.size().length();
            let singular = distinct(self.geometry.singular_points(&patches), apart);
            for part in divided(ends.to_vec(), parts).windows(2) {
                self.add_arc(circle, [part[0], part[1]], &singular, (DEPTH, cell), &mut rule);
            }
            rules.push(rule);
        }
        rules
    }

    /// Angles at which something happens in a cell, from 0 to 2π.
    fn turns(&self, cell: &Rect, covering_patches: &[u32], circle: &RoundRim) -> Vec<f64> {
        let geometry = &self.geometry;
        let supports = covering_patches.iter().map(|&i| geometry.partition.support(i as usize));
        let boxes: Vec<Rect> = supports.chain([*cell]).collect();
        let mut turns = Vec::new();
        for axis in 0..2 {
            let borders = boxes.iter().flat_map(|b| [b.min, b.max].map(|p| component(p, axis)));
            let kinks = kinks(geometry.partition, covering_patches, axis);
            for at in borders.chain(kinks) {
                turns.extend(circle.turns_at(axis, at));
            }
        }
        let active = geometry.active_kinks(covering_patches);
        let straight = active.iter().filter_map(|kink| straight_cut(kink, cell));
        for cut in self.cuts_near(cell).chain(straight) {
            turns.extend(circle.turns_on(cut.ends[0], cut.ends[1]));
        }
        let curved = active.iter().filter_map(|kink| match kink {
            KinkLine::Curve(level) => Some(level),
            _ => None,
        });
        turns.sort_by(f64::total_cmp);
        let known = breaks(0.0, TAU, turns.clone(), TOLERANCE);
        for level in curved.chain(&self.circles) {
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
        circle: &RoundRim,
        [from, to]: [f64; 2],
        singular: &[Singularity],
        (depth, cell): (usize, &Rect),
        rule: &mut EdgeRule,
    ) {
        let middle = 0.5 * (from + to);
        let length = circle.radius * (to - from);
        let distance = |at: &Singularity| (circle.at(middle) - at.point).length() - 0.5 * length;
        let nearest = singular.iter().map(distance).fold(f64::INFINITY, f64::min);
        if nearest < length && depth > 0 {
            for half in [[from, middle], [middle, to]] {
                self.add_arc(circle, half, singular, (depth - 1, cell), rule);
            }
            return;
        }
        let active = self.geometry.active_probes(&rule.patches);
        let order = self.orders.choose(&ActiveFunctions {
            patches: rule.patches.len(),
            distance: nearest / length,
            kinks: self.geometry.has_kinks(&rule.patches),
            probes: !active.is_empty(),
        });
        let left = Cell::new(self.divisions);
        let demand = IntegrandDemand {
            probes: self.geometry.probes,
            active: &active,
            anchor: rule.anchor,
            face: None,
            curved: false,
            size: cell.size().length(),
            points: order.saturating_sub(self.orders.reserve).max(1),
            order,
            left: &left,
        };
        let arc = RoundArc { circle, anchor: rule.anchor, turns: [from, to] };
        let RefinedParts { regions: parts, doubt } = refined(vec![arc], &demand);
        rule.doubt.add(&doubt);
        for RoundArc { turns: [from, to], .. } in parts {
            for (turn, weight) in gauss((order + EXTRA_POINTS).min(MAX_POINTS)).on(from, to) {
                let normal = circle.normal(turn);
                let offset = (circle.center - rule.anchor) - normal * circle.radius;
                rule.push(offset, weight * circle.radius, normal);
            }
        }
    }
}

/// A part of a round rim.
#[derive(Clone)]
struct RoundArc<'c> {
    circle: &'c RoundRim,
    anchor: Vec2,
    turns: [f64; 2],
}

impl Subregion for RoundArc<'_> {
    fn nodes(&self, rules: Rules1d, n: usize, push: &mut dyn FnMut(Vec2, f64)) {
        let [from, to] = self.turns;
        for (turn, weight) in rules((n + EXTRA_POINTS).min(MAX_POINTS)).on(from, to) {
            push(self.circle.at(turn) - self.anchor, weight * self.circle.radius);
        }
    }

    fn divisions(&self, _: &[Vec2]) -> Vec<[Self; 2]> {
        let [from, to] = self.turns;
        let middle = 0.5 * (from + to);
        vec![[[from, middle], [middle, to]].map(|turns| Self { turns, ..self.clone() })]
    }
}

/// True if two closed boxes have a point in common.
fn closed_meet(a: &Rect, b: &Rect) -> bool {
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
