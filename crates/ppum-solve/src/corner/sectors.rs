//! The body around a point of its boundary: sectors of material between rays.

use crate::edges::is_smooth;
use ppum::crack::Side;
use ppum::domain::Hole;
use ppum::edge::Edge;
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
        let rims = domain.holes.iter().flat_map(|hole| match hole {
            Hole::Circle { radius, .. } if self.is_on(hole.rim_distance(p)) => vec![*radius],
            Hole::Circle { .. } => vec![hole.rim_distance(p)],
            Hole::Polygon { .. } => self.of_chain(p, &hole.edges().collect::<Vec<_>>(), true),
        });
        let cracks = self.problem.cracks().iter();
        let cracks =
            cracks.flat_map(|crack| self.of_chain(p, &crack.edges().collect::<Vec<_>>(), false));
        let all = edges.into_iter().chain(rims).chain(cracks);
        all.filter(|distance| !self.is_on(*distance)).fold(f64::INFINITY, f64::min)
    }

    /// Distances of a point to edges that follow each other. A smooth curve through the point is as
    /// far as where it has turned away, whatever edges it has.
    fn of_chain(&self, p: Vec2, chain: &[Edge], is_closed: bool) -> Vec<f64> {
        let mut all: Vec<f64> = chain.iter().map(|edge| edge.distance(p)).collect();
        for k in (0..chain.len()).filter(|&k| self.is_on(chain[k].distance(p))) {
            for ahead in [true, false] {
                let run = SmoothRun { chain, is_closed, ahead };
                let (passed, end) = run.until_turned(p, k);
                passed.into_iter().for_each(|k| all[k] = f64::INFINITY);
                all.extend(end.map(|end| (end - p).length()));
            }
        }
        all
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
            for edge in crack.edges() {
                let on = |ahead| RayLine::Crack { crack: index, ahead };
                let ways = self.along(edge, p);
                rays.extend(ways.map(|(way, ahead)| ray(way, on(ahead))));
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
        let ways = |(side, edge): (usize, Edge)| {
            let on = RayLine::Rim { hole: index, side };
            self.along(edge, p).map(move |(way, _)| ray(way, on))
        };
        hole.rim_edges().into_iter().enumerate().flat_map(ways).collect()
    }

    /// The ways along an edge from a point on it, and whether they lead ahead.
    fn along(&self, edge: Edge, p: Vec2) -> impl Iterator<Item = (Vec2, bool)> {
        let (on, touch, tangent) =
            (self.is_on(edge.distance(p)), self.touch, edge.tangent_towards(p));
        let ends = [(edge.from - p, false), (edge.to - p, true)];
        let far = ends.into_iter().filter(move |(way, _)| on && way.length() > touch);
        far.map(move |(way, ahead)| match (edge.is_arc(), ahead) {
            (false, _) => (way, ahead),
            (true, true) => (tangent, ahead),
            (true, false) => (-tangent, ahead),
        })
    }
}

/// Turn, in radians, from which on a curve has turned away from a point of it: about its radius
/// away.
const TURNED: f64 = 1.0;

/// Edges that follow each other, ahead or back.
struct SmoothRun<'e> {
    chain: &'e [Edge],
    is_closed: bool,
    ahead: bool,
}

impl SmoothRun<'_> {
    fn edge(&self, k: usize) -> Edge {
        if self.ahead { self.chain[k] } else { self.chain[k].reversed() }
    }

    /// The edge behind another one.
    fn next(&self, k: usize) -> Option<usize> {
        let n = self.chain.len();
        let is_last = k == if self.ahead { n - 1 } else { 0 };
        let next = (k + if self.ahead { 1 } else { n - 1 }) % n;
        (self.is_closed || !is_last).then_some(next)
    }

    /// The numbers of the edges from a point of one of them on up to a corner, or to where they
    /// have turned away, and that place.
    fn until_turned(&self, p: Vec2, first: usize) -> (Vec<usize>, Option<Vec2>) {
        let (mut passed, mut left) = (Vec::new(), TURNED);
        let (mut k, mut start) = (first, self.edge(first).closest_part(p));
        loop {
            let (edge, sweep) = (self.edge(k), self.chain[k].sweep().abs());
            passed.push(k);
            if sweep * (1.0 - start) >= left {
                return (passed, Some(edge.at(start + left / sweep)));
            }
            left -= sweep * (1.0 - start);
            let next = self.next(k).filter(|&next| next != first);
            match next.filter(|&next| is_smooth(&edge, &self.edge(next))) {
                Some(next) => (k, start) = (next, 0.0),
                None => return (passed, None),
            }
        }
    }
}

fn ray(way: Vec2, on: RayLine) -> Ray {
    Ray { angle: way.y.atan2(way.x), on }
}
