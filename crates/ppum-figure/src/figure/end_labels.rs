//! Labels of a colour bar for values beyond its ends: `to ∞`, `to 12.3`.

use super::color_key::ColorKey;
use super::ink::TICK_TEXT;
use super::metrics::WORD;
use crate::text;
use crate::ticks::{Ticks, power_of_ten};

/// Digits of a number, and most of them, where fewer do not lie beyond the end.
const DIGITS: usize = 3;
const MOST_DIGITS: usize = 5;
/// Part of the range below which a value is rounded to zero.
const ROUNDING: f64 = 5e-4;

/// The words at the lower and the upper end of a bar with these marks; none where nothing lies
/// beyond, or nobody looked.
pub(super) fn end_labels(key: &ColorKey, ticks: &Ticks, scale: f64) -> [Option<String>; 2] {
    let ends = [key.normalization.min(), key.normalization.max()];
    let signs = [-1.0, 1.0];
    let word = |k: usize| {
        let value = key.beyond[k]?;
        let is_beyond = |digits: &usize| {
            let (rounded, _) = number(value, ticks, *digits);
            signs[k] * rounded > signs[k] * in_units(ends[k], ticks)
        };
        let size = (ends[1] - ends[0]) / 10f64.powi(ticks.exponent);
        let enough = (DIGITS..=MOST_DIGITS).find(is_beyond).unwrap_or(DIGITS);
        let fits = |word: &String| text::width(word, TICK_TEXT * scale) <= WORD * scale;
        let worded = |digits| match number(value, ticks, digits) {
            (rounded, _) if is_linear(key) && rounded.abs() < ROUNDING * size => "to 0".to_owned(),
            (_, text) => format!("to {text}"),
        };
        Some((1..=enough).rev().map(worded).find(fits).unwrap_or_else(|| worded(1)))
    };
    [word(0), word(1)]
}

fn is_linear(key: &ColorKey) -> bool {
    key.normalization.scale() == ppum_render::scale::Scale::Linear
}

/// A value in the units that marks are labelled in.
fn in_units(value: f64, ticks: &Ticks) -> f64 {
    (value - ticks.reference) / 10f64.powi(ticks.exponent)
}

/// A value in these units, rounded, and as it is written.
fn number(value: f64, ticks: &Ticks, digits: usize) -> (f64, String) {
    if value.is_infinite() {
        return (value, if value > 0.0 { "∞" } else { "−∞" }.to_owned());
    }
    let text = format!("{:.*e}", digits - 1, in_units(value, ticks));
    let (factor, power) = text.split_once('e').unwrap_or((&text, "0"));
    let (rounded, power) = (text.parse().unwrap_or(value), power.parse().unwrap_or(0));
    let written = match (short(factor), power) {
        (_, -3..=5) => {
            let behind = (digits as i32 - 1 - power).max(0) as usize;
            short(&format!("{rounded:.behind$}")).to_owned()
        }
        ("1", power) => power_of_ten(power),
        (factor, power) => format!("{factor}×{}", power_of_ten(power)),
    };
    (rounded, written.replace('-', "−"))
}

/// A decimal number without zeros at its end.
fn short(text: &str) -> &str {
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_the_marks() {
        let plain = Ticks::default();
        let written = |value: f64, ticks: &Ticks| number(value, ticks, 3).1;
        assert_eq!(written(12.345, &plain), "12.3");
        assert_eq!(written(-0.25, &plain), "−0.25");
        assert_eq!(written(f64::NEG_INFINITY, &plain), "−∞");
        assert_eq!(written(1.234e9, &plain), "1.23×10⁹");
        assert_eq!(written(-1e-7, &plain), "−1×10⁻⁷");
        assert_eq!(written(1e9, &plain), "10⁹");
        let small = Ticks { exponent: -4, reference: 0.5, ..Ticks::default() };
        assert_eq!(written(0.50123, &small), "12.3");
    }
}
