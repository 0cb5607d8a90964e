//! The memory that a solution takes, known before it is computed.
//!
//! The patches that overlap are known once there is a cover, and with them the non-zeros of the
//! system. The cost of the elimination is counted on the graph of the patches, in the order of the
//! elimination, each patch with the number of its unknowns. How long a solution takes is not
//! predicted: it can be watched, and stopped.

use ppum::dataset::monomials;
use ppum_linear::{BlockPattern, fill};
use ppum_problem::{PolynomialOrder, Problem, SolverKind};
use ppum_solve::assembly::pattern;
use ppum_solve::report::LinearKind;
use ppum_solve::space::TrialSpace;
use std::fmt;

/// Bytes of a value of the system or its factor.
const VALUE_BYTES: f64 = size_of::<f64>() as f64;

/// Memory beside the values of system and factor, as a part of them: stable basis, triangles that
/// are held in full, what fronts leave for their parents.
const BESIDE: f64 = 0.4;

/// Memory of any solution: the program, the work on cells. Measured
/// (`docs/decisions/0043-cost.md`).
const FIXED_BYTES: f64 = 8e7;

/// Bytes of a patch beside its blocks.
const PATCH_BYTES: f64 = 1_500.0;

/// Bytes of a value of the system with all levels and the inverses of their diagonal blocks, and of
/// a patch with its ancestors: measured (`docs/decisions/0020-multilevel.md`).
const LEVELS_BYTES: f64 = 18.0;
const LEVELS_PATCH_BYTES: f64 = 2_500.0;

/// Memory above which the direct solver gives way: half of what small machines have. Up to there it
/// is the faster one, or as fast (`docs/decisions/0020-multilevel.md`).
const LARGE_BYTES: f64 = 4e9;

/// Patches from which on nobody counts what elimination would add: the direct solver takes minutes
/// and tens of gigabytes.
const TOO_MANY_TO_COUNT: usize = 600_000;

/// Pairs of overlapping patches that a cell stands for at least: in a uniform cover a patch has
/// five, itself and four neighbours, and up to half of the cells may lie in holes.
const LEAST_PAIRS: f64 = 2.5;

/// The unknowns of a problem and the memory that solving it takes.
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
    /// Memory \[bytes\], right within a factor of 1.5.
    pub memory: f64,
    /// True if the direct solver could take the place of the chosen one.
    pub(crate) falls_back: bool,
}

impl Estimate {
    /// The estimate for the space of a problem, with the linear solver that the problem names or
    /// that suits it and a memory \[bytes\].
    pub(crate) fn of_space(problem: &Problem, space: &TrialSpace<'_>, memory: Option<u64>) -> Self {
        let sizes: Vec<_> = (0..space.sizes.len()).map(|patch| space.unknowns(patch)).collect();
        let pattern = pattern(space);
        let multilevel = Self::multilevel(&sizes, nonzeros(&pattern, &sizes));
        let direct = || multilevel.direct(fill(&pattern, &sizes));
        match problem.solver_kind() {
            SolverKind::Direct => direct(),
            SolverKind::Auto | SolverKind::Multilevel if sizes.len() > TOO_MANY_TO_COUNT => {
                multilevel
            }
            SolverKind::Auto => direct().or(multilevel, memory),
            SolverKind::Multilevel => Self { falls_back: direct().fits(memory), ..multilevel },
        }
    }

    /// The estimate of this solution after another one, of which the coefficients are kept.
    pub(crate) fn after(self, first: &Self) -> Self {
        let kept = VALUE_BYTES * first.unknowns + PATCH_BYTES * first.patches;
        Self { memory: (self.memory + kept).max(first.memory), ..self }
    }

    fn fits(&self, memory: Option<u64>) -> bool {
        memory.is_none_or(|memory| self.memory <= memory as f64)
    }

    /// This one of the direct solver, or the other one where the memory asks for it.
    fn or(self, multilevel: Self, memory: Option<u64>) -> Self {
        let holds = self.fits(memory);
        if holds && self.memory <= LARGE_BYTES || multilevel.memory >= self.memory {
            self
        } else {
            Self { falls_back: holds, ..multilevel }
        }
    }

    /// The number of cells of a cover from which on a problem does not fit into a memory.
    pub(crate) fn most_cells(problem: &Problem, memory: u64) -> usize {
        let order = match &problem.discretization.order {
            PolynomialOrder::Uniform(order) => *order,
            PolynomialOrder::Formula(_) => 0,
        };
        let size = (monomials(order) * problem.components()) as f64;
        let bytes = match problem.solver_kind() {
            SolverKind::Direct => 2.0 * VALUE_BYTES,
            SolverKind::Auto | SolverKind::Multilevel => LEVELS_BYTES,
        };
        (memory as f64 / (LEAST_PAIRS * size * size * bytes + PATCH_BYTES)) as usize
    }

    /// The estimate with the multilevel solver.
    fn multilevel(sizes: &[usize], nonzeros: f64) -> Self {
        let patches = sizes.len() as f64;
        Self {
            patches,
            unknowns: sizes.iter().sum::<usize>() as f64,
            nonzeros,
            solver: LinearKind::Multilevel,
            factor: 0.0,
            memory: LEVELS_BYTES * nonzeros + LEVELS_PATCH_BYTES * patches + FIXED_BYTES,
            falls_back: false,
        }
    }

    /// The estimate with the direct solver, whose factor has so many values.
    fn direct(self, factor: f64) -> Self {
        let values = VALUE_BYTES * (self.nonzeros + factor);
        let memory = values * (1.0 + BESIDE) + PATCH_BYTES * self.patches + FIXED_BYTES;
        Self { solver: LinearKind::Direct, factor, memory, ..self }
    }
}

/// `4,096 patches, 73,728 unknowns, 5.8 million non-zeros, 31 million in the factor: about 0.5 GiB`
impl fmt::Display for Estimate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let solver = match self.solver {
            LinearKind::Direct => format!("{} in the factor", count(self.factor)),
            LinearKind::Multilevel => "multilevel solver".into(),
        };
        let [patches, unknowns, nonzeros] = [self.patches, self.unknowns, self.nonzeros].map(count);
        let memory = gibibytes(self.memory);
        write!(
            f,
            "{patches} patches, {unknowns} unknowns, {nonzeros} non-zeros, {solver}: about {memory}"
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

/// Values of the stored half of a system.
fn nonzeros(pattern: &BlockPattern, sizes: &[usize]) -> f64 {
    let row = |i: usize| {
        let columns = pattern.row(i).iter().map(|&j| sizes[j as usize]);
        (sizes[i] * columns.sum::<usize>()) as f64
    };
    (0..sizes.len()).map(row).sum()
}
