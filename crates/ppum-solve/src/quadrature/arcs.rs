//! Arcs of cracks and rims: cuts of cells along circles.
//!
//! Consecutive arcs that are one smooth curve are a *run*, whose level function is the distance
//! from the nearest of its circles. It cuts a piece along all of the circle, if one of its arcs
//! passes through the interior of the piece. Where arcs of different curves meet the circle of one
//! goes on beside the other: there pieces are cut before, along the line as far from both.
//!
//! A chain of arcs that stands for an ellipse or a spline is one run: its curvature jumps from arc
//! to arc, but Gauss rules see values on the curve alone, which are those of a smooth curve within
//! the tolerance of the chain. So an ellipse costs what a circle costs.

use super::local_curve::LocalCurve;
use super::polygon::{ConvexPolygon, SegmentCut};
use super::split::breaks;
use ppum::crack::Crack;
use ppum::domain::Hole;
use ppum::edge::Edge;
use ppum::vec2::{Rect, Vec2};
use ppum_problem::geometry::wider;

/// Largest sine of the angle between the tangents of arcs that are one smooth curve.
const TURN: f64 = 1e-9;

/// Largest jump of the curvature between arcs of one circle, times their length.
const SAME_CIRCLE: f64 = 1e-10;

/// Largest jump of the curvature in a run, times the square of the shorter of two lengths, as a
/// part of the length of the chain: one that follows a curve within 1e-9 of its size has 3e-7.
const SMOOTH: f64 = 1e-6;

/// Length of a cut at a joint, as a part of the arcs there.
const REACH: f64 = 1e-3;

/// The part of a segment beside an arc that is no part of its cut, so that it does not cut beyond
/// the line at their joint.
const LEFT_OUT: f64 = 1e-9;

/// An arc passes through a piece if more of it than this part of the piece's diameter is inside.
const LEAST: f64 = 1e-9;

/// A run in one piece turns by less than this, in radians: samples of its distance show its course.
const MOST_TURN: f64 = 1.2;

/// Parts of a run are one curve if they turn by less than this with what is between, in radians.
const MOST_JOINED: f64 = 1.5;

/// Most halvings of a piece for that.
const DEPTH: usize = 24;

/// Distance within which arcs meet, as a part of their length.
const TOUCH: f64 = 1e-9;

/// The cuts of cracks and rims.
#[derive(Clone, Default)]
pub(super) struct EdgeCuts {
    /// Segments, and before them lines at joints of arcs.
    pub(super) segments: Vec<SegmentCut>,
    pub(super) runs: Vec<ArcRun>,
}

/// Consecutive arcs that are one smooth curve; a segment alone while a chain is divided.
#[derive(Clone, Debug)]
pub(super) struct ArcRun {
    pub(super) edges: Vec<Edge>,
    boxes: Vec<Rect>,
    /// The index of the crack or rim.
    chain: usize,
    /// Lengths on the circles of the first and of the last arc.
    reach: [f64; 2],
    /// True if the last arc is followed by the first.
    is_closed: bool,
    /// True if all arcs are on one circle.
    is_round: bool,
}

impl EdgeCuts {
    /// The cuts of cracks, whose segments cut beyond their ends, and of the rims of holes.
    pub(super) fn new(cracks: &[&Crack], holes: &[Hole]) -> Self {
        let open = cracks.iter().map(|crack| (crack.edges().collect(), false));
        let closed = holes.iter().map(|hole| (hole.rim_edges(), true));
        let (mut all, mut joints) = (Self::default(), Vec::new());
        for (chain, (edges, is_closed)) in open.chain(closed).enumerate() {
            let runs = runs(&edges, chain, is_closed);
            joints.extend(neighbours(&runs, is_closed).filter_map(|(a, b)| joint(a, b)));
            all.segments.extend(segments(&edges, is_closed));
            all.runs.extend(runs.into_iter().filter(|run| run.edges[0].is_arc()));
        }
        for (k, run) in all.runs.iter().enumerate() {
            let others = all.runs[..k].iter().filter(|other| other.chain != run.chain);
            joints.extend(others.flat_map(|other| run.crossings(other)));
        }
        all.segments.splice(0..0, joints);
        all
    }
}

/// The runs that meet at the joints of a chain.
fn neighbours(runs: &[ArcRun], is_closed: bool) -> impl Iterator<Item = (&ArcRun, &ArcRun)> {
    let n = runs.len();
    let joints = (usize::from(!is_closed)..n).filter(|k| !runs[*k].is_closed);
    joints.map(move |k| (&runs[(k + n - 1) % n], &runs[k]))
}

/// The cuts of the segments among edges.
fn segments(edges: &[Edge], is_closed: bool) -> impl Iterator<Item = SegmentCut> {
    let n = edges.len();
    let cut = move |k: usize| {
        let Edge { from, to, .. } = edges[k];
        let left_out = |at: usize| if edges[at % n].is_arc() { LEFT_OUT } else { 0.0 };
        let is_end = [k == 0, k + 1 == n].map(|is_end| is_end && !is_closed);
        let before = if is_end[0] { 0.0 } else { left_out(k + n - 1) };
        let after = if is_end[1] { 0.0 } else { left_out(k + 1) };
        let way = to - from;
        SegmentCut { ends: [from + way * before, to - way * after], goes_on: is_end }
    };
    (0..n).filter(|&k| !edges[k].is_arc()).map(cut)
}

