//! From a plan to the coefficients: basis, system, linear solver.

use super::SolveError;
use super::chosen::{Chosen, Wanted};
use super::clock::Clock;
use super::goal::DualSolutions;
use crate::assembly::{Assembly, Duals, FreeModes, Functionals, Gauge, Given, System, slivers};
use crate::basis::StableBasis;
use crate::equilibrium::{BodyPieces, Plate};
use crate::hierarchy::Finest;
use crate::intensity::{Sensitivity, sensitivities};
use crate::law::Law;
use crate::linear::LinearError;
use crate::problem::Problem;
use crate::report::{ASSEMBLY_SECONDS, LinearKind, SolverReport, Unresolved};
use crate::space::{Mesh, Space, SpaceError};
use crate::watched::Stage;
use faer::Mat;
use ppum::dataset::{Attribute, Dataset, FieldData, Reaction, Step};
use ppum::field::Field;
use ppum::progress::{Cancelled, Phase, Watcher};

/// The solution of a problem on a space.
pub(super) struct Solution {
    /// Plain coefficients in the order of the system.
    coefficients: Vec<f64>,
    /// Of each patch, the coefficients of the functions that the solver evaluates: a row for each
    /// component of the solution and of the dual solutions.
    pub(super) local: Vec<Mat<f64>>,
    /// Values for each patch.
    attributes: Vec<Attribute>,
    reactions: Vec<Reaction>,
    /// Integrands that quadrature did not resolve.
    pub(super) unresolved: Vec<Unresolved>,
    /// Of each patch, the first functions of components of which nearly nothing lies where it
    /// is alone.
    pub(super) lonely: Vec<Vec<usize>>,
    /// The dual solutions of stress intensity factors, if there are any.
    pub(super) duals: Option<DualSolutions>,
    /// The numbers of the report that are known with the solution.
    pub(super) report: SolverReport,
}

/// A problem on a space, with its watcher: what every step of the solution needs.
#[derive(Clone, Copy)]
pub(super) struct Solving<'a> {
    pub(super) problem: &'a Problem,
    pub(super) mesh: &'a Mesh,
    pub(super) space: &'a Space<'a>,
    /// The linear solver, and whether the direct one may take its place.
    pub(super) kind: LinearKind,
    pub(super) falls_back: bool,
    pub(super) watcher: &'a dyn Watcher,
}

/// The system in the stable basis, without the penalty of the gauge.
pub(super) struct Assembled {
    pub(super) basis: StableBasis,
    pub(super) system: System,
    pub(super) gauge: Gauge,
}

