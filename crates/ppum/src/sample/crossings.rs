//! Where curves pass through cracks.

use super::place::SidedPoint;
use crate::crack::{Crack, CrackEnd, SegmentId, Side};
use crate::vec2::Vec2;

/// A curve that places lie on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Curve {
    /// The line from a point to another one; its variable is the distance from the first.
    Line([Vec2; 2]),
    /// The circle about a centre; its variable is the angle from the x axis, from −π to π.
    Circle(Vec2, f64),
}

/// A point at which a curve passes through a crack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    /// The curve's variable there.
    pub at: f64,
    /// The point, on the side that the curve comes from and on that where it goes on.
    pub places: [SidedPoint; 2],
}

/// Passages nearer to each other than this part of the curve are one: through a kink, or through
/// its two segments.
const SAME: f64 = 1e-12;

/// [`passages_from`] the origin.
fn passages(cracks: &[Crack], curve: Curve) -> Vec<Passage> {
    let mut found: Vec<Passage> = Vec::new();
    for (index, crack) in (0..).zip(cracks) {
        for (segment, ends) in (0..).zip(crack.points.windows(2)) {
            let id = SegmentId { crack: index, segment };
            let ends = [ends[0], ends[1]];
            let is_part = |part: &f64| is_on(crack, segment as usize, *part);
            let parts = curve.parts(ends).into_iter().flatten().filter(is_part);
            found.extend(parts.filter_map(|part| curve.passage(ends, part, id)));
        }
    }
    found.sort_by(|a, b| a.at.total_cmp(&b.at));
    found.dedup_by(|b, a| b.at - a.at <= SAME * curve.length());
    found
}

/// The points at which a curve passes through the cracks, in its order; not tips, nor where it runs
/// along a segment. The curve's points are counted from an anchor, that of a circle its centre:
/// near it no digit of them is lost. Linear in the number of segments.
#[must_use]
pub fn passages_from(cracks: &[Crack], anchor: Vec2, curve: Curve) -> Vec<Passage> {
    if anchor == Vec2::ZERO {
        return passages(cracks, curve);
    }
    let shifted = |crack: &Crack| {
        let points = crack.points.iter().map(|&p| p - anchor).collect();
        Crack { points, ends: crack.ends }
    };
    let shifted: Vec<Crack> = cracks.iter().map(shifted).collect();
    let mut all = passages(&shifted, curve);
    for passage in &mut all {
        let Some(id) = passage.places[0].on else { continue };
        let points = &shifted[id.crack as usize].points[id.segment as usize..];
        let offset = curve.refined([points[0], points[1]], passage.places[0].point);
        passage.at = curve.at(offset).0;
        for place in &mut passage.places {
            *place = SidedPoint { point: anchor + offset, anchor, offset, ..*place };
        }
    }
    all
}

/// True if a part of a segment's length belongs to the crack, without its tips.
fn is_on(crack: &Crack, segment: usize, part: f64) -> bool {
    let starts = segment == 0 && crack.ends[0] == CrackEnd::Tip;
    let ends = segment + 2 == crack.points.len() && crack.ends[1] == CrackEnd::Tip;
    let from = if starts { SAME } else { -SAME };
    let to = if ends { 1.0 - SAME } else { 1.0 + SAME };
    (from..=to).contains(&part)
}

impl Curve {
    /// Length of the range of its variable.
    #[must_use]
    pub fn length(&self) -> f64 {
        match self {
            Self::Line([a, b]) => (*b - *a).length(),
            Self::Circle(..) => std::f64::consts::TAU,
        }
    }

    /// The parts of a segment at which its line meets the curve; NaN where it does not.
    fn parts(&self, [p, q]: [Vec2; 2]) -> [Option<f64>; 2] {
        let way = q - p;
        match *self {
            Self::Line([a, b]) => {
                let sine = way.cross(b - a);
                let is_parallel = sine.abs() <= SAME * way.length() * (b - a).length();
                [(!is_parallel).then(|| (a - p).cross(b - a) / sine), None]
            }
            Self::Circle(center, radius) => {
                // |p − c + t way|² = r², from the point of the line that is nearest to the centre
                let (tangent, from) = (way.unit(), p - center);
                let (nearest, distance) = (-tangent.dot(from), tangent.cross(from));
                let half = ((radius - distance) * (radius + distance)).sqrt();
                [-half, half].map(|half| Some((nearest + half) / way.length()))
            }
        }
    }

