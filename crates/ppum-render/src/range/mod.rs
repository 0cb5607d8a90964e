//! The range of values that the colours span: chosen, or found from the values.
//!
//! The *automatic range* spans the [extrema](crate::extrema::extrema) of what is seen where they
//! are known and finite: those of the field, whatever the number of pixels. Stresses grow like
//! r^(−1/2) towards a tip, so with a tip in the view the largest value of a raster says how near a
//! pixel's centre happens to be and nothing about the field. There, and where no extrema are known,
//! the range is *robust*: it looks at the finite values' quantiles at 0.5 % and 99.5 %. An extreme
//! value bounds the range if it lies at most a fifth of the quantiles' span outside them, else the
//! quantile does, and what is outside is drawn in the colours below and above. On a logarithmic
//! scale the same is done with the logarithms of the positive values. Further:
//!
//! - a logarithmic scale begins where the robust range does: zeros are peaks of the logarithm;
//! - values that are nowhere negative and come near zero get a range from zero;
//! - for a diverging colour map a range that was found is made symmetric if zero lies inside;
//! - one value c everywhere, except for rounding, in the pixels or [all over the
//!   body](crate::extrema::ExtremumSite::Everywhere), gets c ± |c|/2, zero gets −1/2 to 1/2; no
//!   usable value at all gets 0 to 1 (on a logarithmic scale 0.1 to 1).
//!
//! The *full range* spans all finite values: to the extrema, and to the pixels' largest value where
//! the quantity is infinite. *Percentiles* are those of the pixels' finite values (on a logarithmic
//! scale positive ones): P % of n sorted values, counted from 0, is number P (n − 1)/100,
//! interpolated between two.

use std::fmt;
use std::str::FromStr;

use ppum::text::exact;
use ppum_raster::raster::{Raster, RasterValue};

use crate::extrema::Extrema;
use crate::scale::{Normalization, Scale};

/// The range of values that the colours should span.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum RangeChoice {
    /// All values; robust against peaks that are infinite, see the [module](self).
    #[default]
    Auto,
    /// All finite values.
    Full,
    /// From the first number to the second.
    Fixed(f64, f64),
    /// From the first percentile to the second.
    Percentiles(f64, f64),
}

/// The reason why a range cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RangeError {
    /// No word, numbers or percentiles that mean a range.
    #[error("`{0}` is no range; write auto, full, MIN,MAX, or percentiles P%,Q%")]
    Syntax(String),
    /// Bounds that do not rise.
    #[error("the range from {} to {} is empty; give the smaller number first", exact(*.0), exact(*.1))]
    Empty(f64, f64),
    /// Bounds that are not finite.
    #[error("the range from {} to {} has no end; give two finite numbers", exact(*.0), exact(*.1))]
    Endless(f64, f64),
    /// Bounds whose difference is larger than the largest number, or smaller than the smallest
    /// normal one.
    #[error("the range from {} to {} is wider or narrower than double precision can tell", exact(*.0), exact(*.1))]
    Extreme(f64, f64),
    /// Percentiles that do not rise or lie outside 0 to 100.
    #[error(
        "from {0} % to {1} % lies no range; give two percentiles from 0% to 100%, the smaller one first, \
        or one below 50%"
    )]
    Percentiles(f64, f64),
    /// A logarithmic scale from a value that is not positive.
    #[error("a logarithmic scale cannot begin at {0}; begin above zero, or use symlog")]
    LogOfNonPositive(f64),
}

impl FromStr for RangeChoice {
    type Err = RangeError;
    fn from_str(text: &str) -> Result<Self, RangeError> {
        let number = |part: &str| part.trim().parse::<f64>().ok();
        let percent = |part: &str| number(part.trim().strip_suffix('%')?);
        match (text.trim(), text.split_once(',')) {
            ("auto", _) => return Ok(Self::Auto),
            ("full", _) => return Ok(Self::Full),
            (_, None) => {
                if let Some(p) = percent(text) {
                    return percentiles(p, 100.0 - p);
                }
            }
            (_, Some((a, b))) => {
                if let (Some(min), Some(max)) = (number(a), number(b)) {
                    return check(min, max).map(|()| Self::Fixed(min, max));
                }
                if let (Some(p), Some(q)) = (percent(a), percent(b)) {
                    return percentiles(p, q);
                }
            }
        }
        Err(RangeError::Syntax(text.to_owned()))
    }
}

