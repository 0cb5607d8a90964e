//! Adaptive division of pieces on which functions vary too fast for one rule.
//!
//! The integrals of f, f² and |∇f|² over a piece are compared with the sums over its halves,
//! divided in each of a few directions. While the differences add up to more than a part of the
//! integrals over all pieces, the worst piece is replaced by its halves in the direction that
//! matters most. A layer exp(−d/ε) across pieces of size h takes O(log(h/ε)) of them, because
//! polygons are divided across the direction in which the gradient changes.
//!
//! A layer along a side of a piece may be so thin that no Gauss point sees it. Therefore Gauss
//! rules are also compared with rules that have points as good as on the boundary. An integrand
//! that vanishes at all points of these rules is missed.
//!
//! For loads, only the integral of f itself is controlled, relative to the whole load: they may be
//! singular, and vanish almost everywhere. Where division ends before the tolerance is reached, the
//! remaining error is recorded as a [`QuadratureErrorEstimate`].

use super::error_estimate::QuadratureErrorEstimate;
use super::gauss::{Rules1d, closed, gauss};
use super::geometry::{CrackFace, Probes, SmoothnessGeometry};
use super::orders::Orders;
use ppum::vec2::{Rect, Vec2};
use std::cell::Cell;

/// Differences that are left, relative to the integral over all parts.
const ACCURACY: f64 = 1e-10;

/// The accuracy of the area of pieces with curved sides.
const AREA_ACCURACY: f64 = 1e-8;

/// Most parts that one piece is divided into.
const BUDGET: usize = 400;

/// Most divisions in one cell, or along one line through it (docs/problem/accuracy.md).
pub(super) const MOST_DIVISIONS: usize = 10_000;

/// Number of parts from which on errors must come down whenever it doubles. A layer of 1e-9 of a
/// piece is found with fewer.
const FIRST_CHECK: usize = 32;

/// The share they must come down to. Noise does not get less by division, while the value on a
/// boundary of a layer that is still too thin to be seen otherwise counts half at each.
const SHARE: f64 = 0.8;

/// Most divisions one inside the other. Halves of halves are rounding before.
const DEPTH: usize = 45;

/// Functions below this size are zero: their squares are not numbers any more.
const NOTHING: f64 = 1e-140;

/// Least gap between the variances of the gradient in two directions that makes one of them count.
const DIRECTED: f64 = 0.5;

/// Gradients that vary across a direction by less than this part of their variance do so along it
/// alone.
const RIDGE: f64 = 1e-4;

/// Directions whose angle is smaller than this are one.
const PARALLEL: f64 = 1e-3;

/// A region of integration with a Gauss rule that can be subdivided.
pub(super) trait Subregion: Clone {
    /// Calls `push` with the offsets and weights of a rule that is as exact as `n` Gauss points in
    /// each direction.
    fn nodes(&self, rules: Rules1d, n: usize, push: &mut dyn FnMut(Vec2, f64));

    /// Ways to divide the region in two. `directions` are those in which the gradients of functions
    /// change.
    fn divisions(&self, directions: &[Vec2]) -> Vec<[Self; 2]>;
}

/// The integrands that a division has to resolve.
#[derive(Clone, Copy)]
pub(super) struct IntegrandDemand<'a> {
    /// The functions.
    pub(super) probes: &'a dyn Probes,
    /// Those that are active.
    pub(super) active: &'a [u32],
    /// Origin of the offsets.
    pub(super) anchor: Vec2,
    /// The face of a crack that the parts lie on, if they are on one.
    pub(super) face: Option<CrackFace>,
    /// True if parts have curved boundaries: then the integral of 1 is controlled, too.
    pub(super) curved: bool,
    /// Size of the cell.
    pub(super) size: f64,
    /// Gauss points in each direction of the rules that are compared.
    pub(super) points: usize,
    /// Those of the rules that are used.
    pub(super) order: usize,
    /// Divisions that are left for the cell.
    pub(super) left: &'a Cell<usize>,
}