/// The edges in runs.
fn runs(edges: &[Edge], chain: usize, is_closed: bool) -> Vec<ArcRun> {
    let alone: Vec<ArcRun> = edges.iter().map(|edge| ArcRun::new(*edge, chain)).collect();
    let length: f64 = alone.iter().map(|run| run.reach[0]).sum();
    let is_same = |jump: f64, [a, b]: [f64; 2]| jump * a.max(b) <= SAME_CIRCLE;
    let is_smooth = |jump: f64, [a, b]: [f64; 2]| jump * a.min(b).powi(2) <= SMOOTH * length;
    joined(joined(alone, is_closed, true, is_same), is_closed, false, is_smooth)
}

/// Runs with those put together that go on smoothly, by the jump of their curvatures and the
/// lengths that have these.
fn joined(
    runs: Vec<ArcRun>,
    is_closed: bool,
    is_round: bool,
    is_one: impl Fn(f64, [f64; 2]) -> bool,
) -> Vec<ArcRun> {
    let goes_on = |a: &ArcRun, b: &ArcRun| {
        let (before, after) = (a.edges[a.edges.len() - 1], b.edges[0]);
        let turn = before.end_tangents()[1].cross(after.end_tangents()[0]).abs();
        let jump = (before.curvature() - after.curvature()).abs();
        let both = before.is_arc() && after.is_arc() && !a.is_closed;
        both && turn <= TURN && is_one(jump, [a.reach[1], b.reach[0]])
    };
    let mut all: Vec<ArcRun> = Vec::new();
    for run in runs {
        match all.last_mut().filter(|last| goes_on(last, &run)) {
            Some(last) => last.extend(run, is_round),
            None => all.push(run),
        }
    }
    if is_closed && goes_on(&all[all.len() - 1], &all[0]) {
        match all.pop() {
            Some(last) if all.is_empty() => all.push(ArcRun { is_closed, ..last }),
            Some(mut last) => {
                last.extend(all.remove(0), is_round);
                all.push(last);
            }
            None => {}
        }
    }
    all
}

/// The line at a joint of runs on which the distances from both are the same.
fn joint(a: &ArcRun, b: &ArcRun) -> Option<SegmentCut> {
    let (before, after) = (&a.edges[a.edges.len() - 1], &b.edges[0]);
    let [t, u] = [before.end_tangents()[1], after.end_tangents()[0]];
    // both are along it, and one is zero of a straight and of a reverse joint
    let [across, back] = [(t + u).left(), u - t];
    let along = if across.length() > back.length() { across } else { back };
    (before.is_arc() || after.is_arc()).then(|| short_cut(after.from, along, [before, after]))
}

/// A cut at a point where edges meet, short beside them.
fn short_cut(at: Vec2, along: Vec2, edges: [&Edge; 2]) -> SegmentCut {
    let reach = along.unit() * (REACH * edges[0].length().min(edges[1].length()));
    SegmentCut::segment([at - reach, at + reach])
}

impl ArcRun {
    fn new(edge: Edge, chain: usize) -> Self {
        let (edges, boxes, reach) = (vec![edge], vec![edge.bounds()], [edge.length(); 2]);
        Self { edges, boxes, chain, reach, is_closed: false, is_round: true }
    }

    fn extend(&mut self, next: Self, is_round: bool) {
        self.edges.extend(next.edges);
        self.boxes.extend(next.boxes);
        let [first, last] = [self.reach[0], next.reach[1]];
        self.reach = if is_round { [first + last; 2] } else { [first, last] };
        self.is_round &= is_round;
    }

    /// The arcs whose boxes meet a box.
    pub(super) fn near(&self, rect: &Rect) -> impl Iterator<Item = (usize, &Edge)> {
        let wide = wider(rect, LEAST * rect.size().length());
        let near = move |k: &usize| self.boxes[*k].overlaps(&wide);
        (0..self.edges.len()).filter(near).map(|k| (k, &self.edges[k]))
    }

    /// True if an arc passes through the inside of a rectangle.
    pub(super) fn meets(&self, rect: &Rect) -> bool {
        let polygon = ConvexPolygon(rect.corners().map(|p| p - rect.min).to_vec());
        self.near(rect).any(|(_, edge)| passes(edge, rect.min, &polygon))
    }

    /// Cuts between the arcs where they cross those of another run, or one ends on the other.
    fn crossings(&self, other: &Self) -> Vec<SegmentCut> {
        let mut cuts = Vec::new();
        for (one, bounds) in self.edges.iter().zip(&self.boxes) {
            for (_, other) in other.near(bounds) {
                cuts.extend(crossings(one, other));
            }
        }
        cuts
    }

