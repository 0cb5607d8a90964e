//! Numbers as facts have them in JSON.

use serde::{Serialize, Serializer};

/// A number that may not be finite. JSON has finite numbers only: +∞ is the string `"inf"`, −∞ is
/// `"-inf"`, and what is undefined (NaN) is `null`. Finite numbers are written with the digits that
/// read back as the same f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JsonNumber(pub f64);

impl Serialize for JsonNumber {
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
        let json = |v| serde_json::to_string(&JsonNumber(v)).unwrap();
        assert_eq!(json(0.1), "0.1");
        assert_eq!(json(f64::NAN), "null");
        assert_eq!(json(f64::INFINITY), "\"inf\"");
        assert_eq!(json(f64::NEG_INFINITY), "\"-inf\"");
    }
}
