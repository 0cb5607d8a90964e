//! The effort of a solution, known before it is computed: unknowns, non-zeros, memory and time.
//!
//! The patches that overlap are known once there is a cover, and with them the non-zeros of the
//! system. What the elimination adds is counted on the graph of the patches, in the order of the
//! elimination, each patch with the number of its unknowns. Before there is a cover a bound from
//! below is known, which sorts out what would take too long to be counted.

use ppum::crack::tips;
use ppum::dataset::monomials;
use ppum::domain::Hole;
use ppum::vec2::Rect;
use ppum_linear::{BlockPattern, fill};
use ppum_problem::{Cells, Order, Problem, SolverKind};
use ppum_solve::assembly::pattern;
use ppum_solve::report::LinearKind;
use ppum_solve::space::Space;
use std::f64::consts::PI;
use std::fmt;

/// Bytes of a value of the system, which is held once.
const SYSTEM_BYTES: f64 = 8.0;

/// Bytes of a value of the factor.
const FACTOR_BYTES: f64 = 8.0;

/// Memory beside the values of system and factor, as a part of them: stable basis, triangles that
/// are held in full, what fronts leave for their parents.
const BESIDE: f64 = 0.4;

/// Memory of any solution: the program, the work on cells.
const FIXED_BYTES: f64 = 3e7;

/// Bytes of a coefficient of a solution.
const COEFFICIENT_BYTES: f64 = 8.0;

/// Values of a patch beside its blocks.
const PATCH_BYTES: f64 = 1_500.0;

/// Bytes of a value of the system with all levels and the inverses of their diagonal blocks, and of
/// a patch with its ancestors: measured (`docs/decisions/0020-multilevel.md`).
const LEVELS_BYTES: f64 = 18.0;
const LEVELS_PATCH_BYTES: f64 = 2_500.0;

/// Seconds of a step of the multilevel solver for a value of the system, which memory decides and
/// not the number of cores.
const STEP_SECONDS: f64 = 1.0e-8;

/// Steps of a solution, and of the dual solutions that tips need beside.
const STEPS: f64 = 22.0;
const DUAL_STEPS: f64 = 2.0 * 12.0;

/// Work on the cells of all coarser levels and on the ways between them, as a part of that on the
/// finest: a third, and more where there are enrichments.
const COARSER: f64 = 0.6;

/// Memory above which the direct solver gives way even where it would be faster: half of what small
/// machines have.
const LARGE_BYTES: f64 = 4e9;

/// Patches from which on nobody counts what elimination would add: the direct solver takes minutes
/// and tens of gigabytes.
const TOO_MANY_TO_COUNT: usize = 600_000;

/// Patches that a patch of a uniform cover overlaps with, itself and of each pair only one counted.
const NEIGHBOURS: f64 = 5.0;

/// Seconds of an operation of the factorisation, of a value of the factor in all solutions with it,
/// and of a product of functions at a quadrature point, on one core of a machine of
/// 2023 (`docs/decisions/0027-factorisation.md`).
const FACTOR_SECONDS: f64 = 4.0e-11;
const SWEEP_SECONDS: f64 = 1.2e-8;
const ASSEMBLY_SECONDS: f64 = 1.1e-9;

/// Seconds that a cell takes in any case.
const CELL_SECONDS: f64 = 1.5e-4;

/// Seconds that the stress intensity of a tip takes on one core.
const TIP_SECONDS: f64 = 0.2;

/// The effort of solving a problem.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Patches of the cover.
    pub patches: f64,
    /// Unknowns, before functions that depend on others are cut off.
    pub unknowns: f64,
    /// Values of the system's matrix, of which one half is stored.
    pub nonzeros: f64,
    /// The linear solver that is taken.
    pub solver: LinearKind,
    /// Values of the matrix's factor; zero for the multilevel solver.
    pub factor: f64,
    /// Memory \[bytes\], right within a third.
    pub memory: f64,
    /// True if the direct solver could take the place of the chosen one.
    pub(super) falls_back: bool,
    /// Time on this number of cores \[s\], right within a factor of about three on a machine of
    /// today; what the formulas of a problem take is not in it.
    pub seconds: f64,
}

/// The work of a solution, counted in operations.
#[derive(Clone, Copy, Debug, Default)]
struct OperationCount {
    assembly: f64,
    factor: f64,
    tips: f64,
}

impl Estimate {
    /// The estimate for the space of a problem, with the linear solver that the problem names or
    /// that suits it and a memory \[bytes\].
    pub(crate) fn of_space(problem: &Problem, space: &Space<'_>, memory: Option<u64>) -> Self {
        let sizes: Vec<_> = (0..space.sizes.len()).map(|patch| space.unknowns(patch)).collect();
        let pattern = pattern(space);
        let tips = if problem.equation.elastic().is_some() { n_tips(problem) } else { 0.0 };
        let work = OperationCount { assembly: assembly(space), factor: 0.0, tips };
        let (patches, nonzeros) = (sizes.len() as f64, nonzeros(&pattern, &sizes));
        let multilevel = || Self::multilevel(patches, &sizes, nonzeros, work);
        let direct = || {
            let fill = fill(&pattern, &sizes);
            Self::new(
                patches,
                &sizes,
                nonzeros,
                fill.values,
                OperationCount { factor: fill.operations, ..work },
            )
        };
        match problem.solver_kind() {
            SolverKind::Direct => direct(),
            SolverKind::Auto | SolverKind::Multilevel if sizes.len() > TOO_MANY_TO_COUNT => {
                multilevel()
            }
            SolverKind::Auto => direct().or(multilevel(), memory),
            SolverKind::Multilevel => Self { falls_back: direct().fits(memory), ..multilevel() },
        }
    }

