//! Places that keep their digits.

use ppum::crack::SegmentId;
use ppum::vec2::Vec2;
use serde::{Deserialize, Serialize};

/// A point of the plate, `anchor + offset`; the two are never added up where digits count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Spot {
    /// A point near by.
    pub anchor: [f64; 2],
    /// The way from it.
    pub offset: [f64; 2],
    /// The crack and its segment that the point lies on, if it was put there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on: Option<[u32; 2]>,
}

impl Spot {
    /// The point `anchor + offset`.
    #[must_use]
    pub fn new(anchor: Vec2, offset: Vec2) -> Self {
        Self { anchor: anchor.into(), offset: offset.into(), on: None }
    }

    /// The same on a segment of a crack.
    #[must_use]
    pub fn on(self, segment: SegmentId) -> Self {
        Self { on: Some([segment.crack, segment.segment]), ..self }
    }

    /// The anchor.
    #[must_use]
    pub fn anchor(&self) -> Vec2 {
        self.anchor.into()
    }

    /// The way from the anchor.
    #[must_use]
    pub fn offset(&self) -> Vec2 {
        self.offset.into()
    }

    /// The point, rounded.
    #[must_use]
    pub fn point(&self) -> Vec2 {
        self.anchor() + self.offset()
    }

    /// The way to it from another point.
    #[must_use]
    pub fn from(&self, origin: Vec2) -> Vec2 {
        (self.anchor() - origin) + self.offset()
    }

    /// True for the same point, whatever it is counted from.
    #[must_use]
    pub fn is_at(&self, other: &Self) -> bool {
        self.from(other.anchor()) == other.offset()
    }

    /// Each coordinate as a text: `0.5`, or `0.5 + 1e-12` where both parts count.
    #[must_use]
    pub fn texts(&self) -> [String; 2] {
        [0, 1].map(|k| {
            let (a, b) = (self.anchor[k], self.offset[k]);
            let [sum, both] = [format!("{:?}", a + b), format!("{a:?} + {b:?}")];
            let is_exact = (a + b) - a == b && (a + b) - b == a;
            let text = if is_exact { sum } else { both };
            text.replace("+ -", "- ").replace(".0 ", " ").trim_end_matches(".0").to_owned()
        })
    }

    /// The spot with a coordinate as a text says; none if that is no number, nor the sum of two.
    #[must_use]
    pub fn with_text(&self, k: usize, text: &str) -> Option<Self> {
        let (a, b) = sum(text)?;
        let mut changed = Self { on: None, ..*self };
        (changed.anchor[k], changed.offset[k]) = (a, b);
        Some(changed)
    }
}

/// `a`, `a + b` or `a - b`, with blanks around the sign.
fn sum(text: &str) -> Option<(f64, f64)> {
    let number =
        |text: &str| text.trim().replace('−', "-").parse::<f64>().ok().filter(|v| v.is_finite());
    for (sign, factor) in [(" + ", 1.0), (" - ", -1.0), (" − ", -1.0)] {
        if let Some((a, b)) = text.trim().split_once(sign) {
            return Some((number(a)?, factor * number(b)?));
        }
    }
    Some((number(text)?, 0.0))
}

#[cfg(test)]
mod tests {
    use ppum::vec2::vec2;

    use super::*;

    #[test]
    fn coordinates_are_sums_of_two_numbers() {
        for (text, sum_of_two) in [
            ("0.5", Some((0.5, 0.0))),
            ("-0.5 + 1e-12", Some((-0.5, 1e-12))),
            ("0.5 - 1e-12", Some((0.5, -1e-12))),
            (" −2 ", Some((-2.0, 0.0))),
            ("1e-3", Some((1e-3, 0.0))),
            ("0.5 +", None),
            ("inf", None),
            ("", None),
        ] {
            assert_eq!(sum(text), sum_of_two, "{text}");
        }
    }

    /// What is written is read as the same point, digit by digit.
    #[test]
    fn texts_keep_all_digits() {
        for (anchor, offset) in [
            (vec2(0.5, 0.0), vec2(1e-13, -3e-20)),
            (vec2(-0.1, 0.3), vec2(0.2, 0.4)),
            (vec2(0.0, 1.0), vec2(0.0, 0.0)),
        ] {
            let spot = Spot::new(anchor, offset);
            let [x, y] = spot.texts();
            let read = Spot::default().with_text(0, &x).and_then(|s| s.with_text(1, &y));
            let read = read.expect("two numbers");
            // the same point, whichever way its parts are split
            assert_eq!(read.from(anchor), offset, "{x} {y}");
        }
    }
}
