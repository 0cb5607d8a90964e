//! A step of a series: its plan, what is decided with it, and whether the series ends there.

use super::decision::{GrowthDataError, decide};
use super::life::Life;
use crate::solve::{Plan, SolveError};
use ppum::dataset::{Dataset, Growth, GrowthStop, Record, Step, Warning, WarningKind};
use ppum::progress::Watcher;
use ppum_problem::{GrowthRule, Problem};
use ppum_solve::report::ENERGIES;

/// A step that has been solved: its problem, and what was decided.
pub(super) struct PreviousStep {
    pub(super) problem: Problem,
    pub(super) growth: Growth,
}

/// A series on its way.
pub(super) struct GrowthSeries<'a> {
    pub(super) rule: &'a GrowthRule,
    pub(super) memory: Option<u64>,
}

/// A step that is complete, and whether the series ends with it because of what the next one meets.
pub(super) fn end_series(mut dataset: Dataset, obstacle: Option<&SolveError>) -> (Dataset, bool) {
    let (stop, message) = match obstacle {
        None | Some(SolveError::Cancelled(_)) => return (dataset, false),
        Some(error @ SolveError::Unbalanced(_)) => (GrowthStop::PieceComesOff, error.to_string()),
        Some(error) => (GrowthStop::Unsolvable, error.to_string()),
    };
    dataset.steps[0].growth.iter_mut().for_each(|growth| growth.stop = Some(stop));
    dataset.steps[0].warnings.push(ending(stop, &message));
    (dataset, true)
}

/// The warning that a series ends before its end.
fn ending(stop: GrowthStop, message: &str) -> Warning {
    let message = format!("growth ends here, {}: {message}", stop.words());
    Warning::new(WarningKind::Growth, None, [0.0; 2], message)
}

impl GrowthSeries<'_> {
    /// The plan of a problem whose loads balance.
    pub(super) fn plan<'p>(
        &'p self,
        problem: &'p Problem,
        watcher: &dyn Watcher,
    ) -> Result<Plan<'p>, SolveError> {
        let plan = Plan::new(problem, self.memory, watcher)?;
        plan.check(watcher)?;
        Ok(plan)
    }

    /// The dataset of a step under its load, with what is decided in it: if nothing can be, the end
    /// of the series.
    ///
    /// # Errors
    /// Nothing can be decided in the first step.
    pub(super) fn with_decision(
        &self,
        problem: &Problem,
        mut dataset: Dataset,
        before: Option<&Growth>,
        life: &mut Life,
    ) -> Result<(Dataset, Growth), GrowthDataError> {
        let step = &mut dataset.steps[0];
        let decision = decide(problem, self.rule, &step.intensities, before, life);
        let (growth, load) = match (decision, before) {
            (Err(error), Some(Growth { cycles, .. })) => {
                let stop = GrowthStop::Unsolvable;
                step.warnings.push(ending(stop, &error.to_string()));
                let mut growth = Growth::default();
                (growth.cycles, growth.stop) = (*cycles, Some(stop));
                (growth, 1.0)
            }
            (decision, _) => decision?,
        };
        scale_loads(step, load);
        step.growth = Some(growth.clone());
        Ok((dataset, growth))
    }
}

/// The step under a multiple of its loads.
fn scale_loads(step: &mut Step, load: f64) {
    step.load *= load;
    if load == 1.0 {
        return;
    }
    for field in &mut step.fields {
        field.coefficients.iter_mut().flatten().for_each(|c| *c *= load);
    }
    for tip in &mut step.intensities {
        let rings = tip.rings.iter_mut().flat_map(|ring| [&mut ring.k1, &mut ring.k2]);
        let factors = [&mut tip.k1, &mut tip.k2].into_iter().chain(rings);
        factors.chain(&mut tip.t_stress).chain(&mut tip.error).for_each(|k| *k *= load);
        tip.j.iter_mut().for_each(|j| *j *= load * load);
    }
    for reaction in &mut step.reactions {
        reaction.force.iter_mut().for_each(|force| *force *= load);
        reaction.moment *= load;
    }
    let is_energy = |record: &&mut Record| ENERGIES.contains(&record.name.as_str());
    let energies = step.history.iter_mut().filter(is_energy);
    energies.for_each(|record| record.value *= load * load);
}
