//! Diagnostics: findings about a solution that do not make it wrong to have, but wrong to
//! trust unread.
//!
//! Each is a [`Warning`] with a word for its kind, a place, the number that gave rise to it and the
//! bound that it passes. [`solve()`](crate::solve::solve) stores them in the dataset; [`recompute`]
//! finds them again from a dataset, with the stress intensity factors.

mod corners;
mod digits;
mod faces;
mod interfaces;
mod locking;
mod pressure;
mod report;
mod rims;
mod tips;
mod warning;

pub use digits::{FEW_DIGITS, GradientRounding, rounding};

use crate::error::SolveError;
use crate::intensity::{LoadCase, TipResult, intensities_by, with_cells};
use corners::of_corners;
use digits::of_digits;
use faces::of_faces;
use interfaces::of_interfaces;
use locking::locking;
use ppum::dataset::{Dataset, Warning, WarningKind};
use ppum::field::{Field, FieldError};
use ppum::progress::{Phase, Watcher};
use ppum::text::LocationText;
use ppum_problem::Problem;
use ppum_problem::geometry::known_points;
use ppum_solve::law::{Law, Temperature};
use ppum_solve::norms::energy;
use ppum_solve::report::{SolverReport, UnresolvedIntegrand};
use ppum_solve::space::TrialSpace;
use ppum_solve::watched::WorkPhase;
use pressure::of_pressure;
use report::{Cutters, of_report};
use rims::of_rims;
use tips::of_tips;
use warning::{
    LARGE_ERROR, LARGE_LOCKING, above, percent, short, smaller_cells, unresolved_function,
};

/// A field that is to be diagnosed, the first of its step.
pub(crate) struct DiagnosedField<'a> {
    pub(crate) field: &'a Field<'a>,
    pub(crate) space: &'a TrialSpace<'a>,
    /// The temperature that strains the body, if one does.
    pub(crate) temperature: Option<&'a Temperature>,
    /// The problem that it solves, if that is known.
    pub(crate) problem: Option<&'a Problem>,
    pub(crate) report: &'a SolverReport,
}

/// The findings about a solution.
pub(crate) struct Diagnosis {
    pub(crate) warnings: Vec<Warning>,
    /// The relative rounding error of stresses, see [`rounding`].
    pub(crate) rounding: f64,
}

/// The stress intensity factors of a step's first field, and the warnings about it. `problem` is
/// what it solves, on the cracks of the step: its loads act near the tips. Without one none do.
///
/// # Errors
/// A step that is not there, functions that do not compile; cancelled, within the time of one cell.
pub fn recompute(
    dataset: &Dataset,
    step: usize,
    problem: Option<&Problem>,
    watcher: &dyn Watcher,
) -> Result<(Vec<TipResult>, Vec<Warning>), SolveError> {
    Field::new(dataset, step)?;
    let has_cells = dataset.steps[step].partition.boxes().has_cells();
    let (cells, number) = with_cells(dataset, step)?;
    let split = Temperature::split(&cells, number)?;
    let (dataset, step) = split.as_ref().map_or((&*cells, number), |(plain, _)| (plain, 0));
    let temperature = split.as_ref().map(|(_, heat)| heat);
    let field = &Field::new(dataset, step)?;
    let space = &space_of(field)?;
    let loads = LoadCase { problem, factor: field.step.load };
    let law = &Law::new(&dataset.equation).heated(temperature);
    let tips = intensities_by(law, dataset, field, space, &loads, watcher)?;
    // what else is warned of is found cell by cell
    if !has_cells {
        let places = LocationText::new(&field.domain.bounds, &field.step.cracks);
        let warnings = of_tips(problem, &tips, &field.step.cracks, &places);
        return Ok((tips, warnings));
    }
    let report = &SolverReport::of(&field.step.history);
    let case = DiagnosedField { field, space, temperature, problem, report };
    let Diagnosis { warnings, .. } = case.diagnose(&tips, watcher)?;
    Ok((tips, warnings))
}

fn space_of<'a>(field: &Field<'a>) -> Result<TrialSpace<'a>, FieldError> {
    Ok(TrialSpace::new(field.step, field.domain, field.equation, field.tables)?)
}

