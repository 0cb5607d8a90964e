//! Adaptive division of pieces on which functions vary too fast for one rule.
//!
//! The integrals of f, f² and |∇f|² over a piece are compared with the sums over its halves, divided
//! in each of a few directions. While the differences add up to more than a part of the integrals
//! over all pieces, the worst piece is replaced by its halves in the direction that matters most. A
//! layer exp(−d/ε) across pieces of size h takes O(log(h/ε)) of them, because polygons are divided
//! across the direction in which the gradient changes.
//!
//! A layer so thin that no point of the rules sees it is seen by points on the border of the piece.
//! Functions that vanish on the border and at all points of the rules are not seen.

use super::geometry::Probes;
use ppum::vec2::Vec2;

/// Differences that are left, relative to the integral over all parts.
const ACCURACY: f64 = 1e-10;

/// Most parts that one piece is divided into.
const BUDGET: usize = 400;

/// Most divisions one inside the other. Halves of halves are rounding before.
const DEPTH: usize = 45;

/// A part whose integral is smaller by this factor than a value on its border times its size hides
/// a layer, and counts as that product. Polynomials that a rule resolves stay below.
const HIDDEN: f64 = 1e4;

/// Functions below this size are zero: their squares are not numbers any more.
const NOTHING: f64 = 1e-140;

/// Least gap between the variances of the gradient in two directions that makes one of them count.
const DIRECTED: f64 = 0.5;

/// Directions whose angle is smaller than this are one.
const PARALLEL: f64 = 1e-3;

/// Something with a Gauss rule that can be divided.
pub(super) trait Part: Sized {
    /// Calls `push` with the offsets and weights of the rule of `n` points in each direction.
    fn nodes(&self, n: usize, push: &mut dyn FnMut(Vec2, f64));

    /// Calls `push` with points on the border, and for each what the weight of a rule of one point
    /// would be there.
    fn border(&self, push: &mut dyn FnMut(Vec2, f64));

    /// Ways to divide the part in two. `directions` are those in which the gradients of functions
    /// change.
    fn divisions(&self, directions: &[Vec2]) -> Vec<[Self; 2]>;
}

/// What a division has to resolve.
#[derive(Clone, Copy)]
pub(super) struct Demand<'a> {
    /// The functions.
    pub(super) probes: &'a dyn Probes,
    /// Those that are active.
    pub(super) active: &'a [u32],
    /// What offsets are measured from.
    pub(super) anchor: Vec2,
    /// True if parts have curved borders: then the integral of 1 is held, too.
    pub(super) curved: bool,
    /// Gauss points in each direction of the rules that are compared.
    pub(super) points: usize,
}

/// An integral, and the integral of the absolute value.
#[derive(Clone, Copy, Default)]
struct Integral {
    value: f64,
    size: f64,
}

/// A part with its integrals, the errors of its rule, and its halves.
struct Entry<P> {
    part: P,
    depth: usize,
    integrals: Vec<Integral>,
    errors: Vec<f64>,
    halves: Option<[P; 2]>,
}

/// The parts divided until their rules resolve the functions that are demanded.
pub(super) fn refined<P: Part>(parts: Vec<P>, demand: &Demand<'_>) -> Vec<P> {
    if demand.active.is_empty() && !demand.curved {
        return parts;
    }
    let mut entries: Vec<Entry<P>> = parts.into_iter().map(|p| demand.entry(p, 0)).collect();
    while entries.len() < BUDGET {
        let Some(worst) = worst(&entries) else { break };
        let Some(halves) = entries[worst].halves.take() else { break };
        let depth = entries[worst].depth + 1;
        let [first, second] = halves.map(|part| demand.entry(part, depth));
        entries[worst] = first;
        entries.push(second);
    }
    entries.into_iter().map(|e| e.part).collect()
}

/// The entry with the largest error of those integrals whose errors add up to too much.
fn worst<P>(entries: &[Entry<P>]) -> Option<usize> {
    let n = entries.first().map_or(0, |e| e.errors.len());
    let mut found: Option<(usize, f64)> = None;
    for k in 0..n {
        let size: f64 = entries.iter().map(|e| e.integrals[k].size).sum();
        let error: f64 = entries.iter().map(|e| e.errors[k]).sum();
        if error > ACCURACY * size {
            for (i, entry) in entries.iter().enumerate() {
                let part = entry.errors[k] / size;
                if found.is_none_or(|(_, most)| part > most) {
                    found = Some((i, part));
                }
            }
        }
    }
    found.map(|(i, _)| i)
}

