//! Places next to singular points: there a quantity varies within each pixel.

use ppum::crack::Side;
use ppum::vec2::{Vec2, vec2};
use rayon::prelude::*;

use super::curves::{BoundaryCurve, best_first};
use super::{ExtremumSearch, HIDDEN, Promise, ROUND, climb};

/// Rings around a point, the radius of the least in units of what is hidden there, and how much
/// larger each is than that before: to two pixels.
const RINGS: usize = 20;
const FIRST: f64 = 1.5;
const WIDER: f64 = 1.46;

/// Places beside all points together, at most.
const SAMPLES: usize = 1 << 13;

/// Places on a ring, at least and at most.
const PLACES: [usize; 2] = [12, 48];

/// Scale of the steps from a place, in parts of its distance from the point: some of the distance
/// to the next one.
const SCALE: f64 = 0.1;

/// Faces of cracks next to points that they end at, in ever shorter parts; none if there are too
/// many points.
pub(super) fn faces(curves: &[BoundaryCurve], hidden: &[Vec2], pixel: f64) -> Vec<BoundaryCurve> {
    if hidden.len() * curves.len() > SAMPLES / RINGS {
        return Vec::new();
    }
    let distances = [HIDDEN * pixel, 2.0, 2.0 * pixel];
    let pairs = hidden.iter().flat_map(|point| curves.iter().map(move |curve| (point, curve)));
    pairs.flat_map(|(point, curve)| curve.parts_from(*point, distances)).collect()
}

impl ExtremumSearch<'_, '_> {
    /// Places beside singular points from which a search may begin, each with the scale of its
    /// steps, the most promising first; none if there are too many such points.
    pub(super) fn beside_singular(&self, sign: f64) -> Vec<Promise<(Vec2, f64)>> {
        let places = SAMPLES / (RINGS * self.hidden.len().max(1));
        if places < PLACES[0] {
            return Vec::new();
        }
        let places = places.min(PLACES[1]);
        let found = self.hidden.par_iter().flat_map_iter(|&p| self.around(p, places, sign));
        best_first(found.collect(), ROUND)
    }

    /// The places around a point that are not below their neighbours nearer and farther, nor below
    /// both beside them: one of these may lie on the other side of a crack.
    fn around(&self, point: Vec2, places: usize, sign: f64) -> Vec<Promise<(Vec2, f64)>> {
        let mut local = self.field.at(self.region.anchor);
        let at = |ring: usize, place: usize| {
            let r = FIRST * HIDDEN * WIDER.powi(ring as i32) * self.pixel;
            let angle = (place as f64 + 0.4142) / places as f64 * std::f64::consts::TAU;
            (point + vec2(angle.cos(), angle.sin()) * r, SCALE * r)
        };
        let mut height = |ring: usize, place: usize| {
            let (at, _) = at(ring, place);
            if !self.is_seen(at) || self.is_hidden(at) {
                return f64::NAN;
            }
            sign * climb::finite(self.slope.quantity().at(&mut local, at, Side::Above))
        };
        let heights: Vec<Vec<f64>> =
            (0..RINGS).map(|ring| (0..places).map(|k| height(ring, k)).collect()).collect();
        let promise = |ring: usize, k: usize| {
            let here = heights[ring][k];
            let beside = [1, places - 1].map(|by| heights[ring][(k + by) % places]);
            let inward = ring.checked_sub(1).map_or(here, |inner| heights[inner][k]);
            let outward = heights.get(ring + 1).map_or(here, |outer| outer[k]);
            let is_top = !(inward > here || outward > here || beside.iter().all(|v| *v > here));
            let least = [inward, outward, beside[0], beside[1]].into_iter().fold(here, f64::min);
            (is_top && !here.is_nan()).then(|| (2.0 * here - least, at(ring, k)))
        };
        (0..RINGS * places).filter_map(|n| promise(n / places, n % places)).collect()
    }
}
