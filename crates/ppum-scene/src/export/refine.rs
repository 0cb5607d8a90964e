//! Refinement of a mesh until interpolation between its points resolves the field.

use ppum::field::Field;
use ppum::progress::{Cancelled, Phase, Progress, Watcher};
use ppum::sample::{SampledQuantity, SidedPoint, evaluate_each};
use ppum::vec2::Vec2;
use rayon::prelude::*;

use super::arrays::ArrayColumns;
use super::borders;
use super::elements::{ElementPlace, evaluate_elements};
use super::lagrange::{BarycentricPoint, Lagrange};
use super::singular::SingularPoints;
use super::torn::{Torn, TornPoint, ValueSide};

/// Part of the tolerance that is allowed at tests: elsewhere it may be a little more, and in large
/// triangles of higher order, of which tests see a smaller part, more than that.
const MARGINS: [f64; 2] = [0.75, 0.5];

/// Triangles with edges shorter than this part of the domain, or thinner than the other, are not
/// divided: rounding would decide what lies in them.
const SHORTEST: f64 = 1e-12;
const THINNEST: f64 = 1e-13;

/// Both are at least this part of the largest coordinate: middles of shorter edges are rounded onto
/// their ends, and dividing such triangles makes others like them without end.
const FINEST: f64 = 64.0 * f64::EPSILON;

/// Tolerances are no finer than this part of the largest value: rounding.
const ROUNDING: f64 = 1e-13;

/// Triangles are divided in order of their differences: at a time those with more than this part of
/// the largest one, and no more than one in so many of the triangles that may still be added, but
/// for the last few. Which these are does not depend on the tolerance.
const WORST: f64 = 0.5;
const SHARE: usize = 8;
const LAST: usize = 64;

/// Places, or triangles, that a thread takes at a time.
const CHUNK: usize = 1024;

/// Tests that are evaluated at a time.
const TESTS: usize = 7 * 64 * CHUNK;

/// The limits of a refinement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// In parts of the range of an array.
    pub(super) tolerance: f64,
    pub(super) cells: usize,
}

/// A mesh with its values, and what is known of them so far.
pub(super) struct RefinedMesh<'a, 'd> {
    pub(super) field: &'a Field<'d>,
    pub(super) columns: &'a ArrayColumns,
    /// How values are interpolated.
    pub(super) cell: Lagrange,
    pub(super) mesh: Torn<'d>,
    /// A row for each point.
    pub(super) values: Vec<f64>,
    pub(super) singular: SingularPoints,
    /// Smallest and largest value of each column that was seen outside of singular points.
    pub(super) ranges: Vec<[f64; 2]>,
    /// For each triangle the largest difference at its tests in parts of the ranges of arrays; zero
    /// if it is rounding or the triangle is not divided, as where it does not fall.
    pub(super) differences: Vec<f64>,
    pub(super) limits: Limits,
}

/// The size of the values of a column's array.
#[derive(Clone, Copy, Debug)]
struct ValueScale {
    range: f64,
    /// Differences up to this are rounding.
    rounding: f64,
}

impl RefinedMesh<'_, '_> {
    /// Refines the given triangles, which are new or have changed, and all that come of them and
    /// are left of others, the largest differences first. False if the limit of cells is met.
    pub(super) fn refine(
        &mut self,
        mut fresh: Vec<u32>,
        watcher: &dyn Watcher,
    ) -> Result<bool, Cancelled> {
        loop {
            watcher.report(Progress::new(
                Phase::Evaluation,
                self.mesh.triangles.len(),
                self.limits.cells,
            ))?;
            self.test(&fresh);
            let worst = self.worst();
            if worst.is_empty() {
                return Ok(true);
            }
            let Some(changed) = self.bisect(&worst) else { return Ok(false) };
            fresh = changed;
        }
    }

