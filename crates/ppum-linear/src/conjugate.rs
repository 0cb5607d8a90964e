//! Conjugate gradients for K u = f with a preconditioner M ≈ K⁻¹ \[Hestenes & Stiefel 1952\].
//!
//! The error in the energy norm falls with every step. (rᵀ M r)^½ stands for it: between the two
//! lies no more than the condition of M K, which the coefficients of the iteration tell: they make
//! the tridiagonal matrix of Lanczos' method.

use super::eigen::SymmetricEigen;
use faer::Mat;
use rayon::prelude::*;

/// Numbers that one thread adds up at a time; sums do not depend on the number of threads.
const CHUNK: usize = 1 << 14;

/// The way to a solution.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ConvergenceHistory {
    /// (rᵀ M r)^½ before the first step.
    pub size: f64,
    /// The residual norms before the first step and after each, relative to the first.
    pub residuals: Vec<f64>,
    /// Condition of M K, a bound from below.
    pub condition: f64,
    /// For each step and each level, the finest first, the norm of the right-hand side relative to
    /// that of the first step.
    pub levels: Vec<Vec<f64>>,
}

/// Why an iteration has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum IterationEnd {
    Reached,
    /// The residual no longer falls, or the steps are used up.
    Stalled,
    /// Somebody wants it.
    Stopped,
}

/// The system that is solved: products with K and M, and the watcher that may stop it.
pub(super) struct Iteration<'a> {
    pub(super) multiply: &'a dyn Fn(&[f64], &mut [f64]),
    pub(super) precondition: &'a dyn Fn(&[f64], &mut ConvergenceHistory) -> Vec<f64>,
    pub(super) goes_on: &'a (dyn Fn() -> bool + Sync),
    /// The part of (rᵀ M r)^½ that may be left.
    pub(super) tolerance: f64,
    pub(super) most_steps: usize,
}

/// Steps without any gain after which rounding has the last word.
const PATIENCE: usize = 12;

impl Iteration<'_> {
    /// Solves for the residual `r` of x = 0, which becomes that of the solution.
    pub(super) fn run(&self, r: &mut [f64]) -> (Vec<f64>, ConvergenceHistory, IterationEnd) {
        let mut x = vec![0.0; r.len()];
        let mut course = ConvergenceHistory::default();
        let mut z = (self.precondition)(r, &mut course);
        let first = dot(r, &z);
        course.size = first.max(0.0).sqrt();
        let (mut p, mut rho, mut steps) = (z.clone(), first, Vec::new());
        course.residuals.push(if first == 0.0 { 0.0 } else { 1.0 });
        let (mut best, mut best_at, mut product) = (1.0, 0, vec![0.0; r.len()]);
        let end = loop {
            if rho <= 0.0 || (rho / first).sqrt() <= self.tolerance {
                break if rho >= 0.0 { IterationEnd::Reached } else { IterationEnd::Stalled };
            }
            if steps.len() == self.most_steps
                || steps.len() - best_at > PATIENCE
                || !rho.is_finite()
            {
                break IterationEnd::Stalled;
            }
            if !(self.goes_on)() {
                break IterationEnd::Stopped;
            }
            (self.multiply)(&p, &mut product);
            let alpha = rho / dot(&p, &product);
            add(alpha, &p, &mut x);
            add(-alpha, &product, r);
            z = (self.precondition)(r, &mut course);
            let next = dot(r, &z);
            let beta = next / rho;
            rho = next;
            combine(&z, beta, &mut p);
            steps.push((alpha, beta));
            let left = (rho.max(0.0) / first).sqrt();
            course.residuals.push(left);
            if left < best {
                (best, best_at) = (left, steps.len());
            }
        };
        course.condition = condition(&steps);
        (x, course, end)
    }
}

/// The quotient of the extreme eigenvalues of the tridiagonal matrix that the steps make.
fn condition(steps: &[(f64, f64)]) -> f64 {
    let n = steps.len();
    let before = |k: usize| if k == 0 { (1.0, 0.0) } else { steps[k - 1] };
    let matrix = Mat::from_fn(n, n, |i, j| match i.abs_diff(j) {
        0 => 1.0 / steps[i].0 + before(i).1 / before(i).0,
        1 => steps[i.min(j)].1.max(0.0).sqrt() / steps[i.min(j)].0,
        _ => 0.0,
    });
    let eigen = SymmetricEigen::new(matrix.as_ref());
    let values = eigen.map(|eigen| eigen.values).unwrap_or_default();
    let ends = values.first().zip(values.last().filter(|least| **least > 0.0));
    ends.map_or(1.0, |(largest, least)| largest / least)
}

/// aᵀ b
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let part = |(a, b): (&[f64], &[f64])| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let parts: Vec<f64> = a.par_chunks(CHUNK).zip(b.par_chunks(CHUNK)).map(part).collect();
    parts.iter().sum()
}

/// ‖a‖
pub(super) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// y ← y + factor x
fn add(factor: f64, x: &[f64], y: &mut [f64]) {
    y.par_chunks_mut(CHUNK).zip(x.par_chunks(CHUNK)).for_each(|(y, x)| {
        y.iter_mut().zip(x).for_each(|(y, x)| *y += factor * x);
    });
}

/// p ← z + factor p
fn combine(z: &[f64], factor: f64, p: &mut [f64]) {
    p.par_chunks_mut(CHUNK).zip(z.par_chunks(CHUNK)).for_each(|(p, z)| {
        p.iter_mut().zip(z).for_each(|(p, z)| *p = z + factor * *p);
    });
}
