//! Curved interfaces: chords between the places where a level function changes its sign.

use super::cut::{AnchoredPolygon, PolygonCut};
use super::{SAGITTA, centroid};
use ppum::formula::Formula;
use ppum::vec2::{Rect, Vec2, vec2};

/// Bisections of a change of sign, to rounding.
const BISECTIONS: usize = 52;

/// Samples in each direction of a rectangle that tell whether a curve may be near.
const SAMPLES: usize = 4;

/// Most divisions in four, one inside the other.
const DEPTH: usize = 4;

/// A curve that meets a polygon's sides in two places nearer to each other than this part of the
/// polygon touches a corner.
const TOUCHING: f64 = 1e-9;

/// A formula of x and y, of offsets from an anchor.
#[derive(Debug)]
pub(crate) struct FormulaLevel {
    pub(crate) formula: Formula,
    pub(crate) anchor: Vec2,
}

impl LevelCurve for FormulaLevel {
    fn value(&self, offset: Vec2) -> f64 {
        let p = self.anchor + offset;
        self.formula.evaluate(&[p.x, p.y])
    }
}

impl FormulaLevel {
    /// False if samples say that the curve stays away from a rectangle: their least value is more
    /// than neighbours differ.
    pub(super) fn may_meet(&self, rect: &Rect) -> bool {
        let step = rect.size() / (SAMPLES - 1) as f64;
        let value = |k: usize| {
            let (i, j) = (k % SAMPLES, k / SAMPLES);
            let p = self.anchor + rect.min + vec2(step.x * i as f64, step.y * j as f64);
            self.formula.evaluate(&[p.x, p.y])
        };
        let values: Vec<f64> = (0..SAMPLES * SAMPLES).map(value).collect();
        let least = values.iter().fold(f64::INFINITY, |a, v| a.min(v.abs()));
        let right =
            (0..values.len()).filter(|k| k % SAMPLES > 0).map(|k| [values[k - 1], values[k]]);
        let up = (SAMPLES..values.len()).map(|k| [values[k - SAMPLES], values[k]]);
        right.chain(up).any(|[a, b]| (a > 0.0) != (b > 0.0) || (a - b).abs() >= least)
    }
}

/// The zeros of a function. They are missed where the function does not change its sign between the
/// corners, the middles of the sides and the centroid of a polygon.
pub(crate) trait LevelCurve {
    /// The function.
    fn value(&self, p: Vec2) -> f64;

    /// True if the field may jump or end on a chord with a middle.
    fn is_face(&self, _middle: Vec2) -> bool {
        true
    }

    fn is_positive(&self, p: Vec2) -> bool {
        self.value(p) > 0.0
    }

    /// The parts of a polygon on both sides.
    fn split(&self, polygon: AnchoredPolygon, least: f64) -> Vec<AnchoredPolygon> {
        let mut parts = Vec::new();
        self.divide(polygon, least, DEPTH, &mut parts);
        parts
    }

    fn divide(
        &self,
        polygon: AnchoredPolygon,
        least: f64,
        depth: usize,
        parts: &mut Vec<AnchoredPolygon>,
    ) {
        let crossings = self.crossings(&polygon);
        let inside = self.is_positive(centroid(&polygon.corners));
        let unseen = crossings.is_empty() && inside == self.is_positive(polygon.corners[0]);
        if unseen {
            parts.push(polygon);
            return;
        }
        if let [a, b] = crossings[..] {
            if (b - a).length() <= TOUCHING * size(&polygon) {
                parts.push(polygon);
                return;
            }
            let sagitta = self.sagitta(a, b);
            if sagitta <= SAGITTA * size(&polygon) || depth == 0 {
                let is_face = self.is_face((a + b) * 0.5);
                let cut = PolygonCut::chord([a, b], sagitta.max(f64::MIN_POSITIVE), is_face);
                parts.extend(polygon.split(&cut, least).into_iter().flatten());
                return;
            }
        }
        if depth == 0 {
            parts.push(polygon);
            return;
        }
        let center = centroid(&polygon.corners);
        let axes = [vec2(1.0, 0.0), vec2(0.0, 1.0)].map(|axis| PolygonCut::through(center, axis));
        let halves = polygon.split(&axes[0], least).into_iter().flatten();
        let quarters = halves.flat_map(|half| half.split(&axes[1], least)).flatten();
        quarters.for_each(|quarter| self.divide(quarter, least, depth - 1, parts));
    }

    /// The places on a polygon's sides where the sign changes.
    fn crossings(&self, polygon: &AnchoredPolygon) -> Vec<Vec2> {
        let halves = (0..polygon.corners.len()).flat_map(|k| {
            let (a, middle, b) = (polygon.corners[k], polygon.middle(k), polygon.next(k));
            [[a, middle], [middle, b]]
        });
        halves.filter_map(|[a, b]| self.root(a, b)).collect()
    }

    /// The change of sign between two points, by bisection, whichever comes first; `None` if there
    /// is none.
    fn root(&self, a: Vec2, b: Vec2) -> Option<Vec2> {
        let (mut a, mut b) = if (b.x, b.y) < (a.x, a.y) { (b, a) } else { (a, b) };
        let positive = self.is_positive(a);
        if self.is_positive(b) == positive {
            return None;
        }
        for _ in 0..BISECTIONS {
            let middle = (a + b) * 0.5;
            if self.is_positive(middle) == positive { a = middle } else { b = middle }
        }
        Some((a + b) * 0.5)
    }

    /// Distance of the middle of a chord from the curve; ∞ if it is more than a quarter of
    /// the chord.
    fn sagitta(&self, a: Vec2, b: Vec2) -> f64 {
        let (middle, reach) = ((a + b) * 0.5, (b - a).left() * 0.25);
        let root = self.root(middle - reach, middle + reach);
        root.map_or(f64::INFINITY, |root| (root - middle).length())
    }
}

fn size(polygon: &AnchoredPolygon) -> f64 {
    let first = polygon.corners[0];
    polygon.corners.iter().fold(0.0, |a: f64, &corner| a.max((corner - first).length()))
}
