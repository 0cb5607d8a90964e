//! The way of a tip through the body: an arc, up to what it meets.

use ppum::border::touch;
use ppum::crack::{Crack, End, TipId, tips};
use ppum::dataset::{TipIncrement, TipStatus};
use ppum::domain::Hole;
use ppum::line::Line;
use ppum::segment::{Segment, distance};
use ppum::vec2::{Rect, Vec2};
use ppum_problem::{DomainEdge, Problem, arc_from};

/// Part of an increment that may not be left between the new tip and what is ahead of it: the way
/// there is divided in two equal ones instead, each more than half of what was asked for.
const LEFT: f64 = 0.5;

/// Distance at which a tip joins the tip of another crack that it would pass, in increments: nearer
/// ones would leave a sliver between them that no cell resolves.
const JOINS: f64 = 0.25;

/// Sends a tip along an arc of a length, among the cracks as they are: its row gets the vertices
/// after the tip, the length, and what it comes to.
pub(super) fn go(problem: &Problem, cracks: &[Crack], length: f64, row: &mut TipIncrement) {
    let tip = row.tip;
    let from = problem.cracks()[tip.crack as usize].end_point(tip.end);
    // along an edge rounding must not lead out of the body
    let edge = problem.body.line_of(tip.crack as usize).and_then(|line| DomainEdge::of_line(&line));
    let bounds = &problem.domain().bounds;
    let on_edge = |p: Vec2| edge.map_or(p, |edge| edge.point(bounds, edge.coordinate(p)));
    let arc = |from, direction, curvature, length| -> Vec<Vec2> {
        arc_from(from, direction, curvature, length).into_iter().map(on_edge).collect()
    };
    let ahead = Ahead { problem, cracks, tip, reach: JOINS * length };
    row.path = arc(from, row.direction, row.curvature, length);
    (row.length, row.fate) = (length, TipStatus::Grows);
    if let Some(hit) = ahead.first(from, &row.path) {
        return hit.end(row);
    }
    let (end, at_end) = (*row.path.last().unwrap_or(&from), row.direction + row.curvature * length);
    if let Some(hit) = ahead.first(end, &arc(end, at_end, 0.0, LEFT * length)) {
        row.length = 0.5 * (length + hit.distance);
        row.path = arc(from, row.direction, row.curvature, row.length);
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
    /// Number of the segment of the way.
    segment: usize,
    /// Distance along the way.
    distance: f64,
    at: Vec2,
    fate: TipStatus,
}

impl Hit {
    /// Ends the way of a tip here.
    fn end(self, row: &mut TipIncrement) {
        row.fate = self.fate;
        if self.fate == TipStatus::MeetsItself {
            (row.path, row.length) = (Vec::new(), 0.0);
            return;
        }
        row.path.truncate(self.segment);
        row.path.push(self.at);
        row.length = self.distance;
    }
}

impl Ahead<'_> {
    /// The first thing that a way from a point meets.
    fn first(&self, from: Vec2, path: &[Vec2]) -> Option<Hit> {
        let (mut before, mut distance) = (from, 0.0);
        for (segment, &to) in path.iter().enumerate() {
            let nearest = self.meets([before, to]).min_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((_, at, fate)) = nearest {
                // a tip beside the way is not on it
                let distance = distance + (at - before).length();
                return Some(Hit { segment, distance, at, fate });
            }
            (before, distance) = (to, distance + (to - before).length());
        }
        None
    }

    /// Returns the obstacles that a segment meets: for each the part of the segment before it, the
    /// place, and the status that the tip gets there.
    fn meets(&self, s: Segment) -> impl Iterator<Item = (f64, Vec2, TipStatus)> + '_ {
        let domain = self.problem.domain();
        let near = touch(&domain.bounds);
        let border = leaves(s, &domain.bounds).map(|(t, at)| (t, at, TipStatus::LeavesBody));
        let holes = (0u32..).zip(&domain.holes).filter_map(move |(k, hole)| {
            let fate =
                if hole.is_outside() { TipStatus::LeavesBody } else { TipStatus::MeetsHole(k) };
            enters(s, hole).map(|t| (t, on(s, t), fate))
        });
        let others = (0u32..).zip(self.cracks).flat_map(move |(k, crack)| {
            let own = k == self.tip.crack;
            let fate = if own { TipStatus::MeetsItself } else { TipStatus::MeetsCrack(k) };
            let segments = crack.points.windows(2).enumerate();
            let others = segments.filter(move |(j, _)| !(own && self.is_last(crack, *j)));
            others
                .filter_map(move |(_, p)| crosses(s, [p[0], p[1]], near))
                .map(move |(t, at)| (t, at, fate))
        });
        border.into_iter().chain(holes).chain(others).chain(self.tips(s))
    }

    /// The tips of other cracks beside a segment.
    fn tips(&self, s: Segment) -> impl Iterator<Item = (f64, Vec2, TipStatus)> + '_ {
        let others = tips(self.cracks).filter(|other| other.crack != self.tip.crack);
        let (along, square) = (s[1] - s[0], (s[1] - s[0]).dot(s[1] - s[0]));
        others.filter_map(move |other| {
            let at = self.cracks[other.crack as usize].end_point(other.end);
            let t = ((at - s[0]).dot(along) / square).clamp(0.0, 1.0);
            let is_near = distance(s, at) <= self.reach && (at - s[0]).dot(along) > 0.0;
            is_near.then_some((t, at, TipStatus::MeetsCrack(other.crack)))
        })
    }

    /// True of the segment that ends at the tip.
    fn is_last(&self, crack: &Crack, segment: usize) -> bool {
        match self.tip.end {
            End::Start => segment == 0,
            End::Last => segment + 2 == crack.points.len(),
        }
    }
}

