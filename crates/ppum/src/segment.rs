//! Segments of cracks, rims and boundaries.

use crate::vec2::{Rect, Vec2};

/// A segment by its ends. It may be a point.
pub type Segment = [Vec2; 2];

/// The sides of a polygon, from each corner to the next.
pub fn sides(corners: &[Vec2]) -> impl Iterator<Item = Segment> + Clone {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(&a, &b)| [a, b])
}

/// The area of a polygon, positive if its corners run counter-clockwise.
#[must_use]
pub fn signed_area(corners: &[Vec2]) -> f64 {
    let Some(&origin) = corners.first() else { return 0.0 };
    0.5 * sides(corners).map(|[a, b]| (a - origin).cross(b - origin)).sum::<f64>()
}

/// Distance of `p` to a segment, to rounding of p − a and b − a.
#[must_use]
pub fn distance(segment @ [a, b]: Segment, p: Vec2) -> f64 {
    ((p - a) - (b - a) * closest_part(segment, p)).length()
}

/// The point of a segment that is closest to `p`.
#[must_use]
pub fn closest_point(segment @ [a, b]: Segment, p: Vec2) -> Vec2 {
    a + (b - a) * closest_part(segment, p)
}

/// The part of its length, from 0 to 1, at which a segment is closest to `p`.
fn closest_part([a, b]: Segment, p: Vec2) -> f64 {
    let (d, q) = (b - a, p - a);
    let square = d.dot(d);
    if square > 0.0 { (q.dot(d) / square).clamp(0.0, 1.0) } else { 0.0 }
}

/// Distance of `p` to a polyline; ∞ if it has fewer than two points.
#[must_use]
pub fn polyline_distance(points: &[Vec2], p: Vec2) -> f64 {
    points.windows(2).map(|s| distance([s[0], s[1]], p)).fold(f64::INFINITY, f64::min)
}

/// Distance of two segments from each other, zero if they cross.
#[must_use]
pub fn gap(s: Segment, t: Segment) -> f64 {
    // of segments on one line rounding may find either on both sides of the other
    if splits(s, t) && splits(t, s) && bounds(s).overlaps(&bounds(t)) {
        return 0.0;
    }
    let ends = [(s[0], t), (s[1], t), (t[0], s), (t[1], s)];
    ends.into_iter().map(|(p, segment)| distance(segment, p)).fold(f64::INFINITY, f64::min)
}

fn bounds([a, b]: Segment) -> Rect {
    Rect::new(a.min(b), a.max(b))
}

/// True if the line of `s` has the ends of `t` on different sides.
fn splits([a, b]: Segment, t: Segment) -> bool {
    let [c, d] = t.map(|p| (b - a).cross(p - a));
    (c < 0.0) != (d < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vec2::vec2;
    use ppum_testkit::random::Random;

    #[test]
    fn beside_beyond_and_of_a_point() {
        let segment = [vec2(1.0, 1.0), vec2(3.0, 1.0)];
        for (p, expected) in
            [([2.0, 3.0], 2.0), ([0.0, 1.0], 1.0), ([6.0, 5.0], 5.0), ([1.0, 1.0], 0.0)]
        {
            assert_eq!(distance(segment, p.into()), expected);
        }
        assert_eq!(distance([vec2(1.0, 1.0); 2], vec2(4.0, 5.0)), 5.0);
        assert_eq!(polyline_distance(&[vec2(0.0, 0.0)], vec2(1.0, 0.0)), f64::INFINITY);
    }

    /// The least distance to points of the segment, whichever way it runs.
    #[test]
    fn it_is_the_least() {
        let mut random = Random(4);
        let mut point = || vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        for _ in 0..200 {
            let (a, b, p) = (point(), point(), point());
            let at = |k: u32| a + (b - a) * (f64::from(k) / 2000.0);
            let least = (0..=2000).map(|k| (at(k) - p).length()).fold(f64::INFINITY, f64::min);
            let found = distance([a, b], p);
            assert!(found <= least + 1e-15 && least - found < 1e-3, "{a:?} {b:?} {p:?}");
            assert!((distance([b, a], p) - found).abs() < 1e-15);
        }
    }

    #[test]
    fn gaps_of_segments() {
        let segment = |a: [f64; 2], b: [f64; 2]| [Vec2::from(a), Vec2::from(b)];
        let s = segment([0.0, 0.0], [2.0, 0.0]);
        for (t, expected) in [
            (segment([1.0, -1.0], [1.0, 1.0]), 0.0),
            (segment([1.0, 0.5], [1.0, 1.0]), 0.5),
            (segment([5.0, 4.0], [6.0, 4.0]), 5.0),
            (segment([3.0, 0.0], [4.0, 0.0]), 1.0),
            (segment([1.0, 0.0], [4.0, 0.0]), 0.0),
            (segment([0.0, 1.0], [2.0, 3.0]), 1.0),
        ] {
            assert_eq!(gap(s, t), expected, "{t:?}");
            assert_eq!(gap(t, s), expected, "{t:?}");
        }
    }

    /// Segments on one oblique line that keep apart.
    #[test]
    fn gaps_on_one_line() {
        let mut random = Random(5);
        for _ in 0..1000 {
            let [from, way] =
                [0.3, 1.0].map(|size| Vec2::from(<[f64; 2]>::from(random.direction())) * size);
            let at = |s: f64| from + way * s;
            let (s, t) = ([at(0.0), at(-1.3)], [at(0.41), at(2.9)]);
            for (s, t) in [(s, t), (t, s)] {
                assert!((gap(s, t) - 0.41).abs() < 1e-14, "{s:?} {t:?}");
            }
        }
    }
}