    /// The triangles to divide next, the largest difference first.
    fn worst(&self) -> Vec<u32> {
        let largest = self.differences.iter().copied().fold(0.0, f64::max);
        let margin = MARGINS[usize::from(self.cell.order > 1)];
        // infinite differences are more than any part of them
        let least = (WORST * largest).min(f64::MAX).max(margin * self.limits.tolerance);
        let is_worst = |t: &u32| self.differences[*t as usize] > least;
        let mut worst: Vec<u32> =
            (0..self.differences.len() as u32).into_par_iter().filter(is_worst).collect();
        let difference = |t: u32| self.differences[t as usize];
        worst.sort_by(|&a, &b| difference(b).total_cmp(&difference(a)).then(a.cmp(&b)));
        let left = self.limits.cells.saturating_sub(self.mesh.triangles.len());
        worst.truncate((left / SHARE).max(LAST));
        worst
    }

    /// Divides triangles; those that have changed, in order. None if the limit of cells is met.
    pub(super) fn bisect(&mut self, coarse: &[u32]) -> Option<Vec<u32>> {
        let before = self.mesh.triangles.len();
        let mut changed = Vec::new();
        let mut is_changed = vec![false; before];
        for &triangle in coarse {
            if self.mesh.triangles.len() >= self.limits.cells {
                self.evaluate_new();
                return None;
            }
            if !is_changed[triangle as usize] {
                let from = changed.len();
                self.mesh.bisect(triangle, &mut changed);
                is_changed.resize(self.mesh.triangles.len(), true);
                changed[from..].iter().for_each(|&t| is_changed[t as usize] = true);
            }
        }
        self.evaluate_new();
        changed.sort_unstable();
        changed.dedup();
        Some(changed)
    }

    /// Evaluates the points that have no values yet.
    pub(super) fn evaluate_new(&mut self) {
        let width = self.columns.len();
        let new = &self.mesh.points[self.values.len() / width..];
        let rows = self.rows(new);
        let new: Vec<Vec2> = new.iter().map(|point| point.position).collect();
        new.iter().zip(rows.chunks(width)).for_each(|(at, row)| self.widen(*at, row));
        self.values.extend(rows);
    }

    /// Exact rows at points of the mesh.
    fn rows(&self, new: &[TornPoint]) -> Vec<f64> {
        let width = self.columns.len();
        let (mut inside, mut apart, mut places, mut elements) = (vec![], vec![], vec![], vec![]);
        for (k, point) in new.iter().enumerate() {
            match point.seen {
                ValueSide::Element(place) => elements.push(place),
                ValueSide::Plane { place, inside: seen } => {
                    inside.push(seen);
                    if place != seen {
                        apart.push(k);
                        places.push(place);
                    }
                }
            }
        }
        if !elements.is_empty() {
            return evaluate_elements(self.field, &self.columns.quantities, &elements);
        }
        let mut rows = evaluate(self.field, self.columns, &inside);
        let exact = evaluate(self.field, self.columns, &places);
        for (&k, exact) in apart.iter().zip(exact.chunks(width)) {
            let row = &mut rows[k * width..][..width];
            let steady = (0..width).filter(|&c| !self.columns.jumps[c]);
            steady.for_each(|c| row[c] = exact[c]);
        }
        rows
    }

    /// Rows of all nodes of each triangle.
    pub(super) fn nodes(&self, triangles: &[u32]) -> Vec<f64> {
        let (width, inner) = (self.columns.len(), self.cell.nodes.len() - 3);
        let points = triangles.par_iter().flat_map_iter(|&t| self.mesh.inner_nodes(t, &self.cell));
        let rows = self.rows(&points.collect::<Vec<_>>());
        let mut all = Vec::with_capacity(rows.len() + 3 * width * triangles.len());
        for (k, &t) in triangles.iter().enumerate() {
            let corners = self.mesh.triangles[t as usize].corners;
            corners.iter().for_each(|&c| all.extend(&self.values[c as usize * width..][..width]));
            all.extend(&rows[k * inner * width..][..inner * width]);
        }
        all
    }