impl Solving<'_> {
    /// The data of the problem, and the plate that they act on.
    ///
    /// # Errors
    /// Loads without restraint, data that are not finite; cancelled.
    pub(super) fn loaded(&self) -> Result<(Given<'_>, Plate), SolveError> {
        let Self { problem, space, watcher, .. } = *self;
        let pieces = BodyPieces::new(&problem.domain, &problem.cracks);
        if pieces.all().is_empty() {
            return Err(SpaceError::Nothing.into());
        }
        let stage = Stage::uncounted(watcher, Phase::Basis)?;
        let given = Given::new(problem, space, &stage).map_err(SolveError::of_data)?;
        let balances = given.balance(space, &pieces, &stage).map_err(SolveError::of_data)?;
        Ok((given, Plate::new(pieces, balances)?))
    }

    /// The stable basis, damped where the border cuts slivers.
    fn basis(&self, law: &Law<'_>) -> Result<StableBasis, SolveError> {
        let Self { problem, space, watcher, .. } = *self;
        let stage = Stage::new(watcher, Phase::Basis, 3 * space.partition().len())?;
        let mut basis = StableBasis::new(space, &stage).map_err(SolveError::of_basis)?;
        let assembly = Assembly { problem, space, basis: &basis, law };
        let slivers = slivers(assembly, &stage).map_err(SolveError::of_data)?;
        basis.damp(space, &slivers).map_err(SolveError::of_basis)?;
        Ok(basis)
    }

    /// The system of what is given on the plate.
    ///
    /// # Errors
    /// Data and functions that are not finite; cancelled.
    pub(super) fn assemble(
        &self,
        given: &Given<'_>,
        plate: &Plate,
        tips: &[Sensitivity<'_>],
        clock: &mut Clock,
    ) -> Result<Assembled, SolveError> {
        let Self { problem, space, watcher, .. } = *self;
        let law = &Law::new(&problem.equation);
        let basis = self.basis(law)?;
        clock.lap(Phase::Basis);
        let assembly = Assembly { problem, space, basis: &basis, law };
        let stage = Stage::new(watcher, Phase::Assembly, assembly.n_cells())?;
        let free = FreeModes::new(plate);
        let functionals = Functionals { free: &free, duals: &Duals::new(tips, space) };
        let system = System::new(assembly, given, functionals, &stage);
        let mut system = system.map_err(SolveError::of_data)?;
        let gauge = Gauge::new(free, std::mem::take(&mut system.moments), &system.matrix);
        clock.lap(Phase::Assembly);
        Ok(Assembled { basis, system, gauge })
    }

    /// The solution of the problem, whose dataset has no coefficients yet.
    ///
    /// # Errors
    /// See [`SolveError`].
    pub(super) fn solution(
        &self,
        dataset: &Dataset,
        clock: &mut Clock,
    ) -> Result<Solution, SolveError> {
        let (given, plate) = self.loaded()?;
        let field = Field::new(dataset, 0)?;
        let tips = sensitivities(dataset, &field, self.space);
        let mut assembled = self.assemble(&given, &plate, &tips, clock)?;
        let found = match self.solve_system(self.kind, &mut assembled, &plate, &tips) {
            Err(error) if self.falls_back && is_of_levels(&error) => {
                let found = self.solve_system(LinearKind::Direct, &mut assembled, &plate, &tips);
                found.map(|found| found.told_of_fallback())
            }
            other => other,
        };
        let SystemSolution { unknowns: solution, duals, report } = found?;
        let Assembled { basis, mut system, gauge } = assembled;
        clock.lap(Phase::Solution);
        let components = self.problem.components();
        let cut_off: Vec<_> = basis.cut_off(components).map(|n| n as f64).collect();
        let kept: usize = basis.unknowns(components).sum();
        let all = kept as f64 + cut_off.iter().sum::<f64>();
        let left = kept as f64 - report.dependent.unwrap_or(0.0);
        let made = [(Phase::Basis, basis.bytes()), (Phase::Assembly, system.bytes())];
        let bytes = made.map(|(phase, bytes)| (phase, bytes as f64)).into_iter();
        let points = system.points();
        let report = SolverReport {
            unknowns: Some(all),
            cut_off: Some(cut_off.iter().sum()),
            bytes: bytes.chain(report.solver_bytes.map(|held| (Phase::Solution, held))).collect(),
            worked: vec![
                (Phase::Cover, all),
                (Phase::Basis, all),
                (Phase::Assembly, kept as f64),
                (Phase::Solution, left),
            ],
            nitsche: Some(system.nitsche),
            pieces: Some(plate.pieces.all().len() as f64),
            free_modes: Some(gauge.len() as f64),
            imbalance: Some(plate.imbalance()),
            quadrature_points: Some(points.iter().sum()),
            ..report
        };
        let dual_unknowns = duals.iter().flat_map(|duals| &duals.unknowns).map(Vec::as_slice);
        let all: Vec<&[f64]> = std::iter::once(solution.as_slice()).chain(dual_unknowns).collect();
        Ok(Solution {
            coefficients: basis.plain(self.space, &solution, components),
            local: basis.local_coefficients(&all, components),
            attributes: vec![
                attribute("cut-off", cut_off),
                attribute("least-eigenvalue", basis.least()),
                attribute("quadrature-points", points),
                attribute(ASSEMBLY_SECONDS, system.seconds()),
            ],
            reactions: system.reactions.of(self.problem, &basis, &system.matrix, &solution),
            unresolved: std::mem::take(&mut system.unresolved),
            lonely: basis.lonely,
            duals,
            report,
        })
    }

    /// The solution of the system, without what is left of free motions, and the dual solutions.
    fn solve_system(
        &self,
        kind: LinearKind,
        Assembled { basis, system, gauge, .. }: &mut Assembled,
        plate: &Plate,
        tips: &[Sensitivity<'_>],
    ) -> Result<SystemSolution, SolveError> {
        let located = |error| self.located(error);
        let stage = Stage::new(self.watcher, Phase::Solution, 3)?;
        let goes_on = || stage.advance(0).is_ok();
        let free = gauge.loads(&system.matrix);
        let chosen = match kind {
            LinearKind::Direct => {
                gauge.add_penalty(&mut system.matrix);
                Chosen::direct(&system.matrix)
            }
            LinearKind::Multilevel => {
                let (problem, mesh, space) = (self.problem, self.mesh, self.space);
                let coarser = Finest { problem, plate, mesh, space, basis }.coarser(&stage)?;
                let wanted: Wanted<'_> = (problem.solver.tolerance, &goes_on);
                Chosen::multilevel(&system.matrix, coarser, &free, wanted)
            }
        };
        let chosen = chosen.map_err(located)?;
        let solver = chosen.as_dyn();
        stage.advance(1)?;
        let mut solution = solver.solve(&system.load).map_err(located)?;
        stage.advance(1)?;
        gauge.center(solver, &system.matrix, &mut solution.unknowns).map_err(located)?;
        stage.advance(1)?;
        let duals = self.duals(tips, &system.duals, solver)?;
        let report = chosen.report(solution.relative_residual, solution.course);
        Ok(SystemSolution { unknowns: solution.unknowns, duals, report })
    }

    /// The error at the place of its patch.
    pub(super) fn located(&self, error: LinearError) -> SolveError {
        match error.patch() {
            Some(patch) => {
                let around = self.space.partition().support(patch).into();
                SolveError::Singular { around, error }
            }
            None if error == LinearError::Stopped => Cancelled.into(),
            None => SolveError::Factor(error),
        }
    }
}

/// The unknowns and dual solutions of a system.
struct SystemSolution {
    unknowns: Vec<f64>,
    duals: Option<DualSolutions>,
    /// The numbers of the report that the linear solver knows.
    report: SolverReport,
}

impl SystemSolution {
    fn told_of_fallback(self) -> Self {
        Self { report: SolverReport { fallback: Some(1.0), ..self.report }, ..self }
    }
}

/// True if coarser levels may be the reason of an error.
fn is_of_levels(error: &SolveError) -> bool {
    let (SolveError::Singular { error, .. } | SolveError::Factor(error)) = error else {
        return false;
    };
    !matches!(error, LinearError::LoadNotFinite { .. })
}

impl Solution {
    /// Writes the solution into its step.
    pub(super) fn store(&mut self, step: &mut Step) {
        step.reactions = std::mem::take(&mut self.reactions);
        write_coefficients(&mut step.fields[0], &self.coefficients);
        step.attributes.append(&mut self.attributes);
    }
}

fn attribute(name: &str, values: Vec<f64>) -> Attribute {
    Attribute { name: name.into(), values }
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
