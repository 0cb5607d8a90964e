//! Scales: where a value lies in a range.
//!
//! ```text
//! linear    s(v) = v
//! log       s(v) = ln v,                      v > 0
//! symlog    s(v) = sign(v) ln(1 + |v|/c),     c = max(|min|, |max|) / 1000
//!
//! position(v) = (s(v) − s(min)) / (s(max) − s(min))
//! ```
//!
//! The symmetric logarithm is linear for |v| ≪ c and logarithmic for |v| ≫ c, with continuous slope
//! \[J. B. W. Webber, A bi-symmetric log transformation for wide-range data, Meas. Sci. Technol. 24
//! (2013) 027001\]; three decades on each side tell the weak parts of a field from zero and still
//! leave colours to the strong ones.

use std::fmt;
use std::str::FromStr;

use ppum::text::hint;

/// The way values spread over the colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Equal steps.
    #[default]
    Linear,
    /// Equal ratios; for positive values.
    Log,
    /// Logarithmic on both sides of zero, linear around it.
    SymLog,
}

/// A word that names no scale.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is no scale{hint}; write linear, log or symlog", hint = hint(.0, ["linear", "log", "symlog"]))]
pub struct UnknownScale(String);

const SCALES: [Scale; 3] = [Scale::Linear, Scale::Log, Scale::SymLog];

impl Scale {
    fn name(self) -> &'static str {
        ["linear", "log", "symlog"][self as usize]
    }
}

impl FromStr for Scale {
    type Err = UnknownScale;
    fn from_str(text: &str) -> Result<Self, UnknownScale> {
        let known = SCALES.into_iter().find(|scale| scale.name() == text);
        known.ok_or_else(|| UnknownScale(text.to_owned()))
    }
}

impl fmt::Display for Scale {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Decades between the symmetric logarithm's largest value and its linear part.
const SYMLOG_RATIO: f64 = 1000.0;

/// A scale on a range: the map from values to positions in \[0, 1\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Normalization {
    scale: Scale,
    min: f64,
    max: f64,
    /// c of the symmetric logarithm.
    threshold: f64,
    /// s(min), s(max) − s(min) and one over it: this is done for every pixel.
    start: f64,
    span: f64,
    per_span: f64,
}

impl Normalization {
    /// A scale on a range that is known to be fit for it: min < max, not nearer than the smallest
    /// normal number, and min > 0 on a logarithmic scale.
    /// [`RangeChoice`](crate::range::RangeChoice) ensures that for user-defined ranges.
    #[must_use]
    pub fn new(scale: Scale, min: f64, max: f64) -> Self {
        debug_assert!(min < max && (max - min).is_normal() && (scale != Scale::Log || min > 0.0));
        let threshold = min.abs().max(max.abs()) / SYMLOG_RATIO;
        let mut norm = Self { scale, min, max, threshold, start: 0.0, span: 1.0, per_span: 1.0 };
        norm.start = norm.scaled(min);
        norm.span = norm.scaled(max) - norm.start;
        norm.per_span = 1.0 / norm.span;
        norm
    }

    /// The scale.
    #[must_use]
    pub fn scale(&self) -> Scale {
        self.scale
    }

    /// The value at position 0.
    #[must_use]
    pub fn min(&self) -> f64 {
        self.min
    }

    /// The value at position 1.
    #[must_use]
    pub fn max(&self) -> f64 {
        self.max
    }

    /// c of the symmetric logarithm: where it turns from linear to logarithmic.
    #[must_use]
    pub fn threshold(&self) -> f64 {
        self.threshold
    }

    /// s(min) of the scaled value s.
    #[must_use]
    pub fn start(&self) -> f64 {
        self.start
    }

    /// One over s(max) − s(min): the position is (s − s(min)) times it.
    #[must_use]
    pub fn per_span(&self) -> f64 {
        self.per_span
    }

    /// Position of a value: 0 at `min`, 1 at `max`; below 0, above 1 or infinite outside the range;
    /// NaN for NaN. On the logarithmic scale values ≤ 0 are at −∞.
    #[must_use]
    pub fn position(&self, value: f64) -> f64 {
        (self.scaled(value) - self.start) * self.per_span
    }

    /// The value at a position: the inverse of [`position`](Self::position).
    #[must_use]
    pub fn value(&self, position: f64) -> f64 {
        let s = self.start + position * self.span;
        match self.scale {
            Scale::Linear => s,
            Scale::Log => s.exp(),
            Scale::SymLog => s.signum() * self.threshold * s.abs().exp_m1(),
        }
    }

    fn scaled(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => value,
            Scale::Log if value <= 0.0 => f64::NEG_INFINITY,
            Scale::Log => value.ln(),
            Scale::SymLog => value.signum() * (value.abs() / self.threshold).ln_1p(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_follow_the_formulas() {
        let linear = Normalization::new(Scale::Linear, -1.0, 3.0);
        assert_eq!([-1.0, 1.0, 3.0, 5.0].map(|v| linear.position(v)), [0.0, 0.5, 1.0, 1.5]);
        let log = Normalization::new(Scale::Log, 1e-3, 1e3);
        assert!((log.position(1.0) - 0.5).abs() < 1e-15);
        assert_eq!(log.position(-2.0), f64::NEG_INFINITY);
        let symlog = Normalization::new(Scale::SymLog, -10.0, 10.0);
        assert_eq!(symlog.position(0.0), 0.5);
        let expected = 0.5 + 0.5 * (1.0 + 0.1 / 0.01f64).ln() / 1001f64.ln();
        assert!((symlog.position(0.1) - expected).abs() < 1e-15);
        assert!((symlog.position(-0.1) - (1.0 - expected)).abs() < 1e-15);
    }

    #[test]
    fn values_invert_positions_on_every_scale() {
        for (scale, min, max) in
            [(Scale::Linear, -2.0, 7.0), (Scale::Log, 1e-9, 1e4), (Scale::SymLog, -5.0, 400.0)]
        {
            let norm = Normalization::new(scale, min, max);
            for k in 0..=20 {
                let t = f64::from(k) / 20.0;
                assert!((norm.position(norm.value(t)) - t).abs() < 1e-13, "{scale} {t}");
            }
            assert!((norm.value(0.0) - min).abs() < 1e-12 * max);
            assert!(norm.position(f64::NAN).is_nan());
            assert_eq!(norm.position(f64::INFINITY), f64::INFINITY);
        }
    }

    #[test]
    fn scales_have_names() {
        for scale in [Scale::Linear, Scale::Log, Scale::SymLog] {
            assert_eq!(scale.to_string().parse::<Scale>().unwrap(), scale);
        }
        let error = "logarithmic".parse::<Scale>().unwrap_err().to_string();
        assert!(error.contains("linear, log or symlog"), "{error}");
    }
}