    /// The parts of the run that pass through a polygon, which is given from an anchor.
    pub(super) fn through<'c>(&self, anchor: Vec2, polygon: &ConvexPolygon) -> Vec<LocalCurve<'c>> {
        let mut parts = self.parts(&seen_box(anchor, polygon));
        parts.retain(|part| part.iter().any(|edge| passes(edge, anchor, polygon)));
        if self.is_round {
            // all are on one circle
            parts.truncate(1);
            parts.iter_mut().for_each(|part| part.truncate(1));
        }
        parts.iter().map(|part| LocalCurve::arcs(part, anchor)).collect()
    }

    /// The arcs near a box, in parts that follow each other. Arcs between two parts belong
    /// to them if all is one curve that does not turn much: else circles would go on beside each
    /// other.
    fn parts(&self, rect: &Rect) -> Vec<Vec<Edge>> {
        let n = self.edges.len();
        let between = |from: usize, to: usize| (from..to).map(|k| self.edges[k % n]);
        let is_one = |from: usize, to: usize| {
            between(from, to).map(|edge| edge.sweep().abs()).sum::<f64>() < MOST_JOINED
        };
        let mut parts: Vec<[usize; 2]> = Vec::new();
        for (k, _) in self.near(rect) {
            match parts.last_mut().filter(|part| is_one(part[0], k + 1)) {
                Some(part) => part[1] = k + 1,
                None => parts.push([k, k + 1]),
            }
        }
        if let [[_, to], .., [from, _]] = parts[..]
            && self.is_closed
            && is_one(from, to + n)
        {
            parts.remove(0);
            parts.pop();
            parts.push([from, to + n]);
        }
        parts.into_iter().map(|[from, to]| between(from, to).collect()).collect()
    }
}

/// The box of a polygon that is given from an anchor.
fn seen_box(anchor: Vec2, polygon: &ConvexPolygon) -> Rect {
    let bounds = polygon.bounds();
    Rect::new(anchor + bounds.min, anchor + bounds.max)
}

/// Parts of a polygon in which no curve of several circles turns much.
pub(super) fn resolved(
    polygon: ConvexPolygon,
    anchor: Vec2,
    runs: &[&ArcRun],
) -> Vec<ConvexPolygon> {
    let (mut open, mut parts) = (vec![(polygon, DEPTH)], Vec::new());
    while let Some((polygon, depth)) = open.pop() {
        let here = seen_box(anchor, &polygon);
        let chains = runs.chunk_by(|a, b| a.chain == b.chain);
        let turns = chains.into_iter().any(|chain| turn(chain, &here) > MOST_TURN);
        match (turns && depth > 0).then(|| polygon.halves()).flatten() {
            Some(halves) => open.extend(halves.map(|half| (half, depth - 1))),
            None => parts.push(polygon),
        }
    }
    parts
}

/// The angle by which runs of one chain turn inside a box; zero of arcs of one circle.
fn turn(runs: &[&ArcRun], rect: &Rect) -> f64 {
    let inside = |edge: &Edge| match edge.sweep().abs() {
        small if small < 0.1 * MOST_TURN => small,
        large => large * edge.within(rect).iter().map(|[from, to]| to - from).sum::<f64>(),
    };
    let of_run = |run: &&ArcRun| run.near(rect).map(|(_, edge)| inside(edge)).sum::<f64>();
    let turns: Vec<f64> = runs.iter().map(of_run).filter(|turn| *turn > 0.0).collect();
    let is_round = turns.len() == 1 && runs.iter().all(|run| run.is_round);
    if is_round { 0.0 } else { turns.iter().sum() }
}

/// The lines between two arcs where they cross, or one ends on the other.
fn crossings(one: &Edge, other: &Edge) -> Vec<SegmentCut> {
    let near = TOUCH * (one.length() + other.length());
    let parts = one.meets_curve(other).into_iter();
    let points = parts.map(|part| one.at(part.clamp(-TOUCH, 1.0 + TOUCH)));
    let points = points.filter(|p| one.distance(*p).max(other.distance(*p)) <= near);
    let cuts = points.flat_map(|p| {
        let [t, u] = [one, other].map(|edge| edge.tangent_towards(p));
        [t + u, t - u].map(|along| short_cut(p, along, [one, other]))
    });
    cuts.filter(|cut| cut.ends[0] != cut.ends[1]).collect()
}

/// True if an arc runs through the inside of a polygon.
fn passes(edge: &Edge, anchor: Vec2, polygon: &ConvexPolygon) -> bool {
    let edge = Edge { from: edge.from - anchor, to: edge.to - anchor, ..*edge };
    let least = LEAST * polygon.diameter() / edge.length();
    // between the lines of all sides no part of it is in and out: corners need no care
    let lines = polygon.edges().filter(|(a, b)| a != b);
    let parts = lines.flat_map(|(a, b)| edge.meets_curve(&Edge::segment([a, b]))).collect();
    breaks(0.0, 1.0, parts, 0.0)
        .windows(2)
        .any(|part| part[1] - part[0] > least && polygon.holds(edge.at(0.5 * (part[0] + part[1]))))
}