    /// The point at which the curve, a circle one about the origin, meets the line of a segment,
    /// near a point where it is known to do so: found from the end that is nearer to the origin, so
    /// that near it no digit is lost.
    fn refined(&self, [p, q]: [Vec2; 2], known: Vec2) -> Vec2 {
        let near = if p.length() < q.length() { p } else { q };
        let tangent = (q - p).unit();
        match *self {
            Self::Line([a, b]) => {
                a + (b - a) * ((near - a).cross(tangent) / (b - a).cross(tangent))
            }
            Self::Circle(_, radius) => {
                let distance = tangent.cross(near);
                let half = ((radius - distance) * (radius + distance)).max(0.0).sqrt();
                let ahead = half.copysign(tangent.dot(known));
                tangent.left() * distance + tangent * ahead
            }
        }
    }

    /// The variable and the direction of the curve at one of its points.
    fn at(&self, point: Vec2) -> (f64, Vec2) {
        match *self {
            Self::Line([a, b]) => ((point - a).dot((b - a).unit()), b - a),
            Self::Circle(center, _) => {
                let out = point - center;
                (out.y.atan2(out.x), out.left())
            }
        }
    }

    /// The passage through a segment at a part of it; none beyond the curve's ends.
    fn passage(&self, [p, q]: [Vec2; 2], part: f64, id: SegmentId) -> Option<Passage> {
        let point = if part < 0.5 { p + (q - p) * part } else { q - (q - p) * (1.0 - part) };
        let (at, way) = self.at(point);
        let is_within = match self {
            Self::Line(_) => (-SAME..=1.0 + SAME).contains(&(at / self.length())),
            Self::Circle(..) => at.is_finite(),
        };
        let goes_up = (q - p).cross(way) > 0.0;
        let sides = if goes_up { [Side::Below, Side::Above] } else { [Side::Above, Side::Below] };
        let place =
            |side| SidedPoint { point, anchor: point, offset: Vec2::ZERO, on: Some(id), side };
        is_within.then(|| Passage { at, places: sides.map(place) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vec2::vec2;

    /// A number from −1 to 1 for each k, without a pattern.
    fn number(k: u32) -> f64 {
        (f64::from(k) * 12.9898).sin() * 43758.5453 % 1.0
    }

    fn random(k: u32) -> Vec2 {
        vec2(number(2 * k), number(2 * k + 1))
    }

    /// True if the points lie on different sides of the line through p and q.
    fn parts([p, q]: [Vec2; 2], a: Vec2, b: Vec2) -> bool {
        ((q - p).cross(a - p) > 0.0) != ((q - p).cross(b - p) > 0.0)
    }

    /// Lines pass through the segments whose ends they part, and come from the side on which
    /// they begin.
    #[test]
    fn lines_pass_from_one_side_to_the_other() {
        let mut passed = 0;
        for k in 0..500 {
            let [a, b, p, q] = [0, 1, 2, 3].map(|n| random(4 * k + n));
            let crack = Crack { points: vec![p, q], ends: [CrackEnd::Tip; 2] };
            let found = passages(&[crack], Curve::Line([a, b]));
            let expected = parts([p, q], a, b) && parts([a, b], p, q);
            assert_eq!(found.len(), usize::from(expected), "{k}");
            for Passage { at, places } in found {
                passed += 1;
                let point = places[0].point;
                assert!((point - a - (b - a).unit() * at).length() < 1e-9);
                let from = if (q - p).cross(a - p) > 0.0 { Side::Above } else { Side::Below };
                assert_eq!(places[0].side, from);
                assert_ne!(places[0].side, places[1].side);
            }
        }
        assert!(passed > 50, "{passed}");
    }

    /// Just before a passage a circle is on the side that it comes from.
    #[test]
    fn circles_pass_from_one_side_to_the_other() {
        let mut passed = 0;
        for k in 0..500 {
            let [center, p, q] = [0, 1, 2].map(|n| random(3 * k + n));
            let radius = 0.1 + number(k).abs();
            let crack = Crack { points: vec![p, q], ends: [CrackEnd::Tip; 2] };
            let inside = [p, q].map(|end| (end - center).length() < radius);
            let found = passages(&[crack], Curve::Circle(center, radius));
            assert_eq!(found.len() % 2, usize::from(inside[0] != inside[1]), "{k}");
            for Passage { at, places } in found {
                passed += 1;
                let on = |angle: f64| center + vec2(angle.cos(), angle.sin()) * radius;
                assert!((places[0].point - on(at)).length() < 1e-9);
                for (place, angle) in places.iter().zip([at - 1e-6, at + 1e-6]) {
                    let above = (q - p).cross(on(angle) - p) > 0.0;
                    assert_eq!(place.side == Side::Above, above, "{k}");
                }
            }
        }
        assert!(passed > 50, "{passed}");
    }

    /// Counted from an anchor passages are the same, and deep inside they keep their digits.
    #[test]
    fn anchors_change_nothing_but_digits() {
        for k in 0..100 {
            let [a, b, p, q, anchor] = [0, 1, 2, 3, 4].map(|n| random(5 * k + n));
            let cracks = [Crack { points: vec![p, q], ends: [CrackEnd::Tip; 2] }];
            let found = passages(&cracks, Curve::Line([a, b]));
            let seen = passages_from(&cracks, anchor, Curve::Line([a - anchor, b - anchor]));
            assert_eq!(found.len(), seen.len(), "{k}");
            for (found, seen) in found.iter().zip(&seen) {
                assert!((found.at - seen.at).abs() < 1e-12);
                assert!((found.places[0].point - seen.places[0].point).length() < 1e-12);
                assert_eq!(found.places.map(|p| p.side), seen.places.map(|p| p.side));
            }
        }
        // 10⁻¹¹ behind a tip
        let points = vec![vec2(-0.5, 0.1), vec2(0.5, 0.1)];
        let cracks = [Crack { points, ends: [CrackEnd::Tip; 2] }];
        let [a, b] = [vec2(-1e-11, -1e-11), vec2(-1e-11, 2e-11)];
        let seen = passages_from(&cracks, vec2(0.5, 0.1), Curve::Line([a, b]));
        assert_eq!(seen.len(), 1);
        assert!((seen[0].at / 1e-11 - 1.0).abs() < 1e-12);
        assert!((seen[0].places[0].offset.x / -1e-11 - 1.0).abs() < 1e-14);
        let around = passages_from(&cracks, vec2(0.5, 0.1), Curve::Circle(Vec2::ZERO, 1e-11));
        assert_eq!(around.len(), 1);
        assert!((around[0].places[0].offset.x / -1e-11 - 1.0).abs() < 1e-14);
    }

    /// A kink is passed once, a tip and a segment along the line not at all.
    #[test]
    fn kinks_are_passed_once_and_tips_not() {
        let points = vec![vec2(-0.5, -0.5), vec2(0.1, 0.3), vec2(0.2, 0.9)];
        let cracks = [Crack { points, ends: [CrackEnd::Mouth, CrackEnd::Tip] }];
        let count = |a, b| passages(&cracks, Curve::Line([a, b])).len();
        assert_eq!(count(vec2(-1.0, 0.3), vec2(1.0, 0.3)), 1);
        assert_eq!(count(vec2(-1.0, 0.9), vec2(1.0, 0.9)), 0);
        assert_eq!(count(vec2(-1.0, -0.5), vec2(1.0, -0.5)), 1);
        let oblique = [vec2(-0.5, -0.35), vec2(0.7, 0.13)];
        let straight = [Crack { points: oblique.to_vec(), ends: [CrackEnd::Tip; 2] }];
        let [p, q] = oblique.map(|end| end + (oblique[1] - oblique[0]) * 0.1);
        assert_eq!(passages(&straight, Curve::Line([p, q])), []);
    }
}