    /// Compares interpolation with the field at the tests of triangles.
    fn test(&mut self, triangles: &[u32]) {
        let (width, tests) = (self.columns.len(), self.cell.tests.clone());
        self.differences.resize(self.mesh.triangles.len(), 0.0);
        for part in triangles.chunks(TESTS / tests.len()) {
            let at: Vec<_> =
                part.iter().flat_map(|&t| tests.iter().map(move |b| (t, *b))).collect();
            let exact = self.exact(&at);
            for (&(t, b), row) in at.iter().zip(exact.chunks(width)) {
                self.widen(self.position(t, b), row);
            }
            let (scales, nodes) = (self.scales(), self.nodes(part));
            let rows = exact.par_chunks(tests.len() * width);
            let differences: Vec<f64> = part
                .par_iter()
                .zip(nodes.par_chunks(self.cell.nodes.len() * width))
                .zip(rows)
                .map(|((&t, nodes), rows)| self.largest_difference((t, nodes), rows, &scales))
                .collect();
            for (&t, difference) in part.iter().zip(differences) {
                let convergence = &mut self.mesh.triangles[t as usize].convergence;
                convergence.record(difference);
                self.differences[t as usize] =
                    if convergence.has_stalled() { 0.0 } else { difference };
            }
        }
    }

    /// The largest difference of exact rows at the tests of a triangle from interpolation between
    /// its nodes.
    fn largest_difference(
        &self,
        (triangle, nodes): (u32, &[f64]),
        rows: &[f64],
        scales: &[ValueScale],
    ) -> f64 {
        if !self.may_divide(triangle) {
            return 0.0;
        }
        let tests = self.cell.tests.iter().zip(&self.cell.at_tests);
        let tests = tests.zip(rows.chunks(self.columns.len()));
        let differences = tests.map(|((at, weights), exact)| {
            let at = self.position(triangle, *at);
            self.difference(at, exact, &self.interpolated(nodes, weights), scales)
        });
        differences.fold(self.mesh.deviation(triangle, &self.cell), f64::max)
    }

    /// Exact rows at places inside triangles, given by barycentric coordinates.
    pub(super) fn exact(&self, at: &[(u32, BarycentricPoint)]) -> Vec<f64> {
        if self.field.step.partition.mesh().is_some() {
            let place = |(t, b): &(u32, BarycentricPoint)| {
                self.mesh.element_place(*t, *b, self.position(*t, *b))
            };
            let places: Vec<ElementPlace> = at.par_iter().filter_map(place).collect();
            return evaluate_elements(self.field, &self.columns.quantities, &places);
        }
        let place = |(t, b): &(u32, BarycentricPoint)| self.mesh.place(self.position(*t, *b));
        let places: Vec<SidedPoint> = at.par_iter().map(place).collect();
        evaluate(self.field, self.columns, &places)
    }

    pub(super) fn position(&self, triangle: u32, at: BarycentricPoint) -> Vec2 {
        self.mesh.position(triangle, at, &self.cell)
    }

    /// The row at a place with these weights of nodes.
    pub(super) fn interpolated(&self, nodes: &[f64], weights: &[f64]) -> Vec<f64> {
        let width = self.columns.len();
        let rows = || weights.iter().zip(nodes.chunks(width));
        (0..width).map(|c| rows().map(|(weight, row)| weight * row[c]).sum()).collect()
    }

    /// Largest difference of two rows in parts of the ranges, less near singular points.
    fn difference(
        &self,
        at: Vec2,
        exact: &[f64],
        interpolated: &[f64],
        scales: &[ValueScale],
    ) -> f64 {
        let loosened = self.singular.loosened(at);
        let margin = MARGINS[usize::from(self.cell.order > 1)];
        let part = |c: usize| {
            let factor = if self.singular.columns[c] { loosened } else { 1.0 };
            let difference = (exact[c] - interpolated[c]).abs();
            let is_nowhere = exact[c].is_nan() && interpolated[c].is_nan();
            let ValueScale { range, rounding } = scales[c];
            match factor.is_infinite() || is_nowhere || difference <= margin * rounding * factor {
                true => 0.0,
                false => or_infinite(difference / (range * factor)),
            }
        };
        (0..scales.len()).map(part).fold(0.0, f64::max)
    }