impl<'a> SmoothnessGeometry<'a> {
    /// The demand of some active functions on rules with `order` Gauss points in a cell with a
    /// number of divisions that are left; the parts are straight, and offsets have the origin 0.
    pub(super) fn demand(
        &self,
        active: &'a [u32],
        order: usize,
        orders: Orders,
        (cell, left): (&Rect, &'a Cell<usize>),
    ) -> IntegrandDemand<'a> {
        let (probes, anchor, size) = (self.probes, Vec2::ZERO, cell.size().length());
        let points = order.saturating_sub(orders.reserve).max(1);
        IntegrandDemand {
            probes,
            active,
            anchor,
            face: None,
            curved: false,
            size,
            points,
            order,
            left,
        }
    }
}

/// An integral, and the integral of the absolute value.
#[derive(Clone, Copy, Default)]
struct IntegralPair {
    value: f64,
    size: f64,
}

/// A part with its integrals, the errors of its rule, and the ways to divide it.
struct SubregionEntry<P> {
    region: P,
    depth: usize,
    /// Its area or length.
    measure: f64,
    /// A point of it.
    at: Vec2,
    integrals: Vec<IntegralPair>,
    errors: Vec<f64>,
    divisions: Vec<Division<P>>,
}

/// The halves of a part, and how much they change each integral.
struct Division<P> {
    halves: [P; 2],
    changes: Vec<f64>,
}

/// Calls `push` with the rules of parts, divided until these resolve the functions that are
/// demanded; as they are if division does not help. Returns what they do not resolve.
pub(super) fn refined<P: Subregion>(
    regions: Vec<P>,
    demand: &IntegrandDemand<'_>,
    push: &mut dyn FnMut(Vec2, f64),
) -> QuadratureErrorEstimate {
    let mut rules = |regions: &mut dyn Iterator<Item = &P>| {
        regions.for_each(|region| region.nodes(gauss, demand.order, push));
    };
    if demand.active.is_empty() && !demand.curved {
        rules(&mut regions.iter());
        return QuadratureErrorEstimate::default();
    }
    let mut entries: Vec<SubregionEntry<P>> =
        regions.iter().map(|region| demand.entry(region.clone(), 0)).collect();
    let helped = divide(&mut entries, demand);
    let doubt = demand.doubt(&entries);
    // what is known of a load is kept
    if helped || doubt.load > 0.0 {
        rules(&mut entries.iter().map(|entry| &entry.region));
    } else {
        rules(&mut regions.iter());
    }
    doubt
}

/// Divides the worst part again and again; false if errors do not come down.
fn divide<P: Subregion>(
    entries: &mut Vec<SubregionEntry<P>>,
    demand: &IntegrandDemand<'_>,
) -> bool {
    let mut progress = DecayMonitor { check: FIRST_CHECK, before: f64::INFINITY };
    while entries.len() < BUDGET && demand.left.get() > 0 {
        let allowed = demand.allowed(entries);
        let Some(at) = worst(entries, &allowed) else { break };
        if progress.has_stopped(entries.len(), || excess(entries, &allowed)) {
            return false;
        }
        let depth = entries[at].depth + 1;
        let Some(halves) = entries[at].best_halves(&allowed) else { break };
        demand.left.set(demand.left.get() - 1);
        let [first, second] = halves.map(|region| demand.entry(region, depth));
        entries[at] = first;
        entries.push(second);
    }
    true
}

/// Watches whether errors come down.
struct DecayMonitor {
    /// Number of parts to look at next.
    check: usize,
    /// Error at the last look.
    before: f64,
}

impl DecayMonitor {
    fn has_stopped(&mut self, regions: usize, error: impl FnOnce() -> f64) -> bool {
        if regions < self.check {
            return false;
        }
        let error = error();
        let stopped = error > SHARE * self.before;
        *self = Self { check: 2 * regions, before: error };
        stopped
    }
}

