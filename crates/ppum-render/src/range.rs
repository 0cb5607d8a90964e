//! The range of values that the colours span: chosen, or found from the raster.
//!
//! Stresses grow like r^(−1/2) towards a tip, so the largest value of a raster says how near a pixel's
//! centre happens to be and nothing about the field. The *automatic range* therefore looks at the
//! finite values' quantiles at 0.5 % and 99.5 %: an extreme value bounds the range if it lies at most
//! a fifth of the quantiles' span outside them, else the quantile does, and what is outside is drawn
//! in the colours below and above. On a logarithmic scale the same is done with the logarithms of the
//! positive values. Further:
//!
//! - values that are nowhere negative and come near zero get a range from zero;
//! - for a diverging colour map a range with zero inside is made symmetric;
//! - one value c everywhere, but for rounding, gets c ± |c|/2, zero gets −1/2 to 1/2; no usable value at all gets 0 to 1 (on a
//!   logarithmic scale 0.1 to 1).

use std::fmt;
use std::str::FromStr;

use ppum::text::exact;

use crate::raster::{Raster, Sample};
use crate::scale::{Normalization, Scale};

/// The range of values that the colours span.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Range {
    /// Found from the raster; robust against peaks, see the [module](self).
    #[default]
    Auto,
    /// From the first number to the second.
    Fixed(f64, f64),
}

/// The reason why a range cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RangeError {
    /// Not `auto` and not two numbers.
    #[error("`{0}` is no range; write auto or MIN,MAX")]
    Syntax(String),
    /// Bounds that do not rise, are not finite, or differ by less than the smallest normal number.
    #[error("the range from {} to {} is empty; give two finite numbers, the smaller one first",
        exact(*.0), exact(*.1))]
    Empty(f64, f64),
    /// A logarithmic scale from a value that is not positive.
    #[error("a logarithmic scale cannot begin at {0}; begin above zero, or use symlog")]
    LogOfNonPositive(f64),
}

impl FromStr for Range {
    type Err = RangeError;
    fn from_str(text: &str) -> Result<Self, RangeError> {
        if text.trim() == "auto" {
            return Ok(Self::Auto);
        }
        let number = |part: &str| part.trim().parse::<f64>().ok();
        let bounds = text.split_once(',').and_then(|(a, b)| Some((number(a)?, number(b)?)));
        let (min, max) = bounds.ok_or_else(|| RangeError::Syntax(text.to_owned()))?;
        check(min, max)
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Fixed(min, max) => write!(f, "{min},{max}"),
        }
    }
}

fn check(min: f64, max: f64) -> Result<Range, RangeError> {
    if min < max && (max - min).is_normal() {
        Ok(Range::Fixed(min, max))
    } else {
        Err(RangeError::Empty(min, max))
    }
}

impl Range {
    /// The scale on this range, an automatic one found from the raster; `symmetric` asks for a range
    /// around zero where it contains zero.
    ///
    /// # Errors
    /// A fixed range that is empty or, on a logarithmic scale, not positive.
    pub fn normalization<T: Sample>(
        &self,
        scale: Scale,
        symmetric: bool,
        raster: &Raster<T>,
    ) -> Result<Normalization, RangeError> {
        let (min, max) = match *self {
            Self::Auto => automatic(scale, symmetric, raster),
            Self::Fixed(min, max) => (min, max),
        };
        check(min, max)?;
        if scale == Scale::Log && min <= 0.0 {
            return Err(RangeError::LogOfNonPositive(min));
        }
        Ok(Normalization::new(scale, min, max))
    }
}

/// Share of the values on each side that may be a peak: a disc around a tip of a twelfth of a square
/// picture's width.
const TAIL: f64 = 0.005;
/// Distance from the quantiles, in parts of their span, up to which an extreme value still bounds the range.
/// Smooth fields stay below it (a quadratic: 0.01), a tip's r^(−1/2) is far above.
const SLACK: f64 = 0.2;
/// A range that starts within this part of its end above zero starts at zero.
const NEAR_ZERO: f64 = 0.2;
/// Differences between bounds must stay finite.
const LARGEST: f64 = f64::MAX / 4.0;

