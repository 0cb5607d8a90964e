//! Single colours: `#rrggbb`, `#rgb`, `rgb(r, g, b)`.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

/// An opaque colour: red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rgb(pub [u8; 3]);

impl FromStr for Rgb {
    type Err = String;

    /// `#rrggbb`, `#rgb` or `rgb(r, g, b)`.
    fn from_str(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let known = hex(text).filter(|_| text.starts_with('#')).or_else(|| function(text));
        let color = known.map(|color| Self(color.map(|channel| channel.round() as u8)));
        color.ok_or_else(|| format!("`{text}` is no colour; write #rrggbb, e.g. #c0c0c0"))
    }
}

impl Display for Rgb {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self([r, g, b]) = self;
        write!(f, "#{r:02x}{g:02x}{b:02x}")
    }
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

fn in_range(value: &f64) -> bool {
    (0.0..=255.0).contains(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_read_as_they_are_written() {
        for k in 0..=255_u8 {
            let color = Rgb([k, k.wrapping_mul(7), 255 - k]);
            assert_eq!(color.to_string().parse(), Ok(color));
        }
        assert_eq!("#f80".parse(), Ok(Rgb([255, 136, 0])));
        assert_eq!(" rgb(1, 2, 3) ".parse(), Ok(Rgb([1, 2, 3])));
        for wrong in ["", "grey", "#12", "123456", "#12345g", "rgb(1,2)"] {
            assert!(wrong.parse::<Rgb>().is_err(), "{wrong}");
        }
    }
}
