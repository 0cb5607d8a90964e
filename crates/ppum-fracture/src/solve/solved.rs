//! A plan whose dataset has its coefficients.

use super::SolveError;
use super::assembled::Assembled;
use super::plan::Plan;
use super::unknowns::Unknowns;
use crate::intensity::{LoadCase, TipDisc, TipResult, intensities_by};
use faer::Mat;
use ppum::dataset::{Attribute, FieldData, TipIntensity};
use ppum::field::Field;
use ppum::progress::{Phase, Watcher};
use ppum_solve::assembly::CellErrors;
use ppum_solve::law::{Law, Temperature};
use ppum_solve::report::{ASSEMBLY_SECONDS, SolverReport};
use ppum_solve::space::TrialSpace;

/// A solution with the stress intensity factors of its tips.
pub(super) struct Solved<'p> {
    pub(super) plan: Plan<'p>,
    /// The temperature that strains the body, if one does.
    pub(super) temperature: Option<Temperature>,
    pub(super) report: SolverReport,
    /// The coefficients of the functions that the solver evaluates, for each patch: a row for each
    /// component of the solution and of the dual solutions.
    pub(super) local: Vec<Mat<f64>>,
    /// For each patch, the first functions of components whose support lies almost entirely under
    /// other patches.
    pub(super) sole_support: Vec<Vec<usize>>,
    /// The discs of the tips whose factors have dual solutions.
    pub(super) discs: Vec<TipDisc>,
    /// The cells in which contact ends.
    pub(super) contact: Vec<CellErrors>,
    /// The findings about all tips.
    pub(super) tips: Vec<TipResult>,
}

impl<'p> Solved<'p> {
    /// Solves a plan, and integrates the factors of its tips.
    ///
    /// # Errors
    /// See [`SolveError`].
    pub(super) fn new(mut plan: Plan<'p>, watcher: &dyn Watcher) -> Result<Self, SolveError> {
        let temperature = temperature(&plan, watcher)?;
        let law = Law::new(&plan.problem.equation).heated(temperature.as_ref());
        let mut assembled = Assembled::new(&mut plan, &law, watcher)?;
        let Unknowns { all, contact, report } = Unknowns::new(&plan, &mut assembled, watcher)?;
        plan.clock.lap(Phase::Solution);
        let report = assembled.report(report, plan.problem.components());
        let (local, sole_support, discs) = write(&mut plan, assembled, &all);
        let Plan { problem, dataset, space, clock, .. } = &mut plan;
        let field = Field::new(dataset, 0)?;
        let loads = LoadCase { problem: Some(problem), factor: field.step.load };
        let tips = intensities_by(&law, dataset, &field, space, &loads, watcher)?;
        clock.lap(Phase::Intensity);
        Ok(Self { plan, temperature, report, local, sole_support, discs, contact, tips })
    }

    /// The factors of the tips that have any.
    pub(super) fn factors(&self) -> Vec<TipIntensity> {
        self.tips.iter().filter_map(|outcome| outcome.factors.clone()).collect()
    }
}

/// Writes the solution into the dataset of its plan, and returns what [`Solved`] keeps of the
/// system: its matrix takes most of the memory.
fn write(
    plan: &mut Plan<'_>,
    Assembled { basis, system, tips, .. }: Assembled,
    all: &[Vec<f64>],
) -> (Vec<Mat<f64>>, Vec<Vec<usize>>, Vec<TipDisc>) {
    let Plan { problem, space, dataset, .. } = plan;
    let (solution, components, step) = (&all[0], problem.components(), &mut dataset.steps[0]);
    write_coefficients(&mut step.fields[0], &basis.plain(space, solution, components));
    step.reactions = system.reactions.of(problem, &basis, &system.matrix, solution);
    let cut_off = basis.cut_off(components).map(|n| n as f64).collect();
    step.attributes.extend([
        attribute("cut-off", cut_off),
        attribute("least-eigenvalue", basis.least()),
        attribute("quadrature-points", system.points()),
        attribute(ASSEMBLY_SECONDS, system.seconds()),
    ]);
    let mut local = basis.local_coefficients(all, components);
    write_known(space, &mut step.fields[0], &mut local);
    (local, basis.sole_support, tips)
}

/// The temperature that strains the body, if another problem gives it: solved on the same cells.
fn temperature(plan: &Plan<'_>, watcher: &dyn Watcher) -> Result<Option<Temperature>, SolveError> {
    let Some(heat) = plan.problem.heat() else { return Ok(None) };
    let solved = Solved::new(plan.of_heat(heat, watcher)?, watcher).map_err(SolveError::of_heat)?;
    let equation = plan.problem.dataset_equation().into_owned();
    Ok(Some(Temperature::new(solved.plan.dataset, equation, solved.report)?))
}

impl Assembled {
    /// The report of a linear solver, with the numbers of the system.
    fn report(&mut self, solver: SolverReport, components: usize) -> SolverReport {
        let Self { plate, basis, system, constraint, .. } = self;
        let cut_off = basis.cut_off(components).sum::<usize>() as u64;
        let kept = basis.unknowns(components).sum::<usize>() as u64;
        let (all, left) = (kept + cut_off, kept - solver.dependent.unwrap_or(0));
        let mut bytes =
            vec![(Phase::Basis, basis.bytes() as f64), (Phase::Assembly, system.bytes() as f64)];
        bytes.extend(solver.solver_bytes.map(|held| (Phase::Solution, held as f64)));
        let phases = [Phase::Cover, Phase::Basis, Phase::Assembly, Phase::Solution];
        SolverReport {
            unknowns: Some(all),
            cut_off: Some(cut_off),
            bytes,
            worked: phases.into_iter().zip([all, all, kept, left].map(|n| n as f64)).collect(),
            nitsche: Some(system.nitsche),
            pieces: Some(plate.pieces.all().len() as u64),
            free_modes: Some(constraint.n_free() as u64),
            imbalance: Some(plate.imbalance()),
            quadrature_points: Some(system.points().iter().sum::<f64>() as u64),
            unresolved: std::mem::take(&mut system.unresolved),
            ..solver
        }
    }
}

fn attribute(name: &str, values: Vec<f64>) -> Attribute {
    Attribute { name: name.into(), values }
}

/// Writes the coefficients that are known, also among those that the solver evaluates.
fn write_known(space: &TrialSpace<'_>, data: &mut FieldData, local: &mut [Mat<f64>]) {
    for (patch, local) in local.iter_mut().enumerate() {
        for known in space.known(patch) {
            for (i, component) in data.coefficients_mut(patch).enumerate() {
                component[known.stored] = known.coefficients[i];
                local[(i, known.evaluated)] = known.coefficients[i];
            }
        }
    }
}

/// Writes coefficients that stand patch by patch and in each patch component by component.
fn write_coefficients(data: &mut FieldData, coefficients: &[f64]) {
    let mut rest = coefficients;
    for patch in 0..data.patch_blocks.len() - 1 {
        for component in data.coefficients_mut(patch) {
            let (part, tail) = rest.split_at(component.len());
            component.copy_from_slice(part);
            rest = tail;
        }
    }
}
