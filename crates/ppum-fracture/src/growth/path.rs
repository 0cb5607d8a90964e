//! The way of a tip through the body: an arc, up to what it meets.

use ppum::border::touch;
use ppum::crack::{Crack, End, TipId, tips};
use ppum::dataset::{TipIncrement, TipStatus};
use ppum::domain::Hole;
use ppum::edge::Edge;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::{DomainEdge, Problem};

/// Part of an increment that may not be left between the new tip and what is ahead of it: the way
/// there is divided in two equal ones instead, each more than half of what was asked for.
const LEFT: f64 = 0.5;

/// Distance at which a tip joins the tip of another crack that it would pass, in increments: nearer
/// ones would leave a sliver between them that no cell resolves.
const JOINS: f64 = 0.25;

/// Sends a tip along an arc of a length, among the cracks as they are: its row gets the end of the
/// arc, the length, and what it comes to.
pub(super) fn go(problem: &Problem, cracks: &[Crack], length: f64, row: &mut TipIncrement) {
    let tip = row.tip;
    let from = problem.cracks()[tip.crack as usize].end_point(tip.end);
    // along an edge rounding must not lead out of the body
    let line = problem.body.line_of(tip.crack as usize).and_then(|line| DomainEdge::of_line(&line));
    let bounds = &problem.domain().bounds;
    let on_line = |p: Vec2| line.map_or(p, |line| line.point(bounds, line.coordinate(p)));
    let arc = |from, direction: f64, curvature, length| {
        let edge = Edge::leaving(from, vec2(direction.cos(), direction.sin()), curvature, length);
        Edge { to: on_line(edge.to), ..edge }
    };
    if line.is_some() {
        row.curvature = 0.0;
    }
    let ahead = Ahead { problem, cracks, tip, reach: JOINS * length };
    let own = arc(from, row.direction, row.curvature, length);
    if let Some(hit) = ahead.first(&own) {
        return hit.end(row, from, length);
    }
    (row.path, row.length, row.fate) = (vec![own.to], length, TipStatus::Grows);
    let at_end = row.direction + row.curvature * length;
    if let Some(hit) = ahead.first(&arc(own.to, at_end, 0.0, LEFT * length)) {
        row.length = 0.5 * (length + hit.part * LEFT * length);
        row.path = vec![arc(from, row.direction, row.curvature, row.length).to];
    }
}

/// The obstacles ahead of a tip.
struct Ahead<'a> {
    problem: &'a Problem,
    cracks: &'a [Crack],
    tip: TipId,
    /// Distance to other tips at which they are met.
    reach: f64,
}

/// A place at which a way ends.
#[derive(Clone, Copy, Debug)]
struct Hit {
    /// The part of the way before it.
    part: f64,
    at: Vec2,
    fate: TipStatus,
    /// True of a tip beside the way, to which a straight one leads.
    is_beside: bool,
}

impl Hit {
    fn on_way((part, at): (f64, Vec2), fate: TipStatus) -> Self {
        Self { part, at, fate, is_beside: false }
    }

    /// Ends the way of a tip here, which would have a length.
    fn end(self, row: &mut TipIncrement, from: Vec2, length: f64) {
        row.fate = self.fate;
        if self.fate == TipStatus::MeetsItself {
            (row.path, row.length) = (Vec::new(), 0.0);
            return;
        }
        (row.path, row.length) = (vec![self.at], self.part * length);
        if self.is_beside {
            let way = self.at - from;
            (row.direction, row.curvature, row.length) = (way.y.atan2(way.x), 0.0, way.length());
        }
    }
}

