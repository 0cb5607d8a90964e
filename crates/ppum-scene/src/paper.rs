//! Sizes on paper.

use std::fmt;
use std::str::FromStr;

/// A width on paper, and a height; without one it is that of what is drawn. Written `3.4x2.6`
/// or `3.4`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperSize {
    /// The width, positive.
    pub width: f64,
    /// The height, positive.
    pub height: Option<f64>,
}

/// Longest side of a page, in its unit: more than any paper has.
const LONGEST: f64 = 1000.0;

impl PaperSize {
    /// Returns the length in a unit that is so many times as long.
    #[must_use]
    pub fn over(self, factor: f64) -> Self {
        Self { width: self.width / factor, height: self.height.map(|height| height / factor) }
    }
}

impl FromStr for PaperSize {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let length =
            |text: &str| text.trim().parse().ok().filter(|l: &f64| *l > 0.0 && *l <= LONGEST);
        let (width, height) = text.split_once('x').map_or((text, None), |(w, h)| (w, Some(h)));
        let size = match height {
            None => length(width).map(|width| Self { width, height: None }),
            Some(height) => length(width)
                .zip(length(height))
                .map(|(width, height)| Self { width, height: Some(height) }),
        };
        size.ok_or_else(|| {
            format!(
                "write a width above zero, up to {LONGEST}, or WIDTHxHEIGHT, e.g. 3.4 or 3.4x2.6"
            )
        })
    }
}

impl fmt::Display for PaperSize {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.width)?;
        self.height.map_or(Ok(()), |height| write!(f, "x{height:?}"))
    }
}

crate::written::as_text!(PaperSize);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read_as_they_are_written() {
        for (text, width, height) in [("3.4", 3.4, None), ("3.4x2.6", 3.4, Some(2.6))] {
            let size = PaperSize { width, height };
            assert_eq!((text.parse(), size.to_string()), (Ok(size), text.to_owned()));
        }
        assert_eq!("5.08x2.54".parse::<PaperSize>().map(|size| size.over(2.54)), "2x1".parse());
        for wrong in ["", "0", "3x0", "-1x2", "3x", "x3", "inf", "3,4"] {
            assert!(wrong.parse::<PaperSize>().is_err(), "{wrong}");
        }
    }
}
