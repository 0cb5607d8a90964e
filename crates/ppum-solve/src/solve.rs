//! From a problem to a dataset.

use crate::around::Around;
use crate::balance::{Balance, UnbalancedError};
use crate::basis::StableBasis;
use crate::cholesky::{Cholesky, CholeskyError};
use crate::eigen::EigenError;
use crate::gauge::Gauge;
use crate::law::Law;
use crate::norms::energy;
use crate::pieces::{Piece, Pieces};
use crate::problem::Problem;
use crate::rigid::PerMotion;
use crate::space::{Space, SpaceError, discretise};
pub use crate::spectrum::Spectrum;
use crate::system::{System, Unresolved, assemble, slivers};
use crate::warnings::{judge, of_quadrature, rounding};
use ppum::dataset::{Attribute, Dataset, Reaction, Record, Step};
use ppum::field::{Field, FieldError};
use ppum::function::{FunctionError, FunctionTable};
use std::time::Instant;

/// What the solver is doing, for progress bars.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// The phase.
    pub phase: Phase,
    /// Parts of the phase that are done.
    pub done: usize,
    /// Parts of the phase.
    pub total: usize,
}

/// A phase of the solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Building the cover and the local spaces.
    Cover,
    /// The stable basis of each patch.
    Basis,
    /// Integrating over the cells.
    Assembly,
    /// Factorisation and solution.
    Solution,
    /// Stress intensity factors.
    Intensity,
}

impl Phase {
    /// Name in reports and in the dataset's history.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Cover => "cover",
            Self::Basis => "basis",
            Self::Assembly => "assembly",
            Self::Solution => "solution",
            Self::Intensity => "intensity",
        }
    }
}

