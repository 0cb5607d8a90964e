//! Places that keep their digits, and how they are written.

use ppum::crack::{Crack, SegmentId, TipId, tips};
use ppum::edge::Edge;
use ppum::text::trimmed_to;
use ppum::vec2::Vec2;
use ppum_render::anchored_edge::AnchoredEdge;
use ppum_render::view::View;
use serde::{Deserialize, Serialize};

/// A point of the body, `anchor + offset`; the two are never added up where digits count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Location {
    /// A point near by.
    pub anchor: [f64; 2],
    /// The way from it.
    pub offset: [f64; 2],
    /// The crack and its segment that the point lies on, if it was put there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on: Option<[u32; 2]>,
}

impl Location {
    /// The point `anchor + offset`.
    #[must_use]
    pub fn new(anchor: Vec2, offset: Vec2) -> Self {
        Self { anchor: anchor.into(), offset: offset.into(), on: None }
    }

    /// Returns the location on a segment of a crack.
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

    /// The spot itself, or the tip or the point of a crack that lies within reach of it.
    #[must_use]
    pub fn snapped(self, cracks: &[Crack], reach: f64) -> Self {
        let ends = tips(cracks).map(|tip| cracks[tip.crack as usize].end_point(tip.end));
        let distance = |end: Vec2| self.from(end).length();
        let nearest = ends.min_by(|a, b| distance(*a).total_cmp(&distance(*b)));
        if let Some(tip) = nearest.filter(|tip| distance(*tip) <= reach) {
            return Self::new(tip, Vec2::ZERO);
        }
        match self.nearest_on_crack(cracks) {
            Some((distance, on)) if distance <= reach => on,
            _ => self,
        }
    }

    /// The nearest point of a crack, with its distance.
    fn nearest_on_crack(&self, cracks: &[Crack]) -> Option<(f64, Self)> {
        let mut nearest: Option<(f64, Self)> = None;
        for (crack, c) in (0..).zip(cracks) {
            for (segment, edge) in (0..).zip(c.edges()) {
                let (distance, spot) = self.projected(edge);
                if nearest.is_none_or(|(least, _)| distance < least) {
                    nearest = Some((distance, spot.on(SegmentId { crack, segment })));
                }
            }
        }
        nearest
    }

    /// The nearest point of an edge, seen from its nearer end, with its distance.
    #[must_use]
    pub fn projected(&self, edge: Edge) -> (f64, Self) {
        let [from_a, from_b] = [self.from(edge.from), self.from(edge.to)];
        let (edge, way) = if from_a.length() < from_b.length() {
            (edge, from_a)
        } else {
            (edge.reversed(), from_b)
        };
        let local = AnchoredEdge::new(edge, edge.from);
        let offset = local.frame.at(local.closest(way));
        ((way - offset).length(), Self::new(edge.from, offset))
    }

    /// The number of the tip that it is exactly, if it is one.
    #[must_use]
    pub fn tip(&self, cracks: &[Crack]) -> Option<usize> {
        let end = |tip: TipId| cracks[tip.crack as usize].end_point(tip.end);
        tips(cracks).position(|tip| self.from(end(tip)) == Vec2::ZERO)
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

/// Views narrower than this part of the body have their places told from a point near by.
const DEEP: f64 = 1e-3;

/// True for views of a width in which places are told from a point near by, of a body of a size.
#[must_use]
pub fn is_deep(width: f64, size: f64) -> bool {
    width < DEEP * size
}

/// Where places near the middle of a view of a width are counted from, with its number: a tip that
/// is seen.
#[must_use]
pub fn tip_near(cracks: &[Crack], middle: Vec2, width: f64) -> Option<(usize, Vec2)> {
    let at = |tip: TipId| cracks[tip.crack as usize].end_point(tip.end);
    let distance = |tip: Vec2| (tip - middle).length();
    let nearest = tips(cracks).map(at).enumerate();
    let nearest = nearest.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
    nearest.filter(|(_, tip)| distance(*tip) < 2.0 * width)
}

/// How places of a view are written.
pub struct LocationFormat<'a> {
    /// The view.
    pub view: &'a View,
    /// Size of the body.
    pub size: f64,
    /// The cracks of the step.
    pub cracks: &'a [Crack],
}

impl LocationFormat<'_> {
    /// True if places are told from a point near by.
    #[must_use]
    pub fn is_deep(&self) -> bool {
        is_deep(self.view.width, self.size)
    }

