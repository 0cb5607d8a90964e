//! Points on a crack: on which segment.
//!
//! The decimal digits of a point on an oblique crack are rarely f64 numbers that lie on it. A point
//! within rounding of a crack therefore counts as on it, and is evaluated on its segment
//! ([`Field::on`](crate::field::Field::on)), on the side that is asked for. Points given with an
//! offset mean exactly what they say, and are on a crack only up to the rounding of the offset.
//!
//! ```
//! use ppum::crack::{Crack, CrackEnd, SegmentId};
//! use ppum::sides::Segments;
//! use ppum::vec2::{Vec2, vec2};
//!
//! let points = vec![vec2(-1.0, -0.3), vec2(1.0, 0.4)];
//! let cracks = [Crack::polyline(points, [CrackEnd::Tip; 2])];
//! let segments = Segments::new(&cracks);
//! assert_eq!(segments.at(vec2(0.3, 0.155), Vec2::ZERO), Some(SegmentId { crack: 0, segment: 0 }));
//! assert_eq!(segments.at(vec2(0.3, 0.155), vec2(0.0, 1e-30)), None);
//! ```

use crate::box_tree::BoxTree;
use crate::crack::{Crack, CrackEnd, LocalSegment, SegmentId};
use crate::edge::Edge;
use crate::vec2::{Rect, Vec2, vec2};

/// Rounding of a point's coordinates and of its distance from a line, in parts of their size.
pub(crate) const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The segments of cracks in a search tree, to be asked which of them a point lies on.
#[derive(Clone, Debug)]
pub struct Segments<'c> {
    cracks: &'c [Crack],
    /// All segments in their order.
    all: Vec<SegmentId>,
    tree: BoxTree,
    /// Largest coordinate.
    size: f64,
}

impl<'c> Segments<'c> {
    /// The segments of the cracks of a step, each of two points or more; O(n log n) for n segments.
    #[must_use]
    pub fn new(cracks: &'c [Crack]) -> Self {
        let (mut all, mut boxes, mut size) = (Vec::new(), Vec::new(), 0.0f64);
        for (index, crack) in (0..).zip(cracks) {
            for (segment, edge) in (0..).zip(crack.edges()) {
                let Rect { min, max } = edge.bounds();
                all.push(SegmentId { crack: index, segment });
                boxes.push(Rect::new(min, max));
                size = size.max(min.max_norm()).max(max.max_norm());
            }
        }
        Self { cracks, all, tree: BoxTree::new(&boxes), size }
    }

    /// The segment that `anchor + offset` lies on, if it lies on a crack; of several the first.
    /// Tips do not count: there is nothing to part. O(log n).
    #[must_use]
    pub fn at(&self, anchor: Vec2, offset: Vec2) -> Option<SegmentId> {
        let point = anchor + offset;
        let size = self.size.max(anchor.max_norm()).max(point.max_norm());
        // more than the rounding that counts as on a segment
        let reach = (8.0 * ROUNDING * size).max(f64::MIN_POSITIVE);
        let mut near = Vec::new();
        self.tree.query_box(&Rect::around(point, vec2(reach, reach)), &mut near);
        let touched = |id: &SegmentId| {
            touches_segment(&self.cracks[id.crack as usize], id.segment, anchor, offset)
        };
        near.into_iter().map(|index| self.all[index as usize]).find(touched)
    }
}

/// True if `anchor + offset` lies on a segment of a crack, and not at a tip.
fn touches_segment(crack: &Crack, segment: u32, anchor: Vec2, offset: Vec2) -> bool {
    let (k, last) = (segment as usize, crack.points.len() - 2);
    let is_tip =
        [k == 0 && crack.ends[0] == CrackEnd::Tip, k == last && crack.ends[1] == CrackEnd::Tip];
    let edge = crack.edge(k);
    if edge.is_arc() {
        touches_arc(edge, is_tip, anchor, offset)
    } else {
        touches([edge.from, edge.to], is_tip, anchor, offset)
    }
}

/// True if `anchor + offset` lies on an arc, up to rounding.
fn touches_arc(arc: Edge, is_tip: [bool; 2], anchor: Vec2, offset: Vec2) -> bool {
    let size = [anchor, arc.from, arc.to].iter().fold(0.0, |size: f64, p| size.max(p.max_norm()));
    let rounding = ROUNDING * if offset == Vec2::ZERO { size } else { offset.max_norm() };
    let is_beyond = |(end, is_tip): (Vec2, bool), is_closest: bool| {
        let is_at = ((anchor - end) + offset).length() <= rounding;
        if is_tip { is_at || is_closest } else { is_closest && !is_at }
    };
    let part = arc.closest_part(anchor + offset);
    let distance = LocalSegment::new(arc, anchor).curved_distance_of([offset.x, offset.y]);
    distance.abs() <= rounding
        && !is_beyond((arc.from, is_tip[0]), part == 0.0)
        && !is_beyond((arc.to, is_tip[1]), part == 1.0)
}

