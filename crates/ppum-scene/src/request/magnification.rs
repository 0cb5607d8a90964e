//! How much a body is deformed.

use std::fmt;
use std::str::FromStr;

use ppum::field::Field;
use ppum::text::trimmed;
use ppum_render::deform::{DeformError, automatic_factor};

/// How many times its displacement a body is drawn with: written as a number, or `auto`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Magnification {
    /// The largest displacement is some 5 % of the body.
    Auto,
    /// So many times.
    Given(f64),
}

impl FromStr for Magnification {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text.trim() {
            "auto" => Ok(Self::Auto),
            number => match number.parse() {
                Ok(factor) if f64::is_finite(factor) => Ok(Self::Given(factor)),
                _ => Err("write a finite number, or auto"),
            },
        }
    }
}

impl fmt::Display for Magnification {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Given(factor) => write!(f, "{factor:?}"),
        }
    }
}

crate::request::written::as_text!(Magnification);

impl Magnification {
    /// The number, which for `auto` follows from the displacements of all bodies.
    ///
    /// # Errors
    /// Fields that are no displacements.
    pub fn number(self, fields: &[&Field<'_>]) -> Result<f64, DeformError> {
        match (self, fields.first()) {
            (Self::Given(factor), _) => Ok(factor),
            (Self::Auto, Some(first)) => automatic_factor(fields, &first.domain.bounds),
            (Self::Auto, None) => Ok(1.0),
        }
    }
}

/// The factor as it is told: `deformed ×100`.
#[must_use]
pub fn words(factor: f64) -> String {
    format!("deformed ×{}", trimmed(factor))
}