    /// The estimate of this solution after another one, of which the coefficients are kept.
    pub(super) fn after(self, first: &Self) -> Self {
        let kept = COEFFICIENT_BYTES * first.unknowns + PATCH_BYTES * first.patches;
        Self {
            memory: (self.memory + kept).max(first.memory),
            seconds: self.seconds + first.seconds,
            ..self
        }
    }

    fn fits(&self, memory: Option<u64>) -> bool {
        memory.is_none_or(|memory| self.memory <= memory as f64)
    }

    /// This one of the direct solver, or the other one where that wins or the memory asks for it.
    fn or(self, multilevel: Self, memory: Option<u64>) -> Self {
        let holds = self.fits(memory);
        let is_direct = holds && self.memory <= LARGE_BYTES && self.seconds <= multilevel.seconds;
        if is_direct || multilevel.memory >= self.memory {
            self
        } else {
            Self { falls_back: holds, ..multilevel }
        }
    }

    /// A bound from below, without a cover.
    pub(crate) fn least(problem: &Problem) -> Self {
        let patches = least_patches(problem);
        let size = (least_size(problem) * problem.components()) as f64;
        let unknowns = patches * size;
        let nonzeros = patches * NEIGHBOURS.min(patches) * size * size;
        let points = points(least_order(problem));
        let functions = (NEIGHBOURS + 4.0).min(patches) * least_size(problem) as f64;
        let assembly = patches * points * functions * functions;
        let work = OperationCount { assembly, ..OperationCount::default() };
        let direct = Self { unknowns, ..Self::new(patches, &[], nonzeros, nonzeros, work) };
        let multilevel = Self { unknowns, ..Self::multilevel(patches, &[], nonzeros, work) };
        match problem.solver_kind() {
            SolverKind::Direct => direct,
            SolverKind::Multilevel => multilevel,
            SolverKind::Auto if direct.memory < multilevel.memory => direct,
            SolverKind::Auto => multilevel,
        }
    }

    /// The number of cells of a cover from which on a problem does not fit into a memory.
    pub(crate) fn most_cells(problem: &Problem, memory: u64) -> usize {
        let size = (least_size(problem) * problem.components()) as f64;
        let bytes = match problem.solver_kind() {
            SolverKind::Direct => SYSTEM_BYTES + FACTOR_BYTES,
            SolverKind::Auto | SolverKind::Multilevel => LEVELS_BYTES,
        };
        let values = NEIGHBOURS * size * size * bytes;
        (memory as f64 / (values + PATCH_BYTES)) as usize
    }

    fn new(
        patches: f64,
        sizes: &[usize],
        nonzeros: f64,
        factor: f64,
        work: OperationCount,
    ) -> Self {
        let cores = rayon::current_num_threads() as f64;
        let values = SYSTEM_BYTES * nonzeros + FACTOR_BYTES * factor;
        let cells = CELL_SECONDS * patches + ASSEMBLY_SECONDS * work.assembly;
        let of_factor = FACTOR_SECONDS * work.factor + SWEEP_SECONDS * factor;
        Self {
            patches,
            unknowns: sizes.iter().map(|&size| size as f64).sum(),
            nonzeros,
            solver: LinearKind::Direct,
            falls_back: false,
            factor,
            memory: values * (1.0 + BESIDE) + PATCH_BYTES * patches + FIXED_BYTES,
            seconds: (cells + TIP_SECONDS * work.tips + of_factor) / cores,
        }
    }
}

impl Estimate {
    /// The estimate with the multilevel solver.
    fn multilevel(patches: f64, sizes: &[usize], nonzeros: f64, work: OperationCount) -> Self {
        let direct =
            Self::new(patches, sizes, nonzeros, 0.0, OperationCount { factor: 0.0, ..work });
        let cells = CELL_SECONDS * patches + ASSEMBLY_SECONDS * work.assembly;
        let coarser = COARSER * cells / rayon::current_num_threads() as f64;
        let steps = STEPS + if work.tips > 0.0 { DUAL_STEPS } else { 0.0 };
        Self {
            solver: LinearKind::Multilevel,
            memory: LEVELS_BYTES * nonzeros + LEVELS_PATCH_BYTES * patches + FIXED_BYTES,
            seconds: direct.seconds + coarser + steps * STEP_SECONDS * nonzeros,
            ..direct
        }
    }
}

