//! Points, edges and cracks against boxes and holes.

use ppum::border::touch;
use ppum::crack::Crack;
use ppum::domain::Hole;
use ppum::edge::Edge;
use ppum::line::Line;
use ppum::vec2::{Rect, Vec2};
use std::f64::consts::PI;

/// Distance from a rim that is rounding, in parts of the coordinates.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// True if `p` lies in the open box.
pub fn inside(open: &Rect, p: Vec2) -> bool {
    p.x > open.min.x && p.x < open.max.x && p.y > open.min.y && p.y < open.max.y
}

/// Length of a crack inside an open box and outside of holes; a segment along the box's boundary
/// does not count.
pub fn length_inside(crack: &Crack, open: &Rect, holes: &[Hole]) -> f64 {
    crack.edges().map(|edge| solid_length(edge, open, holes.iter())).sum()
}

/// Length of an edge inside an open box and outside of holes.
pub(crate) fn solid_length<'h>(
    edge: Edge,
    open: &Rect,
    holes: impl Iterator<Item = &'h Hole> + Clone,
) -> f64 {
    let ranges = clipped(edge, open).into_iter();
    ranges.map(|range| solid_part(edge, range, holes.clone()) * edge.length()).sum()
}

/// Part of a range of an edge's length that lies outside of holes.
pub fn solid_part<'h>(
    edge: Edge,
    [from, to]: [f64; 2],
    holes: impl Iterator<Item = &'h Hole> + Clone,
) -> f64 {
    let crossings = holes.clone().flat_map(|hole| rim_crossings(edge, hole));
    let mut breaks: Vec<f64> = crossings.filter(|t| *t > from && *t < to).collect();
    breaks.extend([from, to]);
    breaks.sort_by(f64::total_cmp);
    let is_solid = |t: f64| !holes.clone().any(|hole| hole.contains(edge.at(t)));
    let parts = breaks.windows(2).filter(|t| is_solid(0.5 * (t[0] + t[1])));
    parts.map(|t| t[1] - t[0]).sum()
}

/// The parts of its length at which an edge meets a rim, and perhaps others, below 0 and above 1,
/// of its line or circle.
pub fn rim_crossings(edge: Edge, hole: &Hole) -> Vec<f64> {
    let line = Line::through([edge.from, edge.to]);
    let straight = |p: Vec2, q: Vec2| {
        let (s, t) = (line.side(p), line.side(q));
        (s * t <= 0.0 && s != t).then(|| line.foot(p + (q - p) * (s / (s - t))))
    };
    match *hole {
        Hole::Circle { center, radius } if !edge.is_arc() => {
            line.meets_circle(center, radius).map_or_else(Vec::new, Vec::from)
        }
        Hole::Circle { center, radius } => {
            edge.meets_curve(&Edge::around(center, radius, [0.0, PI]))
        }
        Hole::Polygon { .. } => {
            let crossings = |side: Edge| match edge.is_arc() || side.is_arc() {
                false => straight(side.from, side.to).into_iter().collect(),
                true => curved_crossings(edge, side),
            };
            hole.edges().flat_map(crossings).collect()
        }
    }
}

/// The parts at which the line or circle of an edge meets another edge, also where rounding has put
/// these beyond its ends.
fn curved_crossings(edge: Edge, other: Edge) -> Vec<f64> {
    let near = ROUNDING * other.bounds().max_norm();
    let is_on = |part: &f64| other.distance(edge.at(*part)) <= near;
    edge.meets_curve(&other).into_iter().filter(is_on).collect()
}

/// True for a crack that lies on a rim: it is a face of the body, and cuts nothing.
pub fn is_on_rim(crack: &Crack, holes: &[Hole]) -> bool {
    holes.iter().any(|hole| hole.line_along(crack).is_some() || follows(crack, hole))
}

/// True for a crack with arcs all of which lies on the rim of a hole.
fn follows(crack: &Crack, hole: &Hole) -> bool {
    let touch = touch(&hole.rim_bounds());
    crack.is_curved() && crack.edges().all(|edge| lies_along(edge, hole, touch))
}

/// True if an edge lies on a rim, up to the distance `touch`.
pub(crate) fn lies_along(edge: Edge, hole: &Hole, touch: f64) -> bool {
    let parts = [0.0, 0.25, 0.5, 1.0].iter();
    parts.map(|part| edge.at(*part)).all(|p| hole.rim_distance(p) <= touch)
}

/// Returns the parts of a range that lie outside of others.
pub fn without(range: [f64; 2], others: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let beside = |parts: Vec<[f64; 2]>, &[a, b]: &[f64; 2]| {
        let (a, b) = (a.min(b), a.max(b));
        let both = |[from, to]: [f64; 2]| [[from, to.min(a)], [from.max(b), to]];
        parts.into_iter().flat_map(both).filter(|[from, to]| from < to).collect()
    };
    others.iter().fold(vec![range], beside)
}

/// An edge with a range of its length.
type EdgePart = (Edge, [f64; 2]);

