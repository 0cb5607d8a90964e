//! Numbers, locations and words as people read them.
//!
//! Files and JSON have all digits of results. In messages and tables numbers are short, a number
//! that is only a rounding error of its neighbours is zero, and locations have as many digits as
//! distinguish them.

use std::collections::BTreeSet;

pub use ppum_formula::spelling::{hint, nearest};

use crate::crack::Crack;
use crate::vec2::{Rect, Vec2};

/// Significant digits of a number.
const DIGITS: usize = 6;

/// Most digits of a coordinate: decimals of up to 15 digits survive the conversion to f64.
const MOST_DIGITS: usize = 15;

/// A number below this part of its neighbours' size is a rounding error: solutions of linear
/// systems are seldom more accurate.
const ROUNDING: f64 = 2e-10;

/// As [`ROUNDING`], for coordinates, which are results of a few sums and products.
const ROUNDING_OF_PLACES: f64 = 8.0 * f64::EPSILON;

/// All digits that tell a number from its neighbours, with an exponent where there would be
/// many zeros.
#[must_use]
pub fn exact(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

/// Six significant digits, with an exponent only if that is shorter.
#[must_use]
pub fn short(value: f64) -> String {
    with_digits(value, DIGITS)
}

fn with_digits(value: f64, digits: usize) -> String {
    let scientific = format!("{value:.*e}", digits - 1);
    let exponent = scientific.split_once('e').and_then(|(_, e)| e.parse::<i32>().ok());
    let last = digits as i32 - 1;
    match exponent {
        Some(_) if value == 0.0 => "0".into(),
        Some(e) if (-4..=last).contains(&e) => format!("{value:.*}", (last - e) as usize),
        _ => scientific,
    }
}

/// As [`short`], without zeros at the end; whole numbers in full.
#[must_use]
pub fn trimmed(value: f64) -> String {
    trimmed_to(value, DIGITS)
}

/// As [`trimmed`], with another number of significant digits.
#[must_use]
pub fn trimmed_to(value: f64, digits: usize) -> String {
    if is_counted(value, digits) {
        return (value as i64).to_string();
    }
    let text = with_digits(value, digits);
    let (mantissa, exponent) = text.find('e').map_or((&*text, ""), |e| text.split_at(e));
    let has_point = mantissa.contains('.');
    let kept =
        if has_point { mantissa.trim_end_matches('0').trim_end_matches('.') } else { mantissa };
    format!("{kept}{exponent}")
}

/// True for integers such as counts; a large measured value is an integer only because f64 has no
/// more digits.
fn is_counted(value: f64, digits: usize) -> bool {
    let is_whole = value.fract() == 0.0 && value.abs() < 9e15; // f64 holds every whole number up to 2^53
    let has_few = || format!("{value:.*e}", digits.saturating_sub(1)).parse() == Ok(value);
    is_whole && (value.abs() < 1e9 || has_few())
}

/// The value, or zero if it is a rounding error beside numbers of the given size.
#[must_use]
pub fn beside(value: f64, size: f64) -> f64 {
    if value.abs() < ROUNDING * size { 0.0 } else { value }
}

/// Two numbers with as many digits as tell them apart.
#[must_use]
pub fn apart(a: f64, b: f64) -> [String; 2] {
    let shown = |digits: usize| [a, b].map(|v| trimmed_to(v, digits));
    let differ = |texts: &[String; 2]| texts[0] != texts[1];
    (DIGITS..=17).map(shown).find(differ).unwrap_or_else(|| shown(DIGITS))
}

/// Writes locations in a body, with enough digits to distinguish the vertices of its cracks.
/// Coordinates within the rounding errors of the body's are written as zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocationText {
    /// Size of coordinates.
    size: Vec2,
    digits: usize,
}

impl LocationText {
    /// Places of a box with cracks.
    #[must_use]
    pub fn new(bounds: &Rect, cracks: &[Crack]) -> Self {
        let size = (-bounds.min).max(bounds.min).max(-bounds.max).max(bounds.max);
        let with = |digits| Self { size, digits };
        let texts = |places: Self| -> usize {
            let points = cracks.iter().flat_map(|crack| &crack.points);
            points.map(|&p| places.show(p)).collect::<BTreeSet<_>>().len()
        };
        let most = texts(with(MOST_DIGITS));
        let enough = |digits: &usize| texts(with(*digits)) == most;
        let least = (DIGITS + far(size, bounds.size())).min(MOST_DIGITS);
        with((least..MOST_DIGITS).find(enough).unwrap_or(MOST_DIGITS))
    }