/// `4,096 patches, 73,728 unknowns, 5.8 million non-zeros, 31 million in the factor: about 0.5 GiB
/// and 20 s`
impl fmt::Display for Estimate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let solver = match self.solver {
            LinearKind::Direct => format!("{} in the factor", count(self.factor)),
            LinearKind::Multilevel => "multilevel solver".into(),
        };
        write!(
            f,
            "{} patches, {} unknowns, {} non-zeros, {solver}: about {} and {}",
            count(self.patches),
            count(self.unknowns),
            count(self.nonzeros),
            gibibytes(self.memory),
            duration(self.seconds)
        )
    }
}

/// A memory in words, with two digits.
pub(crate) fn gibibytes(bytes: f64) -> String {
    let (mebi, gibi) = (bytes / (1u64 << 20) as f64, bytes / (1u64 << 30) as f64);
    match gibi {
        1_000.0.. => format!("{} TiB", two_digits(gibi / 1_024.0)),
        1.0.. => format!("{} GiB", two_digits(gibi)),
        _ => format!("{} MiB", two_digits(mebi)),
    }
}

fn two_digits(value: f64) -> String {
    if value < 10.0 { format!("{value:.1}") } else { format!("{value:.0}") }
}

/// A count in words: digits in groups of three, millions and more with two digits.
fn count(value: f64) -> String {
    let words = [(1e12, "trillion"), (1e9, "billion"), (1e6, "million")];
    match words.into_iter().find(|(unit, _)| value >= *unit) {
        Some((unit, word)) => format!("{} {word}", two_digits(value / unit)),
        None if value >= 1e3 => format!("{},{:03}", value as u64 / 1000, value as u64 % 1000),
        None => format!("{value:.0}"),
    }
}

fn duration(seconds: f64) -> String {
    let (minutes, hours) = (seconds / 60.0, seconds / 3600.0);
    match seconds {
        172_800.0.. => format!("{:.0} days", hours / 24.0),
        7_200.0.. => format!("{hours:.0} hours"),
        120.0.. => format!("{minutes:.0} minutes"),
        1.0.. => format!("{seconds:.0} s"),
        _ => "less than a second".to_owned(),
    }
}

/// Values of the stored half of a system.
fn nonzeros(pattern: &BlockPattern, sizes: &[usize]) -> f64 {
    let row = |i: usize| {
        let columns = pattern.row(i).iter().map(|&j| sizes[j as usize]);
        (sizes[i] * columns.sum::<usize>()) as f64
    };
    (0..sizes.len()).map(row).sum()
}

/// Products of functions at the quadrature points of all cells.
fn assembly(space: &Space<'_>) -> f64 {
    let points = points(space.degree());
    let of_cell = |patches: &Vec<u32>| {
        let functions: usize = patches.iter().map(|&patch| space.sizes[patch as usize]).sum();
        points * (functions * functions) as f64
    };
    space.coverers.iter().map(of_cell).sum()
}

/// Quadrature points of a cell that nothing cuts: nine parts with different patches.
fn points(degree: usize) -> f64 {
    9.0 * ((degree + 2) * (degree + 2)) as f64
}

/// Patches that a cover has at least: the solid part of the base cover, and one per tip.
fn least_patches(problem: &Problem) -> f64 {
    let base = match &problem.discretization.cells {
        Cells::Level(level) => 4f64.powi(*level as i32),
        Cells::Grid([x, y]) => f64::from(*x) * f64::from(*y),
        Cells::Points(_) => 1.0,
    };
    let bounds = &problem.domain().bounds;
    let holes: f64 = problem.domain().holes.iter().map(|hole| area(hole, bounds)).sum();
    let solid = (1.0 - holes / (bounds.size().x * bounds.size().y)).max(0.0);
    let refined = problem.discretization.refine;
    let tips = if refined { n_tips(problem) } else { 0.0 };
    (base * solid).max(tips).max(1.0)
}

fn n_tips(problem: &Problem) -> f64 {
    tips(problem.cracks()).count() as f64
}

/// A bound of the area that a hole takes of a box.
fn area(hole: &Hole, bounds: &Rect) -> f64 {
    let part = hole.bounds().intersection(bounds).size();
    let inside = part.x.max(0.0) * part.y.max(0.0);
    match hole {
        Hole::Circle { radius, .. } => inside.min(PI * radius * radius),
        Hole::Polygon { .. } if hole.is_outside() => inside - least_inside(hole, bounds),
        Hole::Polygon { .. } => inside,
    }
}

/// The area of an outline in a box; nothing of one that the box cuts.
fn least_inside(outline: &Hole, bounds: &Rect) -> f64 {
    let corner = bounds.min;
    let twice: f64 = outline.sides().map(|[a, b]| (a - corner).cross(b - corner)).sum();
    let is_whole = outline.sides().all(|[a, _]| bounds.contains(a));
    if is_whole { 0.5 * twice.abs() } else { 0.0 }
}

fn least_order(problem: &Problem) -> usize {
    match &problem.discretization.order {
        Order::Uniform(order) => *order,
        Order::Formula(_) => 0,
    }
}

/// Functions that a patch has at least.
fn least_size(problem: &Problem) -> usize {
    monomials(least_order(problem))
}
