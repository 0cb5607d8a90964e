//! Convex polygons: cutting by lines, size, distance.
//!
//! Vertices run counter-clockwise, as offsets from an anchor the caller knows.

use ppum::segment;
use ppum::vec2::{Rect, Vec2, vec2};
use std::cmp::Ordering;

/// Distances below this part of a polygon's diameter are rounding.
const TOUCH: f64 = 1e-14;

/// Rounding of a cross product of two differences, relative to the size of its terms.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Part of a segment beyond its ends at which it may still be met.
const SLACK: f64 = 1e-6;

/// Area of a sliver in squares of its length.
const SLENDER: f64 = 1e-2;

/// Cuts from which on a polygon is halved before.
const MANY: usize = 10;

/// Most halvings of a polygon.
const DEEPEST: usize = 40;

/// A convex polygon.
#[derive(Clone, Debug)]
pub(super) struct ConvexPolygon(pub(super) Vec<Vec2>);

/// A segment that cuts polygons along its line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SegmentCut {
    pub(super) ends: [Vec2; 2],
    /// Whether it also cuts what it meets only beyond this end.
    pub(super) goes_on: [bool; 2],
}

impl SegmentCut {
    pub(super) fn line(ends: [Vec2; 2]) -> Self {
        Self { ends, goes_on: [true; 2] }
    }

    pub(super) fn segment(ends: [Vec2; 2]) -> Self {
        Self { ends, goes_on: [false; 2] }
    }

    /// True if a point of the line is one at which it cuts, up to rounding.
    pub(super) fn passes(&self, p: Vec2) -> bool {
        let along = self.ends[1] - self.ends[0];
        let at = (p - self.ends[0]).dot(along) / along.dot(along);
        (self.goes_on[0] || at > -SLACK) && (self.goes_on[1] || at < 1.0 + SLACK)
    }

    /// The cut seen from an anchor.
    pub(super) fn seen_from(self, anchor: Vec2) -> Self {
        Self { ends: self.ends.map(|p| p - anchor), ..self }
    }
}

/// |b − a| times the signed distance of `p` to the line from `a` to `b`, positive on the left; zero
/// where only rounding tells it from zero.
///
/// Formed as (a − p) × (b − p): the same from whichever cell or piece it is asked, and exact at
/// both ends of the segment.
pub(super) fn line_side(a: Vec2, b: Vec2, p: Vec2) -> f64 {
    let (u, v) = (a - p, b - p);
    let size = (u.x * v.y).abs() + (u.y * v.x).abs();
    let cross = u.cross(v);
    if cross.abs() <= ROUNDING * size { 0.0 } else { cross }
}

