//! Cells at curved rims: as large as the stress at the rim allows. It is the curvature that counts,
//! not into how many arcs a curve is divided.

use ppum::domain::Hole;
use ppum::edge::Edge;
use ppum::vec2::{Rect, Vec2};
use ppum_problem::{PolynomialOrder, nine};

/// Error of the stress at a rim, relative to the largest one, that its cells aim at.
const AIM: f64 = 0.0075;

/// The error of cells as large as the radius of curvature: polynomials of order p in cells of size
/// h leave ROUGH (h/R)^p at most, at the worst of all points of a rim. Plates with round holes
/// under tension (Kirsch 1898) had 2.4, 2.6, 1.8 and 1.0 for the orders 1 to 4.
const ROUGH: f64 = 2.6;

/// Largest cells at a rim, in its radii: energies are right to 2e-4 then. Cells of 0.23 radii had
/// 1.3e-3 under bending.
pub(super) const FOR_ENERGY: f64 = 0.22;

/// Smallest cells at a rim, in its radii: those of order 2, as order 1 would ask for cells
/// without end.
const LEAST: f64 = 0.05;

/// Largest angle, in radians, by which a rim turns between segments that follow a curve, as those
/// of meshes do: what turns more has a singular field, see [`corner`](crate::corner).
const TURN: f64 = 0.3;

/// A place on a curved rim: on an arc, or a corner between segments that follow a curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct RimCorner {
    pub(super) at: Vec2,
    /// Radius of curvature.
    pub(super) radius: f64,
    /// Length of the rim that belongs to the place.
    pub(super) length: f64,
}

/// Estimated error of the stress at a rim, relative to the largest one, in cells of a size
/// in radii.
pub fn rim_error(size: f64, order: usize) -> f64 {
    (ROUGH * size.powi(order.max(1) as i32)).min(1.0)
}

/// Largest cells at the rim of a hole, in its radii.
pub(super) fn finest(order: &PolynomialOrder, hole: &Rect) -> f64 {
    let order = nine(hole).filter_map(|p| order.at(p).ok()).min().unwrap_or(1).max(1);
    (AIM / ROUGH).powf(1.0 / order as f64).clamp(LEAST, FOR_ENERGY)
}

/// Places on the curved parts of a polygon's rim, on arcs at turns of a step at most.
pub(super) fn bends(hole: &Hole, step: f64) -> Vec<RimCorner> {
    let sides: Vec<_> = hole.edges().collect();
    let of_side = |k: usize| match [sides[k], sides[(k + 1) % sides.len()]] {
        [own, _] if own.is_arc() => along_arc(&own, step),
        [own, next] if !next.is_arc() => bend(&own, &next).into_iter().collect(),
        _ => Vec::new(),
    };
    (0..sides.len()).flat_map(of_side).collect()
}

fn along_arc(arc: &Edge, step: f64) -> Vec<RimCorner> {
    let radius = arc.curvature().recip().abs();
    let corner = |part: Edge| RimCorner { at: part.middle(), radius, length: part.length() };
    arc.divided(step).map(corner).collect()
}

/// The corner between two segments if they follow a curve.
fn bend(before: &Edge, after: &Edge) -> Option<RimCorner> {
    let (at, before, after) = (before.to, before.chord(), after.chord());
    let turn = before.cross(after).atan2(before.dot(after)).abs();
    let length = 0.5 * (before.length() + after.length());
    (turn > 0.0 && turn < TURN).then(|| RimCorner { at, radius: length / turn, length })
}