/// A problem that cannot be solved.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
    /// Its cover or local spaces.
    #[error(transparent)]
    Space(#[from] SpaceError),
    /// Data that are not finite.
    #[error(
        "the data of the problem are not finite, or too large to compute with, {0}: look at the formulas and tables \
         of the material, the loads and what is given on the border"
    )]
    Data(Around),
    /// The same, nobody knows where.
    #[error(
        "the data of the problem are not finite, or too large to compute with: look at the formulas and tables of \
         the material, the loads and what is given on the border"
    )]
    Eigen(#[from] EigenError),
    /// Functions of the local spaces.
    #[error(
        "a function of the local spaces is not finite, or too large to compute with, {0}; look at the formulas \
         of [[enrichment]]"
    )]
    Basis(Around),
    /// Loads without support.
    #[error(transparent)]
    Unbalanced(#[from] UnbalancedError),
    /// The factorisation, at a place.
    #[error("{around}: {error}")]
    Singular {
        /// Where.
        around: Around,
        /// What is wrong there.
        error: CholeskyError,
    },
    /// The factorisation.
    #[error(transparent)]
    Factor(#[from] CholeskyError),
    /// A function of the space.
    #[error(transparent)]
    Function(#[from] FunctionError),
    /// The field that was found.
    #[error(transparent)]
    Field(#[from] FieldError),
}

/// Solves a problem: one step, one field. `report` is told what is being done.
///
/// The coefficients belong to the plain functions; neither the transformed basis nor what it cut
/// off is seen in the dataset. Results do not depend on the number of threads.
///
/// The step's history reports, beside seconds: `unknowns` before the cut-off and `cut-off`; the relative
/// `residual`; `dependent`, unknowns left out because they depend on those of other patches; `crossed
/// twice`, patches that hold several runs of one crack and so glue two of their parts together (use smaller
/// cells there); `nitsche`, the largest penalty β of a cell in units of stiffness over cell width, 3 to 36
/// in whole cells and more in slivers; `pieces` and their `free motions`; `quadrature points` of the
/// system's integrals; `rounding`, the relative error of stresses evaluated in double precision, see [`rounding`].
///
/// # Errors
/// See [`SolveError`].
pub fn solve(problem: &Problem, report: &mut dyn FnMut(Progress)) -> Result<Dataset, SolveError> {
    let mut clock = Clock::new();
    report(Progress { phase: Phase::Cover, done: 0, total: 1 });
    let mut step = discretise(problem)?;
    clock.lap(Phase::Cover);
    let mut solution = Solver { problem, step: &step }.run(&mut clock, report)?;
    let unresolved = std::mem::take(&mut solution.unresolved);
    solution.store(&mut step, problem.components());
    let mut dataset = dataset(problem, step);
    report(Progress { phase: Phase::Intensity, done: 0, total: 1 });
    let value = stored_energy(&dataset)?;
    dataset.steps[0].history.push(Record { name: "energy".into(), value, unit: String::new() });
    let (tips, warnings) = judge(&dataset, 0, Some(problem))?;
    let (rounding, _) = rounding(&dataset, 0)?;
    clock.lap(Phase::Intensity);
    let of_quadrature = of_quadrature(&unresolved, &dataset);
    let step = &mut dataset.steps[0];
    step.intensities = tips.into_iter().filter_map(|outcome| outcome.factors).collect();
    step.warnings = warnings;
    step.warnings.extend(of_quadrature);
    step.history.push(Record { name: "rounding".into(), value: rounding, unit: String::new() });
    step.history.extend(clock.records);
    Ok(dataset)
}

/// The extreme eigenvalues of the system of a problem, to a thousandth: the condition number of its
/// discretisation. Costs as much as a solution, and up to a hundred solves with the factor.
///
/// # Errors
/// See [`SolveError`].
pub fn spectrum(problem: &Problem) -> Result<Spectrum, SolveError> {
    let step = discretise(problem)?;
    let solver = Solver { problem, step: &step };
    let Assembled { system, .. } =
        solver.assemble(&solver.space()?, &mut Clock::new(), &mut |_| {})?;
    Ok(Spectrum::new(&system.matrix, &Cholesky::new(&system.matrix)?)?)
}

fn dataset(problem: &Problem, step: Step) -> Dataset {
    Dataset {
        title: problem.title.clone(),
        program: concat!("ppum ", env!("CARGO_PKG_VERSION")).into(),
        problem: problem.text.clone(),
        domain: problem.domain.clone(),
        equation: problem.equation.clone(),
        quantities: problem.quantities.clone(),
        tables: problem.tables.clone(),
        steps: vec![step],
    }
}

/// Energy of the solution.
fn stored_energy(dataset: &Dataset) -> Result<f64, FieldError> {
    let Dataset { steps, domain, equation, tables, .. } = dataset;
    let space = Space::new(&steps[0], domain, equation, tables)?;
    Ok(energy(&Field::new(dataset, 0)?, &space))
}

/// Times phases.
struct Clock {
    last: Instant,
    records: Vec<Record>,
}

impl Clock {
    fn new() -> Self {
        Self { last: Instant::now(), records: Vec::new() }
    }

    fn lap(&mut self, phase: Phase) {
        let value = self.last.elapsed().as_secs_f64();
        self.records.push(Record { name: phase.name().into(), value, unit: "s".into() });
        self.last = Instant::now();
    }
}

/// A problem and its empty step.
struct Solver<'a> {
    problem: &'a Problem,
    step: &'a Step,
}

/// What the linear solver found.
struct Solution {
    /// Plain coefficients in the order of the system.
    coefficients: Vec<f64>,
    /// Functions cut off, a patch.
    dropped: Vec<usize>,
    /// Unknowns before the cut-off.
    unknowns: usize,
    /// ‖f − K u‖ / ‖f‖ in the stable basis.
    residual: f64,
    /// Unknowns that depend on others.
    dependent: usize,
    /// The largest Nitsche's β in units of stiffness over cell width.
    nitsche: f64,
    /// Pieces of the plate.
    pieces: usize,
    /// Rigid motions of pieces that nothing holds.
    free_motions: usize,
    /// Largest part of the loads on a piece that does not balance.
    imbalance: f64,
    /// What the supports exert on the plate.
    reactions: Vec<Reaction>,
    /// Quadrature points of the system.
    points: usize,
    /// What they do not resolve.
    unresolved: Vec<Unresolved>,
}

impl Solver<'_> {
    fn run(
        &self,
        clock: &mut Clock,
        report: &mut dyn FnMut(Progress),
    ) -> Result<Solution, SolveError> {
        let components = self.problem.components();
        let space = self.space()?;
        let Assembled { basis, pieces, system, gauge, imbalance } =
            self.assemble(&space, clock, report)?;
        report(Progress { phase: Phase::Solution, done: 0, total: 1 });
        let located = |error| located(error, &space);
        let solver = Cholesky::new(&system.matrix).map_err(located)?;
        let mut solution = solver.solve(&system.load).map_err(located)?;
        gauge.center(&solver, &system.matrix, &mut solution.unknowns).map_err(located)?;
        clock.lap(Phase::Solution);
        Ok(Solution {
            coefficients: basis.plain(&space, &solution.unknowns, components),
            dropped: basis.dropped().collect(),
            unknowns: space.sizes.iter().sum::<usize>() * components,
            residual: solution.relative_residual,
            dependent: solver.dependent.len(),
            nitsche: system.nitsche,
            pieces: pieces.all().len(),
            free_motions: gauge.len(),
            imbalance,
            points: system.points,
            unresolved: system.unresolved,
            reactions: system.reactions.of(self.problem, &system.matrix, &solution.unknowns),
        })
    }

    fn space(&self) -> Result<Space<'_>, SolveError> {
        let Problem { domain, equation, tables, .. } = self.problem;
        let mut space = Space::new(self.step, domain, equation, tables)?;
        if !self.problem.solver.kernels {
            let cracks = self.step.cracks.len();
            space.functions = FunctionTable::of_formulas(&self.step.functions, cracks, tables)?;
        }
        Ok(space)
    }

    fn assemble(
        &self,
        space: &Space<'_>,
        clock: &mut Clock,
        report: &mut dyn FnMut(Progress),
    ) -> Result<Assembled, SolveError> {
        let law = Law::new(&self.problem.equation);
        let pieces = Pieces::new(&self.problem.domain, &self.problem.cracks);
        let total = space.partition.len();
        report(Progress { phase: Phase::Basis, done: 0, total: 1 });
        let mut basis = StableBasis::new(space).map_err(SolveError::Basis)?;
        let slivers =
            slivers(self.problem, space, &basis, &law, &pieces).map_err(SolveError::Data)?;
        basis.damp(space, &slivers).map_err(SolveError::Basis)?;
        clock.lap(Phase::Basis);
        let mut tell = |done| report(Progress { phase: Phase::Assembly, done, total });
        let system = assemble(self.problem, space, &basis, &law, &pieces, &mut tell);
        let mut system = system.map_err(SolveError::Data)?;
        let free = free_motions(&system.balance, &pieces)?;
        let balances = system.balance.iter().zip(&free);
        let imbalance = balances.map(|(b, free)| b.imbalance(free)).fold(0.0, f64::max);
        let gauge = Gauge::new(space, &basis, &pieces, &system.balance, &free, &system.matrix);
        gauge.add_penalty(&mut system.matrix);
        clock.lap(Phase::Assembly);
        Ok(Assembled { basis, pieces, system, gauge, imbalance })
    }
}