fn automatic<T: Sample>(scale: Scale, symmetric: bool, raster: &Raster<T>) -> (f64, f64) {
    let log = scale == Scale::Log;
    if let Some(value) = raster.one_value().filter(|v| !log || *v > 0.0) {
        return around(value);
    }
    let values = raster.values.iter().map(|&v| v.into()).filter(|v: &f64| v.is_finite());
    let mut values: Vec<f64> =
        values.filter(|v| !log || *v > 0.0).map(|v| v.clamp(-LARGEST, LARGEST)).collect();
    let scaled = |v: f64| if log { v.ln() } else { v };
    let Some((min, max)) = robust_bounds(&mut values, scaled) else {
        return if log { (0.1, 1.0) } else { (0.0, 1.0) };
    };
    match around_constant(min, max) {
        Some(bounds) => bounds,
        None if log => (min, max),
        None if symmetric && min < 0.0 && max > 0.0 => (-max.max(-min), max.max(-min)),
        None if min > 0.0 && min < NEAR_ZERO * max => (0.0, max),
        None => (min, max),
    }
}

/// The quantiles, moved out to the extremes where these are near on the scale.
fn robust_bounds(values: &mut [f64], scaled: impl Fn(f64) -> f64) -> Option<(f64, f64)> {
    let last = values.len().checked_sub(1)?;
    let skip = (TAIL * last as f64) as usize;
    let (below, &mut low, _) = values.select_nth_unstable_by(skip, f64::total_cmp);
    let min = below.iter().copied().fold(low, f64::min);
    let (_, &mut high, above) = values.select_nth_unstable_by(last - skip, f64::total_cmp);
    let max = above.iter().copied().fold(high, f64::max);
    let slack = SLACK * (scaled(high) - scaled(low));
    Some((
        if scaled(low) - scaled(min) <= slack { min } else { low },
        if scaled(max) - scaled(high) <= slack { max } else { high },
    ))
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
mod tests {
    use super::*;

    fn bounds(scale: Scale, raster: &Raster<f64>) -> (f64, f64) {
        let norm = Range::Auto.normalization(scale, false, raster).unwrap();
        (norm.min(), norm.max())
    }

    fn list(values: &[f64]) -> Raster {
        Raster::new([values.len() as u32, 1], values.to_vec())
    }

    /// r^(−1/2) around a tip in the middle of a picture, the tip between pixel centres.
    fn tip(n: u32) -> Raster {
        let at = |i: u32| f64::from(i) + 0.6 - f64::from(n) / 2.0;
        Raster::from_fn([n, n], |i, j| (at(i).hypot(at(j)) / f64::from(n)).powf(-0.5))
    }

    #[test]
    fn a_smooth_field_uses_its_whole_range() {
        let ramp = Raster::from_fn([200, 100], |i, j| f64::from(i) - 0.5 * f64::from(j));
        assert_eq!(bounds(Scale::Linear, &ramp), (-49.5, 199.0));
        let square = Raster::from_fn([200, 100], |i, _| f64::from(i).powi(2) - 50.0);
        assert_eq!(bounds(Scale::Linear, &square), (-50.0, 199.0 * 199.0 - 50.0));
    }

    /// The disc with 0.5 % of the area has radius √(0.005/π) = 0.0399 of the width: its edge's value,
    /// 5.007, bounds the range whatever the number of pixels.
    #[test]
    fn a_tip_does_not_set_the_range() {
        for n in [128, 512] {
            let (min, max) = bounds(Scale::Linear, &tip(n));
            assert!((max - 5.007).abs() < 0.1, "{n}: {max}");
            // The corner is the smallest value, √√2 = 1.19, not within a fifth of zero … 5.
            assert!((min - 1.19).abs() < 0.01, "{n}: {min}");
        }
    }

    #[test]
    fn one_infinite_or_huge_pixel_changes_nothing() {
        let mut raster = tip(128);
        let before = bounds(Scale::Linear, &raster);
        raster.values[64 * 128 + 64] = f64::INFINITY;
        raster.values[64 * 128 + 63] = 1e300;
        raster.values[0] = f64::NAN;
        let (min, max) = bounds(Scale::Linear, &raster);
        assert!((min - before.0).abs() < 0.02 && (max - before.1).abs() < 0.02);
    }

    #[test]
    fn magnitudes_that_come_near_zero_begin_there() {
        assert_eq!(bounds(Scale::Linear, &list(&[0.1, 0.4, 0.7, 1.0])), (0.0, 1.0));
        assert_eq!(bounds(Scale::Linear, &list(&[0.5, 0.7, 1.0])), (0.5, 1.0));
        assert_eq!(bounds(Scale::Linear, &list(&[-0.1, 0.7, 1.0])), (-0.1, 1.0));
    }

    #[test]
    fn degenerate_rasters_still_have_a_range() {
        let inf = f64::INFINITY;
        assert_eq!(bounds(Scale::Linear, &list(&[f64::NAN; 3])), (0.0, 1.0));
        assert_eq!(bounds(Scale::Linear, &list(&[inf, -inf])), (0.0, 1.0));
        assert_eq!(bounds(Scale::Log, &list(&[-1.0, 0.0, f64::NAN])), (0.1, 1.0));
        assert_eq!(bounds(Scale::Linear, &list(&[4.0, 4.0, f64::NAN])), (2.0, 6.0));
        assert_eq!(bounds(Scale::Linear, &list(&[-4.0, -4.0])), (-6.0, -2.0));
        assert_eq!(bounds(Scale::SymLog, &list(&[0.0, 0.0])), (-0.5, 0.5));
        let (min, max) = bounds(Scale::Log, &list(&[4.0, 4.0]));
        assert_eq!((min, max), (2.0, 6.0));
        let (min, max) = bounds(Scale::Linear, &list(&[-f64::MAX, f64::MAX]));
        assert!(min < -1e307 && max > 1e307);
        assert!(bounds(Scale::Linear, &Raster::new([0, 0], vec![])) == (0.0, 1.0));
    }

    /// The rounding that a linear system leaves of a constant is no picture of its own.
    #[test]
    fn rounding_of_a_constant_is_not_spread_over_the_colours() {
        let noisy: Vec<f64> = (0..1000).map(|k| 4.0 + 1e-13 * f64::from(k % 7)).collect();
        for scale in [Scale::Linear, Scale::Log, Scale::SymLog] {
            let (min, max) = bounds(scale, &list(&noisy));
            assert!((min - 2.0).abs() < 1e-11 && (max - 6.0).abs() < 1e-11, "{min} {max}");
        }
        // a peak is not lost
        let mut peak = vec![4.0; 1000];
        peak[7] = 5.0;
        assert_eq!(list(&peak).one_value(), None);
    }

    #[test]
    fn log_ranges_leave_out_what_is_not_positive() {
        let decades: Vec<f64> = (0..1000).map(|k| 10f64.powf(f64::from(k) / 250.0 - 2.0)).collect();
        let mut values = vec![-5.0, 0.0, 1e-300];
        values.extend(&decades);
        let (min, max) = bounds(Scale::Log, &list(&values));
        assert!((min / 0.01 - 1.0).abs() < 0.1, "{min}");
        assert!((max / decades[999] - 1.0).abs() < 1e-12, "{max}");
    }

    #[test]
    fn diverging_ranges_are_symmetric_around_zero() {
        let signed = list(&[-1.0, 0.0, 3.0]);
        let norm = Range::Auto.normalization(Scale::Linear, true, &signed).unwrap();
        assert_eq!((norm.min(), norm.max()), (-3.0, 3.0));
        let positive = list(&[2.0, 3.0]);
        let norm = Range::Auto.normalization(Scale::Linear, true, &positive).unwrap();
        assert_eq!((norm.min(), norm.max()), (2.0, 3.0));
    }

    #[test]
    fn fixed_ranges_are_checked() {
        assert_eq!("auto".parse(), Ok(Range::Auto));
        assert_eq!("-1, 2e3".parse(), Ok(Range::Fixed(-1.0, 2000.0)));
        assert_eq!("1,1".parse::<Range>(), Err(RangeError::Empty(1.0, 1.0)));
        assert_eq!("2,1".parse::<Range>(), Err(RangeError::Empty(2.0, 1.0)));
        for text in ["1,inf", "nan,1", "0,1e-310", "-1.7e308,1.7e308"] {
            assert!(matches!(text.parse::<Range>(), Err(RangeError::Empty(..))), "{text}");
        }
        assert!(matches!("1..2".parse::<Range>(), Err(RangeError::Syntax(_))));
        let log = Range::Fixed(0.0, 1.0).normalization(Scale::Log, false, &list(&[1.0]));
        assert_eq!(log, Err(RangeError::LogOfNonPositive(0.0)));
        assert_eq!(Range::Fixed(-0.5, 1e-9).to_string().parse(), Ok(Range::Fixed(-0.5, 1e-9)));
    }
}