    /// A number with the digits that tell neighbouring pixels apart.
    #[must_use]
    pub fn rounded(&self, v: f64) -> f64 {
        let step = self.view.pixel_size().log10().floor();
        let power = 10f64.powi(-step as i32);
        let rounded = (v * power).round() / power;
        if rounded.is_finite() { rounded } else { v }
    }

    /// Where places near the middle of the view are counted from, with its name: a tip that is
    /// seen, or the middle.
    #[must_use]
    pub fn origin(&self) -> (Vec2, String) {
        match tip_near(self.cracks, self.view.center, self.view.width) {
            Some((number, tip)) => (tip, format!("tip {number}")),
            None => {
                let center = self.view.center;
                (center, format!("({}, {})", number(center.x, 15), number(center.y, 15)))
            }
        }
    }

    /// A place: `(0.512, -0.3)`, deep inside `tip 1 + (2.5e-11, 1e-12)`.
    #[must_use]
    pub fn show(&self, spot: &Location) -> String {
        let pair = |p: Vec2| {
            let [x, y] = [p.x, p.y].map(|v| number(self.rounded(v), 15));
            format!("({x}, {y})")
        };
        if !self.is_deep() {
            return pair(spot.point());
        }
        let (origin, name) = self.origin();
        match spot.from(origin) {
            Vec2::ZERO => name,
            offset => format!("{name} + {}", pair(offset)),
        }
    }
}

/// A number with at most so many digits: `∞`, `not defined`.
#[must_use]
pub fn number(value: f64, digits: usize) -> String {
    match value {
        f64::INFINITY => "∞".into(),
        f64::NEG_INFINITY => "−∞".into(),
        value if value.is_nan() => "not defined".into(),
        value => trimmed_to(value, digits).replace('-', "−"),
    }
}

#[cfg(test)]
mod tests {
    use ppum::vec2::vec2;
    use ppum_testkit::random::Random;

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

    /// A point beside an arc is put on it, with the side's digits however near it is, and nowhere
    /// farther than the arc is.
    #[test]
    fn points_are_put_on_arcs() {
        let mut random = Random(61);
        for _ in 0..300 {
            let mut point = || vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
            let (from, to, p) = (point(), point(), point());
            let edge = Edge { from, to, bulge: random.between(-5.0, 5.0) };
            let (distance, on) = Location::new(p, Vec2::ZERO).projected(edge);
            assert!((distance - edge.distance(p)).abs() < 1e-12, "{edge:?} {p:?}");
            assert!(edge.distance(on.point()) < 1e-13, "{edge:?} {p:?}");
            let beside = from + edge.end_tangents()[0] * 1e-13;
            let near = Location::new(from, beside - from).projected(edge).1;
            assert!(near.anchor() == from && near.offset().length() < 2e-13, "{edge:?}");
        }
    }

    /// Written points are read back as the same points, digit by digit.
    #[test]
    fn texts_keep_all_digits() {
        for (anchor, offset) in [
            (vec2(0.5, 0.0), vec2(1e-13, -3e-20)),
            (vec2(-0.1, 0.3), vec2(0.2, 0.4)),
            (vec2(0.0, 1.0), vec2(0.0, 0.0)),
        ] {
            let spot = Location::new(anchor, offset);
            let [x, y] = spot.texts();
            let read = Location::default().with_text(0, &x).and_then(|s| s.with_text(1, &y));
            let read = read.expect("two numbers");
            // the same point, whichever way its parts are split
            assert_eq!(read.from(anchor), offset, "{x} {y}");
        }
    }
}