    /// The tolerance of each column.
    pub(super) fn allowed(&self) -> Vec<f64> {
        let allowed = |s: &ValueScale| (self.limits.tolerance * s.range).max(s.rounding);
        self.scales().iter().map(allowed).collect()
    }

    fn scales(&self) -> Vec<ValueScale> {
        let is_seen = |[low, high]: &[f64; 2]| low <= high;
        let scale = |&array: &usize| {
            let same = self.columns.array.iter().zip(&self.ranges).filter(|(a, _)| **a == array);
            let seen: Vec<[f64; 2]> = same.map(|(_, r)| *r).filter(is_seen).collect();
            let most = |of: fn(&[f64; 2]) -> f64| seen.iter().map(of).fold(0.0, f64::max);
            let size = most(|[low, high]| low.abs().max(high.abs()));
            let rounding = (ROUNDING * size).max(f64::MIN_POSITIVE);
            ValueScale { range: most(|[low, high]| high - low), rounding }
        };
        self.columns.array.iter().map(scale).collect()
    }

    fn widen(&mut self, at: Vec2, row: &[f64]) {
        let is_far = self.singular.loosened(at) == 1.0;
        for (c, &value) in row.iter().enumerate() {
            if value.is_finite() && (is_far || !self.singular.columns[c]) {
                let range = &mut self.ranges[c];
                *range = [range[0].min(value), range[1].max(value)];
            }
        }
    }

    pub(super) fn may_divide(&self, triangle: u32) -> bool {
        let [a, b, c] = self.mesh.corners(triangle);
        let longest = [b - a, c - b, a - c].map(Vec2::length).into_iter().fold(0.0, f64::max);
        let size = borders::longest(&self.field.domain.bounds);
        let finest =
            FINEST * [a, b, c].iter().fold(0.0, |most, p| p.x.abs().max(p.y.abs()).max(most));
        longest > finest.max(SHORTEST * size)
            && (b - a).cross(c - a) > finest.max(THINNEST * size) * longest
    }

    /// Replaces values that are not finite, those of tips, by the mean of those in the middles of
    /// the triangles that meet there; `cells` are the points of each triangle.
    pub(super) fn fill(&mut self, cells: &[u32]) {
        let width = self.columns.len();
        let points = |t: u32| {
            let count = self.cell.nodes.len();
            &cells[t as usize * count..][..count]
        };
        let is_finite = |&point: &u32| {
            self.values[point as usize * width..][..width].iter().all(|v| v.is_finite())
        };
        let touches = |t: &u32| !points(*t).iter().all(is_finite);
        let around: Vec<u32> = (0..self.mesh.triangles.len() as u32).filter(touches).collect();
        let at: Vec<_> = around.iter().map(|&t| (t, [1.0 / 3.0; 3])).collect();
        let middles = self.exact(&at);
        let mut sums = vec![(0.0, 0u32); self.values.len()];
        for (&t, row) in around.iter().zip(middles.chunks(width)) {
            for &point in points(t) {
                for (c, &value) in row.iter().enumerate().filter(|(_, value)| value.is_finite()) {
                    let sum = &mut sums[point as usize * width + c];
                    *sum = (sum.0 + value, sum.1 + 1);
                }
            }
        }
        for (value, (sum, count)) in self.values.iter_mut().zip(sums) {
            if !value.is_finite() && count > 0 {
                *value = sum / f64::from(count);
            }
        }
    }
}

/// Differences that are no numbers are as large as any.
pub(super) fn or_infinite(value: f64) -> f64 {
    if value.is_nan() { f64::INFINITY } else { value }
}

/// Rows of quantities at places, on all threads.
pub(super) fn evaluate(
    field: &Field<'_>,
    columns: &ArrayColumns,
    places: &[SidedPoint],
) -> Vec<f64> {
    let wanted = SampledQuantity::Values(&columns.quantities);
    let rows: Vec<Vec<f64>> =
        places.par_chunks(8 * CHUNK).map(|part| evaluate_each(field, wanted, part)).collect();
    rows.concat()
}
