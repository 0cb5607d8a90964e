//! Diagnostics: findings about a solution that do not make it wrong to have, but wrong to
//! trust unread.
//!
//! Each is a [`Warning`] with a word for its kind, a place, the number that gave rise to it and the
//! bound that it passes. [`solve()`](crate::solve::solve) stores them in the dataset; [`recompute`]
//! finds them again from a dataset, with the stress intensity factors.

mod corners;
mod curves;
mod digits;
mod faces;
mod interfaces;
mod locking;
mod pressure;
mod report;
mod rims;
mod tips;
mod warning;

pub(crate) use curves::error_of_segments;
pub use digits::{FEW_DIGITS, GradientRounding, rounding};
pub use warning::{
    LARGE_CUT_OFF, LARGE_ERROR, LARGE_IMBALANCE, LARGE_LOCKING, LARGE_NITSCHE, LARGE_RESIDUAL,
};

use crate::intensity::{LoadCase, TipResult, intensities_by, with_cells};
use corners::of_corners;
use digits::of_digits;
use faces::of_faces;
use interfaces::of_interfaces;
use locking::locking;
use ppum::dataset::{Dataset, Warning, WarningKind};
use ppum::field::{Field, FieldError};
use ppum::progress::{Cancelled, Phase, Watcher};
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
use warning::{short, smaller_cells, warning};

/// A solution that is to be diagnosed.
pub(crate) struct DiagnosedSolution<'a> {
    pub(crate) dataset: &'a Dataset,
    /// Number of the step.
    pub(crate) step: usize,
    /// The first field of the step.
    pub(crate) field: &'a Field<'a>,
    pub(crate) space: &'a TrialSpace<'a>,
    pub(crate) law: &'a Law<'a>,
    /// The temperature that strains the body, if one does.
    pub(crate) temperature: Option<&'a Temperature>,
    /// The problem that it solves, if that is known.
    pub(crate) problem: Option<&'a Problem>,
    pub(crate) report: &'a SolverReport,
    /// Integrands of the system that were not resolved.
    pub(crate) unresolved: &'a [UnresolvedIntegrand],
}

/// The findings about a solution.
pub(crate) struct Diagnosis {
    pub(crate) warnings: Vec<Warning>,
    /// The relative rounding error of stresses, see [`rounding`].
    pub(crate) rounding: f64,
}

/// A dataset whose factors and warnings cannot be found again.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecomputeError {
    /// Its functions do not compile, or there is no such step.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// The watcher wanted the work to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
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
) -> Result<(Vec<TipResult>, Vec<Warning>), RecomputeError> {
    Field::new(dataset, step)?;
    let has_cells = dataset.steps[step].partition.boxes().has_cells();
    let (cells, number) = with_cells(dataset, step)?;
    let (dataset, step) = (&*cells, number);
    match Temperature::split(dataset, step)? {
        Some((plain, heat)) => {
            recompute_plain((&plain, 0, has_cells), Some(heat), problem, watcher)
        }
        None => recompute_plain((dataset, step, has_cells), None, problem, watcher),
    }
}

/// Recomputes the factors and warnings of a displacement, in a body that a temperature may strain.
fn recompute_plain(
    (dataset, step, has_cells): (&Dataset, usize, bool),
    heat: Option<Temperature>,
    problem: Option<&Problem>,
    watcher: &dyn Watcher,
) -> Result<(Vec<TipResult>, Vec<Warning>), RecomputeError> {
    let field = Field::new(dataset, step)?;
    let Dataset { domain, equation, tables, .. } = dataset;
    let space = TrialSpace::new(field.step, domain, equation, tables).map_err(FieldError::from)?;
    let law = &Law::new(equation).heated(heat.as_ref());
    let loads = LoadCase { problem, factor: field.step.load };
    let tips = intensities_by(law, dataset, &field, &space, &loads, watcher)?;
    // what else is warned of is found cell by cell
    if !has_cells {
        let places = LocationText::new(&domain.bounds, &field.step.cracks);
        let warnings = of_tips(problem, &tips, &field.step.cracks, &places);
        return Ok((tips, warnings));
    }
    let report = &SolverReport::of(&field.step.history);
    let (field, space, temperature, unresolved) = (&field, &space, heat.as_ref(), &[]);
    let case = DiagnosedSolution {
        dataset,
        step,
        field,
        space,
        law,
        temperature,
        problem,
        report,
        unresolved,
    };
    let Diagnosis { warnings, .. } = case.diagnose(&tips, watcher)?;
    Ok((tips, warnings))
}

