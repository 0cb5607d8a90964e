//! A problem on a cover: its local spaces, the data that act on it, and its pieces.

use super::SolveError;
use ppum::dataset::{Dataset, Step};
use ppum::progress::{Phase, Watcher};
use ppum_problem::Problem;
use ppum_solve::assembly::PrescribedData;
use ppum_solve::equilibrium::{BodyPieces, Plate};
use ppum_solve::refine::n_crossed_twice;
use ppum_solve::space::{CoverMesh, SpaceError, TrialSpace, discretise_on};
use ppum_solve::terms::known_fields;
use ppum_solve::watched::WorkPhase;

/// A problem whose cover and functions are known.
pub(super) struct Discretised<'p> {
    pub(super) problem: &'p Problem,
    pub(super) mesh: CoverMesh,
    /// The dataset, whose coefficients are zero until the system is solved.
    pub(super) dataset: Dataset,
    /// The space of its step: the only one from here to the last warning.
    pub(super) space: TrialSpace<'p>,
    /// The step of a temperature that is solved for on the same mesh.
    pub(super) heat: Option<Step>,
    /// Number of patches that a crack or rim crosses twice.
    pub(super) crossed_twice: usize,
}

impl<'p> Discretised<'p> {
    /// The problem on a mesh.
    ///
    /// # Errors
    /// A space that cannot be built or could not be stored; cancelled.
    pub(super) fn new(
        problem: &'p Problem,
        mesh: CoverMesh,
        stage: &WorkPhase<'_>,
    ) -> Result<Self, SolveError> {
        let step = discretise_on(problem, &mesh, stage)?;
        let crossed_twice = n_crossed_twice(problem, step.partition.boxes());
        let dataset = dataset(problem, step.clone());
        dataset.check()?;
        stage.advance(0)?;
        let heat = problem.heat().map(|heat| discretise_on(heat, &mesh, stage));
        let heat = heat.transpose().map_err(|error| SolveError::of_heat(error.into()))?;
        let space = TrialSpace::of_problem(problem, step, heat.as_ref())?;
        let bounds = &problem.domain().bounds;
        if let Some(field) =
            known_fields(problem).iter().find(|field| !field.fits(space.partition(), bounds))
        {
            let (at, reach) = (field.at, field.reach);
            let is_refined = problem.discretization.refine;
            return Err(SpaceError::Reach { at, reach, is_refined }.into());
        }
        Ok(Self { problem, mesh, dataset, space, heat, crossed_twice })
    }

    /// The data of the problem, and the body that they act on.
    ///
    /// # Errors
    /// Loads without restraint, data that are not finite; cancelled.
    pub(super) fn loaded(
        &self,
        watcher: &dyn Watcher,
    ) -> Result<(PrescribedData<'p>, Plate), SolveError> {
        let Self { problem, space, .. } = self;
        let pieces = BodyPieces::new(problem.domain(), problem.cracks());
        if pieces.all().is_empty() {
            return Err(SpaceError::Nothing.into());
        }
        let stage = WorkPhase::uncounted(watcher, Phase::Basis)?;
        let given = PrescribedData::new(problem, space, &stage).map_err(SolveError::of_data)?;
        let balances = given.balance(space, &pieces, &stage).map_err(SolveError::of_data)?;
        let plate = Plate::new(pieces, balances, problem)?;
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
