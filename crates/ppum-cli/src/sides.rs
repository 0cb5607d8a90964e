//! Points on a crack, and how to stand on either side of it.
//!
//! The decimal digits of a point on an oblique crack are rarely f64 numbers that lie on it. A point
//! within rounding of a crack therefore counts as on it, and is moved by no more than that to the
//! side that is asked for. Points given with an offset mean exactly what they say, and are on a crack
//! only up to the rounding of the offset.

use ppum::crack::{Crack, CrackEnd, LocalCrack, Side};
use ppum::vec2::Vec2;

/// Rounding of a point's coordinates and of its distance from a line, in parts of their size.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// If `anchor + offset` lies on a crack, the offsets that stand above and below it. Tips do not
/// count: there is nothing to part.
pub(crate) fn on_crack(cracks: &[Crack], anchor: Vec2, offset: Vec2) -> Option<[Vec2; 2]> {
    cracks.iter().find_map(|crack| {
        let last = crack.points.len() - 2;
        (0..=last).find_map(|k| {
            let is_tip = [
                k == 0 && crack.ends[0] == CrackEnd::Tip,
                k == last && crack.ends[1] == CrackEnd::Tip,
            ];
            let ends = [crack.points[k], crack.points[k + 1]];
            let contact = Contact::new(ends, is_tip, anchor, offset)?;
            let local = LocalCrack::new(crack, anchor);
            Some([contact.stand(&local, Side::Above)?, contact.stand(&local, Side::Below)?])
        })
    })
}

/// A point on a segment.
struct Contact {
    offset: Vec2,
    /// Normal of the segment, to its left.
    normal: Vec2,
    /// Distance from the segment's line, positive on the left; at most `rounding`.
    distance: f64,
    rounding: f64,
}

impl Contact {
    fn new([a, b]: [Vec2; 2], is_tip: [bool; 2], anchor: Vec2, offset: Vec2) -> Option<Self> {
        let size = [anchor.x, anchor.y, a.x, a.y, b.x, b.y].into_iter().fold(0.0, largest);
        let rounding =
            ROUNDING * if offset == Vec2::ZERO { size } else { largest(offset.x, offset.y) };
        let near = if (anchor - a).length() < (anchor - b).length() { a } else { b };
        let tangent = (b - a).unit();
        let from_near = (anchor - near) + offset;
        let distance = tangent.cross(from_near);
        // What is left of the segment before and behind the point.
        let inner = tangent.dot(from_near);
        let length = (b - a).length();
        let rest = if near == a { [inner, length - inner] } else { [length + inner, -inner] };
        let ends_beyond = rest
            .into_iter()
            .zip(is_tip)
            .any(|(rest, is_tip)| if is_tip { rest <= rounding } else { rest < -rounding });
        let normal = tangent.left();
        (distance.abs() <= rounding && !ends_beyond).then_some(Self {
            offset,
            normal,
            distance,
            rounding,
        })
    }

    /// The offset on one side, moved only if it must be.
    fn stand(&self, crack: &LocalCrack, side: Side) -> Option<Vec2> {
        let wanted = match side {
            Side::Above => 1.0,
            Side::Below => -1.0,
        };
        let is_there = |p: &Vec2| crack.side([p.x, p.y], side) == wanted;
        let moved = self.offset + self.normal * (2.0 * wanted * self.rounding - self.distance);
        [self.offset, moved].into_iter().find(is_there)
    }
}

fn largest(a: f64, b: f64) -> f64 {
    a.abs().max(b.abs())
}

#[cfg(test)]
mod tests {
    use ppum::vec2::vec2;

    use super::*;

    fn crack(points: &[(f64, f64)], ends: [CrackEnd; 2]) -> Crack {
        Crack { points: points.iter().map(|&(x, y)| vec2(x, y)).collect(), ends }
    }

    /// Points a + t (b − a), rounded, of many oblique segments: each has two sides, a hair apart.
    #[test]
    fn rounded_points_on_oblique_cracks() {
        for k in 0..500 {
            let (sin, cos) = (0.1 + 0.7 * f64::from(k)).sin_cos();
            let (a, b) = (vec2(0.3 * cos, 0.3 * sin), vec2(-0.5 * sin - 0.9 * cos, 0.2 * cos));
            let crack = crack(&[(a.x, a.y), (b.x, b.y)], [CrackEnd::Tip; 2]);
            let point = a + (b - a) * (0.01 + 0.98 * f64::from(k) / 500.0);
            let found = on_crack(std::slice::from_ref(&crack), point, Vec2::ZERO);
            let local = LocalCrack::new(&crack, point);
            let [above, below] = found.expect("on the crack");
            assert_eq!(local.side([above.x, above.y], Side::Above), 1.0);
            assert_eq!(local.side([below.x, below.y], Side::Below), -1.0);
            assert!(above.length().max(below.length()) < 1e-14, "{above:?} {below:?}");
        }
    }

    #[test]
    fn tips_do_not_count_and_mouths_and_kinks_do() {
        let bent = [crack(&[(0.0, 0.1), (0.3, 0.1), (0.5, 0.7)], [CrackEnd::Mouth, CrackEnd::Tip])];
        let at = |x, y| on_crack(&bent, vec2(x, y), Vec2::ZERO);
        assert_eq!(at(0.0, 0.1), Some([Vec2::ZERO; 2]));
        assert_eq!(at(0.3, 0.1), Some([Vec2::ZERO; 2]));
        assert!(at(0.4, 0.4).is_some());
        for (x, y) in [(0.5, 0.7), (-1e-9, 0.1), (0.1, 0.1 + 1e-12), (0.6, 1.0)] {
            assert_eq!(at(x, y), None, "{x} {y}");
        }
    }

    #[test]
    fn offsets_mean_what_they_say() {
        let straight = [crack(&[(-0.5, 0.3), (0.5, 0.3)], [CrackEnd::Tip; 2])];
        let at = |dx, dy| on_crack(&straight, vec2(0.5, 0.3), vec2(dx, dy));
        assert_eq!(at(-1e-30, 0.0), Some([vec2(-1e-30, 0.0); 2]));
        assert_eq!(at(1e-30, 0.0), None);
        assert_eq!(at(-1e-30, 1e-40), None);
    }
}
