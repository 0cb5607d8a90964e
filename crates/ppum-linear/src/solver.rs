//! Linear systems that are ready for right-hand sides: the contract of all solvers.

use super::block_matrix::BlockMatrix;

/// A symmetric positive semi-definite system K u = f, prepared for any number of right-hand sides.
pub trait LinearSolver {
    /// Solves K u = f.
    ///
    /// # Errors
    /// A right-hand side that is not finite, or that no u fits because K is singular.
    ///
    /// # Panics
    /// If `load` has not one entry for each unknown.
    fn solve(&self, load: &[f64]) -> Result<LinearSolution, LinearError>;

    /// Solves for several right-hand sides.
    ///
    /// # Errors
    /// Those of [`LinearSolver::solve`].
    fn solve_all(&self, loads: &[Vec<f64>]) -> Result<Vec<LinearSolution>, LinearError> {
        loads.iter().map(|load| self.solve(load)).collect()
    }

    /// Solutions of which a few digits are enough.
    ///
    /// # Errors
    /// A right-hand side that is not finite, or that no u fits.
    fn solve_roughly(&self, loads: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, LinearError>;

    /// A basis of the solutions of K u = 0 where K is singular and the solver knows them.
    fn kernel(&self) -> Option<Vec<Vec<f64>>> {
        None
    }

    /// Number of unknowns that are left out, because they depend on others.
    fn n_dependent(&self) -> usize {
        0
    }

    /// Bytes that are held: matrices and factors.
    fn bytes(&self) -> usize;

    /// Blocks, unknowns, stored values and bytes of all levels, the finest first; none without
    /// levels.
    fn level_sizes(&self) -> Vec<[usize; 4]> {
        Vec::new()
    }
}

/// Asks whether a right-hand side is finite.
pub(super) fn check_load(matrix: &BlockMatrix, load: &[f64]) -> Result<(), LinearError> {
    assert_eq!(load.len(), matrix.n_unknowns(), "one entry for each unknown");
    let place = load.iter().position(|x| !x.is_finite());
    place.map_or(Ok(()), |u| Err(LinearError::LoadNotFinite { patch: matrix.patch_of(u) }))
}

/// A solution and how well it solves the system.
#[derive(Clone, Debug)]
pub struct LinearSolution {
    /// u, one entry for each unknown.
    pub unknowns: Vec<f64>,
    /// ‖f − K u‖ / ‖f‖ in the Euclidean norm; zero for f = 0.
    pub relative_residual: f64,
    /// How it was found, by iteration.
    pub history: Option<ConvergenceHistory>,
}

/// The way to a solution by conjugate gradients with a preconditioner M ≈ K⁻¹.
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

/// A system that cannot be solved.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LinearError {
    /// A zero, negative or undefined pivot.
    #[error(
        "the solution is not unique there: hold the plate by displacements if a part of it can move freely; if \
         cracks or holes leave thin strips of material between them, use smaller cells"
    )]
    NotPositiveDefinite {
        /// The patch.
        patch: usize,
        /// Unknown within the patch, component-major.
        unknown: usize,
    },
    /// A right-hand side that is not finite.
    #[error(
        "the load is not finite there; look at the tractions, body forces, given displacements and strains"
    )]
    LoadNotFinite {
        /// The patch.
        patch: usize,
    },
    /// The factor does not fit into memory.
    #[error(
        "no memory to factorise {unknowns} unknowns; use a coarser cover, a lower order or a \
         smaller overlap"
    )]
    OutOfMemory {
        /// Unknowns of the system.
        unknowns: usize,
    },
    /// Iteration does not come to the tolerance.
    #[error(
        "after {steps} steps the multilevel solver has left {left:.1e} of the error; ask for a larger tolerance or for the \
         direct solver"
    )]
    NotConverged {
        /// Steps made.
        steps: usize,
        /// Part of the error in the energy norm that is left, estimated.
        left: f64,
    },
    /// A singular system whose coarser levels are not singular in the same way.
    #[error(
        "the multilevel solver does not find the motions of pieces of the plate that nothing holds; hold them, or ask for the \
         direct solver"
    )]
    NoModes {
        /// Force on what was found, in units of the largest stiffness.
        force: f64,
    },
    /// Somebody wanted it to stop.
    #[error("the solution was stopped")]
    Stopped,
}

impl LinearError {
    /// The patch that it is about.
    #[must_use]
    pub fn patch(&self) -> Option<usize> {
        match *self {
            Self::NotPositiveDefinite { patch, .. } | Self::LoadNotFinite { patch } => Some(patch),
            _ => None,
        }
    }
}