fn on(s: Segment, t: f64) -> Vec2 {
    s[0] + (s[1] - s[0]) * t
}

/// Where a segment that begins in a box comes to its boundary, and the place exactly on it.
fn leaves(s: Segment, bounds: &Rect) -> Option<(f64, Vec2)> {
    let step = s[1] - s[0];
    let part = |from: f64, step: f64, min: f64, max: f64| {
        let wall = if step > 0.0 { max } else { min };
        (step != 0.0).then(|| ((wall - from) / step, wall)).filter(|(t, _)| *t <= 1.0)
    };
    let x = part(s[0].x, step.x, bounds.min.x, bounds.max.x);
    let y = part(s[0].y, step.y, bounds.min.y, bounds.max.y);
    let first_is_x = match (x, y) {
        (Some((t, _)), Some((u, _))) => t <= u,
        (x, _) => x.is_some(),
    };
    let (t, wall) = if first_is_x { x? } else { y? };
    let mut at = on(s, t);
    *(if first_is_x { &mut at.x } else { &mut at.y }) = wall;
    Some((t, at.max(bounds.min).min(bounds.max)))
}

/// Where a segment that begins outside of a hole enters it.
fn enters(s: Segment, hole: &Hole) -> Option<f64> {
    match hole {
        Hole::Circle { center, radius } => {
            // the nearer of both
            let [t, _] = Line::through(s).meets_circle(*center, *radius)?;
            let comes_nearer = (*center - s[0]).dot(s[1] - s[0]) > 0.0;
            (comes_nearer && t <= 1.0).then_some(t.max(0.0))
        }
        Hole::Polygon { .. } => {
            let hits = hole.sides().filter_map(|side| Some(crosses(s, side, 0.0)?.0));
            hits.min_by(f64::total_cmp)
        }
    }
}

/// Where a segment meets another one, or comes as near to it as what touches.
fn crosses(s: Segment, other: Segment, near: f64) -> Option<(f64, Vec2)> {
    let way = other[1] - other[0];
    let [t, u] = Line::through(s).meets(&Line::through(other))?;
    let slack = near / way.length();
    let is_on = |x: f64, slack: f64| (-slack..=1.0 + slack).contains(&x);
    (is_on(t, 0.0) && is_on(u, slack)).then(|| (t, other[0] + way * u.clamp(0.0, 1.0)))
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
            let found = from_origin(&problem, direction, turn / 0.2, 0.2).path;
            let last = found[found.len() - 1] - found[found.len() - 2];
            let wanted = direction + turn;
            assert!(last.unit().dot(vec2(wanted.cos(), wanted.sin())) > 1.0 - 1e-12);
            let chord = 0.2 * (0.5 * turn).sin() / (0.5 * turn);
            let middle = direction + 0.5 * turn;
            let end = vec2(middle.cos(), middle.sin()) * chord;
            assert!((found[found.len() - 1] - end).length() < 1e-12);
        }
    }

    /// Ways end on rims of holes of either kind, whose places are known.
    #[test]
    fn holes() {
        let circle = Hole::Circle { center: vec2(0.5, 0.0), radius: 0.25 };
        let points = vec![vec2(0.25, -0.1), vec2(0.6, -0.1), vec2(0.6, 0.3), vec2(0.25, 0.3)];
        for hole in [circle, Hole::polygon(points)] {
            let problem = plate(vec![hole], &[&[[-0.5, 0.0], [0.0, 0.0]]]);
            let found = from_origin(&problem, 0.0, 0.0, 0.3);
            assert_eq!(
                (found.fate, found.path.as_slice()),
                (TipStatus::MeetsHole(0), &[vec2(0.25, 0.0)][..])
            );
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
