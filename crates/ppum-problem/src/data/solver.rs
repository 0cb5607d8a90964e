//! The linear solver of a problem.

use super::word_table;

/// Settings of the solver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolverSettings {
    /// The linear solver.
    pub kind: SolverKind,
    /// Part of the error in the energy norm that iteration may leave, estimated by its residual.
    pub tolerance: f64,
    /// Use native kernels where there are any; false evaluates their formulas, which should give
    /// the same to rounding.
    pub kernels: bool,
}

impl Default for SolverSettings {
    fn default() -> Self {
        Self { kind: SolverKind::default(), tolerance: TOLERANCE, kernels: true }
    }
}

/// Default tolerance of iteration: fields and stress intensity factors are those of the direct
/// solver to 1e-9, a thousand times that, whatever they weigh in the energy.
const TOLERANCE: f64 = 1e-12;

/// The linear solver.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SolverKind {
    /// The choice that suits the problem.
    #[default]
    Auto,
    /// Sparse Cholesky factorisation.
    Direct,
    /// Conjugate gradients with a hierarchy of coarser covers.
    Multilevel,
}

word_table!(SolverKind: Auto "auto", Direct "direct", Multilevel "multilevel");