impl Ahead<'_> {
    /// The first thing that a way meets.
    fn first(&self, way: &Edge) -> Option<Hit> {
        self.meets(way).min_by(|a, b| a.part.total_cmp(&b.part))
    }

    /// The obstacles that a way meets.
    fn meets<'m>(&'m self, way: &'m Edge) -> impl Iterator<Item = Hit> + 'm {
        let domain = self.problem.domain();
        let near = touch(&domain.bounds);
        let border = leaves(way, &domain.bounds).map(|at| Hit::on_way(at, self.beyond(at.1)));
        let holes = (0u32..).zip(&domain.holes).filter_map(move |(k, hole)| {
            let at = enters(way, hole)?;
            let is_outside = hole.is_outside();
            let fate = if is_outside { self.beyond(at.1) } else { TipStatus::MeetsHole(k) };
            Some(Hit::on_way(at, fate))
        });
        let others = (0u32..).zip(self.cracks).flat_map(move |(k, crack)| {
            let own = k == self.tip.crack;
            let fate = if own { TipStatus::MeetsItself } else { TipStatus::MeetsCrack(k) };
            let edges = crack.edges().enumerate();
            let others = edges.filter(move |(j, _)| !(own && self.is_last(crack, *j)));
            others
                .filter_map(move |(_, edge)| crosses(way, &edge, near))
                .map(move |at| Hit::on_way(at, fate))
        });
        border.into_iter().chain(holes).chain(others).chain(self.tips(way))
    }

    /// The status of a tip at a point of the boundary.
    fn beyond(&self, at: Vec2) -> TipStatus {
        let is_axis = at.x.abs() <= touch(&self.problem.domain().bounds);
        match self.problem.equation.is_axisymmetric() && is_axis {
            true => TipStatus::MeetsAxis,
            false => TipStatus::LeavesBody,
        }
    }

    /// The tips of other cracks beside a way.
    fn tips<'m>(&'m self, way: &'m Edge) -> impl Iterator<Item = Hit> + 'm {
        let others = tips(self.cracks).filter(|other| other.crack != self.tip.crack);
        let start = way.end_tangents()[0];
        others.filter_map(move |other| {
            let at = self.cracks[other.crack as usize].end_point(other.end);
            let is_near = way.distance(at) <= self.reach && (at - way.from).dot(start) > 0.0;
            let (part, fate) = (way.closest_part(at), TipStatus::MeetsCrack(other.crack));
            is_near.then_some(Hit { part, at, fate, is_beside: true })
        })
    }

    /// True of the edge that ends at the tip.
    fn is_last(&self, crack: &Crack, edge: usize) -> bool {
        match self.tip.end {
            End::Start => edge == 0,
            End::Last => edge + 2 == crack.points.len(),
        }
    }
}