/// Number of connected parts of the rim of a polygon inside an open box.
pub fn runs_of_rim(hole: &Hole, open: &Rect) -> usize {
    let parts = |side: Edge| clipped(side, open).into_iter().map(move |range| (side, range));
    let parts: Vec<_> = hole.edges_near(open).flat_map(|(_, side)| parts(side)).collect();
    let goes_on = |((side, [_, to]), (next, [from, _])): &(&EdgePart, &EdgePart)| {
        *to == 1.0 && *from == 0.0 && side.to == next.from && inside(open, side.to)
    };
    let joins = parts.iter().zip(parts.iter().cycle().skip(1)).filter(goes_on).count();
    // a rim that lies all inside goes on at each vertex
    (parts.len() - joins).max(parts.len().min(1))
}

/// Length of an edge inside an open box.
pub fn edge_inside(edge: Edge, open: &Rect) -> f64 {
    clipped(edge, open).into_iter().map(|[from, to]| (to - from) * edge.length()).sum()
}

/// The ranges of an edge's length inside an open box.
pub fn clipped(edge: Edge, open: &Rect) -> Vec<[f64; 2]> {
    if edge.is_arc() {
        return edge.within(open);
    }
    let Edge { from: a, to: b, .. } = edge;
    // along an edge of the box nothing is inside
    let is_off = |a: f64, b: f64, min: f64, max: f64| a == b && (a <= min || a >= max);
    if is_off(a.x, b.x, open.min.x, open.max.x) || is_off(a.y, b.y, open.min.y, open.max.y) {
        return Vec::new();
    }
    let range = Line::through([a, b]).within(open, [0.0, 1.0]).filter(|[from, to]| to > from);
    range.into_iter().collect()
}

/// True if a part of an edge lies inside an open box or on its boundary.
pub fn meets(edge: Edge, rect: &Rect) -> bool {
    distance(edge, rect) == 0.0
}

/// Distance of an edge of positive length to a box, zero if they meet.
pub fn distance(edge: Edge, rect: &Rect) -> f64 {
    if edge_inside(edge, rect) > 0.0 {
        return 0.0;
    }
    let of_corners = rect.corners().into_iter().map(|p| edge.distance(p));
    let of_sides = rect.sides().into_iter().filter(|_| edge.is_arc());
    let of_sides = of_sides.map(|side| edge.gap(&Edge::segment(side)));
    let of_ends = [rect.distance(edge.from), rect.distance(edge.to)];
    of_corners.chain(of_ends).chain(of_sides).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::vec2;

    #[test]
    fn runs_of_a_rim_that_closes_outside() {
        let unit = Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0));
        let runs = |points: &[[f64; 2]]| {
            let points = points.iter().chain(&[[9.0, 9.0], [-9.0, 9.0]]);
            runs_of_rim(&Hole::polygon(points.map(|&p| p.into()).collect()), &unit)
        };
        assert_eq!(runs(&[[-1.0, 0.5], [2.0, 0.6]]), 1);
        assert_eq!(runs(&[[-1.0, 0.5], [0.4, 0.5], [2.0, 0.6]]), 1, "a kink inside");
        assert_eq!(runs(&[[0.2, 2.0], [0.4, -1.0], [0.6, 2.0]]), 2, "a kink below");
        assert_eq!(runs(&[[0.2, 2.0], [0.4, 0.1], [0.6, 2.0]]), 1, "a kink inside");
        assert_eq!(runs(&[[0.2, 2.0], [0.2, 0.5], [3.0, 0.5], [3.0, 0.2], [-1.0, 0.2]]), 2);
        assert_eq!(runs(&[[-1.0, 0.0], [2.0, 0.0]]), 0, "along the border");
        assert_eq!(runs(&[[-1.0, 0.5], [0.0, 0.5], [-1.0, 0.6]]), 0, "up to the border");
    }

    #[test]
    fn runs_of_a_rim_in_a_box() {
        let unit = Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0));
        let runs = |points: &[[f64; 2]]| {
            let turns = points.len();
            let mut points: Vec<Vec2> = points.iter().map(|&p| p.into()).collect();
            let mut turned = || {
                points.rotate_left(1);
                runs_of_rim(&Hole::polygon(points.clone()), &unit)
            };
            let all: Vec<_> = (0..turns).map(|_| turned()).collect();
            assert!(all.iter().all(|n| *n == all[0]), "wherever it begins: {all:?}");
            all[0]
        };
        assert_eq!(runs(&[[0.2, 0.2], [0.8, 0.2], [0.5, 0.8]]), 1, "inside");
        assert_eq!(runs(&[[0.2, -1.0], [0.4, -1.0], [0.3, 0.5]]), 1, "an apex inside");
        assert_eq!(runs(&[[0.2, -1.0], [0.4, -1.0], [0.3, 2.0]]), 2, "a strip through");
        assert_eq!(runs(&[[-1.0, -1.0], [0.5, -1.0], [0.5, 3.0], [-1.0, 3.0]]), 1, "one side");
        assert_eq!(runs(&[[-1.0, -1.0], [2.0, -1.0], [2.0, 3.0], [-1.0, 3.0]]), 0, "all of it");
    }
}