impl fmt::Display for RangeChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Full => f.write_str("full"),
            Self::Fixed(min, max) => write!(f, "{min},{max}"),
            Self::Percentiles(p, q) => write!(f, "{p}%,{q}%"),
        }
    }
}

fn check(min: f64, max: f64) -> Result<(), RangeError> {
    match (min, max) {
        _ if !min.is_finite() || !max.is_finite() => Err(RangeError::Endless(min, max)),
        _ if min >= max => Err(RangeError::Empty(min, max)),
        _ if !(max - min).is_normal() => Err(RangeError::Extreme(min, max)),
        _ => Ok(()),
    }
}

fn percentiles(p: f64, q: f64) -> Result<RangeChoice, RangeError> {
    let is_range = 0.0 <= p && p < q && q <= 100.0;
    if is_range { Ok(RangeChoice::Percentiles(p, q)) } else { Err(RangeError::Percentiles(p, q)) }
}

/// A range that was found or given, and what is known of the values.
#[derive(Clone, Debug, PartialEq)]
pub struct ColorRange {
    /// The value at the lower end of the colours.
    pub min: f64,
    /// The value at the upper end.
    pub max: f64,
    /// How it came about.
    pub basis: Basis,
    /// The smallest and the largest value of all, where they were looked for.
    pub values: Option<Extrema>,
}

/// How a range came about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Basis {
    /// It was given.
    Given,
    /// It holds all values.
    All,
    /// It holds all values of pixels that are finite.
    Pixels,
    /// It leaves out peaks.
    Robust,
    /// It spans these percentiles of the pixels' values.
    Percentiles(f64, f64),
}

impl fmt::Display for Basis {
    /// `given`, `all`, `pixels`, `robust`, `percentiles 2,98`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Given => f.write_str("given"),
            Self::All => f.write_str("all"),
            Self::Pixels => f.write_str("pixels"),
            Self::Robust => f.write_str("robust"),
            Self::Percentiles(p, q) => write!(f, "percentiles {p},{q}"),
        }
    }
}

impl ColorRange {
    /// The scale on it.
    ///
    /// # Errors
    /// A range that is empty or, on a logarithmic scale, not positive.
    pub fn normalization(&self, scale: Scale) -> Result<Normalization, RangeError> {
        check(self.min, self.max)?;
        if scale == Scale::Log && self.min <= 0.0 {
            return Err(RangeError::LogOfNonPositive(self.min));
        }
        Ok(Normalization::new(scale, self.min, self.max))
    }

    /// The smallest value if it lies below the range, and the largest one if it lies above.
    #[must_use]
    pub fn beyond(&self) -> [Option<f64>; 2] {
        let Some(Extrema { min, max, .. }) = &self.values else { return [None; 2] };
        let [min, max] = [min.value, max.value];
        [(min < self.min).then_some(min), (max > self.max).then_some(max)]
    }

    /// One range for several images, which holds theirs; `symmetric` as for one. None for none.
    #[must_use]
    pub fn shared(spans: &[Self], symmetric: bool) -> Option<Self> {
        let (first, rest) = spans.split_first()?;
        let mut all = rest.iter().fold(first.clone(), |all, span| all.with(span));
        if all.basis != Basis::Given && symmetric && all.min < 0.0 && all.max > 0.0 {
            (all.min, all.max) = around_zero(all.min, all.max);
        }
        Some(all)
    }

    fn with(self, other: &Self) -> Self {
        let values = match (self.values, &other.values) {
            (Some(a), Some(b)) => Some(a.united(b)),
            // the extrema of some images are not those of all
            _ => None,
        };
        let is_same = self.basis == other.basis;
        let basis = match [self.basis, other.basis] {
            _ if is_same => self.basis,
            bases if bases.contains(&Basis::Robust) => Basis::Robust,
            _ => Basis::Pixels,
        };
        Self { min: self.min.min(other.min), max: self.max.max(other.max), basis, values }
    }
}