/// The part of a way that begins in a box up to where it comes to its boundary, and the place
/// exactly on it.
fn leaves(way: &Edge, bounds: &Rect) -> Option<(f64, Vec2)> {
    let walls = bounds.sides().map(Edge::segment);
    let parts = walls.iter().flat_map(|wall| {
        let parts = way.meets_curve(wall).into_iter().filter(|part| *part > 0.0 && *part <= 1.0);
        parts.map(|part| (part, wall.closest_point(way.at(part))))
    });
    parts.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// The part of a way that begins outside of a hole up to where it enters it, and the place on the
/// rim.
fn enters(way: &Edge, hole: &Hole) -> Option<(f64, Vec2)> {
    match *hole {
        Hole::Circle { center, radius } => {
            let parts = way.meets_curve(&Edge::around(center, radius, [0.0, 1.0])).into_iter();
            let mut parts = parts.filter(|part| (0.0..=1.0).contains(part));
            let out = |part: f64| way.at(part) - center;
            let first = parts.find(|part| out(*part).dot(way.tangent(*part)) < 0.0)?;
            Some((first, center + out(first).unit() * radius))
        }
        Hole::Polygon { .. } => {
            let hits = hole.edges().flat_map(|side| {
                let at = move |[part, on_side]: [f64; 2]| (part, side.at(on_side));
                way.meets(&side).into_iter().map(at)
            });
            hits.min_by(|a, b| a.0.total_cmp(&b.0))
        }
    }
}

/// The part of a way up to where it meets an edge, or comes as near to it as what touches, and the
/// place on that edge.
fn crosses(way: &Edge, other: &Edge, near: f64) -> Option<(f64, Vec2)> {
    let is_on = |part: &f64| (0.0..=1.0).contains(part) && other.distance(way.at(*part)) <= near;
    let part = way.meets_curve(other).into_iter().find(is_on)?;
    Some((part, other.closest_point(way.at(part))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::dataset::{Material, StressState};
    use ppum::vec2::vec2;
    use ppum_problem::{BaseCells, Discretization, ProblemData};
    use ppum_testkit::random::Random;
    use std::f64::consts::PI;

    fn plate(holes: Vec<Hole>, cracks: &[&[[f64; 2]]]) -> Problem {
        let bounds = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
        let steel = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
        let domain = ppum::domain::Domain { bounds, holes };
        let set = Discretization::new(BaseCells::Level(3));
        let plate = ProblemData::elasticity(domain, steel, set);
        let plate = cracks.iter().fold(plate, |plate, points| plate.with_crack(points));
        Problem::new(plate).expect("a problem in order")
    }

    const TIP: TipId = TipId { crack: 0, end: End::Last };

    fn from_origin(problem: &Problem, direction: f64, curvature: f64, length: f64) -> TipIncrement {
        let staying = TipIncrement::staying(TIP, TipStatus::Grows);
        let mut row = TipIncrement { direction, curvature, ..staying };
        go(problem, problem.cracks(), length, &mut row);
        row
    }

    /// Ways end exactly on the boundary, and not shortly before it.
    #[test]
    fn the_border() {
        let problem = plate(Vec::new(), &[&[[-0.5, 0.0], [0.0, 0.0]]]);
        let mut random = Random(1);
        for _ in 0..200 {
            let direction = random.between(-1.5, 1.5);
            let reach = 1.0 / direction.cos().max(direction.sin().abs());
            let long = from_origin(&problem, direction, 0.0, reach * random.between(1.01, 3.0));
            assert_eq!(long.fate, TipStatus::LeavesBody);
            let end = long.path[0];
            assert!(end.x.abs() == 1.0 || end.y.abs() == 1.0, "{end:?}");
            assert!((long.length - reach).abs() < 1e-14);
            let near = from_origin(&problem, direction, 0.0, reach * random.between(0.68, 0.99));
            assert_eq!(near.fate, TipStatus::Grows);
            assert!((near.length - 0.5 * reach).abs() < 1e-14);
            let short = from_origin(&problem, direction, 0.0, 0.6 * reach);
            assert!((short.length - 0.6 * reach).abs() < 1e-14);
        }
    }

    /// Arcs are as long as they should be, and end in the direction that they should.
    #[test]
    fn arcs() {
        let problem = plate(Vec::new(), &[&[[-0.5, 0.0], [0.0, 0.0]]]);
        let mut random = Random(2);
        for _ in 0..100 {
            let (direction, turn) = (random.between(-PI, PI), random.between(-0.3, 0.3));
            let row = from_origin(&problem, direction, turn / 0.2, 0.2);
            let [edge] = row.edges(Vec2::ZERO)[..] else { panic!("one arc") };
            let wanted = direction + turn;
            assert!(edge.end_tangents()[1].dot(vec2(wanted.cos(), wanted.sin())) > 1.0 - 1e-14);
            assert!((edge.length() - 0.2).abs() < 1e-15);
        }
    }

    /// Arcs that leave the body, enter a hole or meet a crack end there with their own curvature.
    #[test]
    fn arcs_end_at_obstacles() {
        let circle = Hole::Circle { center: vec2(0.5, 0.0), radius: 0.25 };
        let walls: [&[[f64; 2]]; 2] = [&[[-0.5, 0.0], [0.0, 0.0]], &[[-0.9, 0.7], [0.9, 0.7]]];
        let problem = plate(vec![circle], &walls);
        let mut fates = [0; 3];
        let mut random = Random(4);
        for _ in 0..200 {
            let (direction, curvature) = (random.between(-1.6, 1.6), random.between(-0.6, 0.6));
            let row = from_origin(&problem, direction, curvature, 1.6);
            let Some(&at) = row.path.first() else { continue };
            let off = match row.fate {
                TipStatus::LeavesBody => at.x.abs().max(at.y.abs()) - 1.0,
                TipStatus::MeetsHole(0) => (at - vec2(0.5, 0.0)).length() - 0.25,
                TipStatus::MeetsCrack(1) if at.x.abs() < 0.9 => at.y - 0.7,
                _ => continue,
            };
            let [edge] = row.edges(Vec2::ZERO)[..] else { panic!("one arc") };
            let way = vec2(direction.cos(), direction.sin());
            assert!(off.abs() < 1e-15, "{row:?}");
            assert!((edge.curvature() - curvature).abs() < 1e-13);
            assert!((edge.end_tangents()[0] - way).length() < 1e-13, "{row:?}");
            assert!((edge.length() - row.length).abs() < 1e-14);
            fates[match row.fate {
                TipStatus::LeavesBody => 0,
                TipStatus::MeetsHole(_) => 1,
                _ => 2,
            }] += 1;
        }
        assert!(fates.iter().all(|n| *n > 10), "{fates:?}");
    }

    /// Ways end on rims of holes of either kind, whose places are known.
    #[test]
    fn holes() {
        let circle = Hole::Circle { center: vec2(0.5, 0.0), radius: 0.25 };
        let points = vec![vec2(0.25, -0.1), vec2(0.6, -0.1), vec2(0.6, 0.3), vec2(0.25, 0.3)];
        for hole in [circle, Hole::polygon(points)] {
            let problem = plate(vec![hole], &[&[[-0.5, 0.0], [0.0, 0.0]]]);
            let found = from_origin(&problem, 0.0, 0.0, 0.3);
            assert_eq!((found.fate, found.path.len()), (TipStatus::MeetsHole(0), 1));
            assert!((found.path[0] - vec2(0.25, 0.0)).length() < 1e-15);
            let past = from_origin(&problem, 1.2, 0.0, 0.3);
            assert_eq!(past.fate, TipStatus::Grows);
        }
    }

    /// The nearest of several cracks is met; a tip that would be passed closely is joined; the own
    /// crack is not crossed.
    #[test]
    fn cracks() {
        let walls: [&[[f64; 2]]; 3] =
            [&[[-0.5, 0.0], [0.0, 0.0]], &[[0.6, -0.5], [0.6, 0.5]], &[[0.4, -0.5], [0.4, 0.5]]];
        let problem = plate(Vec::new(), &walls);
        let found = from_origin(&problem, 0.0, 0.0, 0.7);
        assert_eq!(
            (found.fate, found.path.as_slice()),
            (TipStatus::MeetsCrack(2), &[vec2(0.4, 0.0)][..])
        );
        let beside: [&[[f64; 2]]; 2] = [&[[-0.5, 0.0], [0.0, 0.0]], &[[0.3, 0.05], [0.8, 0.05]]];
        let problem = plate(Vec::new(), &beside);
        let found = from_origin(&problem, 0.0, 0.0, 0.4);
        assert_eq!(
            (found.fate, found.path.as_slice()),
            (TipStatus::MeetsCrack(1), &[vec2(0.3, 0.05)][..])
        );
        assert_eq!(found.length, vec2(0.3, 0.05).length());
        let bent: [&[[f64; 2]]; 1] =
            [&[[0.5, -0.5], [0.5, 0.5], [-0.5, 0.5], [-0.5, 0.0], [0.0, 0.0]]];
        let problem = plate(Vec::new(), &bent);
        let found = from_origin(&problem, 0.0, 0.0, 0.7);
        assert_eq!((found.fate, found.path.len()), (TipStatus::MeetsItself, 0));
    }
}