/// Largest ratio of the error of an integral over all parts to what is allowed.
fn excess<P>(entries: &[SubregionEntry<P>], allowed: &[f64]) -> f64 {
    let error = |k: usize| entries.iter().map(|e| e.errors[k]).sum::<f64>();
    allowed.iter().enumerate().map(|(k, allowed)| error(k) / allowed).fold(0.0, f64::max)
}

/// The entry with the largest error of those integrals whose errors add up to too much.
fn worst<P>(entries: &[SubregionEntry<P>], allowed: &[f64]) -> Option<usize> {
    let mut found: Option<(usize, f64)> = None;
    for (k, allowed) in allowed.iter().enumerate() {
        if entries.iter().map(|e| e.errors[k]).sum::<f64>() > *allowed {
            for (i, entry) in entries.iter().enumerate() {
                let region = entry.errors[k] / allowed;
                if found.is_none_or(|(_, most)| region > most) {
                    found = Some((i, region));
                }
            }
        }
    }
    found.map(|(i, _)| i)
}

impl<P> SubregionEntry<P> {
    /// Takes the halves that change most, in parts of what each integral may err.
    fn best_halves(&mut self, allowed: &[f64]) -> Option<[P; 2]> {
        let change = |d: &Division<P>| -> f64 {
            d.changes.iter().zip(allowed).map(|(c, a)| c / a).fold(0.0, f64::max)
        };
        let better = |best: Division<P>, next: Division<P>| {
            if change(&next) > change(&best) { next } else { best }
        };
        self.divisions.drain(..).reduce(better).map(|division| division.halves)
    }
}

/// Integrals by two rules.
struct RuleSums {
    gauss: Vec<IntegralPair>,
    closed: Vec<IntegralPair>,
}

impl RuleSums {
    /// Returns the larger one for each integral.
    fn larger(self) -> Vec<IntegralPair> {
        let larger = |(a, b): (IntegralPair, IntegralPair)| if a.size >= b.size { a } else { b };
        self.gauss.into_iter().zip(self.closed).map(larger).collect()
    }
}

/// Differences of values.
fn differences(a: &[IntegralPair], b: &[IntegralPair]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| (a.value - b.value).abs()).collect()
}

/// The larger of each two numbers.
fn larger(a: Vec<f64>, b: &[f64]) -> Vec<f64> {
    a.into_iter().zip(b).map(|(a, b)| a.max(*b)).collect()
}

/// Samples of functions at points with weights.
#[derive(Default)]
struct IntegrandSamples {
    offsets: Vec<Vec2>,
    weights: Vec<f64>,
    /// Function after function.
    values: Vec<[f64; 3]>,
}

impl IntegrandSamples {
    fn of(&self, function: usize) -> impl Iterator<Item = (f64, [f64; 3])> + '_ {
        let n = self.offsets.len();
        let values = &self.values[function * n..(function + 1) * n];
        self.weights.iter().copied().zip(values.iter().copied())
    }
}

