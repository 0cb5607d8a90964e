//! The cost of a solution, known before it is made.

use super::SolveError;
use super::clock::Clock;
use super::discretised::Discretised;
use super::estimate::Estimate;
use ppum::dataset::Dataset;
use ppum::progress::{Phase, Watcher};
use ppum_problem::Problem;
use ppum_solve::space::{CoverMesh, TrialSpace};
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
    pub(super) discretised: Discretised<'p>,
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
        let mut discretised = Discretised::new(problem, mesh, stage)?;
        let estimate = fits(estimate(&mut discretised, memory)?, memory)?;
        clock.lap(Phase::Cover);
        Ok(Self { discretised, memory, estimate, clock })
    }

    /// The unknowns of the solution, and the memory that it takes.
    #[must_use]
    pub fn estimate(&self) -> &Estimate {
        &self.estimate
    }

    /// The dataset before the solution is known: all coefficients are zero.
    #[must_use]
    pub fn dataset(&self) -> &Dataset {
        &self.discretised.dataset
    }

    /// The problem.
    pub(crate) fn problem(&self) -> &'p Problem {
        self.discretised.problem
    }

    /// Looks whether the loads on each piece of the body balance, or something holds it. That
    /// takes their integrals, and no system.
    ///
    /// # Errors
    /// Loads without restraint, data that are not finite; cancelled.
    pub fn check(&self, watcher: &dyn Watcher) -> Result<(), SolveError> {
        if let Some(heat) = self.problem().heat() {
            self.of_heat(heat, watcher)?.check(watcher).map_err(SolveError::of_heat)?;
        }
        self.discretised.loaded(watcher).map(drop)
    }
}

impl Plan<'_> {
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
        let mesh = self.discretised.mesh.clone();
        Plan::on(heat, mesh, self.memory, (Clock::new(), &stage)).map_err(SolveError::of_heat)
    }
}

/// The estimate of a solution, and of the temperature that is solved for before it.
fn estimate(
    discretised: &mut Discretised<'_>,
    memory: Option<u64>,
) -> Result<Estimate, SolveError> {
    let Discretised { problem, space, heat, .. } = discretised;
    let own = Estimate::of_space(problem, space, memory);
    let Some((heat, step)) = problem.heat().zip(heat.take()) else { return Ok(own) };
    let space = TrialSpace::of_problem(heat, step, None)?;
    Ok(own.after(&Estimate::of_space(heat, &space, memory)))
}

/// The estimate, if what it needs is there.
fn fits(needs: Estimate, memory: Option<u64>) -> Result<Estimate, SolveError> {
    match memory {
        Some(memory) if needs.memory > memory as f64 => Err(SolveError::TooLarge { needs, memory }),
        _ => Ok(needs),
    }
}

/// The cells that a memory holds at most.
pub(super) fn most_cells(problem: &Problem, memory: Option<u64>) -> usize {
    memory.map_or(usize::MAX, |memory| Estimate::most_cells(problem, memory))
}
