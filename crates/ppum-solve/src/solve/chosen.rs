//! The solver of a linear system: the place where one is chosen.

use crate::linear::{BlockMatrix, Cholesky, Coarse, Course, LinearError, LinearSolver, Multilevel};
use crate::report::{LevelSize, LinearKind, SolverReport};

/// The part of the error that iteration may leave, and who is asked whether to go on.
pub(super) type Wanted<'a> = (f64, &'a (dyn Fn() -> bool + Sync));

/// A solver that is ready.
pub(super) enum Chosen<'a> {
    Direct(Box<Cholesky<'a>>),
    Multilevel(Box<Multilevel<'a>>),
}

impl<'a> Chosen<'a> {
    /// The factor of a matrix.
    pub(super) fn direct(matrix: &'a BlockMatrix) -> Result<Self, LinearError> {
        Ok(Self::Direct(Box::new(Cholesky::new(matrix)?)))
    }

    /// Conjugate gradients with these coarser levels, of a singular matrix with these functionals.
    pub(super) fn multilevel(
        matrix: &'a BlockMatrix,
        coarser: Vec<Coarse>,
        free: &[Vec<f64>],
        wanted: Wanted<'a>,
    ) -> Result<Self, LinearError> {
        Ok(Self::Multilevel(Box::new(Multilevel::new(matrix, coarser, free, wanted)?)))
    }

    /// What is told of a solution.
    pub(super) fn report(&self, residual: f64, course: Option<Course>) -> SolverReport {
        let known = SolverReport {
            residual: Some(residual),
            dependent: Some(self.as_dyn().n_dependent() as f64),
            ..SolverReport::default()
        };
        let (kind, bytes) = match self {
            Self::Direct(solver) => (LinearKind::Direct, solver.bytes()),
            Self::Multilevel(solver) => (LinearKind::Multilevel, solver.bytes()),
        };
        let (solver, solver_bytes) = (Some(kind.code()), Some(bytes as f64));
        let (Self::Multilevel(levels), Some(course)) = (self, course) else {
            return SolverReport { solver, solver_bytes, ..known };
        };
        SolverReport {
            solver,
            solver_bytes,
            solver_levels: Some(levels.n_levels() as f64),
            iterations: Some(course.residuals.len() as f64 - 1.0),
            preconditioned_condition: Some(course.condition),
            levels: levels.sizes().into_iter().map(level_size).collect(),
            residuals: course.residuals,
            level_residuals: course.levels,
            ..known
        }
    }

    pub(super) fn as_dyn(&self) -> &dyn LinearSolver {
        match self {
            Self::Direct(solver) => solver.as_ref(),
            Self::Multilevel(solver) => solver.as_ref(),
        }
    }
}

fn level_size(of: [usize; 4]) -> LevelSize {
    let [patches, unknowns, values, bytes] = of.map(|n| n as f64);
    LevelSize { patches, unknowns, values, bytes }
}