/// The system in the stable basis, with the penalty of the gauge.
struct Assembled {
    basis: StableBasis,
    pieces: Pieces,
    system: System,
    gauge: Gauge,
    /// See [`Solution::imbalance`].
    imbalance: f64,
}

/// The error at the place of its patch.
fn located(error: CholeskyError, space: &Space<'_>) -> SolveError {
    match error.patch() {
        Some(patch) => {
            SolveError::Singular { around: space.partition.support(patch).into(), error }
        }
        None => SolveError::Factor(error),
    }
}

/// The free motions of each piece, after a check that the loads leave them alone.
fn free_motions(balances: &[Balance], pieces: &Pieces) -> Result<Vec<Vec<PerMotion>>, SolveError> {
    let several = pieces.all().len() > 1;
    let of_piece = |(balance, piece): (&Balance, &Piece)| {
        let free = balance.free()?;
        balance.check(&free, several.then_some(piece.inside))?;
        Ok(free)
    };
    balances.iter().zip(pieces.all()).map(of_piece).collect()
}

impl Solution {
    /// Writes the solution into its step.
    fn store(self, step: &mut Step, components: usize) {
        step.reactions = self.reactions;
        let data = &mut step.fields[0];
        let mut rest = self.coefficients.as_slice();
        let mut starts =
            data.patch_blocks.iter().map(|&b| data.block_offset.get(b as usize).copied());
        let mut first = starts.next().flatten().unwrap_or(0) as usize;
        let all = data.coefficients[0].len();
        for next in starts {
            let next = next.map_or(all, |offset| offset as usize);
            for component in &mut data.coefficients {
                let (part, tail) = rest.split_at(next - first);
                component[first..next].copy_from_slice(part);
                rest = tail;
            }
            first = next;
        }
        let cut = self.dropped.iter().map(|&n| (n * components) as f64);
        let values: Vec<_> = cut.collect();
        let total = values.iter().sum();
        step.attributes.push(Attribute { name: "cut-off".into(), values });
        let record = |name: &str, value| Record { name: name.into(), value, unit: String::new() };
        step.history.extend([
            record("unknowns", self.unknowns as f64),
            record("cut-off", total),
            record("residual", self.residual),
            record("dependent", self.dependent as f64),
            record("nitsche", self.nitsche),
            record("pieces", self.pieces as f64),
            record("free motions", self.free_motions as f64),
            record("imbalance", self.imbalance),
            record("quadrature points", self.points as f64),
        ]);
    }
}
