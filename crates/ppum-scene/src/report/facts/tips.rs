//! The crack tips of a step with their stress intensity factors.

use std::collections::BTreeMap;

use ppum::crack::{TipId, tips};
use ppum::dataset::{self, Dataset, TipIntensity};
use ppum::text::{beside, short};
use serde::Serialize;

use super::JsonNumber;

/// A tip. Unknown values are NaN.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Tip {
    /// Number of the step.
    pub step: usize,
    /// Number of the crack.
    pub crack: u32,
    /// Its place.
    #[serde(rename = "tip")]
    pub at: [f64; 2],
    /// Direction of the crack at the tip, radians from the x axis.
    pub angle: f64,
    /// K_I.
    pub k1: JsonNumber,
    /// K_II.
    pub k2: JsonNumber,
    /// T, the finite part of the stress along the crack.
    pub t_stress: JsonNumber,
    /// The J-integral, found without the factors.
    pub j: JsonNumber,
    /// G = (K_I² + K_II²) / E′ with the material at the tip.
    pub g: JsonNumber,
    /// Direction of the largest hoop stress, radians from [`Self::angle`].
    pub growth_angle: JsonNumber,
    /// Estimated error of (K_I, K_II).
    pub error: JsonNumber,
    /// Largest relative difference of two rings: no estimate of the error.
    pub spread: JsonNumber,
    rings: Vec<RingFacts>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct RingFacts {
    r1: f64,
    r2: f64,
    k1: JsonNumber,
    k2: JsonNumber,
}

/// Heads of the columns of [`Tip::words`].
pub const HEADS: [&str; 8] = ["K_I", "K_II", "T", "G", "angle", "error", "spread", "J/G-1"];

/// The meaning of columns of the table of tips.
pub const MEANING: &str =
    "angle: of growth (hoop stress); error: of K, estimated, relative; spread, J/G-1: checks alone";

const DASH: &str = "–";

impl Tip {
    /// A tip of step number `index` with its factors.
    #[must_use]
    pub fn new(dataset: &Dataset, index: usize, factors: &TipIntensity) -> Self {
        let TipIntensity { tip, k1, k2, t_stress, j, error, rings } = factors;
        let crack = &dataset.steps[index].cracks[tip.crack as usize];
        let (axis, at) = (crack.growth_direction(tip.end), crack.end_point(tip.end));
        let elastic = dataset.equation.elastic();
        let known = |value: Option<f64>| JsonNumber(value.unwrap_or(f64::NAN));
        Self {
            step: index,
            crack: tip.crack,
            at: at.into(),
            angle: axis.y.atan2(axis.x),
            k1: JsonNumber(*k1),
            k2: JsonNumber(*k2),
            t_stress: known(*t_stress),
            j: known(*j),
            g: known(elastic.map(|body| factors.energy_release_in(body, [at, axis]))),
            growth_angle: known(factors.growth_angle_in(&dataset.equation, [at, axis])),
            error: known(*error),
            spread: JsonNumber(factors.spread()),
            rings: rings.iter().map(RingFacts::new).collect(),
        }
    }

    /// A tip that has no factors.
    #[must_use]
    pub fn without_factors(dataset: &Dataset, index: usize, tip: TipId) -> Self {
        Self::new(dataset, index, &TipIntensity::new(tip, f64::NAN, f64::NAN))
    }

    /// |K| = √(K_I² + K_II²).
    fn size(&self) -> f64 {
        self.k1.0.hypot(self.k2.0)
    }

    /// The estimated error as a part of |K|.
    #[must_use]
    pub fn relative_error(&self) -> f64 {
        self.error.0 / self.size()
    }

    /// Its numbers in words, in the order of [`HEADS`]: what is rounding of what stands beside it
    /// is zero, and what is not known a dash.
    #[must_use]
    pub fn words(&self) -> [String; 8] {
        let (size, g) = (self.size(), self.g.0);
        let reach = self.rings.iter().map(|ring| ring.r2).fold(f64::NAN, f64::max);
        [
            number(self.k1.0, size),
            number(self.k2.0, size),
            // where T is zero, it is found as rounding of the stresses in the disc
            number(self.t_stress.0, size / reach.sqrt()),
            number(g, g),
            degrees(self.growth_angle.0),
            part(self.relative_error()),
            part(self.spread.0),
            part((self.j.0 / g - 1.0).abs()),
        ]
    }
}

impl RingFacts {
    fn new(ring: &dataset::Ring) -> Self {
        Self { r1: ring.r1, r2: ring.r2, k1: JsonNumber(ring.k1), k2: JsonNumber(ring.k2) }
    }
}

fn number(value: f64, size: f64) -> String {
    if value.is_nan() { DASH.into() } else { short(beside(value, size)) }
}

fn degrees(angle: f64) -> String {
    if angle.is_nan() {
        return DASH.into();
    }
    // zero has no sign
    format!("{:.1}°", (10.0 * angle.to_degrees()).round() / 10.0 + 0.0)
}

fn part(part: f64) -> String {
    match part {
        0.0 => "0".into(),
        part if part.is_finite() => format!("{part:.0e}"),
        _ => DASH.into(),
    }
}

/// The tips of step number `index` in their order, with the factors that are stored.
#[must_use]
pub fn all_tips(dataset: &Dataset, index: usize) -> Vec<Tip> {
    let step = &dataset.steps[index];
    // of several factors of a tip the first ones count
    let stored = step.intensities.iter().rev();
    let known: BTreeMap<TipId, &TipIntensity> = stored.map(|known| (known.tip, known)).collect();
    let tip = |tip: TipId| match known.get(&tip) {
        Some(factors) => Tip::new(dataset, index, factors),
        None => Tip::without_factors(dataset, index, tip),
    };
    tips(&step.cracks).map(tip).collect()
}
