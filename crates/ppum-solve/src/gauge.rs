//! Supports: which rigid motions the boundary values leave free, whether the loads allow it, and
//! the penalty that fixes them.

use crate::basis::{BasisEvaluator, StableBasis};
use crate::cell::CellFunctions;
use crate::eigen::{EigenError, SymmetricEigen};
use crate::rigid::{MOTIONS, PerMotion, RigidMotions};
use crate::shape::Shapes;
use crate::space::Space;
use crate::system::System;
use faer::Mat;

/// Part of the largest eigenvalue below which a motion counts as free.
const FREE: f64 = 1e-10;

/// Part of the loads' magnitude that may remain unbalanced: quadrature of the data, not more.
const BALANCE: f64 = 1e-6;

/// The loads move a plate that is not held.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the loads do not balance and nothing holds the plate against them: a resultant of {resultant:.6e} \
     remains of loads of {magnitude:.6e} in all; hold a component of the displacement on an edge, or \
     balance the tractions"
)]
pub struct UnbalancedError {
    /// Work of the loads on the free rigid motion, with unit displacement.
    pub resultant: f64,
    /// ∫ of the magnitude of all loads.
    pub magnitude: f64,
}

/// The rigid motions that no boundary value holds, as combinations of the basic ones.
pub(crate) fn free_motions(
    system: &System,
    motions: &RigidMotions,
) -> Result<Vec<PerMotion>, EigenError> {
    let n = motions.count();
    let held = Mat::from_fn(n, n, |a, b| system.held[a][b]);
    let eigen = SymmetricEigen::new(held.as_ref())?;
    let largest = eigen.values.first().copied().unwrap_or(0.0);
    let free = (0..n).filter(|&k| eigen.values[k] <= FREE * largest);
    Ok(free
        .map(|k| std::array::from_fn(|m| if m < n { eigen.vectors[(m, k)] } else { 0.0 }))
        .collect())
}

/// Checks that the loads do no work on the free motions.
///
/// # Errors
/// Loads that do.
pub(crate) fn check_balance(system: &System, free: &[PerMotion]) -> Result<(), UnbalancedError> {
    for motion in free {
        let work: f64 = motion.iter().zip(&system.resultant).map(|(m, r)| m * r).sum();
        if work.abs() > BALANCE * system.magnitude {
            return Err(UnbalancedError { resultant: work, magnitude: system.magnitude });
        }
    }
    Ok(())
}

/// Adds γ Σ_k r_k r_kᵀ to the matrix, r_k = ∫ N·m_k over one cell for each free motion m_k. It moves
/// the free motions only: exact for balanced loads, whatever γ > 0.
pub(crate) fn gauge(
    system: &mut System,
    space: &Space<'_>,
    basis: &StableBasis,
    motions: &RigidMotions,
    free: &[PerMotion],
) {
    let components = motions.components();
    if free.is_empty() {
        return;
    }
    // the cell with the fewest functions: away from cracks, where nothing is nearly dependent
    let size = |cell: &usize| {
        space.coverers[*cell].iter().map(|&p| space.sizes[p as usize]).sum::<usize>()
    };
    let cell = (0..space.coverers.len()).min_by_key(size).expect("a cover has a cell");
    let functions = CellFunctions::new(space, basis, cell);
    let moments = moments(space, basis, cell, &functions, motions, free);
    let length = moments.iter().flatten().fold(0.0f64, |m, v| m.max(v * v));
    let largest = functions.patches.iter().map(|&p| largest_diagonal(system, p as usize));
    let gamma = largest.fold(0.0, f64::max) / length;
    for (k, &p) in functions.patches.iter().enumerate() {
        for (l, &q) in functions.patches.iter().enumerate().skip(k) {
            let (rows, columns) =
                (functions.unknowns(k, components), functions.unknowns(l, components));
            let block = Mat::from_fn(rows.len(), columns.len(), |a, b| {
                gamma * moments.iter().map(|r| r[rows[a]] * r[columns[b]]).sum::<f64>()
            });
            system.matrix.add_block(p as usize, q as usize, block.as_ref());
        }
    }
}

fn largest_diagonal(system: &System, patch: usize) -> f64 {
    let block = system.matrix.block(patch, patch).expect("a patch is coupled to itself");
    (0..block.nrows()).map(|k| block[(k, k)]).fold(0.0, f64::max)
}

/// r_k over the unknowns of a cell.
fn moments(
    space: &Space<'_>,
    basis: &StableBasis,
    cell: usize,
    functions: &CellFunctions,
    motions: &RigidMotions,
    free: &[PerMotion],
) -> Vec<Vec<f64>> {
    let components = motions.components();
    let quadrature = space.quadrature(0);
    let (mut evaluator, mut shapes) = (BasisEvaluator::new(space, basis), Shapes::default());
    let mut moments = vec![vec![0.0; functions.len() * components]; free.len()];
    for rule in quadrature.cell(&space.partition.cell[cell], &space.coverers[cell]) {
        evaluator.evaluate(rule.anchor, &rule.offsets, &rule.patches, &mut shapes);
        let numbers = functions.numbers(&rule.patches);
        for (q, (&offset, &weight)) in rule.offsets.iter().zip(&rule.weights).enumerate() {
            let basic = motions.at(rule.anchor + offset);
            for (moment, motion) in moments.iter_mut().zip(free) {
                for i in 0..components {
                    let m: f64 = (0..MOTIONS).map(|k| motion[k] * basic[k][i]).sum();
                    for (a, number) in numbers.iter().enumerate() {
                        let n = shapes.value[a * shapes.points + q];
                        moment[number * components + i] += weight * m * n;
                    }
                }
            }
        }
    }
    moments
}
