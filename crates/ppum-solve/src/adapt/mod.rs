//! Where a solution errs, how much, and what to do about it.
//!
//! The estimated error is a sum over the cells, η² = Σ_j η_j², of four parts (`overlap`, `data`):
//!
//! ```text
//! ∫_{C_j} Σ_i s_i φ_i |ε(u_i) − ε(u)|²_C      the local fields do not agree
//! (d/(π p))² ∫_{C_j} |f − Π f|² / C           the source has what polynomials do not
//! h/(2p + 2) ∫_Γ |t − σ(u) n|² / C            the traction there is not the one given
//! (p² + 1)/h ∫_Γ C |u − g|²                   nor is the value, or the gap of faces that are closed
//! ```
//!
//! None of it is a bound. Fields that are smooth have errors of 0.4 to 1.1 η, those with singular
//! points up to 1.3 η.
//!
//! [`mark()`] takes the cells that make up a part of the estimated error (Dörfler 1996);
//! [`Adviser`] says of each whether to divide it or to raise its order.

mod advice;
mod boundary;
mod data;
mod decay;
mod mark;
mod overlap;
mod span;

pub use advice::Adviser;
use advice::singular_points;
pub use mark::mark;

use crate::watched::{Halt, WorkPhase};
use data::unseen_data;
use faer::Mat;
pub use overlap::LocalFields;
use overlap::disagreements;
use ppum::field::Field;
use ppum_problem::Problem;

/// The estimated error in the energy norm, cell by cell.
pub struct ErrorEstimate {
    /// ½ ∫ σ:(ε − ε⁰) of the field.
    pub energy: f64,
    /// The squares η_j².
    pub squares: Vec<f64>,
    /// The products of the disagreements of the field and of all dual fields: a row for each
    /// of them.
    pub products: Vec<Mat<f64>>,
}

/// The energy of a field, its estimated error, and what that has in common with those of dual
/// fields; `local` are all of them. Advances the stage by twice the number of cells.
///
/// # Errors
/// Cancelled.
pub fn estimated(
    problem: &Problem,
    field: &Field<'_>,
    local: LocalFields<'_>,
    stage: &WorkPhase<'_>,
) -> Result<ErrorEstimate, Halt> {
    let (energy, products) = disagreements(local, &singular_points(problem), stage)?;
    let unseen = unseen_data(problem, field, local.space, local.law, stage)?;
    let squares = products.iter().zip(&unseen).map(|(own, unseen)| own[(0, 0)] + unseen).collect();
    Ok(ErrorEstimate { energy, squares, products })
}
