//! A problem on a cover: its local spaces, the data that act on it, its pieces, and the cost of its
//! solution.

use super::SolveError;
use super::clock::Clock;
use crate::estimate::Estimate;
use ppum::dataset::{Dataset, Step};
use ppum::progress::{Phase, Watcher};
use ppum_problem::Problem;
use ppum_solve::assembly::PrescribedData;
use ppum_solve::equilibrium::{BodyEquilibrium, BodyPieces};
use ppum_solve::refine::n_crossed_twice;
use ppum_solve::space::{CoverMesh, SpaceError, TrialSpace, discretise_on};
use ppum_solve::terms::known_fields;
use ppum_solve::watched::WorkPhase;

/// A problem whose cover and functions are known, and with them what its solution takes.
///
/// ```
/// use ppum::progress::unwatched;
/// use ppum::vec2::{Rect, vec2};
/// use ppum_problem::{BaseCells, Condition, Discretization, DomainEdge, Problem, ProblemData};
/// use ppum_fracture::solve::{Plan, SolveError};
///
/// let domain = Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0));
/// let plate = |level| {
///     let plate = ProblemData::poisson(domain, 1.0, Discretization::new(BaseCells::Level(level)));
///     let zero = vec![Condition::Dirichlet(0.0.into())];
///     Problem::new(plate.with_boundary(DomainEdge::Left, zero)).map_err(SolveError::Problem)
/// };
/// let (small, large) = (plate(3)?, plate(10)?);
/// let memory = Some(1 << 30);
/// let plan = Plan::new(&small, memory, unwatched())?;
/// assert_eq!(plan.estimate().patches, 64.0);
/// plan.check(unwatched())?;
/// assert!(Plan::new(&large, memory, unwatched()).is_err());
/// # Ok::<(), SolveError>(())
/// ```
pub struct Plan<'p> {
    pub(crate) problem: &'p Problem,
    pub(super) mesh: CoverMesh,
    /// The dataset, whose coefficients are zero until the system is solved.
    pub(super) dataset: Dataset,
    /// The space of its step: the only one from here to the last warning.
    pub(super) space: TrialSpace<'p>,
    /// Number of patches that a crack or rim crosses twice.
    pub(super) crossed_twice: usize,
    /// The memory that may be used \[bytes\].
    pub(super) memory: Option<u64>,
    pub(super) estimate: Estimate,
    pub(super) clock: Clock,
}

impl<'p> Plan<'p> {
    /// The plan of a problem, whose solution may take so much memory \[bytes\]. If the problem asks
    /// for adaptation, this is the plan of its first step.
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
        let stage = WorkPhase::uncounted(watcher, Phase::Cover)?;
        let mesh = CoverMesh::new(problem, most_cells(problem, memory), &stage)?;
        Self::on(problem, mesh, memory, (clock, &stage))
    }

    /// The plan on a mesh.
    pub(super) fn on(
        problem: &'p Problem,
        mesh: CoverMesh,
        memory: Option<u64>,
        (mut clock, stage): (Clock, &WorkPhase<'_>),
    ) -> Result<Self, SolveError> {
        let step = discretise_on(problem, &mesh, stage)?;
        let crossed_twice = n_crossed_twice(problem, step.partition.boxes());
        let dataset = dataset(problem, step.clone());
        dataset.check()?;
        stage.advance(0)?;
        let heat = problem.heat().map(|heat| Ok((heat, discretise_on(heat, &mesh, stage)?)));
        let heat = heat.transpose().map_err(SolveError::of_heat)?;
        let space = TrialSpace::of_problem(problem, step, heat.as_ref().map(|(_, step)| step))?;
        let bounds = &problem.domain().bounds;
        let mut known = known_fields(problem).into_iter();
        if let Some(field) = known.find(|field| !field.fits(space.partition(), bounds)) {
            let (at, reach) = (field.at, field.reach);
            let is_refined = problem.discretization.refine;
            return Err(SpaceError::Reach { at, reach, is_refined }.into());
        }
        let mut needs = Estimate::of_space(problem, &space, memory);
        if let Some((heat, step)) = heat {
            let space = TrialSpace::of_problem(heat, step, None)?;
            needs = needs.after(&Estimate::of_space(heat, &space, memory));
        }
        if let Some(memory) = memory.filter(|memory| needs.memory > *memory as f64) {
            return Err(SolveError::TooLarge { needs, memory });
        }
        clock.lap(Phase::Cover);
        Ok(Self { problem, mesh, dataset, space, crossed_twice, memory, estimate: needs, clock })
    }

    /// The unknowns of the solution, and the memory that it takes.
    #[must_use]
    pub fn estimate(&self) -> &Estimate {
        &self.estimate
    }

    /// The dataset before the solution is known: all coefficients are zero.
    #[must_use]
    pub fn dataset(&self) -> &Dataset {
        &self.dataset
    }

    /// Looks whether the loads on each piece of the body balance, or something holds it. That
    /// takes their integrals, and no system.
    ///
    /// # Errors
    /// Loads without restraint, data that are not finite; cancelled.
    pub fn check(&self, watcher: &dyn Watcher) -> Result<(), SolveError> {
        if let Some(heat) = self.problem.heat() {
            self.of_heat(heat, watcher)?.check(watcher).map_err(SolveError::of_heat)?;
        }
        self.loaded(watcher).map(drop)
    }

    /// The plan of the problem of a temperature on the cells of this one.
    ///
    /// # Errors
    /// See [`SolveError`].
    pub(super) fn of_heat<'h>(
        &self,
        heat: &'h Problem,
        watcher: &dyn Watcher,
    ) -> Result<Plan<'h>, SolveError> {
        let stage = WorkPhase::uncounted(watcher, Phase::Cover)?;
        let mesh = self.mesh.clone();
        Plan::on(heat, mesh, self.memory, (Clock::new(), &stage)).map_err(SolveError::of_heat)
    }

    /// The data of the problem, and the body that they act on.
    ///
    /// # Errors
    /// Loads without restraint, data that are not finite; cancelled.
    pub(super) fn loaded(
        &self,
        watcher: &dyn Watcher,
    ) -> Result<(PrescribedData<'p>, BodyEquilibrium), SolveError> {
        let Self { problem, space, .. } = self;
        let pieces = BodyPieces::new(problem.domain(), problem.cracks());
        if pieces.all().is_empty() {
            return Err(SpaceError::Nothing.into());
        }
        let stage = WorkPhase::uncounted(watcher, Phase::Basis)?;
        let given = PrescribedData::new(problem, space, &stage).map_err(SolveError::of_data)?;
        let balances = given.balance(space, &pieces, &stage).map_err(SolveError::of_data)?;
        let plate = BodyEquilibrium::new(pieces, balances, problem)?;
        plate.conditions(&problem.supports)?;
        Ok((given, plate))
    }
}

fn dataset(problem: &Problem, step: Step) -> Dataset {
    let mut dataset =
        Dataset::new(problem.domain().clone(), problem.equation.clone()).with_step(step);
    dataset.title.clone_from(&problem.title);
    dataset.program = concat!("ppum ", env!("CARGO_PKG_VERSION")).into();
    dataset.problem.clone_from(&problem.text);
    // those of a temperature have no meaning before it is known
    if problem.temperature.is_none() {
        dataset.quantities.clone_from(&problem.quantities);
    }
    dataset.tables.clone_from(&problem.tables);
    dataset
}

/// The cells that a memory holds at most.
pub(super) fn most_cells(problem: &Problem, memory: Option<u64>) -> usize {
    memory.map_or(usize::MAX, |memory| Estimate::most_cells(problem, memory))
}
