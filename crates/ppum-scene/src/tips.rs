//! The crack tips of a step with their stress intensity factors, as tables show them.

use std::collections::BTreeMap;

use ppum::crack::{TipId, tips};
use ppum::dataset::{Dataset, Step, TipIntensity};
use ppum::text::{beside, short};
use ppum::vec2::Vec2;

/// A tip. What is not known is NaN.
#[derive(Clone, Debug, PartialEq)]
pub struct Tip {
    /// Which one.
    pub id: TipId,
    /// Its place.
    pub at: Vec2,
    /// Direction of growth, radians from the x axis.
    pub angle: f64,
    /// K_I.
    pub k1: f64,
    /// K_II.
    pub k2: f64,
    /// T, the finite part of the stress along the crack.
    pub t_stress: f64,
    /// The J-integral, found without the factors.
    pub j: f64,
    /// G = (K_I² + K_II²) / E′ with the material at the tip.
    pub g: f64,
    /// Direction of the largest hoop stress, radians from [`Self::angle`].
    pub growth_angle: f64,
    /// Estimated error of (K_I, K_II), as a part of their size.
    pub error: f64,
    /// The largest relative difference of two radii: no estimate of the error.
    pub spread: f64,
    /// Radius of the largest disc that was integrated over.
    reach: f64,
}

/// Heads of the columns of [`Tip::words`].
pub const HEADS: [&str; 8] = ["K_I", "K_II", "T", "G", "angle", "error", "spread", "J/G-1"];

/// What these columns mean.
pub const MEANING: &str =
    "angle: of growth (hoop stress); error: of K, estimated, relative; spread, J/G-1: checks alone";

const DASH: &str = "–";

impl Tip {
    /// A tip of a step with its factors, if it has any.
    #[must_use]
    pub fn new(dataset: &Dataset, step: &Step, id: TipId, factors: Option<&TipIntensity>) -> Self {
        let crack = &step.cracks[id.crack as usize];
        let (axis, at) = (crack.growth_direction(id.end), crack.end_point(id.end));
        let none = TipIntensity::new(id, f64::NAN, f64::NAN);
        let factors = factors.unwrap_or(&none);
        let elastic = dataset.equation.elastic();
        let known = |value: Option<f64>| value.unwrap_or(f64::NAN);
        Self {
            id,
            at,
            angle: axis.y.atan2(axis.x),
            k1: factors.k1,
            k2: factors.k2,
            t_stress: known(factors.t_stress),
            j: known(factors.j),
            g: known(elastic.map(|body| factors.energy_release(&body.at(at)))),
            growth_angle: known(factors.growth_angle()),
            error: known(factors.error) / factors.k1.hypot(factors.k2),
            spread: factors.spread(),
            reach: factors.rings.iter().map(|ring| ring.r2).fold(f64::NAN, f64::max),
        }
    }

    /// Its numbers in words, in the order of [`HEADS`]: what is rounding of what stands beside it is zero, and what is not known a
    /// dash.
    #[must_use]
    pub fn words(&self) -> [String; 8] {
        let size = self.k1.hypot(self.k2);
        let number = |value: f64, size: f64| match value {
            value if value.is_nan() => DASH.into(),
            value => short(beside(value, size)),
        };
        let angle = match self.growth_angle {
            angle if angle.is_nan() => DASH.into(),
            // zero has no sign
            angle => format!("{:.1}°", (10.0 * angle.to_degrees()).round() / 10.0 + 0.0),
        };
        let part = |part: f64| match part {
            0.0 => "0".into(),
            part if part.is_finite() => format!("{part:.0e}"),
            _ => DASH.into(),
        };
        [
            number(self.k1, size),
            number(self.k2, size),
            // where T is zero, it is found as rounding of the stresses in the disc
            number(self.t_stress, size / self.reach.sqrt()),
            number(self.g, self.g),
            angle,
            part(self.error),
            part(self.spread),
            part((self.j / self.g - 1.0).abs()),
        ]
    }
}

/// The tips of a step in their order, with the factors that the solver stored.
#[must_use]
pub fn stored(dataset: &Dataset, step: &Step) -> Vec<Tip> {
    // of several factors of a tip the first ones count
    let all = step.intensities.iter().rev();
    let known: BTreeMap<TipId, &TipIntensity> = all.map(|factors| (factors.tip, factors)).collect();
    let tip = |id| Tip::new(dataset, step, id, known.get(&id).copied());
    tips(&step.cracks).map(tip).collect()
}
