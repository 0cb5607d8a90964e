//! From a problem to a dataset.

mod estimate;

use crate::assembly::{Gauge, Given, System, Unresolved, assemble, slivers};
use crate::basis::StableBasis;
use crate::diagnostics::{judge, of_quadrature, rounding};
pub use crate::equilibrium::UnbalancedError;
use crate::equilibrium::{Balance, PerMode, Piece, Pieces};
pub use crate::geometry::Around;
use crate::law::Law;
use crate::linear::Cholesky;
pub use crate::linear::{CholeskyError, EigenError, Spectrum};
use crate::norms::energy;
use crate::problem::Problem;
use crate::space::{Space, SpaceError, discretise_within};
pub use estimate::Estimate;
use estimate::gibibytes;
use ppum::check::CheckError;
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
    /// A dataset that nothing could read again.
    #[error("the solution could not be stored: {0}")]
    Dataset(#[from] CheckError),
    /// More than the memory holds.
    #[error(
        "the solution needs more memory than the {} that may be used: {needs}; use fewer cells, a lower \
         order, or a machine with more memory",
        gibibytes(*memory as f64)
    )]
    TooLarge {
        /// What it needs, at least.
        needs: Estimate,
        /// The memory \[bytes\].
        memory: u64,
    },
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
    Plan::new(problem, None, report)?.solve(report)
}

/// The extreme eigenvalues of the system of a problem, to a thousandth: the condition number of its
/// discretisation. Costs as much as a solution, and up to a hundred solves with the factor.
///
/// # Errors
/// See [`SolveError`].
pub fn spectrum(problem: &Problem) -> Result<Spectrum, SolveError> {
    let plan = Plan::new(problem, None, &mut |_| {})?;
    let solver = plan.solver();
    let space = solver.space()?;
    let Assembled { system, .. } =
        solver.assemble(&space, solver.loaded(&space)?, &mut Clock::new(), &mut |_| {})?;
    Ok(Spectrum::new(&system.matrix, &Cholesky::new(&system.matrix)?)?)
}

/// A problem whose cover and functions are known, and with them what its solution takes.
///
/// ```
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
/// let plan = Plan::new(&small, memory, &mut |_| {})?;
/// assert_eq!(plan.estimate().patches, 64.0);
/// plan.check()?;
/// let refused = Plan::new(&large, memory, &mut |_| {});
/// assert!(matches!(refused, Err(SolveError::TooLarge { .. })));
/// # Ok::<(), SolveError>(())
/// ```
pub struct Plan<'p> {
    problem: &'p Problem,
    /// The dataset with all coefficients zero.
    dataset: Dataset,
    estimate: Estimate,
    clock: Clock,
}

impl<'p> Plan<'p> {
    /// The plan of a problem, whose solution may take so much memory \[bytes\].
    ///
    /// # Errors
    /// A space that cannot be built, functions that are not finite, a solution that takes more memory or could not
    /// be stored.
    pub fn new(
        problem: &'p Problem,
        memory: Option<u64>,
        report: &mut dyn FnMut(Progress),
    ) -> Result<Self, SolveError> {
        let mut clock = Clock::new();
        report(Progress { phase: Phase::Cover, done: 0, total: 1 });
        fits(Estimate::least(problem), memory)?;
        let most = memory.map_or(usize::MAX, |memory| Estimate::most_cells(problem, memory));
        let dataset = dataset(problem, discretise_within(problem, most)?);
        dataset.check()?;
        let solver = Solver { problem, step: &dataset.steps[0] };
        let estimate = fits(Estimate::of_space(problem, &solver.space()?), memory)?;
        clock.lap(Phase::Cover);
        Ok(Self { problem, dataset, estimate, clock })
    }

    /// What the solution takes.
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
    /// Loads without support, data that are not finite.
    pub fn check(&self) -> Result<(), SolveError> {
        let solver = self.solver();
        solver.loaded(&solver.space()?).map(drop)
    }

    /// Solves the problem.
    ///
    /// # Errors
    /// See [`SolveError`].
    pub fn solve(mut self, report: &mut dyn FnMut(Progress)) -> Result<Dataset, SolveError> {
        let solver = Solver { problem: self.problem, step: &self.dataset.steps[0] };
        let mut solution = solver.run(&mut self.clock, report)?;
        let unresolved = std::mem::take(&mut solution.unresolved);
        solution.store(&mut self.dataset.steps[0], self.problem.components());
        self.judged(&unresolved, report)
    }

