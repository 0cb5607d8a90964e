//! Conjugate gradients for K u = f with a preconditioner M ≈ K⁻¹ \[Hestenes & Stiefel 1952\].
//!
//! The error in the energy norm falls with every step. (rᵀ M r)^½ stands for it: between the two
//! lies no more than the condition of M K, which the coefficients of the iteration tell: they make
//! the tridiagonal matrix of Lanczos' method.

use super::eigen::SymmetricEigen;
use super::solver::{ConvergenceHistory, LinearError};
use rayon::prelude::*;

/// Numbers that one thread adds up at a time; sums do not depend on the number of threads.
const CHUNK: usize = 1 << 14;

/// Steps that no problem with working levels needs.
const MOST_STEPS: usize = 300;

/// Steps without any gain after which rounding has the last word.
const PATIENCE: usize = 12;

/// Solves for the residual `r` of x = 0, which becomes that of the solution, until (rᵀ M r)^½ has
/// fallen to a part of what it was: false if it no longer falls, or takes too many steps. The
/// preconditioner appends the norms of the right-hand sides on its levels.
///
/// # Errors
/// `goes_on` is false.
pub(super) fn conjugate_gradients(
    r: &mut [f64],
    tolerance: f64,
    multiply: impl Fn(&[f64], &mut [f64]),
    precondition: impl Fn(&[f64], &mut Vec<f64>) -> Vec<f64>,
    goes_on: &dyn Fn() -> bool,
) -> Result<(Vec<f64>, ConvergenceHistory, bool), LinearError> {
    let (mut x, mut product) = (vec![0.0; r.len()], vec![0.0; r.len()]);
    let mut history = ConvergenceHistory::default();
    let preconditioned = |r: &[f64], history: &mut ConvergenceHistory| {
        history.levels.push(Vec::new());
        history.levels.last_mut().map_or_else(Vec::new, |norms| precondition(r, norms))
    };
    let mut z = preconditioned(r, &mut history);
    let first = dot(r, &z);
    history.size = first.max(0.0).sqrt();
    let (mut p, mut rho, mut steps) = (z.clone(), first, Vec::new());
    history.residuals.push(if first == 0.0 { 0.0 } else { 1.0 });
    let (mut best, mut best_at) = (1.0, 0);
    let is_reached = loop {
        if rho <= 0.0 || (rho / first).sqrt() <= tolerance {
            break rho >= 0.0;
        }
        if steps.len() == MOST_STEPS || steps.len() - best_at > PATIENCE || !rho.is_finite() {
            break false;
        }
        if !goes_on() {
            return Err(LinearError::Stopped);
        }
        multiply(&p, &mut product);
        let alpha = rho / dot(&p, &product);
        add(alpha, &p, &mut x);
        add(-alpha, &product, r);
        z = preconditioned(r, &mut history);
        let next = dot(r, &z);
        let beta = next / rho;
        rho = next;
        combine(&z, beta, &mut p);
        steps.push((alpha, beta));
        let left = (rho.max(0.0) / first).sqrt();
        history.residuals.push(left);
        if left < best {
            (best, best_at) = (left, steps.len());
        }
    };
    history.condition = condition(&steps);
    Ok((x, history, is_reached))
}

/// The quotient of the extreme eigenvalues of the tridiagonal matrix that the steps make.
fn condition(steps: &[(f64, f64)]) -> f64 {
    let before = std::iter::once(&(1.0, 0.0)).chain(steps);
    let diagonal: Vec<f64> = steps.iter().zip(before).map(|(k, b)| 1.0 / k.0 + b.1 / b.0).collect();
    let coupling: Vec<f64> = steps.iter().map(|(a, b)| b.max(0.0).sqrt() / a).collect();
    let eigen = SymmetricEigen::tridiagonal(&diagonal, &coupling);
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

/// ‖r‖ / ‖f‖, zero for r = 0.
pub(super) fn relative(r: &[f64], f: &[f64]) -> f64 {
    let size = norm(r);
    if size == 0.0 { 0.0 } else { size / norm(f) }
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