impl IntegrandDemand<'_> {
    fn entry<P: Subregion>(&self, region: P, depth: usize) -> SubregionEntry<P> {
        let (inside, boundary) = (self.samples(&region, gauss), self.samples(&region, closed));
        let whole = RuleSums { gauss: self.integrals(&inside), closed: self.integrals(&boundary) };
        let mut errors = differences(&whole.gauss, &whole.closed);
        let hidden = errors.iter().zip(&whole.gauss).any(|(e, i)| *e > ACCURACY * i.size);
        let ways = if depth < DEPTH {
            region.divisions(&self.directions([&inside, &boundary]))
        } else {
            Vec::new()
        };
        let finite = |halves: &[P; 2]| halves.iter().all(|half| self.is_finite(half));
        let mut divisions = Vec::with_capacity(ways.len());
        for halves in ways.into_iter().filter(finite) {
            let mut changes = differences(&self.sums(&halves, gauss), &whole.gauss);
            errors = larger(errors, &changes);
            if hidden {
                changes = larger(changes, &differences(&self.sums(&halves, closed), &whole.closed));
            }
            divisions.push(Division { halves, changes });
        }
        if divisions.is_empty() {
            self.forget(&mut errors);
        }
        let measure = inside.weights.iter().sum();
        let at = self.anchor + inside.offsets.first().copied().unwrap_or(Vec2::ZERO);
        SubregionEntry { region, depth, measure, at, integrals: whole.larger(), errors, divisions }
    }

    /// False if a load is not finite at a point of the rule that a part gets in the end.
    fn is_finite<P: Subregion>(&self, region: &P) -> bool {
        let mut loads = self.active.iter().filter(|&&f| self.probes.load(f).is_some()).peekable();
        if loads.peek().is_none() {
            return true;
        }
        let (mut offsets, mut values) = (Vec::new(), Vec::new());
        region.nodes(gauss, self.order, &mut |x, _| offsets.push(x));
        loads.for_each(|&f| self.evaluate(f, &offsets, &mut values));
        values.iter().all(|value| value[0].is_finite())
    }

    /// A part that cannot be divided any more has no error but that of loads.
    fn forget(&self, errors: &mut [f64]) {
        let is_load =
            |k: usize| k < 3 * self.active.len() && self.probes.load(self.active[k / 3]).is_some();
        errors.iter_mut().enumerate().filter(|(k, _)| !is_load(*k)).for_each(|(_, e)| *e = 0.0);
    }

    /// Errors that parts leave.
    fn doubt<P>(&self, entries: &[SubregionEntry<P>]) -> QuadratureErrorEstimate {
        let allowed = self.allowed(entries);
        let cut = entries.len() >= BUDGET || self.left.get() == 0;
        let mut doubt = QuadratureErrorEstimate::default();
        for (k, allowed) in allowed.iter().enumerate() {
            let error: f64 = entries.iter().map(|e| e.errors[k]).sum();
            let worst = entries.iter().max_by(|a, b| a.errors[k].total_cmp(&b.errors[k]));
            let Some(worst) = worst.filter(|_| error > *allowed) else { continue };
            let is_load = self.active.get(k / 3).is_some_and(|&f| self.probes.load(f).is_some());
            if is_load {
                doubt.add(&QuadratureErrorEstimate::of_load(error, worst.at));
            } else if cut {
                let accuracy = if k < 3 * self.active.len() { ACCURACY } else { AREA_ACCURACY };
                let error = accuracy * error / allowed;
                doubt.add(&QuadratureErrorEstimate::of_functions(error, worst.at));
            }
        }
        doubt
    }

    fn evaluate(&self, function: u32, offsets: &[Vec2], out: &mut Vec<[f64; 3]>) {
        self.probes.evaluate(function, (self.anchor, offsets), self.face, out);
    }

    /// The functions at the points of a rule of a part.
    fn samples<P: Subregion>(&self, region: &P, rules: Rules1d) -> IntegrandSamples {
        let mut samples = IntegrandSamples::default();
        region.nodes(rules, self.points, &mut |x, w| {
            samples.offsets.push(x);
            samples.weights.push(w);
        });
        for &function in self.active {
            self.evaluate(function, &samples.offsets, &mut samples.values);
        }
        samples
    }

    /// The integrals of f, f² and |∇f|² of each function, and of 1 if boundaries are curved.
    fn integrals(&self, samples: &IntegrandSamples) -> Vec<IntegralPair> {
        let mut all = Vec::with_capacity(3 * self.active.len() + 1);
        for k in 0..self.active.len() {
            let mut three = [IntegralPair::default(); 3];
            samples.of(k).for_each(|(w, q)| add(&mut three, w, q));
            if self.probes.load(self.active[k]).is_some() {
                three[1..].fill(IntegralPair::default());
            }
            all.extend(three);
        }
        if self.curved {
            let area = samples.weights.iter().sum();
            all.push(IntegralPair { value: area, size: area });
        }
        all
    }

    /// The integrals over two parts together.
    fn sums<P: Subregion>(&self, regions: &[P; 2], rules: Rules1d) -> Vec<IntegralPair> {
        let [mut sums, other] =
            regions.each_ref().map(|region| self.integrals(&self.samples(region, rules)));
        for (sum, other) in sums.iter_mut().zip(other) {
            sum.value += other.value;
            sum.size += other.size;
        }
        sums
    }

    /// The error that each integral over all parts may have. That of |∇f|² may be a part of f² over
    /// the square of the cell's size, too: where f hardly varies its gradient may be rounding. That
    /// of a load may be a part of the mean load.
    fn allowed<P>(&self, entries: &[SubregionEntry<P>]) -> Vec<f64> {
        let size = |k: usize| entries.iter().map(|e| e.integrals[k].size).sum::<f64>();
        let measure: f64 = entries.iter().map(|e| e.measure).sum();
        let of_function = |k: usize| {
            let [value, square, gradient] = [0, 1, 2].map(|i| size(3 * k + i));
            let elsewhere = self.probes.load(self.active[k]).map_or(0.0, |mean| mean * measure);
            [value + elsewhere, square, gradient + square / (self.size * self.size)]
        };
        let functions = (0..self.active.len()).flat_map(of_function).map(|s| ACCURACY * s);
        let area = self.curved.then(|| AREA_ACCURACY * size(3 * self.active.len()));
        functions.chain(area).collect()
    }

    /// For each function the direction in which its gradient changes most, if there is one; and the
    /// direction across the first, unless it changes in that one alone.
    fn directions(&self, samples: [&IntegrandSamples; 2]) -> Vec<Vec2> {
        let (mut directions, mut ridges): (Vec<Vec2>, bool) = (Vec::new(), true);
        for k in 0..self.active.len() {
            let jets = samples.iter().flat_map(|s| s.of(k));
            let gradients: Vec<Vec2> =
                jets.map(|(_, [_, x, y])| Vec2 { x, y }).filter(|g| g.is_finite()).collect();
            if let Some((e, ridge)) = principal(&gradients) {
                ridges &= ridge;
                if directions.iter().all(|d| d.cross(e).abs() > PARALLEL) {
                    directions.push(e);
                }
            }
        }
        if let Some(&e) = directions.first()
            && !ridges
        {
            directions.insert(1, e.left());
        }
        directions
    }
}

