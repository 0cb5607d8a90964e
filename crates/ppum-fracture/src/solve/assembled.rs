//! The system of a discretised problem, in the stable basis.

use super::SolveError;
use super::plan::Plan;
use crate::intensity::{LoadCase, Sensitivity, TipDisc, sensitivities, straight_sensitivity};
use ppum::crack::TipId;
use ppum::field::Field;
use ppum::progress::{Phase, Watcher};
use ppum_problem::Problem;
use ppum_solve::assembly::{
    Assembly, DualLoads, FaceContacts, FreeModes, Functionals, LinearFunctional,
    NullSpaceConstraint, System, slivers, values_at,
};
use ppum_solve::basis::StableBasis;
use ppum_solve::equilibrium::BodyEquilibrium;
use ppum_solve::law::Law;
use ppum_solve::quadrature::CrackFace;
use ppum_solve::space::TrialSpace;
use ppum_solve::terms::known_fields;
use ppum_solve::watched::WorkPhase;

/// The system in the stable basis, without the penalty of the constraint.
pub(super) struct Assembled {
    pub(super) plate: BodyEquilibrium,
    pub(super) basis: StableBasis,
    pub(super) system: System,
    pub(super) constraint: NullSpaceConstraint,
    /// The faces that may touch, whose terms are not in the system.
    pub(super) contacts: FaceContacts,
    /// The discs of the tips whose factors are functionals of the system.
    pub(super) tips: Vec<TipDisc>,
    /// True if each tip has dual solutions of its own, which are exact and without rigid motions.
    pub(super) are_exact: bool,
}

impl Assembled {
    /// The system of what is given on the body.
    ///
    /// # Errors
    /// Loads without restraint, data and functions that are not finite; cancelled.
    pub(super) fn new(
        plan: &mut Plan<'_>,
        law: &Law<'_>,
        watcher: &dyn Watcher,
    ) -> Result<Self, SolveError> {
        Self::with(plan, law, None, watcher)
    }

    /// The system with the functionals of some tips, each its own, or with the sums of those of
    /// all tips.
    pub(super) fn with(
        plan: &mut Plan<'_>,
        law: &Law<'_>,
        tips: Option<&[TipId]>,
        watcher: &dyn Watcher,
    ) -> Result<Self, SolveError> {
        let are_exact = tips.is_some();
        let (given, plate) = plan.loaded(watcher)?;
        let Plan { problem, dataset, space, clock, .. } = plan;
        let field = Field::new(dataset, 0)?;
        // loads change no sensitivity
        let loads = LoadCase { problem: Some(problem), factor: 0.0 };
        let tips = match tips {
            None => sensitivities(dataset, &field, space, law, &loads),
            Some(tips) => {
                let of_tip = |&tip| straight_sensitivity(dataset, &field, space, law, tip, &loads);
                tips.iter().filter_map(of_tip).collect()
            }
        };
        let basis = stable_basis(problem, space, law, watcher)?;
        clock.lap(Phase::Basis);
        let assembly = Assembly { problem, space, basis: &basis, law };
        let stage = WorkPhase::new(watcher, Phase::Assembly, assembly.n_cells())?;
        let free = FreeModes::new(&plate);
        let duals =
            DualLoads::new(tips.iter().map(|tip| tip as &dyn LinearFunctional).collect(), space);
        let duals = if are_exact { duals.separate() } else { duals };
        let functionals = Functionals { free: &free, duals: &duals };
        let system = System::new(assembly, &given, functionals, &stage);
        let mut system = system.map_err(SolveError::of_data)?;
        add_known(assembly, &mut system);
        let contacts = FaceContacts::new(assembly, &stage).map_err(SolveError::of_data)?;
        let moments = (std::mem::take(&mut system.moments), system.known.clone());
        let constraint = NullSpaceConstraint::new(free, moments, &system.matrix);
        let values = |x| values_at(assembly, &system.matrix, (x, None));
        let conditions = plate.conditions(&problem.supports)?;
        let constraint = constraint.with_supports(&problem.supports, &conditions, &values);
        clock.lap(Phase::Assembly);
        let tips = tips.iter().map(Sensitivity::disc).collect();
        Ok(Self { plate, basis, system, constraint, contacts, tips, are_exact })
    }
}

/// Adds F·N(x₀) of the loads F at singular points x₀ to the load.
fn add_known(assembly: Assembly<'_>, system: &mut System) {
    for field in known_fields(assembly.problem) {
        let values =
            values_at(assembly, &system.matrix, (field.at, field.face.map(CrackFace::from)));
        for (values, factor) in values.functionals.iter().zip([field.load.x, field.load.y]) {
            system.load.iter_mut().zip(values).for_each(|(load, value)| *load += factor * value);
        }
    }
}

/// The stable basis, damped where the boundary cuts slivers.
fn stable_basis(
    problem: &Problem,
    space: &TrialSpace<'_>,
    law: &Law<'_>,
    watcher: &dyn Watcher,
) -> Result<StableBasis, SolveError> {
    let stage = WorkPhase::new(watcher, Phase::Basis, 3 * space.partition().len())?;
    let mut basis = StableBasis::new(space, &stage).map_err(SolveError::of_basis)?;
    let assembly = Assembly { problem, space, basis: &basis, law };
    let slivers = slivers(assembly, &stage).map_err(SolveError::of_data)?;
    basis.rescale(space, &slivers).map_err(SolveError::of_basis)?;
    Ok(basis)
}
