//! Single colours: `#rrggbb`, `#rgb`, `rgb(r, g, b)`, three numbers.

use super::stops::Paint;

/// `#rrggbb`, `#rgb`, `rrggbb` or `rgb(r, g, b)`; an opacity behind it, `#rrggbbaa` or `rgba(…)`,
/// is left out.
pub(super) fn word(text: &str) -> Option<Paint> {
    let text = text.trim().trim_matches('"').trim();
    hex(text).or_else(|| function(text)).map(Paint::Bytes)
}

fn hex(text: &str) -> Option<[f64; 3]> {
    let digits = text.strip_prefix('#').unwrap_or(text);
    let values: Option<Vec<u32>> = digits.chars().map(|c| c.to_digit(16)).collect();
    let channel = |k: usize, values: &[u32]| f64::from(16 * values[2 * k] + values[2 * k + 1]);
    match values?.as_slice() {
        &[r, g, b] if text.starts_with('#') => Some([r, g, b].map(|c| f64::from(17 * c))),
        values if values.len() == 6 => Some([0, 1, 2].map(|k| channel(k, values))),
        values if values.len() == 8 && text.starts_with('#') => {
            Some([0, 1, 2].map(|k| channel(k, values)))
        }
        _ => None,
    }
}

fn function(text: &str) -> Option<[f64; 3]> {
    let inner =
        text.strip_prefix("rgba(").or_else(|| text.strip_prefix("rgb("))?.strip_suffix(')')?;
    let numbers = inner.split(',').map(|part| part.trim().parse().ok());
    let values = numbers.collect::<Option<Vec<f64>>>()?;
    let color = [*values.first()?, *values.get(1)?, *values.get(2)?];
    (values.len() <= 4 && color.iter().all(in_range)).then_some(color)
}

/// Three numbers, each 0 to 255.
pub(super) fn numbers(color: [f64; 3]) -> Option<Paint> {
    color.iter().all(in_range).then_some(Paint::Numbers(color))
}

fn in_range(value: &f64) -> bool {
    (0.0..=255.0).contains(value)
}