/// True if `anchor + offset` lies on a segment, up to rounding.
fn touches([a, b]: [Vec2; 2], is_tip: [bool; 2], anchor: Vec2, offset: Vec2) -> bool {
    let size = anchor.max_norm().max(a.max_norm()).max(b.max_norm());
    let rounding = ROUNDING * if offset == Vec2::ZERO { size } else { offset.max_norm() };
    let near = if (anchor - a).length() < (anchor - b).length() { a } else { b };
    let tangent = (b - a).unit();
    let from_near = (anchor - near) + offset;
    // The remainder of the segment before and behind the point.
    let inner = tangent.dot(from_near);
    let length = (b - a).length();
    let rest = if near == a { [inner, length - inner] } else { [length + inner, -inner] };
    let ends_beyond = rest
        .into_iter()
        .zip(is_tip)
        .any(|(rest, is_tip)| if is_tip { rest <= rounding } else { rest < -rounding });
    tangent.cross(from_near).abs() <= rounding && !ends_beyond
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crack(points: &[(f64, f64)], ends: [CrackEnd; 2]) -> Crack {
        Crack::polyline(points.iter().map(|&(x, y)| vec2(x, y)).collect(), ends)
    }

    /// The segment that is found, and that asking all segments in their order finds the same.
    fn segment_at(cracks: &[Crack], anchor: Vec2, offset: Vec2) -> Option<SegmentId> {
        let by_all = (0..).zip(cracks).find_map(|(index, crack)| {
            let mut segments = 0..crack.points.len() as u32 - 1;
            let segment = segments.find(|&k| touches_segment(crack, k, anchor, offset))?;
            Some(SegmentId { crack: index, segment })
        });
        assert_eq!(Segments::new(cracks).at(anchor, offset), by_all, "{anchor:?} {offset:?}");
        by_all
    }

    /// Points a + t (b − a), rounded, of many oblique segments.
    #[test]
    fn rounded_points_on_oblique_cracks() {
        for k in 0..500 {
            let (sin, cos) = (0.1 + 0.7 * f64::from(k)).sin_cos();
            let (a, b) = (vec2(0.3 * cos, 0.3 * sin), vec2(-0.5 * sin - 0.9 * cos, 0.2 * cos));
            let crack = crack(&[(a.x, a.y), (b.x, b.y)], [CrackEnd::Tip; 2]);
            let point = a + (b - a) * (0.01 + 0.98 * f64::from(k) / 500.0);
            let on = Some(SegmentId { crack: 0, segment: 0 });
            assert_eq!(segment_at(&[crack], point, Vec2::ZERO), on, "{point:?}");
        }
    }

    #[test]
    fn tips_do_not_count_and_mouths_and_kinks_do() {
        let bent = [crack(&[(0.0, 0.1), (0.3, 0.1), (0.5, 0.7)], [CrackEnd::Mouth, CrackEnd::Tip])];
        let at = |x, y| segment_at(&bent, vec2(x, y), Vec2::ZERO);
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
        let at = |dx, dy| segment_at(&straight, vec2(0.5, 0.3), vec2(dx, dy));
        assert!(at(-1e-30, 0.0).is_some());
        assert_eq!(at(1e-30, 0.0), None);
        assert_eq!(at(-1e-30, 1e-40), None);
    }

    /// Rounded points of arcs lie on them, at tips and beside them by 10⁻¹² not; with an offset
    /// only what is meant does.
    #[test]
    fn rounded_points_on_arcs() {
        let mut random = ppum_testkit::random::Random(92);
        for _ in 0..300 {
            let mut end = || vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
            let (from, to) = (end(), end());
            let bulge = random.between(-2.0, 2.0);
            let (arc, ends) = (Edge { from, to, bulge }, [CrackEnd::Mouth, CrackEnd::Tip]);
            let crack = [Crack { points: vec![from, to], bulges: vec![bulge], ends }];
            let on = Some(SegmentId { crack: 0, segment: 0 });
            for part in [0.0, 0.1, 0.5, 0.9, 1.0] {
                let (point, out) = (arc.at(part), arc.tangent(part).left());
                let expected = if part < 1.0 { on } else { None };
                assert_eq!(segment_at(&crack, point, Vec2::ZERO), expected, "{arc:?} {part}");
                assert_eq!(segment_at(&crack, point + out * 1e-12, Vec2::ZERO), None, "{arc:?}");
                // where rounding has put the point
                let offset = out * -arc.side(point);
                let beside = segment_at(&crack, point, offset + out * 1e-15);
                assert_eq!(beside, None, "{arc:?} {part}");
            }
        }
    }
}
