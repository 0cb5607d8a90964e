//! Convex polygons: cutting by lines, size, distance.
//!
//! Vertices run counter-clockwise, as offsets from an anchor the caller knows.

use ppum::segment;
use ppum::vec2::Vec2;

/// Distances below this part of a polygon's diameter are rounding.
const TOUCH: f64 = 1e-14;

/// Rounding of a cross product of two differences, relative to the size of its terms.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// A convex polygon.
#[derive(Clone, Debug)]
pub(super) struct Polygon(pub(super) Vec<Vec2>);

/// |b − a| times the signed distance of `p` to the line from `a` to `b`, positive on the left; zero
/// where only rounding tells it from zero.
///
/// Formed as (a − p) × (b − p): the same from whichever cell or piece it is asked, and exact at both
/// ends of the segment.
pub(super) fn line_side(a: Vec2, b: Vec2, p: Vec2) -> f64 {
    let (u, v) = (a - p, b - p);
    let size = (u.x * v.y).abs() + (u.y * v.x).abs();
    let cross = u.cross(v);
    if cross.abs() <= ROUNDING * size { 0.0 } else { cross }
}

impl Polygon {
    pub(super) fn edges(&self) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
        let next = self.0.iter().cycle().skip(1);
        self.0.iter().zip(next).map(|(&a, &b)| (a, b))
    }

    pub(super) fn area(&self) -> f64 {
        let origin = self.0[0];
        0.5 * self.edges().map(|(a, b)| (a - origin).cross(b - origin)).sum::<f64>()
    }

    pub(super) fn diameter(&self) -> f64 {
        let ends =
            self.0.iter().enumerate().flat_map(|(i, &a)| self.0[..i].iter().map(move |&b| a - b));
        ends.map(Vec2::length).fold(0.0, f64::max)
    }

    /// True if `p` lies in the closed polygon, up to rounding.
    pub(super) fn touches(&self, p: Vec2) -> bool {
        self.distance(p) <= TOUCH * self.diameter()
    }

    /// Distance of `p` to the polygon, zero inside.
    pub(super) fn distance(&self, p: Vec2) -> f64 {
        if self.edges().all(|(a, b)| (a - p).cross(b - p) >= 0.0) {
            return 0.0;
        }
        self.edges().map(|(a, b)| segment::distance([a, b], p)).fold(f64::INFINITY, f64::min)
    }

    /// The polygon seen from an anchor moved by `shift`.
    pub(super) fn seen_from(&self, shift: Vec2) -> Self {
        Self(self.0.iter().map(|&v| v - shift).collect())
    }

    /// The parts on the left and on the right of the line through `a` and `b`; `None` if the line
    /// leaves the polygon whole.
    pub(super) fn cut(&self, a: Vec2, b: Vec2) -> Option<[Self; 2]> {
        let side: Vec<f64> = self.0.iter().map(|&v| line_side(a, b, v)).collect();
        if side.iter().all(|&s| s >= 0.0) || side.iter().all(|&s| s <= 0.0) {
            return None;
        }
        let (mut left, mut right) = (Vec::new(), Vec::new());
        for (i, (v, w)) in self.edges().enumerate() {
            let (s, t) = (side[i], side[(i + 1) % side.len()]);
            if s >= 0.0 {
                left.push(v);
            }
            if s <= 0.0 {
                right.push(v);
            }
            if (s > 0.0 && t < 0.0) || (s < 0.0 && t > 0.0) {
                let crossing = v + (w - v) * (s / (s - t));
                left.push(crossing);
                right.push(crossing);
            }
        }
        Some([Self(left), Self(right)])
    }

    /// The polygon cut by the lines of several segments, without the parts smaller than `least`.
    pub(super) fn pieces(self, segments: &[[Vec2; 2]], least: f64) -> Vec<Self> {
        let mut pieces = vec![self];
        for &[a, b] in segments {
            pieces = pieces
                .into_iter()
                .flat_map(|p| p.cut(a, b).map_or_else(|| vec![p], Vec::from))
                .collect();
        }
        pieces.retain(|p| p.area() > least);
        pieces
    }

    /// Two or more smaller polygons: triangles, or a triangle's halves across its longest edge.
    pub(super) fn parts(&self) -> Vec<Self> {
        let v = &self.0;
        if v.len() > 3 {
            return (2..v.len()).map(|k| Self(vec![v[0], v[k - 1], v[k]])).collect();
        }
        let length = |k: usize| (v[(k + 1) % 3] - v[k]).length();
        let k = (1..3).fold(0, |best, k| if length(k) > length(best) { k } else { best });
        let (a, b, c) = (v[k], v[(k + 1) % 3], v[(k + 2) % 3]);
        let mid = (a + b) * 0.5;
        vec![Self(vec![a, mid, c]), Self(vec![mid, b, c])]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::vec2;

    fn square() -> Polygon {
        Polygon(vec![vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(1.0, 1.0), vec2(0.0, 1.0)])
    }

    #[test]
    fn parts_of_a_cut_add_up() {
        let segments = [[vec2(-1.0, 0.3), vec2(2.0, 0.4)], [vec2(0.2, -5.0), vec2(0.7, 3.0)]];
        let pieces = square().pieces(&segments, 0.0);
        assert_eq!(pieces.len(), 4);
        let total: f64 = pieces.iter().map(Polygon::area).sum();
        assert!((total - 1.0).abs() < 1e-15);
    }

    #[test]
    fn lines_along_edges_and_through_corners_make_no_slivers() {
        let edge = [[vec2(-3.0, 1.0), vec2(7.0, 1.0)]];
        assert_eq!(square().pieces(&edge, 0.0).len(), 1);
        let diagonal = [[vec2(-0.1, -0.1), vec2(1.3, 1.3)]];
        let pieces = square().pieces(&diagonal, 0.0);
        assert_eq!(pieces.iter().map(|p| p.0.len()).collect::<Vec<_>>(), [3, 3]);
    }

    #[test]
    fn distance_is_zero_inside_and_euclidean_outside() {
        assert_eq!(square().distance(vec2(1.0, 0.5)), 0.0);
        assert_eq!(square().distance(vec2(4.0, 5.0)), 5.0);
        assert!(!square().touches(vec2(1.0 + 1e-12, 0.5)));
    }

    /// Beyond the sharp end of a sliver all sides are as near as rounding.
    #[test]
    fn a_sliver_does_not_touch_what_lies_beyond_its_end() {
        let sliver = Polygon(vec![vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(1.0, 1e-13)]);
        assert!(sliver.touches(vec2(0.0, 0.0)) && sliver.touches(vec2(0.5, 1e-15)));
        assert!(!sliver.touches(vec2(-0.01, 0.0)));
    }
}