impl RangeChoice {
    /// True if it is found from the values, whose extrema should be looked for then.
    #[must_use]
    pub fn is_found(&self) -> bool {
        !matches!(self, Self::Fixed(..))
    }

    /// The range of a raster's values; `values` are the extrema of what is seen where they are
    /// known, and `symmetric` asks for a range around zero where one that is found contains zero.
    #[must_use]
    pub fn span<T: RasterValue>(
        &self,
        scale: Scale,
        symmetric: bool,
        raster: &Raster<T>,
        values: Option<Extrema>,
    ) -> ColorRange {
        let seen = RangeInput { raster, is_log: scale == Scale::Log, values: values.as_ref() };
        let constant = values.as_ref().and_then(Extrema::constant).filter(|v| seen.is_usable(*v));
        let (basis, found) = match *self {
            _ if self.is_found() && constant.is_some() => (Basis::All, constant.map(|v| (v, v))),
            Self::Auto => seen.automatic(),
            Self::Full => seen.full(),
            Self::Fixed(min, max) => return ColorRange { min, max, basis: Basis::Given, values },
            Self::Percentiles(p, q) => (Basis::Percentiles(p, q), seen.percentiles([p, q])),
        };
        let (min, max) = match found {
            None if seen.is_log => (0.1, 1.0),
            None => (0.0, 1.0),
            Some((min, max)) => match around_constant(min, max) {
                Some(bounds) => bounds,
                None if seen.is_log => (min, max),
                None if symmetric && min < 0.0 && max > 0.0 => around_zero(min, max),
                None if *self == Self::Auto => from_zero(min, max),
                None => (min, max),
            },
        };
        ColorRange { min, max, basis, values }
    }
}

/// Share of the values on each side that may be a peak: a disc around a tip of a twelfth of a
/// square image's width.
const TAIL: f64 = 0.005;
/// Distance from the quantiles, in parts of their span, up to which an extreme value still bounds
/// the range. Smooth fields stay below it (a quadratic: 0.01), a tip's r^(−1/2) is far above.
const SLACK: f64 = 0.2;
/// A range that starts within this part of its end above zero starts at zero.
const NEAR_ZERO: f64 = 0.2;
/// Differences between bounds must stay finite.
const LARGEST: f64 = f64::MAX / 4.0;

/// Half of it is still a normal number.
const LEAST_POSITIVE: f64 = 4.0 * f64::MIN_POSITIVE;

/// The raster and the options that a range is computed from.
struct RangeInput<'a, T> {
    raster: &'a Raster<T>,
    is_log: bool,
    values: Option<&'a Extrema>,
}

type ValueBounds = Option<(f64, f64)>;

