//! Edges as chords that cut the body as the edges do.
//!
//! A chord stands for a part of an arc if no other edge comes between the two. Then the triangles
//! between chords have the connections of the body, and a point between chord and arc belongs to
//! the triangle behind the chord.

use ppum::domain::{Domain, Hole};
use ppum::edge::Edge;
use ppum::vec2::{Rect, Vec2};
use ppum_problem::geometry::{BoxList, wider};
use std::f64::consts::PI;

/// Distance by which points of the boundary are moved to be inside, in sizes of the box.
pub(super) const INWARD: f64 = 1e-9;

/// Largest turn from chord to chord.
const TURN: f64 = PI / 8.0;

/// Halvings of an arc that something nearly touches.
const DEEPEST: usize = 20;

/// Distance up to which ends lie on an arc, and chords end on something, in sizes of the box.
const TOUCH: f64 = 4.0 * INWARD;

/// The rims and cracks of a body, divided into parts that their chords stand for.
#[derive(Debug)]
pub(super) struct ChordParts {
    /// For each hole, the parts of its rim.
    pub(super) rims: Vec<Vec<Edge>>,
    /// For each edge of each crack, its parts.
    pub(super) cracks: Vec<Vec<Vec<Edge>>>,
}

impl ChordParts {
    pub(super) fn new(domain: &Domain, cracks: &[Vec<Edge>]) -> Self {
        let rims: Vec<Vec<Edge>> = domain.holes.iter().map(Hole::rim_edges).collect();
        let sides = domain.bounds.sides().map(Edge::segment);
        let all = sides.iter().chain(rims.iter().flatten()).chain(cracks.iter().flatten());
        let others = BoxList::new(all.map(|edge| (edge.bounds(), *edge)));
        let touch = TOUCH * domain.bounds.size().length();
        let parts = |edge: &Edge| parts(edge, &others, touch);
        Self {
            rims: rims.iter().map(|rim| rim.iter().flat_map(parts).collect()).collect(),
            cracks: cracks.iter().map(|crack| crack.iter().map(parts).collect()).collect(),
        }
    }

    /// The domain with polygons for holes.
    pub(super) fn with_polygons(&self, domain: &Domain) -> Domain {
        let polygon = |(hole, parts): (&Hole, &Vec<Edge>)| {
            let points = parts.iter().map(|part| part.from).collect();
            if hole.is_outside() { Hole::outside(points) } else { Hole::polygon(points) }
        };
        let holes = domain.holes.iter().zip(&self.rims).map(polygon).collect();
        Domain { bounds: domain.bounds, holes }
    }

    /// The parts of arcs, with the boxes around them.
    pub(super) fn arcs(&self) -> BoxList<Edge> {
        let all = self.rims.iter().chain(self.cracks.iter().flatten()).flatten();
        BoxList::new(all.filter(|part| part.is_arc()).map(|part| (part.bounds(), *part)))
    }
}

/// The parts of an edge: one of a segment, two at least of an arc, whose chord may be another edge.
fn parts(edge: &Edge, others: &BoxList<Edge>, touch: f64) -> Vec<Edge> {
    if !edge.is_arc() {
        return vec![*edge];
    }
    let mut ends = vec![0.0, 0.5, 1.0];
    for other in others.near(&wider(&edge.bounds(), touch)) {
        ends.extend(edge.meets(other).into_iter().map(|[part, _]| part));
        let near = [other.from, other.to].into_iter().filter(|end| edge.distance(*end) <= touch);
        ends.extend(near.map(|end| edge.closest_part(end)));
    }
    ends.sort_by(f64::total_cmp);
    ends.dedup_by(|b, a| (*b - *a) * edge.length() <= 1e-3 * touch);
    *ends.last_mut().expect("three at least") = 1.0;
    let mut all = Vec::new();
    for pair in ends.windows(2) {
        let whole = edge.part([pair[0], pair[1]]);
        whole.divided(TURN).for_each(|part| halve(part, others, touch, 0, &mut all));
    }
    all
}

/// Adds a part, halved until nothing comes between it and its chord.
fn halve(part: Edge, others: &BoxList<Edge>, touch: f64, depth: usize, all: &mut Vec<Edge>) {
    let chord = Edge::segment([part.from, part.to]);
    let end = touch / chord.length();
    let is_inner = |[_, at]: &[f64; 2]| *at > end && *at < 1.0 - end;
    let is_apart = |p: Vec2| (p - part.from).length().min((p - part.to).length()) > touch;
    let is_between = |other: &Edge| {
        let mut ends = [other.from, other.to].into_iter();
        other.meets(&chord).iter().any(is_inner)
            || ends.any(|p| is_apart(p) && is_beside_chord(&part, p))
    };
    if depth < DEEPEST && end < 0.1 && others.near(&part.bounds()).any(is_between) {
        let halves = [[0.0, 0.5], [0.5, 1.0]].map(|range| part.part(range));
        halves.into_iter().for_each(|half| halve(half, others, touch, depth + 1, all));
    } else {
        all.push(part);
    }
}

/// True for a point between an arc and its chord.
fn is_beside_chord(arc: &Edge, p: Vec2) -> bool {
    let sign = arc.bulge.signum();
    arc.chord().cross(p - arc.from) * sign < 0.0 && arc.side(p) * sign > 0.0
}

/// The point beyond the chord of an arc for one between the two, by a distance; others as they are.
pub(super) fn beyond_chord(arcs: &BoxList<Edge>, p: Vec2, distance: f64) -> Vec2 {
    let between = arcs.near(&Rect::new(p, p)).find(|arc| is_beside_chord(arc, p));
    between.map_or(p, |arc| {
        let (along, from) = (arc.chord().unit(), p - arc.from);
        arc.from + along * along.dot(from) + along.left() * (arc.bulge.signum() * distance)
    })
}
