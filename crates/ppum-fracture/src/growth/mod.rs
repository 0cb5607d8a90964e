//! Cracks that grow, step by step: solve, let the tips go on, solve again.
//!
//! ```text
//! cracks ─▶ solution ─▶ factors of the tips ─▶ decision: who grows, how far, where to ─▶ cracks of the next step
//! ```
//!
//! A tip goes on along an arc. Its direction is that of the criterion, its curvature that with
//! which the path has turned so far: tips then lie on the path up to the second power of the
//! increments. By the criterion of local symmetry the arc is bent until K_II = 0 at its end.
//!
//! Each step is solved for itself, from its cracks alone, and given away when it is complete. The
//! increments after it are decided with it and stored in its [`Growth`](ppum::dataset::Growth), so
//! that a series goes on from any of its steps with the same bits.

mod criterion;
mod decision;
mod life;
mod path;
mod settle;
mod step;

pub use criterion::{KinkPrediction, kink};
pub use decision::GrowthDataError;
pub use life::LifeError;

use crate::solve::SolveError;
use decision::{grow_cracks, increments, life_step};
use life::Life;
use ppum::dataset::{Dataset, Step};
use ppum::progress::Watcher;
use ppum_problem::{GrowthRule, Problem, ProblemData};
use ppum_solve::watched::StepWatcher;
use settle::solve_step;
use std::collections::BTreeMap;
use std::convert::Infallible;
use step::{GrowthSeries, PreviousStep, end_series};

/// A series that has ended before its end.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GrowthError<E> {
    /// A step that cannot be solved.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// Nothing can be decided in the first step.
    #[error("growth: {0}")]
    Undecided(#[from] GrowthDataError),
    /// The receiver of the steps has ended the series.
    #[error(transparent)]
    Kept(E),
}

/// The last step of a series that is to go on, and its number.
#[derive(Clone, Copy, Debug)]
pub struct ResumePoint<'s> {
    /// Its number, from 0.
    pub number: usize,
    /// The step, with its [`Growth`](ppum::dataset::Growth).
    pub step: &'s Step,
    /// The steps before it, without their fields, which a law of growth remembers; else none.
    pub earlier: &'s [Step],
}

/// Solves a problem whose cracks grow, and gives each step to `keep` as a dataset of its own when
/// it is complete: from the first, or from one after the last that there is.
///
/// A step is complete when it is known whether a next one can be solved. A call that is cancelled
/// gives it away before.
///
/// # Errors
/// A first step that cannot be solved; cancelled; those of `keep`.
pub fn grow<E>(
    problem: &Problem,
    last: Option<ResumePoint<'_>>,
    memory: Option<u64>,
    watcher: &dyn Watcher,
    mut keep: impl FnMut(Dataset) -> Result<(), E>,
) -> Result<(), GrowthError<E>> {
    let single = GrowthRule::new(0);
    let rule = problem.growth.as_ref().unwrap_or(&single);
    let series = GrowthSeries { rule, memory };
    let (mut number, mut current, mut before) = match start(problem, last)? {
        Some(start) => start,
        None => return Ok(()),
    };
    let mut life = life_so_far(rule, last)?;
    let mut done: Option<Dataset> = None;
    while number <= rule.steps {
        let here = StepWatcher { watcher, step: number };
        let plan = series.plan(&current, &here);
        if let Some(dataset) = done.take() {
            let (dataset, ends) = end_series(dataset, plan.as_ref().err());
            keep(dataset).map_err(GrowthError::Kept)?;
            if ends {
                return Ok(());
            }
        }
        let plan = plan?;
        let (cracks, dataset) = solve_step(plan, before.as_ref(), &series, &here)?;
        current = current.with_cracks(cracks);
        let growth_before = before.as_ref().map(|before| &before.growth);
        let (dataset, growth) =
            series.with_decision(&current, dataset, growth_before, &mut life)?;
        if growth.stop.is_some() || number == rule.steps {
            return keep(dataset).map_err(GrowthError::Kept);
        }
        let next = match grow_cracks(&current, &growth) {
            Ok(next) => next,
            Err(error) => {
                return keep(end_series(dataset, Some(&error)).0).map_err(GrowthError::Kept);
            }
        };
        before = Some(PreviousStep { problem: std::mem::replace(&mut current, next), growth });
        (done, number) = (Some(dataset), number + 1);
    }
    Ok(())
}

/// True if a series of one problem may go on as one of the other: they differ in nothing but names
/// and the number of steps.
#[must_use]
pub fn is_same_series(one: &Problem, other: &Problem) -> bool {
    let core = |problem: &Problem| {
        let growth = problem.growth.clone().map(|rule| GrowthRule { steps: 0, ..rule });
        let (title, text, files) = (String::new(), None, Vec::new());
        ProblemData { title, text, files, growth, ..problem.clone().into_data() }
    };
    core(one) == core(other)
}

/// All steps of a series in one dataset.
///
/// # Errors
/// See [`grow`].
pub fn series(
    problem: &Problem,
    memory: Option<u64>,
    watcher: &dyn Watcher,
) -> Result<Dataset, GrowthError<Infallible>> {
    let mut all: Option<Dataset> = None;
    let keep = |step: Dataset| {
        match &mut all {
            Some(all) => all.steps.extend(step.steps),
            None => all = Some(step),
        }
        Ok(())
    };
    grow(problem, None, memory, watcher, keep)?;
    Ok(all.expect("a series has a first step"))
}

/// Number and problem of the next step, and what was decided in the one before.
type NextStep = (usize, Problem, Option<PreviousStep>);

/// The next step; none if the series has ended.
fn start(problem: &Problem, last: Option<ResumePoint<'_>>) -> Result<Option<NextStep>, SolveError> {
    let Some(ResumePoint { number, step, .. }) = last else {
        return Ok(Some((0, problem.clone(), None)));
    };
    let going_on = step.growth.as_ref().filter(|growth| growth.stop.is_none());
    let Some(growth) = going_on.cloned() else { return Ok(None) };
    let problem = problem.with_cracks(step.cracks.clone());
    let next = grow_cracks(&problem, &growth)?;
    Ok(Some((number + 1, next, Some(PreviousStep { problem, growth }))))
}

/// The life of the cracks up to the last step.
fn life_so_far(rule: &GrowthRule, last: Option<ResumePoint<'_>>) -> Result<Life, GrowthDataError> {
    let mut life = Life::default();
    let (Some(law), Some(ResumePoint { step, earlier, .. })) = (&rule.law, last) else {
        return Ok(life);
    };
    let mut lengths = BTreeMap::new();
    for step in earlier.iter().chain([step]) {
        let Some(growth) = &step.growth else { continue };
        let strengths = growth.tips.iter().map(|row| (row.tip, row.k_eq));
        let found = life_step(rule, &step.cracks, &step.intensities, strengths);
        life.add(law, found, std::mem::replace(&mut lengths, increments(growth)))?;
    }
    Ok(life)
}
