//! Pieces of a cell as parts that can be integrated and divided.

use super::adapt::Part;
use super::chart::{UNIT, quadrilaterals, range};
use super::curve::Window;
use super::polygon::Polygon;
use ppum::vec2::{Vec2, vec2};

/// Most ways in which a polygon is divided to see which matters.
const WAYS: usize = 4;

/// A piece on which the integrand is smooth, relative to an anchor.
pub(super) enum Piece<'c> {
    /// With straight sides, away from singular points.
    Polygon(Polygon),
    /// In the coordinates of a chart.
    Window(Window<'c>),
}

impl Part for Piece<'_> {
    fn nodes(&self, n: usize, push: &mut dyn FnMut(Vec2, f64)) {
        match self {
            Self::Polygon(polygon) => {
                quadrilaterals(polygon).for_each(|chart| chart.nodes(&UNIT, n, push));
            }
            Self::Window(window) => window.chart.nodes(&window.range, n, push),
        }
    }

    fn border(&self, push: &mut dyn FnMut(Vec2, f64)) {
        match self {
            Self::Polygon(polygon) => {
                let area = polygon.area();
                for (a, b) in polygon.edges() {
                    push(a, area);
                    push((a + b) * 0.5, area);
                }
            }
            Self::Window(window) => border(window, push),
        }
    }

    fn divisions(&self, directions: &[Vec2]) -> Vec<[Self; 2]> {
        match self {
            Self::Polygon(polygon) => divisions(polygon, directions),
            Self::Window(w) => [0, 1].map(|axis| w.halves(axis).map(Self::Window)).into(),
        }
    }
}

/// Corners and middles of the sides of a window.
fn border(window: &Window<'_>, push: &mut dyn FnMut(Vec2, f64)) {
    let size = window.range.size();
    for (i, j) in [(0, 0), (1, 0), (2, 0), (0, 1), (2, 1), (0, 2), (1, 2), (2, 2)] {
        let at = |axis: usize, k: i32| {
            let (lo, hi) = range(&window.range, axis);
            [lo, 0.5 * (lo + hi), hi][k as usize]
        };
        let (x, jacobian) = window.chart.at([at(0, i), at(1, j)]);
        push(x, jacobian * size.x * size.y);
    }
}

/// The halves of a polygon along each of some directions and across the first; along the axes if
/// there are none.
fn divisions<'c>(polygon: &Polygon, directions: &[Vec2]) -> Vec<[Piece<'c>; 2]> {
    let first = directions.first().copied().unwrap_or(vec2(1.0, 0.0));
    let others = directions.iter().skip(1).copied();
    [first, first.left()]
        .into_iter()
        .chain(others)
        .take(WAYS)
        .filter_map(|e| halves(polygon, e))
        .map(|halves| halves.map(Piece::Polygon))
        .collect()
}

/// The two parts of a polygon that reach equally far in a direction.
fn halves(polygon: &Polygon, e: Vec2) -> Option<[Polygon; 2]> {
    let reach = polygon.0.iter().map(|v| v.dot(e));
    let (lo, hi) = reach.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| (a.min(s), b.max(s)));
    let on = e * (0.5 * (lo + hi));
    polygon.cut(on, on + e.left() * polygon.diameter())
}
