//! Problems that cannot be solved.

use super::estimate::{Estimate, gibibytes};
use crate::diagnostics::RecomputeError;
use crate::equilibrium::{PlateError, UnbalancedError};
use crate::geometry::Around;
use crate::linear::{EigenError, LinearError};
use crate::problem::ProblemError;
use crate::space::SpaceError;
use crate::watched::Halt;
use ppum::check::CheckError;
use ppum::field::FieldError;
use ppum::function::FunctionError;
use ppum::progress::Cancelled;

/// A problem that cannot be solved.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
    /// A problem that its cracks have grown to, and that breaks a rule.
    #[error(transparent)]
    Problem(ProblemError),
    /// Its cover or local spaces.
    #[error(transparent)]
    Space(SpaceError),
    /// Data that are not finite.
    #[error(
        "the data of the problem are not finite, or too large to compute with, {0}: look at the formulas and tables \
         of the material, the loads and what is given on the border"
    )]
    Data(Around),
    /// The same, nobody knows where.
    #[error(
        "the data of the problem are not finite, or too large to compute with: look at the formulas and tables of \
         the material, the loads and what is given on the border"
    )]
    Eigen(#[from] EigenError),
    /// Functions of the local spaces that are not finite.
    #[error("a function of the local spaces is not finite, or too large to compute with, {0}")]
    Basis(Around),
    /// Loads without restraint.
    #[error(transparent)]
    Unbalanced(UnbalancedError),
    /// The factorisation, at a place.
    #[error("{around}: {error}")]
    Singular {
        /// The neighbourhood of the patch.
        around: Around,
        /// The reason.
        error: LinearError,
    },
    /// The factorisation.
    #[error(transparent)]
    Factor(LinearError),
    /// A function of the space.
    #[error(transparent)]
    Function(#[from] FunctionError),
    /// The field that was found.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// A dataset that nothing could read again.
    #[error("the solution could not be stored: {0}")]
    Dataset(#[from] CheckError),
    /// More than the memory holds.
    #[error(
        "the solution needs more memory than the {} that may be used: {needs}; use fewer cells, a lower \
         order, or a machine with more memory",
        gibibytes(*memory as f64)
    )]
    TooLarge {
        /// Its least needs.
        needs: Estimate,
        /// The memory \[bytes\].
        memory: u64,
    },
    /// The watcher wanted the work to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl SolveError {
    /// Work with the data of the problem that was halted.
    pub(super) fn of_data(halt: Halt) -> Self {
        match halt {
            Halt::Cancelled(cancelled) => cancelled.into(),
            Halt::NotFinite(around) => Self::Data(around),
        }
    }

    /// Work with functions of the local spaces alone that was halted.
    pub(super) fn of_basis(halt: Halt) -> Self {
        match halt {
            Halt::Cancelled(cancelled) => cancelled.into(),
            Halt::NotFinite(around) => Self::Basis(around),
        }
    }
}

impl From<SpaceError> for SolveError {
    fn from(error: SpaceError) -> Self {
        match error {
            SpaceError::Cancelled(cancelled) => cancelled.into(),
            error => Self::Space(error),
        }
    }
}

impl From<PlateError> for SolveError {
    fn from(error: PlateError) -> Self {
        match error {
            PlateError::Unbalanced(error) => Self::Unbalanced(error),
            PlateError::Eigen(error) => Self::Eigen(error),
        }
    }
}

impl From<RecomputeError> for SolveError {
    fn from(error: RecomputeError) -> Self {
        match error {
            RecomputeError::Field(error) => Self::Field(error),
            RecomputeError::Cancelled(cancelled) => cancelled.into(),
        }
    }
}
