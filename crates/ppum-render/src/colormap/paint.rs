//! Single colours: `#rrggbb`, `#rgb`.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

/// An opaque colour: red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rgb(pub [u8; 3]);

impl FromStr for Rgb {
    type Err = String;

    /// `#rrggbb` or `#rgb`.
    fn from_str(text: &str) -> Result<Self, String> {
        let text = text.trim();
        let digit = |c: char| Some(c.to_digit(16)? as u8);
        let digits = |hex: &str| hex.chars().map(digit).collect::<Option<Vec<u8>>>();
        match text.strip_prefix('#').and_then(digits).as_deref() {
            Some(&[r, g, b]) => Ok(Self([r, g, b].map(|digit| 17 * digit))),
            Some(&[a, b, c, d, e, f]) => {
                Ok(Self([[a, b], [c, d], [e, f]].map(|[h, l]| 16 * h + l)))
            }
            _ => Err(format!("`{text}` is no colour; write #rrggbb, e.g. #c0c0c0")),
        }
    }
}

impl Display for Rgb {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self([r, g, b]) = self;
        write!(f, "#{r:02x}{g:02x}{b:02x}")
    }
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
        assert_eq!(" #010203 ".parse(), Ok(Rgb([1, 2, 3])));
        for wrong in ["", "grey", "#12", "123456", "#12345g", "rgb(1,2)"] {
            assert!(wrong.parse::<Rgb>().is_err(), "{wrong}");
        }
    }
}
