//! Pieces of a cell as parts that can be integrated and divided.

use super::adapt::Subregion;
use super::chart::{UNIT, quadrilaterals};
use super::curve::ChartWindow;
use super::gauss::Rules1d;
use super::polygon::ConvexPolygon;
use ppum::vec2::{Vec2, vec2};

/// Most ways in which a polygon is divided to see which matters.
const WAYS: usize = 4;

/// A piece on which the integrand is smooth, relative to an anchor.
#[derive(Clone)]
pub(super) enum SmoothPiece<'c> {
    /// With straight sides, away from singular points.
    Polygon(ConvexPolygon),
    /// In the coordinates of a chart.
    Window(ChartWindow<'c>),
}

impl Subregion for SmoothPiece<'_> {
    fn nodes(&self, rules: Rules1d, n: usize, push: &mut dyn FnMut(Vec2, f64)) {
        match self {
            Self::Polygon(polygon) => {
                quadrilaterals(polygon).for_each(|chart| chart.nodes(&UNIT, rules, n, push));
            }
            Self::Window(window) => window.chart.nodes(&window.range, rules, n, push),
        }
    }

    fn divisions(&self, directions: &[Vec2]) -> Vec<[Self; 2]> {
        match self {
            Self::Polygon(polygon) => divisions(polygon, directions),
            Self::Window(w) => [0, 1].map(|axis| w.halves(axis).map(Self::Window)).into(),
        }
    }
}

/// The halves of a polygon along each of some directions; along the axes if there are none.
fn divisions<'c>(polygon: &ConvexPolygon, directions: &[Vec2]) -> Vec<[SmoothPiece<'c>; 2]> {
    let axes = [vec2(1.0, 0.0), vec2(0.0, 1.0)];
    let ways = if directions.is_empty() { &axes } else { directions };
    let halves = ways.iter().take(WAYS).filter_map(|&e| halves(polygon, e));
    halves.map(|halves| halves.map(SmoothPiece::Polygon)).collect()
}

/// The two parts of a polygon that reach equally far in a direction.
fn halves(polygon: &ConvexPolygon, e: Vec2) -> Option<[ConvexPolygon; 2]> {
    let reach = polygon.0.iter().map(|v| v.dot(e));
    let (lo, hi) = reach.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| (a.min(s), b.max(s)));
    let on = e * (0.5 * (lo + hi));
    polygon.cut(on, on + e.left() * polygon.diameter())
}