impl<T: RasterValue> RangeInput<'_, T> {
    fn automatic(&self) -> (Basis, ValueBounds) {
        if let Some(value) = self.raster.one_value().filter(|v| self.is_usable(*v)) {
            return (Basis::All, Some((value, value)));
        }
        match self.extremes() {
            Some((min, max)) if self.is_log && max > 0.0 => self.to_zero(min, max),
            Some((min, max)) if self.is_usable(min) => (Basis::All, Some((min, max))),
            _ => (Basis::Robust, self.robust()),
        }
    }

    /// Between extrema on a logarithmic scale, where zeros are peaks as poles are: errors are
    /// zero somewhere.
    fn to_zero(&self, min: f64, max: f64) -> (Basis, ValueBounds) {
        let bounds = self.robust().map(|(low, high)| (low, max.max(high)));
        let is_whole = bounds.is_some_and(|(low, _)| low <= min);
        (if is_whole { Basis::All } else { Basis::Robust }, bounds)
    }

    /// The quantiles, moved out to the extremes where these are near on the scale.
    fn robust(&self) -> ValueBounds {
        let mut values = self.usable();
        let last = values.len().checked_sub(1)?;
        let skip = (TAIL * last as f64) as usize;
        let (below, &mut low, _) = values.select_nth_unstable_by(skip, f64::total_cmp);
        let min = below.iter().copied().fold(low, f64::min);
        let (_, &mut high, above) = values.select_nth_unstable_by(last - skip, f64::total_cmp);
        let max = above.iter().copied().fold(high, f64::max);
        let [least, most] = self.usable_extrema();
        let (min, max) = (least.map_or(min, |v| min.min(v)), most.map_or(max, |v| max.max(v)));
        let scaled = |v: f64| if self.is_log { v.ln() } else { v };
        let slack = SLACK * (scaled(high) - scaled(low));
        Some((
            if scaled(low) - scaled(min) <= slack { min } else { low },
            if scaled(max) - scaled(high) <= slack { max } else { high },
        ))
    }

    /// The extrema that are known, finite and usable.
    fn usable_extrema(&self) -> [Option<f64>; 2] {
        let known = self.values.filter(|values| !values.is_of_pixels());
        let usable = |v: f64| (v.is_finite() && self.is_usable(v)).then(|| within(v));
        let both = known.map(|values| [values.min.value, values.max.value].map(usable));
        both.unwrap_or_default()
    }

    /// The extrema, if they are known and finite: those of the field, whatever a raster of it says.
    fn extremes(&self) -> ValueBounds {
        let values =
            self.values.filter(|values| !values.is_of_pixels() && !values.is_infinite())?;
        Some((within(values.min.value), within(values.max.value)))
    }

    fn full(&self) -> (Basis, ValueBounds) {
        let pixels = self.usable().into_iter().fold(None, |bounds: ValueBounds, v| {
            Some(bounds.map_or((v, v), |(min, max)| (min.min(v), max.max(v))))
        });
        let [min, max] = self.usable_extrema();
        let basis = if min.is_some() && max.is_some() { Basis::All } else { Basis::Pixels };
        let bounds = pixels.map(|(low, high)| (min.unwrap_or(low), max.unwrap_or(high)));
        (basis, bounds)
    }

    fn percentiles(&self, both: [f64; 2]) -> ValueBounds {
        let mut values = self.usable();
        let last = values.len().checked_sub(1)?;
        let [min, max] = both.map(|percent| {
            let at = percent / 100.0 * last as f64;
            let below = (at as usize).min(last);
            let (_, &mut low, above) = values.select_nth_unstable_by(below, f64::total_cmp);
            let next = above.iter().copied().reduce(f64::min).unwrap_or(low);
            low + (at - below as f64) * (next - low)
        });
        Some((min, max))
    }

    /// The finite values, on a logarithmic scale the positive ones.
    fn usable(&self) -> Vec<f64> {
        let values = self.raster.values.iter().map(|&v| v.into());
        let usable = values.filter(|v: &f64| v.is_finite() && self.is_usable(*v));
        usable.map(within).collect()
    }

    fn is_usable(&self, value: f64) -> bool {
        !self.is_log || value >= LEAST_POSITIVE
    }
}

fn within(value: f64) -> f64 {
    value.clamp(-LARGEST, LARGEST)
}

fn around_zero(min: f64, max: f64) -> (f64, f64) {
    (-max.max(-min), max.max(-min))
}

/// A range that starts near zero, from there.
fn from_zero(min: f64, max: f64) -> (f64, f64) {
    if min > 0.0 && min < NEAR_ZERO * max { (0.0, max) } else { (min, max) }
}

/// A range around values that are equal up to rounding.
fn around_constant(min: f64, max: f64) -> Option<(f64, f64)> {
    let size = min.abs().max(max.abs());
    if max - min > 4.0 * f64::EPSILON * size && max - min >= f64::MIN_POSITIVE {
        return None;
    }
    Some(around(0.5 * (min + max)))
}

fn around(value: f64) -> (f64, f64) {
    let half = if value.abs() < f64::MIN_POSITIVE { 0.5 } else { 0.5 * value.abs() };
    (value - half, value + half)
}

#[cfg(test)]
mod tests;
