//! The crack tips of a step with their stress intensity factors, as tables show them.

use std::collections::BTreeMap;

use ppum::crack::{TipId, tips};
use ppum::dataset::{Step, TipIntensity};
use ppum::text::{beside, short};
use ppum::vec2::Vec2;

/// A tip.
#[derive(Clone, Debug, PartialEq)]
pub struct Tip {
    /// Which one.
    pub id: TipId,
    /// Its place.
    pub at: Vec2,
    /// Direction of growth, radians from the x axis.
    pub angle: f64,
    /// K_I; NaN of a tip without factors.
    pub k1: f64,
    /// K_II; NaN of a tip without factors.
    pub k2: f64,
    /// The largest relative difference of two radii: no estimate of the error.
    pub spread: f64,
}

impl Tip {
    /// A tip of a step with its factors, if it has any.
    #[must_use]
    pub fn new(step: &Step, id: TipId, factors: Option<&TipIntensity>) -> Self {
        let crack = &step.cracks[id.crack as usize];
        let axis = crack.growth_direction(id.end);
        let number = |of: fn(&TipIntensity) -> f64| factors.map_or(f64::NAN, of);
        Self {
            id,
            at: crack.end_point(id.end),
            angle: axis.y.atan2(axis.x),
            k1: number(|factors| factors.k1),
            k2: number(|factors| factors.k2),
            spread: number(TipIntensity::spread),
        }
    }
}

/// The tips of a step in their order, with the factors that the solver stored.
#[must_use]
pub fn stored(step: &Step) -> Vec<Tip> {
    // of several factors of a tip the first ones count
    let all = step.intensities.iter().rev();
    let known: BTreeMap<TipId, &TipIntensity> = all.map(|factors| (factors.tip, factors)).collect();
    tips(&step.cracks).map(|id| Tip::new(step, id, known.get(&id).copied())).collect()
}

/// K_I, K_II and their spread in words: the one of K_I and K_II that is rounding of the other is zero, and what is not
/// known a dash.
#[must_use]
pub fn words(k1: f64, k2: f64, spread: f64) -> [String; 3] {
    let size = k1.hypot(k2);
    let factor = |k: f64| if k.is_nan() { "–".into() } else { short(beside(k, size)) };
    let spread = match spread {
        s if s.is_nan() => "–".into(),
        0.0 => "0".into(),
        s => format!("{s:.0e}"),
    };
    [factor(k1), factor(k2), spread]
}
