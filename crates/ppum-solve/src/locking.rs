//! Locking: displacements of low order in a plate that hardly changes its volume.
//!
//! With λ ≫ μ the energy ½ ∫ 2μ ε:ε + λ (div u)² asks for div u = 0, and polynomials of low order have too few
//! displacements that are free of divergence: the plate becomes too stiff, and its pressure −λ div u oscillates from
//! cell to cell. Polynomials of degree four and more keep their rates (Scott & Vogelius 1985), and their stresses are right point
//! by point, as no reduced integration would have them.
//!
//! How much is lost is seen in the solution. The exact pressure p varies little within a cell and stores the energy
//! ½ ∫ p²/λ, which vanishes; what the fluctuation of div u within cells stores is therefore error,
//!
//! ```text
//! R = Σ_cells ∫ λ (div u − d)² / ∫ σ:ε,   d = ∫ λ div u / ∫ λ
//! ```
//!
//! R is d log E/d log λ of a solution that locks. It grows from nothing at λ = μ, so that about half of
//! R log(λ/μ) is gathered on the way: the energy is off by the part 1 − exp(−½ R log(λ/μ)), right
//! within a factor of three on plates with known solutions.

use crate::norms::fluctuation;
use crate::space::Space;
use ppum::dataset::Equation;
use ppum::domain::Domain;
use ppum::field::Field;
use ppum::vec2::vec2;

/// λ/μ from which on a plate counts as nearly incompressible: ν = 0.476 in plane strain. In plane stress λ/μ stays
/// below 2.
pub const STIFF: f64 = 20.0;

/// Order of polynomials without locking.
const FREE: usize = 4;

/// Places along each axis at which the material is looked at.
const LOOKS: u32 = 64;

/// The largest λ/μ of the plate; zero for a potential.
#[must_use]
pub fn stiffness_ratio(equation: &Equation, domain: &Domain) -> f64 {
    if equation.elastic().is_none() {
        return 0.0;
    }
    let (corner, size) = (domain.bounds.min, domain.bounds.size());
    let along = |k: u32| f64::from(k) / f64::from(LOOKS);
    let points = (0..=LOOKS).flat_map(|j| (0..=LOOKS).map(move |i| (i, j)));
    let points = points.map(|(i, j)| corner + vec2(along(i) * size.x, along(j) * size.y));
    let ratio = |p| {
        let moduli = equation.moduli(p, [0.0, 0.0]);
        moduli.lambda / moduli.mu
    };
    let all = points.filter(|&p| domain.contains(p)).map(ratio);
    all.fold(0.0, f64::max)
}

/// The order of local polynomials where none is given: two, and four where the plate is nearly
/// incompressible.
#[must_use]
pub fn default_order(equation: &Equation, domain: &Domain) -> usize {
    if stiffness_ratio(equation, domain) > STIFF { FREE } else { 2 }
}

/// Estimated part of a solution's energy that is lost to locking; zero where the plate is compressible, and where
/// no polynomials of low order are.
///
/// # Panics
/// If the field is not of the step of `space`.
#[must_use]
pub fn locking(field: &Field<'_>, space: &Space<'_>) -> f64 {
    let ratio = stiffness_ratio(field.equation, field.domain);
    let (data, n_patches) = (space.data, space.partition.len());
    let order = |patch: usize| usize::from(data.block_degree[data.blocks(patch).start]);
    if ratio <= STIFF || (0..n_patches).all(|patch| order(patch) >= FREE) {
        return 0.0;
    }
    -(-0.5 * fluctuation(field, space) * ratio.ln()).exp_m1()
}