impl ConvexPolygon {
    pub(super) fn edges(&self) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
        let next = self.0.iter().cycle().skip(1);
        self.0.iter().zip(next).map(|(&a, &b)| (a, b))
    }

    pub(super) fn area(&self) -> f64 {
        segment::signed_area(&self.0)
    }

    pub(super) fn diameter(&self) -> f64 {
        let [a, b] = self.farthest();
        (b - a).length()
    }

    /// The two vertices that are the farthest apart.
    fn farthest(&self) -> [Vec2; 2] {
        let ends =
            self.0.iter().enumerate().flat_map(|(i, &a)| self.0[..i].iter().map(move |&b| [a, b]));
        let length = |[a, b]: [Vec2; 2]| (b - a).length();
        let longer = |kept, new| if length(new) > length(kept) { new } else { kept };
        ends.fold([self.0[0]; 2], longer)
    }

    /// The smallest box that holds it.
    pub(super) fn bounds(&self) -> Rect {
        let first = Rect::new(self.0[0], self.0[0]);
        self.0.iter().fold(first, |b, v| Rect::new(b.min.min(*v), b.max.max(*v)))
    }

    /// True if `p` lies inside.
    pub(super) fn holds(&self, p: Vec2) -> bool {
        self.edges().all(|(a, b)| a == b || (a - p).cross(b - p) > 0.0)
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

    /// The polygon through a linear map that keeps its sense of rotation.
    pub(super) fn mapped(&self, map: &dyn Fn(Vec2) -> Vec2) -> Self {
        Self(self.0.iter().map(|&v| map(v)).collect())
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

    /// True if a cut has a part of positive length in the polygon.
    fn is_met(&self, cut: &SegmentCut) -> bool {
        let ([a, b], [before, behind]) = (cut.ends, cut.goes_on);
        let mut from = if before { f64::NEG_INFINITY } else { 0.0 };
        let mut to = if behind { f64::INFINITY } else { 1.0 };
        for (v, w) in self.edges() {
            let (s, t) = (line_side(v, w, a), line_side(v, w, b));
            match s.total_cmp(&t) {
                Ordering::Less => from = f64::max(from, s / (s - t)),
                Ordering::Greater => to = f64::min(to, s / (s - t)),
                Ordering::Equal if s < 0.0 => return false,
                Ordering::Equal => {}
            }
        }
        from < to
    }

    /// The polygon divided so that no cut runs through the inside of a part, without the parts
    /// smaller than `least`.
    ///
    /// A cut divides the parts that it meets, each along the whole of its line. Where there are
    /// many, the polygon is halved before: of a chain of n segments that lie on one line except for
    /// noise, some n parts are left, none of them much longer than the segments.
    pub(super) fn pieces(self, cuts: &[SegmentCut], least: f64) -> Vec<Self> {
        let mut pieces = Vec::new();
        self.add_pieces(cuts.to_vec(), DEEPEST, &mut pieces);
        pieces.retain(|p| p.area() > least);
        pieces
    }

    fn add_pieces(self, cuts: Vec<SegmentCut>, depth: usize, pieces: &mut Vec<Self>) {
        let met: Vec<SegmentCut> = cuts.into_iter().filter(|cut| self.is_met(cut)).collect();
        if met.len() > MANY
            && depth > 0
            && let Some(halves) = self.halves()
        {
            let counts =
                halves.each_ref().map(|half| met.iter().filter(|c| half.is_met(c)).count());
            if counts.contains(&0) || counts.iter().all(|count| *count < met.len()) {
                return halves
                    .into_iter()
                    .for_each(|h| h.add_pieces(met.clone(), depth - 1, pieces));
            }
        }
        pieces.extend(self.cut_by(&met));
    }

    /// The parts on either side of the middle of its longer side along the axes.
    pub(super) fn halves(&self) -> Option<[Self; 2]> {
        let Rect { min, max } = self.bounds();
        let (middle, size) = ((min + max) * 0.5, max - min);
        let along = if size.x > size.y { vec2(0.0, size.x) } else { vec2(size.y, 0.0) };
        self.cut(middle, middle + along)
    }

    fn cut_by(self, cuts: &[SegmentCut]) -> Vec<Self> {
        let mut pieces = vec![self];
        for cut in cuts {
            let parts = |p: Self| match p.is_met(cut).then(|| p.cut(cut.ends[0], cut.ends[1])) {
                Some(Some(parts)) => Vec::from(parts),
                _ => vec![p],
            };
            pieces = pieces.into_iter().flat_map(parts).collect();
        }
        pieces
    }

    /// Two or more smaller polygons: triangles, or a triangle's halves across its longest edge; of
    /// a sliver the halves of its length, as its triangles would lie beside each other again
    /// and again.
    pub(super) fn parts(&self) -> Vec<Self> {
        if let Some(halves) = self.halves_of_sliver() {
            return halves.into();
        }
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

    fn halves_of_sliver(&self) -> Option<[Self; 2]> {
        let [a, b] = self.farthest();
        let (along, middle) = (b - a, (a + b) * 0.5);
        let is_sliver = self.area() < SLENDER * along.dot(along);
        is_sliver.then(|| self.cut(middle, middle + along.left()))?
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    fn square() -> ConvexPolygon {
        ConvexPolygon(vec![vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(1.0, 1.0), vec2(0.0, 1.0)])
    }

    #[test]
    fn parts_of_a_cut_add_up() {
        let segments = [[vec2(-1.0, 0.3), vec2(2.0, 0.4)], [vec2(0.2, -5.0), vec2(0.7, 3.0)]];
        let pieces = square().pieces(&segments.map(SegmentCut::segment), 0.0);
        assert_eq!(pieces.len(), 4);
        let total: f64 = pieces.iter().map(ConvexPolygon::area).sum();
        assert!((total - 1.0).abs() < 1e-15);
    }

    #[test]
    fn lines_along_edges_and_through_corners_make_no_slivers() {
        let edge = [SegmentCut::line([vec2(-3.0, 1.0), vec2(7.0, 1.0)])];
        assert_eq!(square().pieces(&edge, 0.0).len(), 1);
        let diagonal = [SegmentCut::line([vec2(-0.1, -0.1), vec2(1.3, 1.3)])];
        let pieces = square().pieces(&diagonal, 0.0);
        assert_eq!(pieces.iter().map(|p| p.0.len()).collect::<Vec<_>>(), [3, 3]);
    }

    /// A segment cuts what it meets, its line the rest where it goes on.
    #[test]
    fn segments_cut_what_they_meet() {
        let ends = [vec2(0.2, 0.3), vec2(0.4, 0.3)];
        let wall = SegmentCut::line([vec2(0.5, 0.0), vec2(0.5, 1.0)]);
        for (goes_on, expected) in [([false; 2], 3), ([true, false], 3), ([false, true], 4)] {
            let pieces = square().pieces(&[wall, SegmentCut { ends, goes_on }], 0.0);
            assert_eq!(pieces.len(), expected, "{goes_on:?}");
        }
        let outside =
            SegmentCut { ends: [vec2(-2.0, 0.5), vec2(-1.0, 0.5)], goes_on: [true, false] };
        assert_eq!(square().pieces(&[outside], 0.0).len(), 1);
    }

    /// However far the vertices of a chain lie beside a line, a few parts come to each; they are
    /// the square, and no segment runs through one.
    #[test]
    fn chains_along_a_line_leave_few_parts() {
        let mut random = Random(11);
        for noise in [0.0, 1e-16, 1e-14, 1e-12, 1e-8, 1e-4, 1e-2] {
            let n = 64;
            let mut vertex = |k: usize| {
                let s = -0.1 + 1.2 * k as f64 / n as f64;
                vec2(s, 0.2 + 0.4 * s + noise * random.between(-1.0, 1.0))
            };
            let points: Vec<Vec2> = (0..=n).map(&mut vertex).collect();
            let cuts: Vec<SegmentCut> =
                points.windows(2).map(|s| SegmentCut::segment([s[0], s[1]])).collect();
            let pieces = square().pieces(&cuts, 0.0);
            let area: f64 = pieces.iter().map(ConvexPolygon::area).sum();
            assert!(
                (area - 1.0).abs() < 1e-14 && pieces.len() < 6 * n,
                "{noise}: {}",
                pieces.len()
            );
            for (cut, piece) in cuts.iter().flat_map(|c| pieces.iter().map(move |p| (c, p))) {
                let deep = |t: f64| {
                    let p = cut.ends[0] + (cut.ends[1] - cut.ends[0]) * t;
                    piece.edges().all(|(v, w)| (v - p).cross(w - p) > 1e-15)
                };
                assert!(![0.1, 0.5, 0.9].into_iter().any(deep), "{noise}: {cut:?} {piece:?}");
            }
        }
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
        let sliver = ConvexPolygon(vec![vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(1.0, 1e-13)]);
        assert!(sliver.touches(vec2(0.0, 0.0)) && sliver.touches(vec2(0.5, 1e-15)));
        assert!(!sliver.touches(vec2(-0.01, 0.0)));
    }
}