/// Adds weight times f, f² and |∇f|², as far as they are numbers.
fn add(sums: &mut [IntegralPair; 3], weight: f64, [f, x, y]: [f64; 3]) {
    let something = |v: f64| if v.abs() > NOTHING { v } else { 0.0 };
    let (f, g) = (something(f), something(x.hypot(y)));
    for (sum, value) in sums.iter_mut().zip([f, f * f, g * g]) {
        let value = weight * value;
        if value.is_finite() {
            sum.value += value;
            sum.size += value.abs();
        }
    }
}

/// The direction in which vectors vary most, if they do and much more than across it; and whether
/// they vary in this direction alone.
fn principal(vectors: &[Vec2]) -> Option<(Vec2, bool)> {
    let scale = vectors.iter().fold(0.0, |s: f64, v| s.max(v.x.abs()).max(v.y.abs()));
    if scale < NOTHING || !scale.is_finite() {
        return None;
    }
    let n = vectors.len() as f64;
    let mean = vectors.iter().fold(Vec2::ZERO, |sum, &v| sum + v / scale) / n;
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for &v in vectors {
        let d = v / scale - mean;
        (xx, xy, yy) = (xx + d.x * d.x, xy + d.x * d.y, yy + d.y * d.y);
    }
    let (half, mixed) = (0.5 * (xx - yy), xy);
    let (all, gap) = (xx + yy, 2.0 * half.hypot(mixed));
    if gap <= DIRECTED * all || all <= f64::EPSILON * n {
        return None;
    }
    let angle = 0.5 * mixed.atan2(half);
    Some((Vec2 { x: angle.cos(), y: angle.sin() }, all - gap < RIDGE * all))
}
