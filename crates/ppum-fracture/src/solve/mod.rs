//! From a problem to a dataset, stage by stage:
//!
//! ```text
//! Plan          cover, local spaces; unknowns, memory, linear solver
//! Assembled     pieces of the plate and their loads; stable basis, system, constraint
//! Solved        unknowns, coefficients, stress intensity factors
//! Diagnosed     estimated errors; then warnings and the report
//! ```

mod adaptive;
mod assembled;
mod clock;
mod contact;
mod diagnosed;
mod duals;
mod goal;
mod plan;
mod solved;
mod unknowns;

pub(crate) use duals::DualSolutions;

pub use crate::error::SolveError;
pub use crate::estimate::Estimate;
pub use plan::Plan;
pub use ppum_linear::{EigenError, LinearError, Spectrum};
pub use ppum_problem::geometry::Vicinity;
pub use ppum_solve::equilibrium::{SupportError, UnbalancedError};

use adaptive::solve_adaptively;
use assembled::Assembled;
use diagnosed::Diagnosed;
use ppum::dataset::{Dataset, TipIntensity};
use ppum::progress::{Phase, Watcher};
use ppum_linear::Cholesky;
use ppum_problem::Problem;
use ppum_solve::law::Law;
use ppum_solve::watched::WorkPhase;
use solved::Solved;

/// Solves a problem: one step, one field; several steps where the problem asks for adaptation and
/// wants to keep all of them. The watcher is told how far the work has come.
///
/// The coefficients belong to the plain functions; neither the transformed basis nor what it cut
/// off is seen in the dataset. Results do not depend on the number of threads. The step's history
/// is a [`SolverReport`](ppum_solve::report::SolverReport).
///
/// # Errors
/// See [`SolveError`]; cancelled, within the time of a cell or of one step of the linear solver.
pub fn solve(problem: &Problem, watcher: &dyn Watcher) -> Result<Dataset, SolveError> {
    Plan::new(problem, None, watcher)?.solve(watcher)
}

/// The extreme eigenvalues of the system of a problem, to a thousandth: the condition number of its
/// discretisation. Costs as much as a solution, and up to a hundred solves with the factor.
///
/// # Errors
/// See [`SolveError`].
pub fn spectrum(problem: &Problem, watcher: &dyn Watcher) -> Result<Spectrum, SolveError> {
    let mut plan = Plan::new(problem, None, watcher)?;
    let assembled = Assembled::new(&mut plan, &Law::new(&problem.equation), watcher)?;
    let Assembled { mut system, constraint, .. } = assembled;
    constraint.add_penalty(&mut system.matrix);
    let stage = WorkPhase::uncounted(watcher, Phase::Solution)?;
    let solver = Cholesky::new(&system.matrix).map_err(SolveError::Factor)?;
    Spectrum::new(&system.matrix, &solver, &|| Ok(stage.advance(0)?))
}

impl Plan<'_> {
    /// Solves the problem, once, or step by step where it asks for adaptation.
    ///
    /// # Errors
    /// See [`SolveError`].
    pub fn solve(self, watcher: &dyn Watcher) -> Result<Dataset, SolveError> {
        match &self.problem.adaptivity {
            Some(set) => solve_adaptively(self, set, watcher),
            None => Diagnosed::new(Solved::new(self, watcher)?, watcher)?.dataset(None, watcher),
        }
    }

    /// Solves the problem, and goes on to errors and warnings only if its stress intensity factors
    /// are those that are wanted; else the factors are what is returned.
    ///
    /// # Errors
    /// See [`SolveError`].
    pub(crate) fn attempt(
        self,
        watcher: &dyn Watcher,
        is_wanted: &dyn Fn(&[TipIntensity]) -> bool,
    ) -> Result<Result<Dataset, Vec<TipIntensity>>, SolveError> {
        if self.problem.adaptivity.is_some() {
            let mut dataset = self.solve(watcher)?;
            let factors = &mut dataset.steps[0].intensities;
            return Ok(if is_wanted(factors) { Ok(dataset) } else { Err(std::mem::take(factors)) });
        }
        let solved = Solved::new(self, watcher)?;
        let factors = solved.factors();
        if !is_wanted(&factors) {
            return Ok(Err(factors));
        }
        Diagnosed::new(solved, watcher)?.dataset(None, watcher).map(Ok)
    }
}
