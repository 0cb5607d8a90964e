//! The body around a point of its boundary: sectors of material between rays.

use ppum::crack::Side;
use ppum::domain::Hole;
use ppum::segment;
use ppum::vec2::{Vec2, vec2};
use ppum_problem::{BoundaryPart, DomainEdge, Problem};
use std::f64::consts::TAU;

/// Angles nearer than this are the same ray.
const SAME_RAY: f64 = 1e-7;

/// Distance at which it is asked what is material, in parts of the room around the point.
pub(super) const LOOK: f64 = 1e-3;

/// Material between two rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sector {
    /// Angle of the first ray from the body's x axis.
    pub(super) from: f64,
    /// The angle counter-clockwise to the second ray, at most 2π.
    pub(super) opening: f64,
    /// On each ray, of each component whether its value is given.
    pub(super) held: [[bool; 2]; 2],
    /// On each ray, the directions of the components.
    pub(super) axes: [[Vec2; 2]; 2],
    /// On each ray, the traction (the flux) at the point.
    pub(super) load: [[f64; 2]; 2],
    /// On each ray, the given values at the point.
    pub(super) value: [[f64; 2]; 2],
}

impl Sector {
    /// The unit normals out of the material on the two rays.
    pub(super) fn normals(&self) -> [Vec2; 2] {
        let way = |angle: f64| vec2(angle.cos(), angle.sin());
        [-way(self.from).left(), way(self.from + self.opening).left()]
    }
}

/// A ray along which the boundary, or a crack, leaves a point.
#[derive(Clone, Copy)]
struct Ray {
    angle: f64,
    on: RayLine,
}

/// Distance at which loads are looked at, in parts of the room around the point.
const BESIDE: f64 = 1e-9;

/// The line that a ray runs on.
#[derive(Clone, Copy)]
enum RayLine {
    /// An edge, with its own coordinate a step from the point.
    Edge(DomainEdge, f64),
    /// A side of the rim of a hole; 0 of a circle.
    Rim { hole: usize, side: usize },
    /// A crack, in its direction or against it.
    Crack { crack: usize, ahead: bool },
}

impl RayLine {
    /// True if conditions on a part of the boundary hold here. The material is on the left of a
    /// first ray.
    fn is_part_of(self, part: BoundaryPart, problem: &Problem, is_first: bool) -> bool {
        match (self, part) {
            (Self::Edge(edge, s), BoundaryPart::Edge { edge: other, from, to }) => {
                other == edge && from < s && s < to
            }
            (Self::Rim { hole, side }, part) => problem.is_on(part, hole, side),
            (Self::Crack { crack, ahead }, BoundaryPart::Crack { crack: other, face }) => {
                let side = if ahead == is_first { Side::Above } else { Side::Below };
                crack == other && face.is_none_or(|face| face == side)
            }
            _ => false,
        }
    }
}

/// The body around points.
pub(super) struct CornerSurroundings<'p> {
    pub(super) problem: &'p Problem,
    /// Lengths below this are zero.
    pub(super) touch: f64,
}