/// Largest part of its radius of curvature that a cell at the rim of a hole is long, with the
/// cell's number; none if no cell is there, or the rim is not curved.
pub fn coarsest(hole: &Hole, cells: &[(u32, Rect)]) -> Option<(f64, u32)> {
    let size = |cell: &Rect| cell.size().x.max(cell.size().y);
    let bends = bends(hole, LEAST);
    let on = |cell: &Rect| match *hole {
        Hole::Circle { center, radius } => {
            let farthest = cell.corners().into_iter().map(|p| (p - center).length());
            let is_on = cell.distance(center) <= radius && farthest.fold(0.0, f64::max) >= radius;
            is_on.then_some(radius)
        }
        Hole::Polygon { .. } => {
            let here = bends.iter().filter(|bend| cell.contains(bend.at)).map(|bend| bend.radius);
            here.min_by(f64::total_cmp)
        }
    };
    let all = cells.iter().filter_map(|(number, cell)| Some((size(cell) / on(cell)?, *number)));
    all.max_by(|a, b| a.0.total_cmp(&b.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::domain::PolygonSide;
    use ppum::vec2::vec2;
    use std::f64::consts::TAU;

    /// The radii of curvature of an ellipse at its vertices are b²/a and a²/b.
    #[test]
    fn radii_of_an_ellipse() {
        let (a, b, n) = (2.0, 0.5, 400);
        let at = |k: u32| std::f64::consts::TAU * f64::from(k) / f64::from(n);
        let points = (0..n).map(|k| vec2(a * at(k).cos(), b * at(k).sin())).collect();
        let all = bends(&Hole::polygon(points), 1.0);
        assert_eq!(all.len(), n as usize);
        let near =
            |p: Vec2| all.iter().find(|bend| (bend.at - p).length() < 1e-9).map(|b| b.radius);
        let (end, flank) = (near(vec2(a, 0.0)).expect("it"), near(vec2(0.0, b)).expect("it"));
        // of second order in the angle between corners
        assert!(
            (end / 0.125 - 1.0).abs() < 5e-3 && (flank / 8.0 - 1.0).abs() < 5e-3,
            "{end} {flank}"
        );
        let perimeter: f64 = all.iter().map(|bend| bend.length).sum();
        assert!((perimeter - 8.5784).abs() < 1e-3, "{perimeter}");
    }

    /// Corners are no bends.
    #[test]
    fn corners_are_none() {
        let square = [[0.0, 0.0], [0.5, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Vec2::from);
        assert!(bends(&Hole::polygon(square.to_vec()), 1.0).is_empty());
    }

    /// The coarsest cell at a circle is the same for a circle, two arcs and forty, and so is what
    /// their places stand for.
    #[test]
    fn circles_of_any_number_of_arcs() {
        let (center, radius) = (vec2(0.2, 0.1), 0.5);
        let of_arcs = |n: u32| {
            let part = TAU / f64::from(n);
            let at = |k: u32| Vec2::from(<[f64; 2]>::from((f64::from(k) * part).sin_cos()));
            let points = (0..n).map(|k| center + vec2(at(k).y, at(k).x) * radius).collect();
            let bulges = vec![(0.25 * part).tan(); n as usize];
            Hole::with_arcs(points, bulges, PolygonSide::Inside)
        };
        let cell = |k: u32| {
            let (i, j) = (f64::from(k % 16), f64::from(k / 16));
            (k, Rect::around(vec2(i, j) * 0.1 - vec2(0.7, 0.7), vec2(0.05, 0.05 + 0.001 * i)))
        };
        let cells: Vec<_> = (0..256).map(cell).collect();
        let expected = coarsest(&Hole::Circle { center, radius }, &cells).expect("cells on it");
        for n in [2, 3, 40] {
            let hole = of_arcs(n);
            let found = coarsest(&hole, &cells).expect("cells on it");
            assert!((found.0 / expected.0 - 1.0).abs() < 1e-12 && found.1 == expected.1, "{n}");
            for step in [0.05, 0.22, 1.0] {
                let all = bends(&hole, step);
                let length: f64 = all.iter().map(|bend| bend.length).sum();
                assert!((length / (TAU * radius) - 1.0).abs() < 1e-12, "{n} {step}");
                for bend in &all {
                    assert!((bend.radius / radius - 1.0).abs() < 1e-12);
                    assert!(((bend.at - center).length() / radius - 1.0).abs() < 1e-12);
                    assert!(bend.length <= step * radius * (1.0 + 1e-12));
                }
            }
        }
    }
}
