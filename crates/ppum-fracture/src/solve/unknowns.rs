//! The unknowns of a system, by the linear solver that suits it.

use super::SolveError;
use super::assembled::Assembled;
use super::contact::solve_contact;
use super::plan::Plan;
use ppum::progress::{Cancelled, Phase, Watcher};
use ppum_linear::{Cholesky, LinearError, LinearSolution, LinearSolver, Multilevel};
use ppum_solve::assembly::CellErrors;
use ppum_solve::hierarchy::FinestLevel;
use ppum_solve::report::{LevelSize, LinearKind, SolverReport};
use ppum_solve::space::TrialSpace;
use ppum_solve::watched::WorkPhase;

/// The unknowns in the stable basis.
pub(super) struct Unknowns {
    /// Those of the solution, without what is left of free motions, and of the dual solutions.
    pub(super) all: Vec<Vec<f64>>,
    /// The cells in which contact ends.
    pub(super) contact: Vec<CellErrors>,
    /// The numbers of the report that the linear solver knows.
    pub(super) report: SolverReport,
}

impl Unknowns {
    /// Solves the system by the solver of an estimate, or by the direct one where coarser levels
    /// do not serve and memory holds a factor.
    ///
    /// # Errors
    /// A system that is singular or too large, a load that is not finite; cancelled.
    pub(super) fn new(
        plan: &Plan<'_>,
        assembled: &mut Assembled,
        watcher: &dyn Watcher,
    ) -> Result<Self, SolveError> {
        match Self::of_kind(plan.estimate.solver, plan, assembled, watcher) {
            Err(error) if plan.estimate.falls_back && is_of_levels(&error) => {
                let mut unknowns = Self::of_kind(LinearKind::Direct, plan, assembled, watcher)?;
                unknowns.report.fallback = true;
                Ok(unknowns)
            }
            other => other,
        }
    }

    fn of_kind(
        kind: LinearKind,
        Plan { problem, mesh, space, .. }: &Plan<'_>,
        Assembled { plate, basis, system, constraint, contacts, are_exact, .. }: &mut Assembled,
        watcher: &dyn Watcher,
    ) -> Result<Self, SolveError> {
        let located = |error| located(error, space);
        let stage = WorkPhase::new(watcher, Phase::Solution, 3)?;
        let goes_on = || stage.advance(0).is_ok();
        let free = constraint.loads(&system.matrix);
        let mut contact_steps = None;
        let solver: Box<dyn LinearSolver + '_> = match kind {
            LinearKind::Direct => {
                constraint.add_penalty(&mut system.matrix);
                if !contacts.is_empty() {
                    contact_steps =
                        Some(solve_contact(contacts, constraint, system, &located, &stage)?);
                }
                Box::new(Cholesky::new(&system.matrix).map_err(located)?)
            }
            LinearKind::Multilevel => {
                let coarser = FinestLevel { problem, plate, mesh, space, basis }.coarser(&stage)?;
                let wanted = (problem.solver.tolerance, &goes_on as &(dyn Fn() -> bool + Sync));
                let solver = Multilevel::new(&system.matrix, coarser, &free, wanted);
                Box::new(solver.map_err(located)?)
            }
        };
        let solver = solver.as_ref();
        stage.advance(1)?;
        let mut solution = solver.solve(&system.load).map_err(located)?;
        stage.advance(1)?;
        constraint.center(solver, &system.matrix, &mut solution.unknowns).map_err(located)?;
        stage.advance(1)?;
        let mut report = report(kind, solver, &solution);
        if let Some(steps) = contact_steps {
            let stresses = contacts.stresses(&system.matrix, &solution.unknowns);
            report.contact_steps = Some(steps as u64);
            contacts.report(&stresses, &mut report);
        }
        let mut all = vec![solution.unknowns];
        if *are_exact {
            for mut dual in solver.solve_all(&system.duals).map_err(located)? {
                let unknowns = &mut dual.unknowns;
                constraint.center(solver, &system.matrix, unknowns).map_err(located)?;
                all.push(dual.unknowns);
            }
        } else if !system.duals.is_empty() {
            all.append(&mut solver.solve_roughly(&system.duals).map_err(located)?);
        }
        let contact = contacts.errors(&system.matrix, &all);
        Ok(Self { all, contact, report })
    }
}

/// The numbers that are told of a solver and a solution.
fn report(kind: LinearKind, solver: &dyn LinearSolver, solution: &LinearSolution) -> SolverReport {
    let report = SolverReport {
        residual: Some(solution.relative_residual),
        dependent: Some(solver.n_dependent() as u64),
        solver: Some(kind),
        solver_bytes: Some(solver.bytes() as u64),
        ..SolverReport::default()
    };
    let Some(history) = &solution.history else { return report };
    let level_size = |of: [usize; 4]| {
        let [patches, unknowns, values, bytes] = of.map(|n| n as f64);
        LevelSize { patches, unknowns, values, bytes }
    };
    let levels: Vec<_> = solver.level_sizes().into_iter().map(level_size).collect();
    SolverReport {
        solver_levels: Some(levels.len() as u64),
        iterations: Some(history.residuals.len().saturating_sub(1) as u64),
        preconditioned_condition: Some(history.condition),
        levels,
        residuals: history.residuals.clone(),
        level_residuals: history.levels.clone(),
        ..report
    }
}

/// The error at the place of its patch.
fn located(error: LinearError, space: &TrialSpace<'_>) -> SolveError {
    match error.patch() {
        Some(patch) => {
            SolveError::Singular { around: space.partition().support(patch).into(), error }
        }
        None if error == LinearError::Stopped => Cancelled.into(),
        None => SolveError::Factor(error),
    }
}

/// True if coarser levels may be the reason of an error.
fn is_of_levels(error: &SolveError) -> bool {
    let (SolveError::Singular { error, .. } | SolveError::Factor(error)) = error else {
        return false;
    };
    !matches!(error, LinearError::LoadNotFinite { .. })
}
