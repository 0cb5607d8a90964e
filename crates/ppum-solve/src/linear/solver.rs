//! Linear systems that are ready for right-hand sides: the contract of all solvers.

/// A symmetric positive semi-definite system K u = f, prepared for any number of right-hand sides.
pub(crate) trait LinearSolver {
    /// Solves K u = f.
    ///
    /// # Errors
    /// A right-hand side that is not finite, or that no u fits because K is singular.
    ///
    /// # Panics
    /// If `load` has not one entry for each unknown.
    fn solve(&self, load: &[f64]) -> Result<LinearSolution, LinearError>;

    /// x ← K⁻¹ x, as it comes: without a look at the residual.
    fn apply_inverse(&self, x: &mut [f64]);

    /// Number of unknowns that are left out, because they depend on others.
    fn n_dependent(&self) -> usize;
}

/// A solution and how well it solves the system.
#[derive(Clone, Debug)]
pub(crate) struct LinearSolution {
    /// u, one entry for each unknown.
    pub(crate) unknowns: Vec<f64>,
    /// ‖f − K u‖ / ‖f‖ in the Euclidean norm; zero for f = 0.
    pub(crate) relative_residual: f64,
}

/// A system that cannot be solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
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
        "the load is not finite there; look at the tractions, body forces and given displacements"
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
}

impl LinearError {
    /// The patch that it is about.
    #[must_use]
    pub fn patch(&self) -> Option<usize> {
        match *self {
            Self::NotPositiveDefinite { patch, .. } | Self::LoadNotFinite { patch } => Some(patch),
            Self::OutOfMemory { .. } => None,
        }
    }
}
