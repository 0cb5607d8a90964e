//! From a problem to a dataset.

mod clock;
mod error;
mod estimate;
mod solution;

pub use crate::equilibrium::UnbalancedError;
pub use crate::geometry::Around;
pub use crate::linear::{EigenError, LinearError, Spectrum};
pub use error::SolveError;
pub use estimate::Estimate;

use crate::diagnostics::Case;
use crate::intensity::intensities_under;
use crate::norms::energy;
use crate::problem::Problem;
use crate::refine::n_crossed_twice;
use crate::report::{SolverReport, Unresolved};
use crate::space::{Space, discretise_within};
use crate::watched::Stage;
use clock::Clock;
use ppum::dataset::{Dataset, Step};
use ppum::field::Field;
use ppum::progress::{Phase, Watcher};
use solution::{Assembled, Solving, linear_solver};

/// Solves a problem: one step, one field. The watcher is told how far the work has come.
///
/// The coefficients belong to the plain functions; neither the transformed basis nor what it cut
/// off is seen in the dataset. Results do not depend on the number of threads. The step's history is a
/// [`SolverReport`].
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
    let plan = Plan::new(problem, None, watcher)?;
    let solving = plan.solving(watcher);
    let (given, plate) = solving.loaded()?;
    let Assembled { system, .. } = solving.assemble(&given, &plate, &mut Clock::new())?;
    let stage = Stage::uncounted(watcher, Phase::Solution)?;
    let solver = linear_solver(&system.matrix).map_err(SolveError::Factor)?;
    Spectrum::new(&system.matrix, &solver, &|| Ok(stage.advance(0)?))
}

/// A problem whose cover and functions are known, and with them what its solution takes.
///
/// ```
/// use ppum::progress::unwatched;
/// use ppum::vec2::{Rect, vec2};
/// use ppum_solve::problem::{Cells, Condition, Discretization, Edge, Problem};
/// use ppum_solve::solve::{Plan, SolveError};
///
/// let domain = Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0));
/// let plate = |level| {
///     Problem::poisson(domain, 1.0, Discretization::new(Cells::Level(level)))
///         .with_boundary(Edge::Left, vec![Condition::Dirichlet(0.0.into())])
/// };
/// let (small, large) = (plate(3), plate(10));
/// let memory = Some(1 << 30);
/// let plan = Plan::new(&small, memory, unwatched())?;
/// assert_eq!(plan.estimate().patches, 64.0);
/// plan.check(unwatched())?;
/// let refused = Plan::new(&large, memory, unwatched());
/// assert!(matches!(refused, Err(SolveError::TooLarge { .. })));
/// # Ok::<(), SolveError>(())
/// ```
pub struct Plan<'p> {
    problem: &'p Problem,
    /// The dataset with all coefficients zero.
    dataset: Dataset,
    /// The space of its step: the only one from here to the last warning.
    space: Space<'p>,
    estimate: Estimate,
    /// Number of patches that a crack or rim crosses twice.
    crossed_twice: usize,
    clock: Clock,
}

impl<'p> Plan<'p> {
    /// The plan of a problem, whose solution may take so much memory \[bytes\].
    ///
    /// # Errors
    /// A space that cannot be built, functions that are not finite, a solution that takes more memory or could not
    /// be stored; cancelled.
    pub fn new(
        problem: &'p Problem,
        memory: Option<u64>,
        watcher: &dyn Watcher,
    ) -> Result<Self, SolveError> {
        let mut clock = Clock::new();
        let stage = Stage::uncounted(watcher, Phase::Cover)?;
        fits(Estimate::least(problem), memory)?;
        let most = memory.map_or(usize::MAX, |memory| Estimate::most_cells(problem, memory));
        let step = discretise_within(problem, most, &stage)?;
        let crossed_twice = n_crossed_twice(problem, &step.partition);
        let dataset = dataset(problem, step.clone());
        dataset.check()?;
        stage.advance(0)?;
        let space = Space::of_problem(problem, step)?;
        let estimate = fits(Estimate::of_space(problem, &space), memory)?;
        clock.lap(Phase::Cover);
        Ok(Self { problem, dataset, space, estimate, crossed_twice, clock })
    }

    /// The effort of the solution.
    #[must_use]
    pub fn estimate(&self) -> &Estimate {
        &self.estimate
    }

    /// The dataset before the solution is known: all coefficients are zero.
    #[must_use]
    pub fn dataset(&self) -> &Dataset {
        &self.dataset
    }

    /// Looks whether the loads on each piece of the plate balance, or something holds it. That takes their
    /// integrals, and no system.
    ///
    /// # Errors
    /// Loads without restraint, data that are not finite; cancelled.
    pub fn check(&self, watcher: &dyn Watcher) -> Result<(), SolveError> {
        self.solving(watcher).loaded().map(drop)
    }

    /// Solves the problem.
    ///
    /// # Errors
    /// See [`SolveError`].
    pub fn solve(mut self, watcher: &dyn Watcher) -> Result<Dataset, SolveError> {
        let Self { problem, ref space, .. } = self;
        let solving = Solving { problem, space, watcher };
        let mut solution = solving.solution(&mut self.clock)?;
        solution.store(&mut self.dataset.steps[0]);
        self.finish(solution.report, &solution.unresolved, watcher)
    }

    fn solving<'a>(&'a self, watcher: &'a dyn Watcher) -> Solving<'a> {
        Solving { problem: self.problem, space: &self.space, watcher }
    }

    /// The dataset of a solution with its stress intensity factors, its diagnosis and its report.
    fn finish(
        self,
        mut report: SolverReport,
        unresolved: &[Unresolved],
        watcher: &dyn Watcher,
    ) -> Result<Dataset, SolveError> {
        let Self { problem, mut dataset, ref space, crossed_twice, mut clock, .. } = self;
        let field = Field::new(&dataset, 0)?;
        report.crossed_twice = Some(crossed_twice as f64);
        report.energy = Some(energy(&field, space));
        let problem = Some(problem);
        let tips = intensities_under(problem, &dataset, &field, space, watcher)?;
        let diagnosis = {
            let (dataset, field, report) = (&dataset, &field, &report);
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

/// The estimate, if what it needs is there.
fn fits(needs: Estimate, memory: Option<u64>) -> Result<Estimate, SolveError> {
    match memory {
        Some(memory) if needs.memory > memory as f64 => Err(SolveError::TooLarge { needs, memory }),
        _ => Ok(needs),
    }
}

fn dataset(problem: &Problem, step: Step) -> Dataset {
    let mut dataset =
        Dataset::new(problem.domain.clone(), problem.equation.clone()).with_step(step);
    dataset.title.clone_from(&problem.title);
    dataset.program = concat!("ppum ", env!("CARGO_PKG_VERSION")).into();
    dataset.problem.clone_from(&problem.text);
    dataset.quantities.clone_from(&problem.quantities);
    dataset.tables.clone_from(&problem.tables);
    dataset
}
