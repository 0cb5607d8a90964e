//! How cracks grow, step by step.

use ppum::expression::Expression;

use super::word_table;

/// A quasi-static series: solve, let the tips go on, again.
#[derive(Clone, Debug, PartialEq)]
pub struct GrowthRule {
    /// Where a tip goes.
    pub criterion: Criterion,
    /// Length by which the tip that grows most does in a step; chosen step by step if none
    /// is given.
    pub increment: Option<f64>,
    /// Most increments.
    pub steps: usize,
    /// K_c > 0 of the place: the strength of a tip that grows \[stress·length^½\].
    pub toughness: Option<Expression>,
    /// The control of the load.
    pub load: LoadControl,
    /// Growth under cyclic loads.
    pub paris: Option<Paris>,
}

/// The direction in which a tip grows, and the factor that is compared with the toughness.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Criterion {
    /// Where the hoop stress around the tip is largest (Erdogan & Sih 1963).
    #[default]
    Hoop,
    /// Where K_II = 0 at the tip of what has grown (Goldstein & Salganik 1974).
    LocalSymmetry,
    /// Where most energy is released (Hussain, Pu & Underwood 1974).
    Energy,
}

word_table!(Criterion: Hoop "hoop", LocalSymmetry "local-symmetry", Energy "energy");

/// The control of the load while cracks grow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LoadControl {
    /// It is that of the problem.
    #[default]
    Constant,
    /// It is multiplied by a factor so that the strength of one tip is its toughness, and that of
    /// no other is larger.
    Critical,
}

word_table!(LoadControl: Constant "constant", Critical "critical");

/// Growth per cycle da/dN = c ΔK^m, ΔK = (1 − ratio) × strength, above a threshold (Paris &
/// Erdogan 1963).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paris {
    /// c > 0, in the units of the problem: length per cycle for ΔK = 1.
    pub c: f64,
    /// m ≥ 0.
    pub m: f64,
    /// ΔK up to which nothing grows.
    pub threshold: f64,
    /// Smallest load of a cycle in parts of the largest, from −1000 to below 1.
    pub ratio: f64,
}

impl GrowthRule {
    /// So many increments by the largest hoop stress under constant load.
    #[must_use]
    pub fn new(steps: usize) -> Self {
        Self {
            criterion: Criterion::default(),
            increment: None,
            steps,
            toughness: None,
            load: LoadControl::default(),
            paris: None,
        }
    }
}

impl Paris {
    /// The law without threshold, for loads that fall to zero in each cycle.
    #[must_use]
    pub fn new(c: f64, m: f64) -> Self {
        Self { c, m, threshold: 0.0, ratio: 0.0 }
    }

    /// ln da/dN of a tip of this strength that grows: powers may be out of all range.
    #[must_use]
    pub fn ln_rate(&self, strength: f64) -> f64 {
        self.c.ln() + self.m * self.range(strength).ln()
    }

    /// True if ΔK of a tip of this strength is above the threshold.
    #[must_use]
    pub fn grows(&self, strength: f64) -> bool {
        self.range(strength) > self.threshold
    }

    /// ΔK of a tip of this strength.
    fn range(&self, strength: f64) -> f64 {
        (1.0 - self.ratio) * strength
    }
}