    /// `(0.5, -0.25)`
    #[must_use]
    pub fn show(&self, p: Vec2) -> String {
        let shown = |v: f64, size: f64| {
            let is_rounding = v.abs() <= ROUNDING_OF_PLACES * size;
            trimmed_to(if is_rounding { 0.0 } else { v }, self.digits)
        };
        format!("({}, {})", shown(p.x, self.size.x), shown(p.y, self.size.y))
    }
}

/// The number of leading digits that all points of a box share because it lies far from the origin.
fn far(size: Vec2, extent: Vec2) -> usize {
    let digits = |size: f64, extent: f64| (size / extent).log10().ceil().max(0.0) as usize;
    digits(size.x, extent.x).max(digits(size.y, extent.y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crack::CrackEnd;
    use crate::vec2::vec2;

    fn places(size: f64, xs: &[f64]) -> Vec<String> {
        let bounds = Rect::new(vec2(-size, -size), vec2(size, size));
        let points: Vec<_> = xs.iter().map(|&x| vec2(x, 0.0)).collect();
        let places =
            LocationText::new(&bounds, &[Crack::polyline(points.clone(), [CrackEnd::Tip; 2])]);
        points.into_iter().map(|p| places.show(p)).collect()
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
            (1e-20, "1.00000e-20"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(short(value), text);
        }
        assert_eq!([-0.0, 1_234_567.0, 1.5].map(trimmed), ["0", "1234567", "1.5"]);
        assert_eq!(trimmed_to(0.049_951, 2), "0.05");
    }

    #[test]
    fn whole_numbers_are_written_in_full_if_they_are_whole_on_purpose() {
        for (value, text) in [
            (123_456_789.0, "123456789"),
            (2.1e11, "210000000000"),
            (-4e15, "-4000000000000000"),
            // doubles of this size have no digits after the point
            (7_141_602_316_710_889.0, "7.1416e15"),
        ] {
            assert_eq!(trimmed_to(value, 5), text);
        }
    }

    #[test]
    fn rounding_is_zero() {
        assert_eq!((beside(-9e-14, 1.6), beside(1e-9, 1.6), beside(0.0, 0.0)), (0.0, 1e-9, 0.0));
        assert_eq!(beside(1e-39, 1e-30), 1e-39);
        assert_eq!(places(1.0, &[-5e-17, 0.1 + 0.2]), ["(0, 0)", "(0.3, 0)"]);
        // in units of their own
        assert_eq!(places(1e-20, &[-5e-37, 1e-21]), ["(0, 0)", "(1e-21, 0)"]);
    }

    /// Whatever the units and however near to each other: points that differ print differently.
    #[test]
    fn places_are_told_apart() {
        for exponent in [-20, -3, 0, 3, 20] {
            for apart in 1..=13 {
                let size = 10f64.powi(exponent);
                let xs = [0.5 * size, (0.5 + 10f64.powi(-apart)) * size];
                let texts = places(size, &xs);
                assert_ne!(texts[0], texts[1], "{exponent} {apart}");
                assert!(texts[0].len() < 24, "{texts:?}");
            }
        }
        assert_eq!(places(1.0, &[0.5, 0.500_000_1]), ["(0.5, 0)", "(0.5000001, 0)"]);
        assert_eq!(places(1.0, &[0.3, 0.1 + 0.2]), ["(0.3, 0)", "(0.3, 0)"], "an ulp apart");
        assert_eq!(apart(1.0, 1.000_000_01), ["1", "1.00000001"]);
        assert_eq!(apart(1.0, 1.0), ["1", "1"]);
    }

    #[test]
    fn places_far_from_the_origin_have_more_digits() {
        let bounds = Rect::new(vec2(1e6, 1e6), vec2(1e6 + 1.0, 1e6 + 1.0));
        let places = LocationText::new(&bounds, &[]);
        assert_eq!(places.show(vec2(1e6 + 0.3, 1e6 + 0.512345)), "(1000000.3, 1000000.512345)");
        let near = Rect::new(vec2(-1.0, 0.0), vec2(1.0, 50.0));
        assert_eq!(LocationText::new(&near, &[]).show(vec2(0.123_456_7, 1.0)), "(0.123457, 1)");
    }
}