impl CornerSurroundings<'_> {
    /// Distance of a point to the nearest part of the boundary and of cracks that does not go
    /// through it. A circle that does is as far as its radius.
    pub(super) fn distance(&self, p: Vec2) -> f64 {
        let domain = self.problem.domain();
        let edges = DomainEdge::ALL.map(|edge| edge.depth(&domain.bounds, p).abs());
        let circles = domain.holes.iter().filter_map(|hole| match hole {
            Hole::Circle { radius, .. } if self.is_on(hole.rim_distance(p)) => Some(*radius),
            Hole::Circle { .. } => Some(hole.rim_distance(p)),
            Hole::Polygon { .. } => None,
        });
        let sides = domain.holes.iter().flat_map(Hole::sides);
        let cracks = self.problem.cracks().iter().flat_map(|c| c.points.windows(2));
        let segments =
            sides.chain(cracks.map(|s| [s[0], s[1]])).map(|[a, b]| segment::distance([a, b], p));
        let all = edges.into_iter().chain(circles).chain(segments);
        all.filter(|distance| !self.is_on(*distance)).fold(f64::INFINITY, f64::min)
    }

    /// The sectors of material around a point whose surroundings are free up to `room`; none inside
    /// the body and at tips.
    pub(super) fn sectors(&self, p: Vec2, room: f64) -> Vec<Sector> {
        let mut rays = self.rays(p, room);
        rays.sort_by(|a, b| a.angle.total_cmp(&b.angle));
        // of a boundary and a crack on it the crack counts
        rays.dedup_by(|b, a| {
            let is_same = b.angle - a.angle < SAME_RAY;
            if is_same && matches!(b.on, RayLine::Crack { .. }) {
                a.on = b.on;
            }
            is_same
        });
        if let [first, .., last] = rays[..]
            && first.angle + TAU - last.angle < SAME_RAY
        {
            let at = if matches!(first.on, RayLine::Crack { .. }) { rays.len() - 1 } else { 0 };
            rays.remove(at);
        }
        let n = rays.len();
        let sector = |k: usize| self.sector(p, [rays[k], rays[(k + 1) % n]], BESIDE * room);
        let sectors = (0..if n < 2 { 0 } else { n }).map(sector);
        sectors.filter(|sector| self.is_material(p, sector, LOOK * room)).collect()
    }

    fn sector(&self, p: Vec2, rays: [Ray; 2], beside: f64) -> Sector {
        let (from, to) = (rays[0].angle, rays[1].angle);
        let opening = (to - from).rem_euclid(TAU);
        let (held, load, value) = Default::default();
        let axes = [[vec2(1.0, 0.0), vec2(0.0, 1.0)]; 2];
        let mut sector = Sector { from, opening, held, axes, load, value };
        let normals = sector.normals();
        for (k, ray) in rays.into_iter().enumerate() {
            for condition in &self.problem.boundary {
                if !ray.on.is_part_of(condition.on, self.problem, k == 0) {
                    continue;
                }
                let place = p + vec2(ray.angle.cos(), ray.angle.sin()) * beside;
                let (held, load) = (condition.fixed(), condition.loads(place, normals[k]));
                let values = condition.values(place, normals[k]);
                if held.contains(&true) {
                    sector.axes[k] = condition.axes();
                }
                for i in 0..2 {
                    sector.held[k][i] |= held[i];
                    sector.load[k][i] += load[i];
                    sector.value[k][i] += if held[i] { values[i] } else { 0.0 };
                }
            }
        }
        sector
    }

    fn is_on(&self, distance: f64) -> bool {
        distance <= self.touch
    }

    fn is_material(&self, p: Vec2, sector: &Sector, reach: f64) -> bool {
        let middle = sector.from + 0.5 * sector.opening;
        self.problem.domain().contains(p + vec2(middle.cos(), middle.sin()) * reach)
    }

    fn rays(&self, p: Vec2, room: f64) -> Vec<Ray> {
        let mut rays = Vec::new();
        for edge in DomainEdge::ALL {
            rays.extend(self.along_edge(edge, p, LOOK * room));
        }
        for (index, hole) in self.problem.domain().holes.iter().enumerate() {
            rays.extend(self.along_rim((index, hole), p));
        }
        for (crack, index) in self.problem.cracks().iter().zip(0..) {
            for segment in crack.points.windows(2) {
                let on = |way: Vec2| RayLine::Crack {
                    crack: index,
                    ahead: way.dot(segment[1] - segment[0]) > 0.0,
                };
                let ways = self.along([segment[0], segment[1]], p);
                rays.extend(ways.map(|way| ray(way, on(way))));
            }
        }
        rays
    }

    /// The rays along an edge.
    fn along_edge(&self, edge: DomainEdge, p: Vec2, step: f64) -> Vec<Ray> {
        let bounds = &self.problem.domain().bounds;
        if !self.is_on(edge.depth(bounds, p).abs()) {
            return Vec::new();
        }
        let [start, end] = edge.range(bounds);
        let ahead = edge.point(bounds, end) - edge.point(bounds, start);
        let own = start + ahead.unit().dot(p - edge.point(bounds, start));
        let ways = [(ahead, end - own, own + step), (-ahead, own - start, own - step)];
        let inside = ways.into_iter().filter(|(_, left, _)| !self.is_on(*left));
        inside.map(|(way, _, s)| ray(way, RayLine::Edge(edge, s))).collect()
    }

    fn along_rim(&self, (index, hole): (usize, &Hole), p: Vec2) -> Vec<Ray> {
        let on = |side: usize| RayLine::Rim { hole: index, side };
        match hole {
            Hole::Circle { center, .. } if self.is_on(hole.rim_distance(p)) => {
                let tangent = (p - *center).left();
                vec![ray(tangent, on(0)), ray(-tangent, on(0))]
            }
            Hole::Circle { .. } => Vec::new(),
            Hole::Polygon { .. } => {
                let sides = hole.sides().enumerate();
                let ways = |(k, side)| self.along(side, p).map(move |way| ray(way, on(k)));
                sides.flat_map(ways).collect()
            }
        }
    }

    /// The ways along a segment from a point on it.
    fn along(&self, [a, b]: [Vec2; 2], p: Vec2) -> impl Iterator<Item = Vec2> {
        let on = self.is_on(segment::distance([a, b], p));
        let touch = self.touch;
        [a - p, b - p].into_iter().filter(move |way| on && way.length() > touch)
    }
}

fn ray(way: Vec2, on: RayLine) -> Ray {
    Ray { angle: way.y.atan2(way.x), on }
}
