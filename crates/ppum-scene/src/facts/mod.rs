//! The facts of a dataset, made once: the commands print them as text and JSON, Python has them as
//! objects, the window as tables.
//!
//! Each is a plain value in the shape of its JSON, which docs/cli.md documents.

mod about;
mod growth;
mod reactions;
mod results;
mod solver;
mod tips;

use serde::{Serialize, Serializer};

pub use about::{About, Crack};
pub use growth::{Growth, increment};
pub use reactions::{Reaction, reaction_lines, reactions};
pub use results::{Record, Results, Warning, warnings};
pub use solver::Solver;
pub use tips::{HEADS, MEANING, Tip, all_tips};

/// A number that may not be finite. JSON has finite numbers only: +∞ is the string `"inf"`, −∞ is
/// `"-inf"`, and what is undefined (NaN) is `null`. Finite numbers are written with the digits that
/// read back as the same f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number(pub f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            v if v.is_nan() => serializer.serialize_none(),
            f64::INFINITY => serializer.serialize_str("inf"),
            f64::NEG_INFINITY => serializer.serialize_str("-inf"),
            v => serializer.serialize_f64(v),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn json_of_any_number() {
        let json = |v| serde_json::to_string(&Number(v)).unwrap();
        assert_eq!(json(0.1), "0.1");
        assert_eq!(json(f64::NAN), "null");
        assert_eq!(json(f64::INFINITY), "\"inf\"");
        assert_eq!(json(f64::NEG_INFINITY), "\"-inf\"");
    }
}
