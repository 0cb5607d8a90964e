//! How a cover is improved by its own solutions.

use super::word_table;

/// Solve, estimate the error, improve the cover where it is large, again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adaptivity {
    /// Most times that the cover is improved.
    pub steps: usize,
    /// θ: the cells that make up this part of the square of the estimated error are improved, in
    /// (0, 1].
    pub fraction: f64,
    /// Most unknowns of a step.
    pub max_unknowns: usize,
    /// Estimated error that is small enough, in the energy norm, as a part of the norm of
    /// the solution.
    pub tolerance: Option<f64>,
    /// Estimated relative error of the stress intensity factors that is small enough, without tips
    /// of the energy: the goal, for which cells are improved instead of for the energy norm.
    pub accuracy: Option<f64>,
    /// The refinement of cells with large errors.
    pub kind: AdaptKind,
    /// The steps that the dataset keeps.
    pub keep: StepsKept,
}

/// The refinement of cells with large errors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AdaptKind {
    /// They are divided.
    #[default]
    H,
    /// Their order is raised.
    P,
    /// Their order is raised where the field is smooth, others are divided.
    Hp,
}

word_table!(AdaptKind: H "h", P "p", Hp "hp");

/// The steps of an adaptation that a dataset keeps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StepsKept {
    /// The last one.
    #[default]
    Last,
    /// All of them.
    All,
}

word_table!(StepsKept: Last "last", All "all");

/// Defaults: up to ten steps and 100,000 unknowns, which a direct solver on one machine makes in
/// less than a minute; θ = 0.6; the cells are divided.
impl Default for Adaptivity {
    fn default() -> Self {
        Self {
            steps: 10,
            fraction: 0.6,
            max_unknowns: 100_000,
            tolerance: None,
            accuracy: None,
            kind: AdaptKind::default(),
            keep: StepsKept::default(),
        }
    }
}

/// Steps to an accuracy: each halves the error at least, most take more of it.
const STEPS_TO_GOAL: usize = 30;

/// Accuracy of K that polynomials of order 2 have after few steps.
const EASY: f64 = 1e-3;

/// Orders that steps to accuracies below these bounds begin with: those that plates with cracks end
/// up at (docs/decisions/0018-errors-of-factors.md).
const FIRST_ORDERS: [(f64, usize); 4] = [(1e-7, 7), (1e-6, 6), (1e-4, 4), (EASY, 3)];

impl Adaptivity {
    /// The steps to a relative error of the factors, or without tips of the energy: orders are
    /// raised and cells divided.
    #[must_use]
    pub fn to(accuracy: f64) -> Self {
        let (steps, accuracy) = (STEPS_TO_GOAL, Some(accuracy));
        Self { steps, accuracy, ..Self::new(AdaptKind::Hp) }
    }

    /// Level of the cover that the steps to an accuracy begin with, if none is given. Plates with
    /// cracks need about that cover, and [this order](Self::first_order), so that steps are few.
    pub(crate) fn first_level(accuracy: f64) -> u32 {
        if accuracy < EASY { 3 } else { 2 }
    }

    /// Order of the polynomials that the steps to an accuracy begin with.
    pub(crate) fn first_order(accuracy: f64) -> usize {
        let reached = FIRST_ORDERS.iter().find(|(bound, _)| accuracy < *bound);
        reached.map_or(2, |(_, order)| *order)
    }

    /// The defaults for one kind.
    #[must_use]
    pub fn new(kind: AdaptKind) -> Self {
        Self { kind, ..Self::default() }
    }
}
