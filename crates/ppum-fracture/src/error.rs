//! Problems that cannot be solved.

use crate::estimate::{Estimate, gibibytes};
use ppum::check::CheckError;
use ppum::field::FieldError;
use ppum::function::FunctionError;
use ppum::progress::Cancelled;
use ppum_linear::{EigenError, LinearError};
use ppum_problem::ProblemError;
use ppum_problem::geometry::Vicinity;
use ppum_solve::equilibrium::{EquilibriumError, SupportError, UnbalancedError};
use ppum_solve::space::SpaceError;
use ppum_solve::watched::Halt;

/// A problem that cannot be solved.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The growth of its cracks leads to a problem that breaks a rule.
    #[error(transparent)]
    Problem(ProblemError),
    /// Its cover or its local spaces cannot be built.
    #[error(transparent)]
    Space(SpaceError),
    /// Its data are not finite near a known location.
    #[error(
        "the data of the problem are not finite, or too large to compute with, {0}: look at the formulas and tables \
         of the material, the loads and what is given on the border (an `exchange` must not be negative)"
    )]
    Data(Vicinity),
    /// Its data are not finite at an unknown location: an eigenvalue problem did not converge.
    #[error(
        "the data of the problem are not finite, or too large to compute with: look at the formulas and tables of \
         the material, the loads and what is given on the border"
    )]
    Eigen(#[from] EigenError),
    /// A function of the local spaces is not finite.
    #[error("a function of the local spaces is not finite, or too large to compute with, {0}")]
    Basis(Vicinity),
    /// Loads on a piece without restraint are not in equilibrium.
    #[error(transparent)]
    Unbalanced(UnbalancedError),
    /// A point that is held would take a force.
    #[error(transparent)]
    Support(#[from] SupportError),
    /// The temperature cannot be found.
    #[error("the temperature: {0}")]
    Temperature(Box<SolveError>),
    /// The factorisation failed at a patch.
    #[error("{around}: {error}")]
    Singular {
        /// The neighbourhood of the patch.
        around: Vicinity,
        /// The reason.
        error: LinearError,
    },
    /// The factorisation failed, at no particular patch.
    #[error(transparent)]
    Factor(LinearError),
    /// A function of the space does not compile.
    #[error(transparent)]
    Function(#[from] FunctionError),
    /// The solution is not a valid field.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// The solution breaks a rule of datasets, so that it could not be read again.
    #[error("the solution could not be stored: {0}")]
    Dataset(#[from] CheckError),
    /// The solution needs more memory than it may use.
    #[error(
        "the solution needs more memory than the {} that may be used: {needs}; use fewer cells, a lower \
         order, or a machine with more memory",
        gibibytes(*memory as f64)
    )]
    TooLarge {
        /// The estimated needs.
        needs: Estimate,
        /// The memory \[bytes\].
        memory: u64,
    },
    /// The energy of its solution is too large for a number.
    #[error(
        "the energy of the solution is too large for a number (it grows like the square of the loads): give lengths, \
         material and loads in other units"
    )]
    Overflow,
    /// Faces that touch do not come to rest.
    #[error(
        "the faces that touch do not come to rest in {steps} steps: with much friction there may be several states, or \
         none; use a smaller `friction`, or smaller cells at the crack"
    )]
    Contact {
        /// Steps made.
        steps: usize,
    },
    /// The watcher cancelled the work.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl SolveError {
    /// The error of a stage that uses the problem's data: integrands that are not finite are those
    /// data.
    pub(crate) fn of_data(halt: Halt) -> Self {
        Self::of_halt(halt, Self::Data)
    }

    /// The error of a stage that uses only functions of the local spaces.
    pub(crate) fn of_basis(halt: Halt) -> Self {
        Self::of_halt(halt, Self::Basis)
    }

    fn of_halt(halt: Halt, not_finite: fn(Vicinity) -> Self) -> Self {
        match halt {
            Halt::Cancelled(cancelled) => cancelled.into(),
            Halt::NotFinite(around) => not_finite(around),
        }
    }

    /// The error of the problem of a temperature.
    pub(crate) fn of_heat(error: Self) -> Self {
        match error {
            Self::Cancelled(cancelled) => cancelled.into(),
            error => Self::Temperature(Box::new(error)),
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

impl From<EquilibriumError> for SolveError {
    fn from(error: EquilibriumError) -> Self {
        match error {
            EquilibriumError::Unbalanced(error) => Self::Unbalanced(error),
            EquilibriumError::Eigen(error) => Self::Eigen(error),
        }
    }
}
