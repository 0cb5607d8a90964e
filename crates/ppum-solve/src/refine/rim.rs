//! Cells at curved rims: as large as the stress at the rim allows.

use ppum::domain::Hole;
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

/// Largest angle, in radians, by which a rim turns at a corner that belongs to a curve: what turns
/// more has a singular field, see [`corner`](crate::corner).
const TURN: f64 = 0.3;

/// A corner of a polygon where it follows a curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct RimCorner {
    pub(super) at: Vec2,
    /// Radius of curvature.
    pub(super) radius: f64,
    /// Length of the rim that belongs to the corner.
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

/// The corners of a polygon at which it follows a curve.
pub(super) fn bends(hole: &Hole) -> Vec<RimCorner> {
    let sides: Vec<_> = hole.sides().collect();
    let n = sides.len();
    let bend = |k: usize| {
        let [from, at] = sides[k];
        let (before, after) = (at - from, sides[(k + 1) % n][1] - at);
        let turn = before.cross(after).atan2(before.dot(after)).abs();
        let length = 0.5 * (before.length() + after.length());
        (turn > 0.0 && turn < TURN).then(|| RimCorner { at, radius: length / turn, length })
    };
    (0..n).filter_map(bend).collect()
}

/// Largest part of its radius of curvature that a cell at the rim of a hole is long, with the
/// cell's number; none if no cell is there, or the rim is not curved.
pub fn coarsest(hole: &Hole, cells: &[(u32, Rect)]) -> Option<(f64, u32)> {
    let size = |cell: &Rect| cell.size().x.max(cell.size().y);
    let on = |bends: &[RimCorner], cell: &Rect| match *hole {
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
    let bends = bends(hole);
    let all =
        cells.iter().filter_map(|(number, cell)| Some((size(cell) / on(&bends, cell)?, *number)));
    all.max_by(|a, b| a.0.total_cmp(&b.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::vec2;

    /// The radii of curvature of an ellipse at its vertices are b²/a and a²/b.
    #[test]
    fn radii_of_an_ellipse() {
        let (a, b, n) = (2.0, 0.5, 400);
        let at = |k: u32| std::f64::consts::TAU * f64::from(k) / f64::from(n);
        let points = (0..n).map(|k| vec2(a * at(k).cos(), b * at(k).sin())).collect();
        let all = bends(&Hole::polygon(points));
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
        assert!(bends(&Hole::polygon(square.to_vec())).is_empty());
    }
}
