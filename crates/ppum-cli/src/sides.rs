//! Points on a crack: on which segment.
//!
//! The decimal digits of a point on an oblique crack are rarely f64 numbers that lie on it. A point
//! within rounding of a crack therefore counts as on it, and is evaluated on its segment, on the side that
//! is asked for. Points given with an offset mean exactly what they say, and are on a crack only up to the
//! rounding of the offset.

use ppum::crack::{Crack, CrackEnd, SegmentId};
use ppum::field::{Field, LocalField};
use ppum::vec2::Vec2;

/// Rounding of a point's coordinates and of its distance from a line, in parts of their size.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The segment that `anchor + offset` lies on, if it lies on a crack. Tips do not count: there is
/// nothing to part.
pub(crate) fn on_crack(cracks: &[Crack], anchor: Vec2, offset: Vec2) -> Option<SegmentId> {
    (0..).zip(cracks).find_map(|(index, crack)| {
        let last = crack.points.len() - 2;
        let segment = (0..=last).find(|&k| {
            let is_tip = [
                k == 0 && crack.ends[0] == CrackEnd::Tip,
                k == last && crack.ends[1] == CrackEnd::Tip,
            ];
            touches([crack.points[k], crack.points[k + 1]], is_tip, anchor, offset)
        })?;
        Some(SegmentId { crack: index, segment: segment as u32 })
    })
}

/// The field as seen from an anchor, on a segment of a crack if points lie on one.
pub(crate) fn seen<'f>(
    field: &'f Field<'_>,
    segment: Option<SegmentId>,
    anchor: Vec2,
) -> LocalField<'f> {
    segment.map_or_else(|| field.at(anchor), |segment| field.on(segment, anchor))
}

/// True if `anchor + offset` lies on a segment, up to rounding.
fn touches([a, b]: [Vec2; 2], is_tip: [bool; 2], anchor: Vec2, offset: Vec2) -> bool {
    let size = [anchor.x, anchor.y, a.x, a.y, b.x, b.y].into_iter().fold(0.0, largest);
    let rounding = ROUNDING * if offset == Vec2::ZERO { size } else { largest(offset.x, offset.y) };
    let near = if (anchor - a).length() < (anchor - b).length() { a } else { b };
    let tangent = (b - a).unit();
    let from_near = (anchor - near) + offset;
    // What is left of the segment before and behind the point.
    let inner = tangent.dot(from_near);
    let length = (b - a).length();
    let rest = if near == a { [inner, length - inner] } else { [length + inner, -inner] };
    let ends_beyond = rest
        .into_iter()
        .zip(is_tip)
        .any(|(rest, is_tip)| if is_tip { rest <= rounding } else { rest < -rounding });
    tangent.cross(from_near).abs() <= rounding && !ends_beyond
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

    /// Points a + t (b − a), rounded, of many oblique segments.
    #[test]
    fn rounded_points_on_oblique_cracks() {
        for k in 0..500 {
            let (sin, cos) = (0.1 + 0.7 * f64::from(k)).sin_cos();
            let (a, b) = (vec2(0.3 * cos, 0.3 * sin), vec2(-0.5 * sin - 0.9 * cos, 0.2 * cos));
            let crack = crack(&[(a.x, a.y), (b.x, b.y)], [CrackEnd::Tip; 2]);
            let point = a + (b - a) * (0.01 + 0.98 * f64::from(k) / 500.0);
            let found = on_crack(std::slice::from_ref(&crack), point, Vec2::ZERO);
            assert_eq!(found, Some(SegmentId { crack: 0, segment: 0 }), "{point:?}");
        }
    }

    #[test]
    fn tips_do_not_count_and_mouths_and_kinks_do() {
        let bent = [crack(&[(0.0, 0.1), (0.3, 0.1), (0.5, 0.7)], [CrackEnd::Mouth, CrackEnd::Tip])];
        let at = |x, y| on_crack(&bent, vec2(x, y), Vec2::ZERO);
        let segment = |segment| Some(SegmentId { crack: 0, segment });
        assert_eq!(at(0.0, 0.1), segment(0));
        assert_eq!(at(0.3, 0.1), segment(0));
        assert_eq!(at(0.4, 0.4), segment(1));
        for (x, y) in [(0.5, 0.7), (-1e-9, 0.1), (0.1, 0.1 + 1e-12), (0.6, 1.0)] {
            assert_eq!(at(x, y), None, "{x} {y}");
        }
    }

    #[test]
    fn offsets_mean_what_they_say() {
        let straight = [crack(&[(-0.5, 0.3), (0.5, 0.3)], [CrackEnd::Tip; 2])];
        let at = |dx, dy| on_crack(&straight, vec2(0.5, 0.3), vec2(dx, dy));
        assert!(at(-1e-30, 0.0).is_some());
        assert_eq!(at(1e-30, 0.0), None);
        assert_eq!(at(-1e-30, 1e-40), None);
    }
}
