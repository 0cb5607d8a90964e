//! Solutions on covers that are improved where the one before errs.

use super::SolveError;
use super::clock::Clock;
use super::diagnosed::{Diagnosed, GoalError};
use super::plan::{Plan, most_cells};
use super::solved::Solved;
use ppum::dataset::{Dataset, Step};
use ppum::field::Field;
use ppum::progress::{Phase, Watcher};
use ppum_problem::{Adaptivity, StepsKept};
use ppum_solve::adapt::{Adviser, mark};
use ppum_solve::report::StopReason;
use ppum_solve::space::{CellChange, CoverMesh};
use ppum_solve::watched::{StepWatcher, WorkPhase};

/// Solves step by step: solve, estimate, mark, improve, from a plan of the first step.
///
/// # Errors
/// See [`SolveError`].
pub(super) fn solve_adaptively(
    first: Plan<'_>,
    set: &Adaptivity,
    watcher: &dyn Watcher,
) -> Result<Dataset, SolveError> {
    let Adaptation { last, stop, mut kept, step } = Adaptation::new(first, set, watcher)?;
    let mut dataset = last.dataset(Some(stop), &StepWatcher { watcher, step })?;
    kept.append(&mut dataset.steps);
    dataset.steps = kept;
    Ok(dataset)
}

/// The mesh of the last step.
///
/// # Errors
/// See [`SolveError`].
pub(super) fn adapted_mesh(
    first: Plan<'_>,
    set: &Adaptivity,
    watcher: &dyn Watcher,
) -> Result<CoverMesh, SolveError> {
    let set = &Adaptivity { keep: StepsKept::Last, ..*set };
    Adaptation::new(first, set, watcher).map(|adapted| adapted.last.solved.plan.mesh)
}

/// The last step of an adaptation, with its number, what ended it, and the steps before it that
/// are kept.
struct Adaptation<'p> {
    last: Diagnosed<'p>,
    stop: StopReason,
    kept: Vec<Step>,
    step: usize,
}

impl<'p> Adaptation<'p> {
    fn new(first: Plan<'p>, set: &Adaptivity, watcher: &dyn Watcher) -> Result<Self, SolveError> {
        let (mut plan, mut kept, mut step) = (first, Vec::new(), 0);
        loop {
            let here = StepWatcher { watcher, step };
            let last = Diagnosed::new(Solved::new(plan, &here)?, &here)?;
            match last.next(set, step + 1, &StepWatcher { watcher, step: step + 1 })? {
                Ok(next) => {
                    if set.keep == StepsKept::All {
                        kept.append(&mut last.dataset(None, &here)?.steps);
                    }
                    plan = next;
                }
                Err(stop) => return Ok(Self { last, stop, kept, step }),
            }
            step += 1;
        }
    }
}

impl<'p> Diagnosed<'p> {
    /// The plan of the step with this number, or what ends the adaptation.
    fn next(
        &self,
        set: &Adaptivity,
        number: usize,
        watcher: &dyn Watcher,
    ) -> Result<Result<Plan<'p>, StopReason>, SolveError> {
        let error = self.solved.report.estimated_error.unwrap_or(0.0);
        let GoalError { largest, cells: parts } = self.goal();
        let wanted = [(set.tolerance, error), (set.accuracy, largest)];
        let mut wanted =
            wanted.into_iter().filter_map(|(most, error)| Some(error <= most?)).peekable();
        let is_enough = wanted.peek().is_some() && wanted.all(|reached| reached);
        if error == 0.0 || is_enough {
            return Ok(Err(StopReason::Tolerance));
        }
        if number > set.steps {
            return Ok(Err(StopReason::Steps));
        }
        let clock = Clock::new();
        let stage = WorkPhase::uncounted(watcher, Phase::Cover)?;
        let parts = if set.accuracy.is_some() { &parts } else { &self.squares };
        let Some(mesh) = self.improved(set, parts)? else {
            return Ok(Err(StopReason::Limits));
        };
        let Plan { problem, memory, .. } = self.solved.plan;
        if mesh.n_cells() > most_cells(problem, memory) {
            return Ok(Err(StopReason::Memory));
        }
        match Plan::on(problem, mesh, memory, (clock, &stage)) {
            Err(SolveError::TooLarge { .. }) => Ok(Err(StopReason::Memory)),
            Ok(plan) if plan.estimate.unknowns > set.max_unknowns as f64 => {
                Ok(Err(StopReason::Unknowns))
            }
            other => other.map(Ok),
        }
    }

    /// The mesh of the next step, given the parts that the cells have in the error; none if nothing
    /// can be improved where it is needed.
    fn improved(&self, set: &Adaptivity, parts: &[f64]) -> Result<Option<CoverMesh>, SolveError> {
        let Plan { problem, mesh, dataset, space, .. } = &self.solved.plan;
        let field = Field::new(dataset, 0)?;
        let adviser = Adviser::new(set.kind, problem, &field, space);
        let mut changes = vec![CellChange::Keep; parts.len()];
        for cell in mark(parts, set.fraction) {
            changes[cell] = adviser.advice(cell);
        }
        Ok(mesh.changed(space.partition(), &changes)?)
    }
}