/// Samples of functions at points with weights.
#[derive(Default)]
struct Samples {
    offsets: Vec<Vec2>,
    weights: Vec<f64>,
    /// Function after function.
    values: Vec<[f64; 3]>,
}

impl Samples {
    fn add(&mut self, offset: Vec2, weight: f64) {
        self.offsets.push(offset);
        self.weights.push(weight);
    }

    fn of(&self, function: usize) -> impl Iterator<Item = (f64, [f64; 3])> + '_ {
        let n = self.offsets.len();
        let values = &self.values[function * n..(function + 1) * n];
        self.weights.iter().copied().zip(values.iter().copied())
    }
}

impl Demand<'_> {
    fn entry<P: Part>(&self, part: P, depth: usize) -> Entry<P> {
        let samples = self.samples(&part);
        let whole = self.integrals(&samples);
        let none = vec![0.0; whole.len()];
        let mut entry = Entry { part, depth, integrals: whole.clone(), errors: none, halves: None };
        if depth == DEPTH {
            return entry;
        }
        let mut most = -1.0;
        for division in entry.part.divisions(&self.directions(&samples)) {
            let sums = self.sums(&division);
            let mut change: f64 = 0.0;
            for ((error, s), w) in entry.errors.iter_mut().zip(&sums).zip(&whole) {
                let difference = (s.value - w.value).abs();
                *error = error.max(difference);
                change = change.max(difference / s.size.max(w.size));
            }
            if change > most {
                most = change;
                (entry.integrals, entry.halves) = (sums, Some(division));
            }
        }
        entry
    }

    /// The functions at the points of the rule of a part, and at those on its border.
    fn samples<P: Part>(&self, part: &P) -> [Samples; 2] {
        let mut both = [Samples::default(), Samples::default()];
        let [inside, border] = &mut both;
        part.nodes(self.points, &mut |x, w| inside.add(x, w));
        part.border(&mut |x, w| border.add(x, w));
        for samples in &mut both {
            for &function in self.active {
                let Samples { offsets, values, .. } = samples;
                self.probes.evaluate(function, self.anchor, offsets, values);
            }
        }
        both
    }

    /// The integrals of f, f² and |∇f|² of each function, and of 1 if borders are curved.
    fn integrals(&self, [inside, border]: &[Samples; 2]) -> Vec<Integral> {
        let mut all = Vec::with_capacity(3 * self.active.len() + 1);
        for k in 0..self.active.len() {
            let mut three = [Integral::default(); 3];
            inside.of(k).for_each(|(w, q)| add(&mut three, w, q));
            for (w, q) in border.of(k) {
                let mut seen = [Integral::default(); 3];
                add(&mut seen, w, q);
                for (sum, seen) in three.iter_mut().zip(seen) {
                    if seen.size > HIDDEN * sum.size {
                        *sum = seen;
                    }
                }
            }
            all.extend(three);
        }
        if self.curved {
            let area = inside.weights.iter().sum();
            all.push(Integral { value: area, size: area });
        }
        all
    }

    fn sums<P: Part>(&self, [a, b]: &[P; 2]) -> Vec<Integral> {
        let of = |part: &P| self.integrals(&self.samples(part));
        let sum = |(a, b): (Integral, Integral)| Integral {
            value: a.value + b.value,
            size: a.size + b.size,
        };
        of(a).into_iter().zip(of(b)).map(sum).collect()
    }

    /// For each function the direction in which its gradient changes most, if there is one.
    fn directions(&self, samples: &[Samples; 2]) -> Vec<Vec2> {
        let mut directions: Vec<Vec2> = Vec::new();
        for k in 0..self.active.len() {
            let gradients = samples.iter().flat_map(|s| s.of(k));
            let gradients = gradients.map(|(_, [_, x, y])| Vec2 { x, y }).filter(|g| g.is_finite());
            let gradients: Vec<Vec2> = gradients.collect();
            if let Some(e) = principal(&gradients)
                && directions.iter().all(|d| d.cross(e).abs() > PARALLEL)
            {
                directions.push(e);
            }
        }
        directions
    }
}

/// Adds weight times f, f² and |∇f|², as far as they are numbers.
fn add(sums: &mut [Integral; 3], weight: f64, [f, x, y]: [f64; 3]) {
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

/// The direction in which vectors vary most, if they do and much more than across it.
fn principal(vectors: &[Vec2]) -> Option<Vec2> {
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
    let gap = 2.0 * half.hypot(mixed);
    if gap <= DIRECTED * (xx + yy) || xx + yy <= f64::EPSILON * n {
        return None;
    }
    let angle = 0.5 * mixed.atan2(half);
    Some(Vec2 { x: angle.cos(), y: angle.sin() })
}
