//! Arcs of rims and cracks as the polylines that exports triangulate.
//!
//! A whole circle has [`SIDES`] sides, r (1/cos(π/n) − 1) < 10⁻⁴ r from it. Polylines of rims do
//! not leave the body: their sides are chords where it lies inside of the circle, and tangents
//! where it lies outside. Cracks are chords, whose vertices lie on them.

use std::f64::consts::TAU;

use ppum::domain::{Domain, Hole};
use ppum::edge::Edge;
use ppum::vec2::{Rect, Vec2, vec2};

/// Sides of the polygon around a round hole.
const SIDES: f64 = 256.0;

/// The domain with polygons in the place of holes with round sides.
pub(super) fn with_polygons(domain: &Domain) -> Domain {
    Domain { bounds: domain.bounds, holes: domain.holes.iter().map(polygon).collect() }
}

fn polygon(hole: &Hole) -> Hole {
    let inner = hole.orientation();
    let points = match hole {
        Hole::Circle { center, radius } => around(*center, *radius),
        Hole::Polygon { .. } => hole.edges().flat_map(|edge| behind(edge, inner)).collect(),
    };
    if hole.is_outside() { Hole::outside(points) } else { Hole::polygon(points) }
}

/// The first point of an edge, and those behind it but for the last one.
fn behind(edge: Edge, inner: f64) -> impl Iterator<Item = Vec2> {
    let is_outside = inner * edge.bulge > 0.0;
    let behind = if is_outside { tangents(&edge) } else { chords(&edge, &[]) };
    std::iter::once(edge.from).chain(behind.into_iter().filter(move |p| *p != edge.to))
}

fn around(center: Vec2, radius: f64) -> Vec<Vec2> {
    let step = TAU / SIDES;
    let corner = |k: u32| {
        let (sin, cos) = (step * f64::from(k)).sin_cos();
        center + vec2(cos, sin) * (radius / (0.5 * step).cos())
    };
    (0..SIDES as u32).map(corner).collect()
}

/// The points in which tangents at the ends of the parts of an arc meet.
fn tangents(edge: &Edge) -> Vec<Vec2> {
    let parts = parts(edge.sweep());
    let corner = |k: u32| {
        let middle = (f64::from(k) + 0.5) / f64::from(parts);
        let half = 0.5 * edge.sweep() / f64::from(parts);
        // r (1/cos ψ/2 − 1) = r tan(ψ/2) tan(ψ/4)
        let beyond = half.tan() * (0.5 * half).tan() / edge.curvature();
        edge.at(middle) - edge.tangent(middle).left() * beyond
    };
    (0..parts).map(corner).collect()
}

/// The points of an edge behind its first one that chords join, with others on it among them.
pub(super) fn chords(edge: &Edge, others: &[Vec2]) -> Vec<Vec2> {
    let others = others.iter().map(|p| (edge.closest_part(*p), *p));
    let mut breaks: Vec<_> = others.chain([(0.0, edge.from), (1.0, edge.to)]).collect();
    breaks.sort_by(|a, b| a.0.total_cmp(&b.0));
    let behind = |pair: &[(f64, Vec2)]| {
        let [(low, _), (high, last)] = [pair[0], pair[1]];
        let count = if edge.is_arc() { parts(edge.sweep() * (high - low)) } else { 1 };
        let part = move |k: u32| low + (high - low) * (f64::from(k) / f64::from(count));
        (1..=count).map(move |k| if k == count { last } else { edge.at(part(k)) })
    };
    breaks.windows(2).flat_map(behind).collect()
}

/// Parts of an arc by its turn: as many as of a circle, or so many that chords are 3·10⁻⁴ of the
/// arc's length from it.
fn parts(turn: f64) -> u32 {
    let turn = turn.abs();
    (turn / TAU * SIDES).max(20.0 * turn.sqrt()).ceil().max(1.0) as u32
}

