//! A solution with its estimated error, and what is made of it.

use super::{Plan, SolveError};
use crate::adapt::estimated_squares;
use crate::diagnostics::Case;
use crate::intensity::intensities_under;
use crate::norms::energy;
use crate::report::{SolverReport, Stop, Unresolved};
use crate::watched::Stage;
use ppum::dataset::{Attribute, Dataset};
use ppum::field::Field;
use ppum::progress::{Phase, Watcher};

/// A plan whose dataset has its coefficients.
pub(super) struct Solved<'p> {
    pub(super) plan: Plan<'p>,
    pub(super) report: SolverReport,
    /// Integrands that quadrature did not resolve.
    pub(super) unresolved: Vec<Unresolved>,
    /// The squares of the estimated error, cell by cell.
    pub(super) squares: Vec<f64>,
}

impl Solved<'_> {
    /// Finds the energy and the estimated error. The attribute `indicator` is η_j / ‖u‖ in the energy norm: the
    /// root of the sum of its squares is the estimated error.
    pub(super) fn estimate(&mut self, watcher: &dyn Watcher) -> Result<(), SolveError> {
        let Plan { problem, dataset, space, clock, .. } = &mut self.plan;
        let stage = Stage::new(watcher, Phase::Estimation, 2 * space.partition().len())?;
        let field = Field::new(dataset, 0)?;
        let energy = energy(&field, space);
        self.squares =
            estimated_squares(problem, &field, space, &stage).map_err(SolveError::of_data)?;
        self.report.energy = Some(energy);
        // nothing is a part of no energy
        if energy > 0.0 {
            let parts = self.squares.iter().map(|square| square / (2.0 * energy));
            self.report.estimated_error = Some(parts.clone().sum::<f64>().sqrt());
            let values = parts.map(f64::sqrt).collect();
            dataset.steps[0].attributes.push(Attribute { name: "indicator".into(), values });
        }
        clock.lap(Phase::Estimation);
        Ok(())
    }

    /// The dataset of a solution with its stress intensity factors, its diagnosis and its report; of the last step of
    /// an adaptation with what has ended it.
    pub(super) fn finish(
        self,
        stop: Option<Stop>,
        watcher: &dyn Watcher,
    ) -> Result<Dataset, SolveError> {
        let Self { plan, mut report, unresolved, .. } = self;
        let Plan { problem, mut dataset, ref space, crossed_twice, mut clock, .. } = plan;
        let field = Field::new(&dataset, 0)?;
        report.crossed_twice = Some(crossed_twice as f64);
        report.stop = stop.map(Stop::code);
        let problem = Some(problem);
        let tips = intensities_under(problem, &dataset, &field, space, watcher)?;
        let diagnosis = {
            let (dataset, field, report) = (&dataset, &field, &report);
            let unresolved = &unresolved;
            let case = Case { dataset, step: 0, field, space, problem, report, unresolved };
            case.diagnose(&tips, watcher)?
        };
        clock.lap(Phase::Intensity);
        report.rounding = Some(diagnosis.rounding);
        report.seconds = clock.seconds;
        let step = &mut dataset.steps[0];
        step.intensities = tips.into_iter().filter_map(|outcome| outcome.factors).collect();
        step.warnings = diagnosis.warnings;
        step.history = report.records();
        Ok(dataset)
    }
}