impl DiagnosedField<'_> {
    /// The findings about the solution and its tips.
    ///
    /// # Errors
    /// Functions that do not compile; cancelled.
    pub(crate) fn diagnose(
        &self,
        tips: &[TipResult],
        watcher: &dyn Watcher,
    ) -> Result<Diagnosis, SolveError> {
        let Self { field, space, temperature, .. } = *self;
        let stage = WorkPhase::uncounted(watcher, Phase::Estimation)?;
        let law = &Law::new(field.equation).heated(temperature);
        let places = LocationText::new(&field.domain.bounds, &field.step.cracks);
        let cutters = Cutters::new(field.step, field.domain);
        let adaptivity = self.problem.and_then(|problem| problem.adaptivity.as_ref());
        let rounding = rounding(field)?;
        let mut warnings = Vec::new();
        let is_strained = !rounding.is_all();
        if is_strained {
            warnings.extend(of_tips(self.problem, tips, &field.step.cracks, &places));
            warnings.extend(of_faces(field, self.problem, &places));
        }
        stage.advance(0)?;
        // an adaptation has looked for itself how small cells should be
        let guided = self.problem.filter(|problem| is_strained && problem.adaptivity.is_none());
        let energy = self.report.energy.filter(|energy| energy.is_finite());
        if let Some((problem, energy)) = guided.zip(energy) {
            warnings.extend(of_corners(problem, field, space, energy, &places));
        }
        stage.advance(0)?;
        warnings.extend(of_rims(field, self.problem, &places));
        stage.advance(0)?;
        warnings.extend(of_interfaces(field, law, space, &places));
        warnings.extend(of_report(self.report, adaptivity, cutters));
        stage.advance(0)?;
        warnings.extend(of_digits(rounding, cutters, &places));
        stage.advance(0)?;
        // shear near singular points stores as much as bending that locks
        if known_points(&field.step.functions).next().is_none() {
            warnings.extend(of_locking(field, space));
        }
        warnings.extend(of_pressure(field, law));
        warnings.extend(of_quadrature(&self.report.unresolved, &places));
        warnings.extend(self.of_temperature(&warnings, watcher)?);
        Ok(Diagnosis { warnings, rounding: rounding.largest })
    }

    /// The warnings about the temperature that strains the body, if it is solved for; without those
    /// about the cells, which are `known` of the body.
    fn of_temperature(
        &self,
        known: &[Warning],
        watcher: &dyn Watcher,
    ) -> Result<Vec<Warning>, SolveError> {
        let problem = self.problem.and_then(Problem::heat);
        let Some((heat, problem)) = self.temperature.zip(problem) else {
            return Ok(Vec::new());
        };
        let dataset = &heat.potential(&problem.equation);
        let field = &Field::new(dataset, 0)?;
        let space = &space_of(field)?;
        let report = &SolverReport { energy: Some(energy(field, space)), ..heat.report.clone() };
        let (temperature, problem) = (None, Some(problem));
        let case = DiagnosedField { field, space, temperature, problem, report };
        let found = case.diagnose(&[], watcher)?.warnings.into_iter();
        // its values strain the body; what digits its gradient has does not matter
        let found = found.filter(|new| new.kind != WarningKind::Digits && !known.contains(new));
        Ok(found.map(of_heat).collect())
    }
}

/// The warning about an order too low for a body that hardly changes its volume.
fn of_locking(field: &Field<'_>, space: &TrialSpace<'_>) -> Option<Warning> {
    let lost = locking(field, space);
    let message = format!(
        "the plate is nearly incompressible, and polynomials of this order make it too stiff: about {} % of the \
         energy is error; use order = 4 or more (4 is taken if `order` is left out), or smaller cells",
        short((1e4 * lost).round() / 1e2)
    );
    above(WarningKind::Locking, None, [lost, LARGE_LOCKING], message)
}

/// The warning about a temperature that is solved for, in a dataset of the body that it strains.
fn of_heat(found: Warning) -> Warning {
    let kind = WarningKind::OfTemperature(Box::new(found.kind));
    let message = format!("the temperature: {}", found.message);
    Warning { kind, message, ..found }
}

/// The warnings about what quadrature does not resolve.
fn of_quadrature(unresolved: &[UnresolvedIntegrand], places: &LocationText) -> Vec<Warning> {
    let large = unresolved.iter().filter(|found| found.error.is_nan() || found.error > LARGE_ERROR);
    let warning = |UnresolvedIntegrand { load, error, at }: &UnresolvedIntegrand| {
        let place = places.show(*at);
        let (kind, message) = match load {
            Some(load) => (
                WarningKind::Load,
                format!(
                    "{load} varies too fast, or grows without bound, around {place}: its resultant is off by about \
                     {error:.1e} of its magnitude; use a formula that can be integrated there, or smaller cells"
                ),
            ),
            None => (WarningKind::Quadrature, unresolved_function(&place, "there ", *error)),
        };
        Warning::new(kind, Some(*at), [*error, LARGE_ERROR], message)
    };
    large.map(warning).collect()
}
