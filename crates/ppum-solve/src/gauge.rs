//! Supports: which rigid motions the boundary values leave free, whether the loads allow it, and
//! the penalty that fixes them.

use crate::basis::{BasisEvaluator, StableBasis};
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

/// Adds γ Σ_k r_k r_kᵀ to the matrix, r_k(u) = ∫ φ_i v_i·m_k over the cell of one patch i, for each
/// free motion m_k. It moves the free motions only: exact for balanced loads, whatever γ > 0. One
/// patch, so that no patches are coupled that do not meet.
pub(crate) fn gauge(
    system: &mut System,
    space: &Space<'_>,
    basis: &StableBasis,
    motions: &RigidMotions,
    free: &[PerMotion],
) {
    if free.is_empty() {
        return;
    }
    // the patch with the fewest functions: away from cracks, where nothing is nearly dependent
    let patch =
        (0..space.sizes.len()).min_by_key(|&p| space.sizes[p]).expect("a cover has a patch");
    let moments = moments(space, basis, patch, motions, free);
    let length = moments.iter().flatten().fold(0.0f64, |m, v| m.max(v * v));
    let stiffness = system.matrix.block(patch, patch).expect("a patch is coupled to itself");
    let n = stiffness.nrows();
    let gamma = (0..n).map(|k| stiffness[(k, k)]).fold(0.0, f64::max) / length;
    let block = Mat::from_fn(n, n, |a, b| gamma * moments.iter().map(|r| r[a] * r[b]).sum::<f64>());
    system.matrix.add_block(patch, patch, block.as_ref());
}

/// r_k over the unknowns of a patch, component-major.
fn moments(
    space: &Space<'_>,
    basis: &StableBasis,
    patch: usize,
    motions: &RigidMotions,
    free: &[PerMotion],
) -> Vec<Vec<f64>> {
    let (components, size) = (motions.components(), basis.sizes[patch]);
    let (mut evaluator, mut shapes) = (BasisEvaluator::new(space, basis), Shapes::default());
    let mut moments = vec![vec![0.0; size * components]; free.len()];
    for rule in space.quadrature(0).cell(&space.partition.cell[patch], &space.coverers[patch]) {
        evaluator.evaluate(rule.anchor, &rule.offsets, &rule.patches, &mut shapes);
        let before = rule.patches.iter().take_while(|&&p| p != patch as u32);
        let first: usize = before.map(|&p| basis.sizes[p as usize]).sum();
        for (q, (&offset, &weight)) in rule.offsets.iter().zip(&rule.weights).enumerate() {
            let basic = motions.at(rule.anchor + offset);
            for (moment, motion) in moments.iter_mut().zip(free) {
                for (row, sum) in moment.iter_mut().enumerate() {
                    let (i, a) = (row / size, first + row % size);
                    let m: f64 = (0..MOTIONS).map(|k| motion[k] * basic[k][i]).sum();
                    *sum += weight * m * shapes.value[a * shapes.points + q];
                }
            }
        }
    }
    moments
}