    fn solver(&self) -> Solver<'_> {
        Solver { problem: self.problem, step: &self.dataset.steps[0] }
    }

    /// The dataset of a solution with its stress intensity factors, and what is to be said of it.
    fn judged(
        mut self,
        unresolved: &[Unresolved],
        report: &mut dyn FnMut(Progress),
    ) -> Result<Dataset, SolveError> {
        report(Progress { phase: Phase::Intensity, done: 0, total: 1 });
        let record = |name: &str, value| Record { name: name.into(), value, unit: String::new() };
        let energy = record("energy", stored_energy(&self.dataset)?);
        self.dataset.steps[0].history.push(energy);
        let (tips, warnings) = judge(&self.dataset, 0, Some(self.problem))?;
        let (rounding, _) = rounding(&self.dataset, 0)?;
        self.clock.lap(Phase::Intensity);
        let of_quadrature = of_quadrature(unresolved, &self.dataset);
        let step = &mut self.dataset.steps[0];
        step.intensities = tips.into_iter().filter_map(|outcome| outcome.factors).collect();
        step.warnings = warnings;
        step.warnings.extend(of_quadrature);
        step.history.push(record("rounding", rounding));
        step.history.extend(self.clock.records);
        Ok(self.dataset)
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
    /// Rigid-body modes of pieces that nothing holds.
    free_modes: usize,
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
        let loaded = self.loaded(&space)?;
        let imbalance = loaded.imbalance();
        let Assembled { basis, pieces, system, gauge } =
            self.assemble(&space, loaded, clock, report)?;
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
            free_modes: gauge.len(),
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

    /// The loads, and what they meet.
    fn loaded(&self, space: &Space<'_>) -> Result<Loaded<'_>, SolveError> {
        let pieces = Pieces::new(&self.problem.domain, &self.problem.cracks);
        if pieces.all().is_empty() {
            return Err(SpaceError::Nothing.into());
        }
        let given = Given::new(self.problem, space);
        let balance = given.balance(space, &pieces).map_err(SolveError::Data)?;
        let free = free_modes(&balance, &pieces)?;
        Ok(Loaded { given, pieces, balance, free })
    }

    fn assemble(
        &self,
        space: &Space<'_>,
        loaded: Loaded<'_>,
        clock: &mut Clock,
        report: &mut dyn FnMut(Progress),
    ) -> Result<Assembled, SolveError> {
        let Loaded { given, pieces, balance, free } = loaded;
        let law = Law::new(&self.problem.equation);
        let total = space.partition.len();
        report(Progress { phase: Phase::Basis, done: 0, total: 1 });
        let mut basis = StableBasis::new(space).map_err(SolveError::Basis)?;
        let slivers = slivers(self.problem, space, &basis, &law).map_err(SolveError::Data)?;
        basis.damp(space, &slivers).map_err(SolveError::Basis)?;
        clock.lap(Phase::Basis);
        let mut tell = |done| report(Progress { phase: Phase::Assembly, done, total });
        let mut system =
            assemble(&given, space, &basis, &law, &mut tell).map_err(SolveError::Data)?;
        let gauge = Gauge::new(space, &basis, &pieces, &balance, &free, &system.matrix);
        gauge.add_penalty(&mut system.matrix);
        clock.lap(Phase::Assembly);
        Ok(Assembled { basis, pieces, system, gauge })
    }
}

/// What loads and holds the pieces of the plate, which is in equilibrium.
struct Loaded<'p> {
    given: Given<'p>,
    pieces: Pieces,
    /// Of each piece.
    balance: Vec<Balance>,
    /// Of each piece, the rigid-body modes that nothing holds.
    free: Vec<Vec<PerMode>>,
}

impl Loaded<'_> {
    /// Largest part of the loads on a piece that does not balance.
    fn imbalance(&self) -> f64 {
        let pieces = self.balance.iter().zip(&self.free);
        pieces.map(|(balance, free)| balance.imbalance(free)).fold(0.0, f64::max)
    }
}

/// The system in the stable basis, with the penalty of the gauge.
struct Assembled {
    basis: StableBasis,
    pieces: Pieces,
    system: System,
    gauge: Gauge,
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

/// The free modes of each piece, after a check that the loads leave them alone.
fn free_modes(balances: &[Balance], pieces: &Pieces) -> Result<Vec<Vec<PerMode>>, SolveError> {
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
            record("free motions", self.free_modes as f64),
            record("imbalance", self.imbalance),
            record("quadrature points", self.points as f64),
        ]);
    }
}
