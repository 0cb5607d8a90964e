//! From a problem to a dataset.

mod adaptive;
mod chosen;
mod clock;
mod error;
mod estimate;
mod goal;
mod solution;
mod solved;

pub use crate::equilibrium::UnbalancedError;
pub use crate::geometry::Around;
pub use crate::linear::{EigenError, LinearError, Spectrum};
pub use error::SolveError;
pub use estimate::Estimate;

use crate::linear::Cholesky;
use crate::problem::Problem;
use crate::refine::n_crossed_twice;
use crate::space::{Mesh, Space, discretise_on};
use crate::watched::Stage;
use adaptive::adapted;
use clock::Clock;
use ppum::dataset::{Dataset, Step, TipIntensity};
use ppum::progress::{Phase, Watcher};
use solution::{Assembled, Solving};
use solved::{PlanSolution, Solved};

/// Solves a problem: one step, one field; several steps where the problem asks for adaptation and
/// wants to keep all of them. The watcher is told how far the work has come.
///
/// The coefficients belong to the plain functions; neither the transformed basis nor what it cut
/// off is seen in the dataset. Results do not depend on the number of threads. The step's history
/// is a [`SolverReport`](crate::report::SolverReport).
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
    let assembled = solving.assemble(&given, &plate, &[], &mut Clock::new())?;
    let Assembled { mut system, gauge, .. } = assembled;
    gauge.add_penalty(&mut system.matrix);
    let stage = Stage::uncounted(watcher, Phase::Solution)?;
    let solver = Cholesky::new(&system.matrix).map_err(SolveError::Factor)?;
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
    mesh: Mesh,
    /// The memory that may be used \[bytes\].
    memory: Option<u64>,
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
    /// The plan of a problem, whose solution may take so much memory \[bytes\]. Of a problem that
    /// asks for adaptation it is the plan of the first step.
    ///
    /// # Errors
    /// A space that cannot be built, functions that are not finite, a solution that takes more
    /// memory or could not be stored; cancelled.
    pub fn new(
        problem: &'p Problem,
        memory: Option<u64>,
        watcher: &dyn Watcher,
    ) -> Result<Self, SolveError> {
        let clock = Clock::new();
        let stage = Stage::uncounted(watcher, Phase::Cover)?;
        fits(Estimate::least(problem), memory)?;
        let mesh = Mesh::new(problem, most_cells(problem, memory), &stage)?;
        Self::on(problem, mesh, memory, (clock, &stage))
    }

    /// The plan on a mesh.
    fn on(
        problem: &'p Problem,
        mesh: Mesh,
        memory: Option<u64>,
        (mut clock, stage): (Clock, &Stage<'_>),
    ) -> Result<Self, SolveError> {
        let step = discretise_on(problem, &mesh, stage)?;
        let crossed_twice = n_crossed_twice(problem, step.partition.boxes());
        let dataset = dataset(problem, step.clone());
        dataset.check()?;
        stage.advance(0)?;
        let space = Space::of_problem(problem, step)?;
        let estimate = fits(Estimate::of_space(problem, &space, memory), memory)?;
        clock.lap(Phase::Cover);
        Ok(Self { problem, mesh, memory, dataset, space, estimate, crossed_twice, clock })
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

    /// Looks whether the loads on each piece of the plate balance, or something holds it. That
    /// takes their integrals, and no system.
    ///
    /// # Errors
    /// Loads without restraint, data that are not finite; cancelled.
    pub fn check(&self, watcher: &dyn Watcher) -> Result<(), SolveError> {
        self.solving(watcher).loaded().map(drop)
    }

    /// Solves the problem, once, or step by step where it asks for adaptation.
    ///
    /// # Errors
    /// See [`SolveError`].
    pub fn solve(self, watcher: &dyn Watcher) -> Result<Dataset, SolveError> {
        match &self.problem.adaptivity {
            None => self.solved(watcher)?.finish(None, watcher),
            Some(set) => adapted(self, set, watcher),
        }
    }

    /// The problem.
    pub(crate) fn problem(&self) -> &'p Problem {
        self.problem
    }

    /// Solves the problem, and goes on to errors and warnings only if its stress intensity factors
    /// are those that are wanted.
    ///
    /// # Errors
    /// See [`SolveError`].
    pub(crate) fn attempt(
        self,
        watcher: &dyn Watcher,
        is_wanted: &dyn Fn(&[TipIntensity]) -> bool,
    ) -> Result<Attempt, SolveError> {
        if self.problem.adaptivity.is_some() {
            let dataset = self.solve(watcher)?;
            let wanted = is_wanted(&dataset.steps[0].intensities);
            return Ok(Attempt::of(dataset, wanted));
        }
        let found = self.solve_plan(watcher)?;
        let factors = found.factors();
        if !is_wanted(&factors) {
            return Ok(Attempt::Refused(factors));
        }
        found
            .estimated(watcher)?
            .finish(None, watcher)
            .map(|dataset| Attempt::Done(Box::new(dataset)))
    }

    /// Solves the plan, and integrates the factors of its tips.
    fn solve_plan(mut self, watcher: &dyn Watcher) -> Result<PlanSolution<'p>, SolveError> {
        let Self { problem, ref mesh, ref space, estimate, .. } = self;
        let Estimate { solver: kind, falls_back, .. } = estimate;
        let solving = Solving { problem, mesh, space, kind, falls_back, watcher };
        let mut solution = solving.solution(&self.dataset, &mut self.clock)?;
        solution.store(&mut self.dataset.steps[0]);
        PlanSolution::new(self, solution, watcher)
    }

    /// The solution with its estimated error.
    fn solved(self, watcher: &dyn Watcher) -> Result<Solved<'p>, SolveError> {
        self.solve_plan(watcher)?.estimated(watcher)
    }

    fn solving<'a>(&'a self, watcher: &'a dyn Watcher) -> Solving<'a> {
        let Self { problem, mesh, space, estimate, .. } = self;
        let Estimate { solver: kind, falls_back, .. } = *estimate;
        Solving { problem, mesh, space, kind, falls_back, watcher }
    }
}

/// What has become of an attempt at a solution.
pub(crate) enum Attempt {
    /// It is what was wanted.
    Done(Box<Dataset>),
    /// Its factors are not.
    Refused(Vec<TipIntensity>),
}

impl Attempt {
    fn of(mut dataset: Dataset, is_wanted: bool) -> Self {
        if is_wanted {
            return Self::Done(Box::new(dataset));
        }
        Self::Refused(std::mem::take(&mut dataset.steps[0].intensities))
    }
}

/// The estimate, if what it needs is there.
fn fits(needs: Estimate, memory: Option<u64>) -> Result<Estimate, SolveError> {
    match memory {
        Some(memory) if needs.memory > memory as f64 => Err(SolveError::TooLarge { needs, memory }),
        _ => Ok(needs),
    }
}

/// The cells that a memory holds at most.
fn most_cells(problem: &Problem, memory: Option<u64>) -> usize {
    memory.map_or(usize::MAX, |memory| Estimate::most_cells(problem, memory))
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
