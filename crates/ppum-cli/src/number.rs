//! Numbers in results.

use std::io::{self, Write};

use serde::{Serialize, Serializer};

/// Prints a result as JSON.
pub(crate) fn json(out: &mut dyn Write, result: &impl Serialize) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, result)?;
    writeln!(out)
}

/// A number that may not be finite. JSON has finite numbers only: +∞ is the string `"inf"`, −∞ is
/// `"-inf"`, and what is undefined (NaN) is `null`. Finite numbers are written with the digits that
/// read back as the same f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Number(pub(crate) f64);

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

/// A number for people: six significant digits, without an exponent where that is no longer.
pub(crate) fn short(value: f64) -> String {
    let scientific = format!("{value:.5e}");
    let exponent = scientific.split_once('e').and_then(|(_, e)| e.parse::<i32>().ok());
    match exponent {
        Some(_) if value == 0.0 => "0".into(),
        Some(e @ -4..=5) => format!("{value:.*}", (5 - e) as usize),
        _ => scientific,
    }
}

/// As [`short`], without zeros at the end; whole numbers in full.
pub(crate) fn trimmed(value: f64) -> String {
    // f64 holds every whole number up to 2^53
    if value.fract() == 0.0 && value.abs() < 9e15 {
        return (value as i64).to_string();
    }
    let text = short(value);
    let (mantissa, exponent) = text.find('e').map_or((&*text, ""), |e| text.split_at(e));
    let has_point = mantissa.contains('.');
    let kept =
        if has_point { mantissa.trim_end_matches('0').trim_end_matches('.') } else { mantissa };
    format!("{kept}{exponent}")
}

/// A point for people.
pub(crate) fn point([x, y]: [f64; 2]) -> String {
    format!("({}, {})", trimmed(x), trimmed(y))
}

/// `1 tip`, `2 tips`.
pub(crate) fn count(n: usize, one: &str, more: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { more })
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

    #[test]
    fn six_digits() {
        for (value, text) in [
            (0.0, "0"),
            (-1.25, "-1.25000"),
            (0.000_123_456_7, "0.000123457"),
            (123_456.7, "123457"),
            (999_999.9, "1.00000e6"),
            (1e-5, "1.00000e-5"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(short(value), text);
        }
        assert_eq!(point([-0.5, 2e-7]), "(-0.5, 2e-7)");
        assert_eq!([-0.0, 1_234_567.0, 1.5].map(trimmed), ["0", "1234567", "1.5"]);
    }
}
