//! Where curves pass through cracks.

use super::place::SidedPoint;
use crate::crack::{Crack, CrackEnd, SegmentId, Side};
use crate::edge::Edge;
use crate::vec2::{Vec2, vec2};

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
        for (segment, edge) in (0..).zip(crack.edges()) {
            let id = SegmentId { crack: index, segment };
            let is_part = |part: &f64| is_on(crack, segment as usize, *part);
            let parts = curve.parts(edge).into_iter().filter(is_part);
            found.extend(parts.filter_map(|part| curve.passage(edge, part, id)));
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
    let shifted = |crack: &Crack| Crack {
        points: crack.points.iter().map(|&p| p - anchor).collect(),
        ..crack.clone()
    };
    let shifted: Vec<Crack> = cracks.iter().map(shifted).collect();
    let mut all = passages(&shifted, curve);
    for passage in &mut all {
        let Some(id) = passage.places[0].on else { continue };
        let edge = shifted[id.crack as usize].edge(id.segment as usize);
        let offset = curve.refined(edge, passage.places[0].point);
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

    /// The parts of an edge at which its line or circle meets the curve.
    fn parts(&self, edge: Edge) -> Vec<f64> {
        if edge.is_arc() {
            return edge.meets_curve(&self.edge());
        }
        let (p, way) = (edge.from, edge.chord());
        match *self {
            Self::Line([a, b]) => {
                let sine = way.cross(b - a);
                let is_parallel = sine.abs() <= SAME * way.length() * (b - a).length();
                if is_parallel { Vec::new() } else { vec![(a - p).cross(b - a) / sine] }
            }
            Self::Circle(center, radius) => {
                // |p − c + t way|² = r², from the point of the line that is nearest to the centre
                let (tangent, from) = (way.unit(), p - center);
                let (nearest, distance) = (-tangent.dot(from), tangent.cross(from));
                let half = ((radius - distance) * (radius + distance)).sqrt();
                [-half, half].map(|half| (nearest + half) / way.length()).to_vec()
            }
        }
    }

    /// A part of the curve.
    fn edge(&self) -> Edge {
        match *self {
            Self::Line(ends) => Edge::segment(ends),
            Self::Circle(center, radius) => {
                let out = vec2(radius, 0.0);
                Edge { from: center - out, to: center + out, bulge: 1.0 }
            }
        }
    }

    /// The point at which the curve, a circle one about the origin, meets the line or circle of an
    /// edge, near a point where it is known to do so: found from the end that is nearer to the
    /// origin, so that near it no digit is lost.
    fn refined(&self, edge: Edge, known: Vec2) -> Vec2 {
        let Edge { from: p, to: q, .. } = edge;
        if edge.is_arc() {
            let met = edge.meets_near_origin(&self.edge()).into_iter();
            let off = |p: &Vec2| (*p - known).length();
            return met.min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(known);
        }
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

    /// The passage through an edge at a part of it; none beyond the curve's ends.
    fn passage(&self, edge: Edge, part: f64, id: SegmentId) -> Option<Passage> {
        let way = if part < 0.5 { edge.way(part) } else { edge.reversed().way(1.0 - part) };
        let point = way + if part < 0.5 { edge.from } else { edge.to };
        let (at, way) = self.at(point);
        let is_within = match self {
            Self::Line(_) => (-SAME..=1.0 + SAME).contains(&(at / self.length())),
            Self::Circle(..) => at.is_finite(),
        };
        let goes_up = edge.tangent(part).cross(way) > 0.0;
        let sides = if goes_up { [Side::Below, Side::Above] } else { [Side::Above, Side::Below] };
        let place =
            |side| SidedPoint { point, anchor: point, offset: Vec2::ZERO, on: Some(id), side };
        is_within.then(|| Passage { at, places: sides.map(place) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
            let crack = Crack::polyline(vec![p, q], [CrackEnd::Tip; 2]);
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
            let crack = Crack::polyline(vec![p, q], [CrackEnd::Tip; 2]);
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
            let cracks = [Crack::polyline(vec![p, q], [CrackEnd::Tip; 2])];
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
        let cracks = [Crack::polyline(points, [CrackEnd::Tip; 2])];
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
        let cracks = [Crack::polyline(points, [CrackEnd::Mouth, CrackEnd::Tip])];
        let count = |a, b| passages(&cracks, Curve::Line([a, b])).len();
        assert_eq!(count(vec2(-1.0, 0.3), vec2(1.0, 0.3)), 1);
        assert_eq!(count(vec2(-1.0, 0.9), vec2(1.0, 0.9)), 0);
        assert_eq!(count(vec2(-1.0, -0.5), vec2(1.0, -0.5)), 1);
        let oblique = [vec2(-0.5, -0.35), vec2(0.7, 0.13)];
        let straight = [Crack::polyline(oblique.to_vec(), [CrackEnd::Tip; 2])];
        let [p, q] = oblique.map(|end| end + (oblique[1] - oblique[0]) * 0.1);
        assert_eq!(passages(&straight, Curve::Line([p, q])), []);
    }

    /// Lines and circles pass through arcs where polylines of many points say, on the same sides;
    /// counted from an anchor near a passage no digit is lost.
    #[test]
    fn arcs_are_passed_as_polylines_are() {
        let mut passed = 0;
        for k in 0..300 {
            let [a, b, p, q] = [0, 1, 2, 3].map(|n| random(4 * k + n));
            let arc = Edge { from: p, to: q, bulge: 1.5 * number(9 * k + 5) };
            let ends = [CrackEnd::Mouth; 2];
            let fine = [Crack::polyline(arc.flattened(1e-9), ends)];
            let arcs = [Crack { points: vec![p, q], bulges: vec![arc.bulge], ends }];
            for curve in [Curve::Line([a, b]), Curve::Circle(a, (b - a).length())] {
                let (found, expected) = (passages(&arcs, curve), passages(&fine, curve));
                let is_clear = expected.iter().all(|passage| {
                    let at = passage.places[0].point;
                    (at - p).length().min((at - q).length()) > 1e-4
                });
                if !is_clear || expected.len() % 2 == 0 && found.len() != expected.len() {
                    continue; // where a curve nearly touches the arc
                }
                assert_eq!(found.len(), expected.len(), "{arc:?} {curve:?}");
                for (passage, other) in found.iter().zip(&expected) {
                    passed += 1;
                    assert_eq!(passage.places.map(|p| p.side), other.places.map(|p| p.side));
                    let point = passage.places[0].point;
                    assert!((point - other.places[0].point).length() < 1e-4, "{arc:?} {curve:?}");
                    if let Curve::Circle(..) = curve {
                        continue;
                    }
                    let near = passages_from(&arcs, point, Curve::Line([a - point, b - point]));
                    let offsets = near.iter().map(|p| p.places[0].offset.length());
                    assert!(offsets.fold(1.0, f64::min) < 1e-14, "{arc:?} {curve:?}");
                }
            }
        }
        assert!(passed > 100, "{passed}");
    }
}
