//! How cracks grow, step by step.

use super::check::MistakeAt;
use super::cracks::touch;
use super::key::Key;
use super::{Keep, Problem};
use ppum::expression::Expression;
use ppum::text::trimmed;

/// A quasi-static series: solve, let the tips go on, again.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
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
    /// What the load does.
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

/// What the load does while cracks grow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LoadControl {
    /// It is that of the problem.
    #[default]
    Constant,
    /// It is multiplied by a factor so that the strength of one tip is its toughness, and that of
    /// no other is larger.
    Critical,
}

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

/// Least increment in units of the length below which things touch: an arc may have
/// several vertices.
const LEAST_INCREMENT: f64 = 100.0;

/// Least ratio of loads: in the largest cycles there are the load is turned around, ratio −1.
const LEAST_RATIO: f64 = -1e3;

/// Most increments: a step may take a second.
const MOST_STEPS: usize = 100_000;

/// All rules broken by the growth of a problem.
pub(super) fn check_growth(problem: &Problem) -> Vec<MistakeAt> {
    let Some(rule) = &problem.growth else { return Vec::new() };
    let key = |name| Key::new("growth").name(name);
    let mut found: Vec<MistakeAt> = broken(rule)
        .into_iter()
        .map(|(name, message)| MistakeAt::new(key(name), message))
        .chain(rule.paris.iter().flat_map(broken_paris))
        .collect();
    let least = LEAST_INCREMENT * touch(&problem.domain.bounds);
    if rule.increment.is_some_and(|increment| increment > 0.0 && increment < least) {
        let message = format!(
            "`increment` is {}, but points of a crack in this plate must be {} apart: make it longer",
            trimmed(rule.increment.unwrap_or(0.0)),
            trimmed(least)
        );
        found.push(MistakeAt::new(key("increment"), message));
    }
    if problem.equation.elastic().is_none() {
        let message = "cracks grow by their stress intensity factors, which only elasticity has; leave [growth] out";
        found.push(MistakeAt::new(Key::new("growth"), message));
    }
    if problem.adaptivity.as_ref().is_some_and(|set| set.keep == Keep::All) {
        let message = "`keep = \"all\"` keeps the steps of an adaptation, and [growth] those of growth; leave it out";
        found.push(MistakeAt::new(Key::new("adaptivity").name("keep"), message));
    }
    found
}

fn broken(rule: &GrowthRule) -> Vec<(&'static str, String)> {
    let GrowthRule { increment, steps, ref toughness, load, paris, .. } = *rule;
    let is_length = |length: &f64| *length > 0.0 && length.is_finite();
    let constant = toughness.as_ref().and_then(Expression::constant);
    let rules = [
        ((1..=MOST_STEPS).contains(&steps), "steps", {
            format!("`steps` is {steps}, but must be 1 to {MOST_STEPS}")
        }),
        (increment.is_none_or(|da| is_length(&da)), "increment", {
            "`increment` must be a positive length; leave it out to have it chosen".into()
        }),
        (constant.is_none_or(|k| is_length(&k)), "toughness", {
            "`toughness` must be positive and finite".into()
        }),
        (load == LoadControl::Constant || toughness.is_some(), "load", {
            "`load = \"critical\"` needs a `toughness`, which the load is chosen to reach; add it"
                .into()
        }),
        (load == LoadControl::Constant || paris.is_none(), "load", {
            "`load = \"critical\"` is for one load that grows, `paris` for many cycles of the same; leave one out"
                .into()
        }),
    ];
    rules.into_iter().filter(|(holds, ..)| !holds).map(|(_, name, text)| (name, text)).collect()
}

fn broken_paris(paris: &Paris) -> Vec<MistakeAt> {
    let Paris { c, m, threshold, ratio } = *paris;
    let rules = [
        (c > 0.0 && c.is_finite(), "c", "`c` must be positive and finite"),
        ((0.0..=100.0).contains(&m), "m", "`m` must be 0 to 100; 2 to 4 is usual"),
        (threshold >= 0.0 && threshold.is_finite(), "threshold", "`threshold` may not be negative"),
        ((LEAST_RATIO..1.0).contains(&ratio), "ratio", {
            "`ratio` is that of the smallest to the largest load of a cycle, and must be below 1 and not below −1000"
        }),
    ];
    let key = |name| Key::new("growth").name("paris").name(name);
    let broken = rules.into_iter().filter(|(holds, ..)| !holds);
    broken.map(|(_, name, message)| MistakeAt::new(key(name), message)).collect()
}
