//! How cracks grow, step by step.

use ppum::expression::Expression;
use ppum::vec2::Vec2;

use super::scopes::DIRECTION;
use super::{GrowthLaw, word_table};

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
    /// K_c > 0 of the place: the strength of a tip that grows \[stress·length^½\]. A formula may
    /// use `direction`, the angle of the new path from the x axis in radians.
    pub toughness: Option<Expression>,
    /// The control of the load.
    pub load: LoadControl,
    /// How fast tips grow; none where growth has no time.
    pub law: Option<GrowthLaw>,
}

impl GrowthRule {
    /// True if the toughness depends on the direction of a new path.
    #[must_use]
    pub fn is_directed(&self) -> bool {
        self.toughness.as_ref().is_some_and(|toughness| toughness.formula().uses(DIRECTION))
    }

    /// The toughness of a new path, by the angle of its direction.
    #[must_use]
    pub fn toughness_at(&self, p: Vec2, direction: f64) -> Option<f64> {
        let toughness = self.toughness.as_ref()?;
        let inputs = [p.x, p.y, direction];
        Some(toughness.constant().unwrap_or_else(|| toughness.formula().evaluate(&inputs)))
    }
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
            law: None,
        }
    }
}
