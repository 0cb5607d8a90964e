//! A solution with its estimated error, and what is made of it.

use super::SolveError;
use super::goal::FactorErrors;
use super::plan::Plan;
use super::solved::Solved;
use crate::diagnostics::DiagnosedField;
use ppum::dataset::{Attribute, Dataset, TipIntensity};
use ppum::field::Field;
use ppum::progress::{Phase, Watcher};
use ppum_solve::adapt::{ErrorEstimate, LocalFields, estimated};
use ppum_solve::law::Law;
use ppum_solve::norms::energy;
use ppum_solve::report::StopReason;
use ppum_solve::space::TrialSpace;
use ppum_solve::terms::known_fields;
use ppum_solve::watched::WorkPhase;

/// Part of the largest [energy scale](crate::intensity::TipResult::energy_scale) of a tip below
/// which factors count as nothing, and are no measure of their errors.
const NOTHING: f64 = 1e-2;

/// Part of the energy that a field of the same size could have up to which the energy is rounding:
/// of rigid motions.
const ROUNDING: f64 = 1e-20;

/// A solution whose errors are estimated.
pub(super) struct Diagnosed<'p> {
    pub(super) solved: Solved<'p>,
    /// The squares of the estimated error, cell by cell.
    pub(super) squares: Vec<f64>,
    goal: FactorErrors,
}

/// The largest estimated error of the factors of a tip, as a part of their size; without tips that
/// of the energy.
pub(super) struct GoalError {
    pub(super) largest: f64,
    /// The part of each cell in the sum of all.
    pub(super) cells: Vec<f64>,
}

impl<'p> Diagnosed<'p> {
    /// Finds the energy and the estimated errors of a solution and its factors.
    ///
    /// # Errors
    /// Data that are not finite; cancelled.
    pub(super) fn new(mut solved: Solved<'p>, watcher: &dyn Watcher) -> Result<Self, SolveError> {
        let Solved { plan, temperature, report, local, sole_support, discs, contact, tips } =
            &mut solved;
        let Plan { problem, dataset, space, clock, .. } = plan;
        let stage = WorkPhase::new(watcher, Phase::Estimation, 2 * space.partition().len())?;
        let field = Field::new(dataset, 0)?;
        let law = &Law::new(&problem.equation).heated(temperature.as_ref());
        let coefficients = std::mem::take(local);
        let fields = LocalFields { space, law, coefficients: &coefficients, sole_support };
        let found = estimated(problem, &field, fields, &stage).map_err(SolveError::of_data)?;
        let cells = &space.partition().cell;
        let goal = FactorErrors::new(discs, cells, &found.products, contact, tips);
        let factors = tips.iter_mut().filter_map(|outcome| outcome.factors.as_mut());
        for (factors, error) in factors.zip(&goal.errors) {
            factors.error = Some(*error);
        }
        let ErrorEstimate { mut energy, squares, .. } = found;
        if known_fields(problem).is_empty() {
            report.energy = Some(energy);
            report.whole_energy = problem.images().map(|images| images * energy);
        } else {
            report.energy = Some(f64::INFINITY);
            energy = energy_of_unknowns(dataset, space)?;
        }
        if !energy.is_finite() {
            return Err(SolveError::Overflow);
        }
        clock.lap(Phase::Estimation);
        // nothing is a part of no energy, or of one that is rounding
        if energy > ROUNDING * energy_of_size(&field) {
            report.estimated_error = Some((squares.iter().sum::<f64>() / (2.0 * energy)).sqrt());
            dataset.steps[0].attributes.push(indicator(&squares, energy));
        }
        let mut diagnosed = Self { solved, squares, goal };
        if !diagnosed.goal.errors.is_empty() {
            diagnosed.solved.report.factor_error = Some(diagnosed.goal().largest);
        }
        Ok(diagnosed)
    }

    /// The estimated error that an accuracy bounds.
    pub(super) fn goal(&self) -> GoalError {
        let Solved { report, tips, .. } = &self.solved;
        let factors = tips.iter().filter_map(|outcome| outcome.factors.as_ref());
        let scales = tips.iter().filter(|outcome| outcome.factors.is_some());
        let largest = scales.fold(0.0_f64, |most, outcome| most.max(outcome.energy_scale));
        if largest == 0.0 {
            let largest = report.estimated_error.unwrap_or(0.0).powi(2);
            return GoalError { largest, cells: self.squares.clone() };
        }
        let sizes: Vec<f64> = factors.map(size).collect();
        let relative = |tip: usize, error: f64| error / sizes[tip].max(NOTHING * largest);
        let errors = self.goal.errors.iter().enumerate().map(|(tip, error)| relative(tip, *error));
        let cells = self.goal.cells.iter().map(|(tip, part)| relative(*tip, *part));
        GoalError { largest: errors.fold(0.0, f64::max), cells: cells.collect() }
    }

    /// The dataset of a solution with its stress intensity factors, its diagnosis and its report;
    /// of the last step of an adaptation with what has ended it.
    pub(super) fn dataset(
        self,
        stop: Option<StopReason>,
        watcher: &dyn Watcher,
    ) -> Result<Dataset, SolveError> {
        let Solved { plan, temperature, mut report, tips, .. } = self.solved;
        let Plan { problem, mut dataset, ref space, crossed_twice, mut clock, .. } = plan;
        let (field, temperature) = (&Field::new(&dataset, 0)?, temperature.as_ref());
        report.crossed_twice = Some(crossed_twice as u64);
        report.stop = stop;
        let case =
            DiagnosedField { field, space, temperature, problem: Some(problem), report: &report };
        let diagnosis = case.diagnose(&tips, watcher)?;
        clock.lap(Phase::Estimation);
        report.rounding = Some(diagnosis.rounding);
        report.seconds = clock.seconds;
        let step = &mut dataset.steps[0];
        step.intensities = tips.into_iter().filter_map(|outcome| outcome.factors).collect();
        step.warnings = diagnosis.warnings;
        step.history = report.records();
        match temperature {
            Some(temperature) => {
                let dataset = temperature.joined(dataset, &problem.quantities);
                dataset.check()?;
                Ok(dataset)
            }
            None => Ok(dataset),
        }
    }
}

/// |(K_I, K_II)|
fn size(tip: &TipIntensity) -> f64 {
    tip.k1.hypot(tip.k2)
}

/// The energy of a field without its known part.
fn energy_of_unknowns(dataset: &Dataset, space: &TrialSpace<'_>) -> Result<f64, SolveError> {
    let mut rest = dataset.clone();
    for patch in 0..space.partition().len() {
        for component in rest.steps[0].fields[0].coefficients_mut(patch) {
            space.known(patch).iter().for_each(|known| component[known.stored] = 0.0);
        }
    }
    Ok(energy(&Field::new(&rest, 0)?, space))
}

/// A modulus times the square of the largest coefficient.
fn energy_of_size(field: &Field<'_>) -> f64 {
    let all = field.data.coefficients.iter().flatten();
    let largest = all.fold(0.0_f64, |most, c| most.max(c.abs()));
    let law = Law::new(field.equation).at(field.step.partition.boxes().center[0]);
    law.modulus(0) * largest * largest
}

/// The attribute `indicator`, η_j / ‖u‖ in the energy norm: the root of the sum of its squares is
/// the estimated error.
fn indicator(squares: &[f64], energy: f64) -> Attribute {
    let values = squares.iter().map(|square| (square / (2.0 * energy)).sqrt()).collect();
    Attribute { name: "indicator".into(), values }
}