/// The points inside of an arc at which other edges end on it or cross it, with the coordinates of
/// those that are along an axis.
pub(super) fn meetings_on_arc(arc: &Edge, others: &[Edge], reach: f64) -> Vec<Vec2> {
    let bounds = arc.bounds();
    let around = Rect::around(bounds.center(), bounds.size() * 0.5 + vec2(reach, reach));
    let near: Vec<&Edge> = others.iter().filter(|edge| around.overlaps(&edge.bounds())).collect();
    let on_arc = near.iter().flat_map(|other| {
        let ends = [other.from, other.to].into_iter().filter(|p| arc.distance(*p) <= reach);
        let crossings = arc.meets(other).into_iter().map(|[part, _]| {
            let through = near.iter().filter(|edge| edge.distance(arc.at(part)) <= reach);
            through.fold(arc.at(part), |p, edge| along_axis(edge, p))
        });
        ends.chain(crossings).collect::<Vec<_>>()
    });
    let mut points = vec![arc.from, arc.to];
    for p in on_arc {
        if points.iter().all(|q| (*q - p).length() > reach) {
            points.push(p);
        }
    }
    points.split_off(2)
}

/// A point with the coordinate of an edge along an axis.
fn along_axis(&Edge { from, to, bulge }: &Edge, p: Vec2) -> Vec2 {
    let of = |from: f64, to: f64, p: f64| if bulge == 0.0 && from == to { from } else { p };
    vec2(of(from.x, to.x, p.x), of(from.y, to.y, p.y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::domain::PolygonSide;
    use ppum::segment::{sides, signed_area};
    use ppum_testkit::random::Random;

    /// Polygons of holes hold the hole, and outlines lie in the body, no farther than 10⁻⁴ of the
    /// radius from their rims.
    #[test]
    fn polygons_do_not_leave_the_body() {
        let mut random = Random(71);
        for k in 0..60 {
            let points: Vec<Vec2> = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.5], [0.0, 1.5]]
                .map(|p| Vec2::from(p) + random.point(&Rect::around(Vec2::ZERO, vec2(0.2, 0.2))))
                .to_vec();
            let bulges: Vec<f64> = (0..4).map(|_| random.between(-0.3, 0.3)).collect();
            let side = [PolygonSide::Inside, PolygonSide::Outside][k % 2];
            let hole = Hole::with_arcs(points, bulges, side);
            let Hole::Polygon { points, bulges, .. } = polygon(&hole) else { panic!("a polygon") };
            assert!(bulges.is_empty());
            for p in sides(&points).flat_map(|[a, b]| [a, (a + b) * 0.5]) {
                let away = hole.rim_distance(p);
                assert!(away < 1e-3 && (away < 1e-13 || !hole.contains(p)), "{hole:?} {p:?}");
            }
            let area = |edge: Edge| edge.area_from(Vec2::ZERO);
            let exact: f64 = hole.edges().map(area).sum();
            assert!((signed_area(&points) - exact).abs() < 5e-3, "{hole:?}");
        }
    }

    /// Chords join points of the arc, among them those at which others end or cross it.
    #[test]
    fn chords_join_points_of_the_arc() {
        let edge = Edge { from: vec2(0.1, 0.2), to: vec2(0.9, -0.3), bulge: 2.1 };
        let end = edge.at(0.3337);
        let others = [[vec2(3.0, 3.0), end], [vec2(0.7, -3.0), vec2(0.7, 3.0)]];
        let met = meetings_on_arc(&edge, &others.map(Edge::segment), 1e-9);
        let points = chords(&edge, &met);
        assert!(points.iter().all(|p| edge.distance(*p) < 1e-14));
        assert!(points.contains(&end) && points.iter().any(|p| p.x == 0.7));
        assert_eq!(points.last(), Some(&edge.to));
        assert!(points.len() > 170, "{}", points.len());
        assert_eq!(chords(&Edge::segment([edge.from, edge.to]), &[]), [edge.to]);
    }
}
