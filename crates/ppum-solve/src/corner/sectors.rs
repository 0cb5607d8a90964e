//! What the plate looks like around a point of its border: sectors of material between rays.

use crate::problem::{BorderPart, BoundaryCondition, Edge, Problem};
use ppum::domain::{Hole, segment_distance};
use ppum::vec2::{Vec2, vec2};
use std::f64::consts::TAU;

/// Angles nearer than this are the same ray.
const SAME_RAY: f64 = 1e-7;

/// Distance at which it is asked what is material, in parts of the room around the point.
const LOOK: f64 = 1e-3;

/// Material between two rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sector {
    /// Angle of the first ray from the plate's x axis.
    pub(super) from: f64,
    /// The angle counter-clockwise to the second ray, at most 2π.
    pub(super) opening: f64,
    /// On each ray, of each component whether its value is given.
    pub(super) held: [[bool; 2]; 2],
}

/// A ray along which the border, or a crack, leaves a point.
#[derive(Clone, Copy)]
struct Ray {
    angle: f64,
    held: [bool; 2],
}

/// The plate around points.
pub(super) struct Surroundings<'p> {
    pub(super) problem: &'p Problem,
    /// Lengths below this are zero.
    pub(super) touch: f64,
}

impl Surroundings<'_> {
    /// Distance of a point to the nearest part of the border and of cracks that does not go through it. A
    /// circle that does is as far as its radius.
    pub(super) fn distance(&self, p: Vec2) -> f64 {
        let domain = &self.problem.domain;
        let edges = Edge::ALL.map(|edge| edge.depth(&domain.bounds, p).abs());
        let circles = domain.holes.iter().filter_map(|hole| match hole {
            Hole::Circle { radius, .. } if self.is_on(hole.rim_distance(p)) => Some(*radius),
            Hole::Circle { .. } => Some(hole.rim_distance(p)),
            Hole::Polygon { .. } => None,
        });
        let sides = domain.holes.iter().flat_map(Hole::sides);
        let cracks = self.problem.cracks.iter().flat_map(|c| c.points.windows(2));
        let segments = sides.chain(cracks.map(|s| [s[0], s[1]]));
        let segments = segments.map(|[a, b]| segment_distance(a, b, p));
        let all = edges.into_iter().chain(circles).chain(segments);
        all.filter(|distance| !self.is_on(*distance)).fold(f64::INFINITY, f64::min)
    }

    /// The sectors of material around a point whose surroundings are free up to `room`; none inside the
    /// plate and at tips.
    pub(super) fn sectors(&self, p: Vec2, room: f64) -> Vec<Sector> {
        let mut rays = self.rays(p, room);
        rays.sort_by(|a, b| a.angle.total_cmp(&b.angle));
        rays.dedup_by(|b, a| b.angle - a.angle < SAME_RAY);
        let n = rays.len();
        let sector = |k: usize| {
            let (first, second) = (rays[k], rays[(k + 1) % n]);
            let opening = (second.angle - first.angle).rem_euclid(TAU);
            let held = [first.held, second.held];
            Sector { from: first.angle, opening, held }
        };
        let sectors = (0..if n < 2 { 0 } else { n }).map(sector);
        sectors.filter(|sector| self.is_material(p, sector, LOOK * room)).collect()
    }

    /// True if the load on an edge jumps at a point between the edge's ends.
    pub(super) fn load_jumps(&self, p: Vec2, room: f64) -> bool {
        let bounds = &self.problem.domain.bounds;
        let jumps = |edge: &Edge| {
            let [start, end] = edge.range(bounds);
            let first = edge.point(bounds, start);
            let s = start + (edge.point(bounds, end) - first).unit().dot(p - first);
            let is_inside = !self.is_on(s - start) && !self.is_on(end - s);
            let at = [s - LOOK * room, s + LOOK * room];
            let [before, after] = at.map(|beside| self.load(*edge, beside, p));
            self.is_on(edge.depth(bounds, p).abs()) && is_inside && before != after
        };
        Edge::ALL.iter().any(jumps)
    }

    /// The loads at `p` of the conditions on an edge that hold at its coordinate `s`.
    fn load(&self, edge: Edge, s: f64, p: Vec2) -> [f64; 2] {
        let there = self.problem.boundary.iter().filter(|condition| match condition.on {
            BorderPart::Edge { edge: other, from, to } => other == edge && from < s && s < to,
            _ => false,
        });
        let loads = there.map(|condition| condition.loads(p, edge.normal()));
        loads.fold([0.0; 2], |sum, load| [sum[0] + load[0], sum[1] + load[1]])
    }

    fn is_on(&self, distance: f64) -> bool {
        distance <= self.touch
    }

    fn is_material(&self, p: Vec2, sector: &Sector, reach: f64) -> bool {
        let middle = sector.from + 0.5 * sector.opening;
        self.problem.domain.contains(p + vec2(middle.cos(), middle.sin()) * reach)
    }

    fn rays(&self, p: Vec2, room: f64) -> Vec<Ray> {
        let mut rays = Vec::new();
        for edge in Edge::ALL {
            rays.extend(self.along_edge(edge, p, LOOK * room));
        }
        for (index, hole) in self.problem.domain.holes.iter().enumerate() {
            let held = self.held(|on| on == BorderPart::Hole(index));
            rays.extend(self.along_rim(hole, p).into_iter().map(|way| ray(way, held)));
        }
        for segment in self.problem.cracks.iter().flat_map(|crack| crack.points.windows(2)) {
            let ways = self.along([segment[0], segment[1]], p);
            rays.extend(ways.map(|way| ray(way, [false; 2])));
        }
        rays
    }

    /// The rays along an edge, with what is held a step from the point.
    fn along_edge(&self, edge: Edge, p: Vec2, step: f64) -> Vec<Ray> {
        let bounds = &self.problem.domain.bounds;
        if !self.is_on(edge.depth(bounds, p).abs()) {
            return Vec::new();
        }
        let [start, end] = edge.range(bounds);
        let ahead = edge.point(bounds, end) - edge.point(bounds, start);
        let own = start + ahead.unit().dot(p - edge.point(bounds, start));
        let ways = [(ahead, end - own, own + step), (-ahead, own - start, own - step)];
        let inside = ways.into_iter().filter(|(_, left, _)| !self.is_on(*left));
        let ray = |(way, _, s): (Vec2, f64, f64)| {
            let holds = |on| match on {
                BorderPart::Edge { edge: other, from, to } => other == edge && from < s && s < to,
                _ => false,
            };
            ray(way, self.held(holds))
        };
        inside.map(ray).collect()
    }

    fn along_rim(&self, hole: &Hole, p: Vec2) -> Vec<Vec2> {
        match hole {
            Hole::Circle { center, .. } if self.is_on(hole.rim_distance(p)) => {
                let tangent = (p - *center).left();
                vec![tangent, -tangent]
            }
            Hole::Circle { .. } => Vec::new(),
            Hole::Polygon { .. } => hole.sides().flat_map(|side| self.along(side, p)).collect(),
        }
    }

    /// The ways along a segment from a point on it.
    fn along(&self, [a, b]: [Vec2; 2], p: Vec2) -> impl Iterator<Item = Vec2> {
        let on = self.is_on(segment_distance(a, b, p));
        let touch = self.touch;
        [a - p, b - p].into_iter().filter(move |way| on && way.length() > touch)
    }

    /// The components that the conditions on a part of the border hold.
    fn held(&self, is_there: impl Fn(BorderPart) -> bool) -> [bool; 2] {
        let there = self.problem.boundary.iter().filter(|condition| is_there(condition.on));
        there.map(BoundaryCondition::held).fold([false; 2], |a, b| [a[0] || b[0], a[1] || b[1]])
    }
}

fn ray(way: Vec2, held: [bool; 2]) -> Ray {
    Ray { angle: way.y.atan2(way.x), held }
}
