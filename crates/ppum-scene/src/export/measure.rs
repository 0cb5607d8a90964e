//! The difference of interpolation and field, measured at random points.

use ppum::vec2::Vec2;
use rayon::prelude::*;

use super::lagrange::BarycentricPoint;
use super::refine::{RefinedMesh, or_infinite};

/// Random points of a measurement: half of them uniform in the domain, half of them uniform among
/// the triangles, so that small ones are seen too.
pub const RANDOM_POINTS: usize = 20_000;

/// Part of the tolerance from which a triangle is divided: peaks next to a random point are higher.
const MARGIN: f64 = 0.7;

/// A measurement.
#[derive(Clone, Debug)]
pub(super) struct Measurement {
    /// Largest difference of each column, outside of singular points.
    pub(super) largest: Vec<f64>,
    /// For each column the share of points that are within the tolerance, of those outside of
    /// singular points.
    pub(super) share: Vec<f64>,
    /// Triangles in which one is not by a margin, and which can be divided.
    pub(super) failed: Vec<u32>,
}

impl RefinedMesh<'_, '_> {
    /// Measures at points that follow from a seed, with values that are evaluated again or those at
    /// the points of `cells`.
    pub(super) fn measure(&self, seed: u64, cells: Option<&[u32]>) -> Measurement {
        let (width, allowed) = (self.columns.len(), self.allowed());
        let at = self.random_points(seed);
        let exact = self.exact(&at);
        let triangles: Vec<u32> = at.iter().map(|(t, _)| *t).collect();
        let nodes = match cells {
            Some(cells) => self.stored(cells, &triangles),
            None => self.nodes(&triangles),
        };
        let rows = exact.par_chunks(width).zip(nodes.par_chunks(self.cell.nodes.len() * width));
        let difference = |(at, (exact, nodes))| self.differences(at, exact, nodes);
        let differences: Vec<Vec<f64>> = at.par_iter().zip(rows).map(difference).collect();
        let mut found =
            Measurement { largest: vec![0.0; width], share: vec![1.0; width], failed: Vec::new() };
        for c in 0..width {
            let all = differences.iter().map(|row| row[c]).filter(|difference| *difference >= 0.0);
            let all: Vec<f64> = all.collect();
            found.largest[c] = all.iter().copied().fold(0.0, f64::max);
            let within = all.iter().filter(|difference| **difference <= allowed[c]).count();
            found.share[c] = within as f64 / all.len().max(1) as f64;
        }
        let fails =
            |row: &Vec<f64>| row.iter().zip(&allowed).any(|(d, allowed)| *d > MARGIN * allowed);
        let failed =
            at.iter().zip(&differences).filter(|(_, row)| fails(row)).map(|((t, _), _)| *t);
        let has_stalled = |t: u32| self.mesh.triangles[t as usize].convergence.has_stalled();
        found.failed = failed.filter(|&t| self.may_divide(t) && !has_stalled(t)).collect();
        found.failed.sort_unstable();
        found.failed.dedup();
        found
    }

    /// Rows of all nodes of each triangle as they are stored.
    fn stored(&self, cells: &[u32], triangles: &[u32]) -> Vec<f64> {
        let (width, size) = (self.columns.len(), self.cell.nodes.len());
        let points = triangles.iter().flat_map(|&t| &cells[t as usize * size..][..size]);
        points.flat_map(|&point| &self.values[point as usize * width..][..width]).copied().collect()
    }

    /// Differences at a place; −1 where nothing is claimed of a column.
    fn differences(&self, at: &(u32, BarycentricPoint), exact: &[f64], nodes: &[f64]) -> Vec<f64> {
        let is_far = self.singular.loosened(self.position(at.0, at.1)) == 1.0;
        let interpolated = self.interpolated(nodes, &self.cell.weights(at.1));
        let difference = |c: usize| match is_far || !self.singular.columns[c] {
            true if exact[c].is_nan() && interpolated[c].is_nan() => -1.0,
            true => or_infinite((exact[c] - interpolated[c]).abs()),
            false => -1.0,
        };
        (0..exact.len()).map(difference).collect()
    }

    fn random_points(&self, seed: u64) -> Vec<(u32, BarycentricPoint)> {
        let count = self.mesh.triangles.len() as u32;
        let mut sum = 0.0;
        let mut areas = Vec::with_capacity(count as usize);
        for triangle in 0..count {
            sum += double_area(self.mesh.corners(triangle));
            areas.push(sum);
        }
        let mut random = SplitMix64(seed);
        let mut point = |k: usize| {
            let [chosen, p, q] = [(); 3].map(|()| random.unit());
            let triangle = match k % 2 {
                0 => areas.partition_point(|&area| area <= chosen * sum) as u32,
                _ => (chosen * f64::from(count)) as u32,
            };
            let [p, q] = if p + q > 1.0 { [1.0 - p, 1.0 - q] } else { [p, q] };
            (triangle.min(count - 1), [1.0 - p - q, p, q])
        };
        (0..RANDOM_POINTS).map(&mut point).collect()
    }
}

fn double_area([a, b, c]: [Vec2; 3]) -> f64 {
    (b - a).cross(c - a)
}

/// SplitMix64 (Steele, Lea, Flood 2014): the same numbers on every machine.
struct SplitMix64(u64);

impl SplitMix64 {
    /// Uniform in \[0, 1).
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}
