//! Locking: displacements of low order in a body that hardly changes its volume.
//!
//! With λ ≫ μ the energy ½ ∫ 2μ ε:ε + λ (div u)² asks for div u = 0, and polynomials of low order
//! have too few displacements that are free of divergence: the body becomes too stiff, and its
//! pressure −λ div u oscillates from cell to cell. Polynomials of degree four and more keep their
//! rates (Scott & Vogelius 1985); what is left of the oscillation there, `pressure` tells.
//!
//! The loss is seen in the solution. The exact pressure p varies little within a cell and stores
//! the energy ½ ∫ p²/λ, which vanishes; what the fluctuation of div u within cells stores is
//! therefore error,
//!
//! ```text
//! R = Σ_cells ∫ λ (div u − d)² / ∫ σ:ε,   d = ∫ λ div u / ∫ λ
//! ```
//!
//! R is d log E/d log λ of a solution that locks. It grows from nothing at λ = μ, so that about
//! half of R log(λ/μ) is gathered on the way: the energy is off by the part 1 − exp(−½ R log(λ/μ)),
//! right within a factor of three on bodies with known solutions.

use ppum::field::Field;
use ppum_problem::{FREE_OF_LOCKING, STIFF, stiffness_ratio};
use ppum_solve::norms::fluctuation;
use ppum_solve::space::TrialSpace;

/// Estimated part of a solution's energy that is lost to locking; zero where the body is
/// compressible, and where no polynomials of low order are.
///
/// # Panics
/// If the field is not of the step of `space`.
#[must_use]
pub(super) fn locking(field: &Field<'_>, space: &TrialSpace<'_>) -> f64 {
    let ratio = stiffness_ratio(field.equation, field.domain);
    let (data, n_patches) = (space.data(), space.partition().len());
    let order = |patch: usize| usize::from(data.block_degree[data.blocks(patch).start]);
    if ratio <= STIFF || (0..n_patches).all(|patch| order(patch) >= FREE_OF_LOCKING) {
        return 0.0;
    }
    -(-0.5 * fluctuation(field, space) * ratio.ln()).exp_m1()
}