impl DiagnosedSolution<'_> {
    /// The findings about the solution and its tips.
    ///
    /// # Errors
    /// Functions that do not compile; cancelled.
    pub(crate) fn diagnose(
        &self,
        tips: &[TipResult],
        watcher: &dyn Watcher,
    ) -> Result<Diagnosis, RecomputeError> {
        let Self { dataset, field, space, law, .. } = *self;
        let stage = WorkPhase::uncounted(watcher, Phase::Estimation)?;
        let places = LocationText::new(&dataset.domain.bounds, &field.step.cracks);
        let cutters = Cutters::new(field.step, &dataset.domain);
        let adaptivity = self.problem.and_then(|problem| problem.adaptivity.as_ref());
        let rounding = rounding(dataset, self.step)?;
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
            warnings.extend(of_corners(problem, field, space, (energy, &places)));
        }
        stage.advance(0)?;
        warnings.extend(of_rims(field, &dataset.domain.holes, self.problem, &places));
        stage.advance(0)?;
        warnings.extend(of_interfaces((field, law), (dataset, space), &places));
        warnings.extend(of_report(self.report, adaptivity, cutters));
        stage.advance(0)?;
        warnings.extend(of_digits(rounding, cutters, &places));
        stage.advance(0)?;
        // shear near singular points stores as much as bending that locks
        if known_points(&field.step.functions).next().is_none() {
            warnings.extend(of_locking(field, space));
        }
        warnings.extend(of_pressure(field, law));
        warnings.extend(of_quadrature(self.unresolved, &places));
        warnings.extend(self.of_temperature(&warnings, watcher)?);
        Ok(Diagnosis { warnings, rounding: rounding.largest })
    }

    /// The warnings about the temperature that strains the body, if it is solved for; without those
    /// about the cells, which are `known` of the body.
    fn of_temperature(
        &self,
        known: &[Warning],
        watcher: &dyn Watcher,
    ) -> Result<Vec<Warning>, RecomputeError> {
        let problem = self.problem.and_then(Problem::heat);
        let Some((heat, problem)) = self.temperature.zip(problem) else {
            return Ok(Vec::new());
        };
        let dataset = &heat.potential(&problem.equation);
        let field = &Field::new(dataset, 0)?;
        let Dataset { domain, equation, tables, .. } = dataset;
        let space =
            &TrialSpace::new(field.step, domain, equation, tables).map_err(FieldError::from)?;
        let report = &SolverReport { energy: Some(energy(field, space)), ..heat.report.clone() };
        let (problem, unresolved) = (Some(problem), heat.unresolved.as_slice());
        let case = DiagnosedSolution {
            dataset,
            step: 0,
            field,
            space,
            law: &Law::new(equation),
            temperature: None,
            problem,
            report,
            unresolved,
        };
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
    (lost > LARGE_LOCKING)
        .then(|| warning(WarningKind::Locking, None, [lost, LARGE_LOCKING], message))
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
    let warning = |found: &UnresolvedIntegrand| {
        let UnresolvedIntegrand { load, error, at } = found;
        let kind = if load.is_some() { WarningKind::Load } else { WarningKind::Quadrature };
        warning(
            kind,
            Some(*at),
            [*error, LARGE_ERROR],
            unresolved_text(load.as_deref(), *error, &places.show(*at)),
        )
    };
    large.map(warning).collect()
}

fn unresolved_text(load: Option<&str>, error: f64, at: &str) -> String {
    match load {
        Some(load) => format!(
            "{load} varies too fast, or grows without bound, around {at}: its resultant is off by about {error:.1e} \
             of its magnitude; use a formula that can be integrated there, or smaller cells"
        ),
        None => format!(
            "a function or a coefficient varies too fast around {at}: integrals over a piece of a cell there are \
             off by about {error:.1e}; use smaller cells there, or a smoother formula"
        ),
    }
}
