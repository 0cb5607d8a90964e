//! A static search tree over axis-parallel boxes: which of them contain a point or meet a box?
//!
//! A packed R-tree over the boxes in the order of a Hilbert curve, of the crate `static_aabb2d_index`. It
//! serves patches of any cover, graded or not, without looking at the quadtree that made it. The tree finds
//! closed boxes that touch; which borders count is decided here.

use static_aabb2d_index::{StaticAABB2DIndex, StaticAABB2DIndexBuilder};

use crate::vec2::{Rect, Vec2};

/// Boxes that are found by their places.
///
/// Built in O(N log N); a query costs O(log N + k) for k boxes found when the boxes overlap a bounded
/// number of others, as the patches of a cover do.
#[derive(Clone, Debug)]
pub struct BoxTree {
    boxes: Vec<Rect>,
    tree: StaticAABB2DIndex<f64>,
}

impl BoxTree {
    /// The tree over `boxes`, which keep their indices. Boxes that are empty or undefined are found nowhere.
    ///
    /// # Panics
    /// If there are more than `u32::MAX` boxes.
    #[must_use]
    pub fn new(boxes: &[Rect]) -> Self {
        assert!(u32::try_from(boxes.len()).is_ok(), "at most 2^32 - 1 boxes");
        let mut builder = StaticAABB2DIndexBuilder::new(boxes.len());
        for b in boxes {
            // the library asks for boxes with min ≤ max
            let Rect { min, max } =
                if is_a_box(b) { *b } else { Rect::new(Vec2::ZERO, Vec2::ZERO) };
            builder.add(min.x, min.y, max.x, max.y);
        }
        let tree = builder.build().expect("as many boxes as were announced");
        Self { boxes: boxes.to_vec(), tree }
    }

    /// Appends, in ascending order, the indices of the boxes that contain `p`; a box is taken closed
    /// on the left and below, open on the right and above.
    pub fn query_point(&self, p: Vec2, out: &mut Vec<u32>) {
        let holds = |b: &Rect| p.x >= b.min.x && p.x < b.max.x && p.y >= b.min.y && p.y < b.max.y;
        self.collect(&Rect::new(p, p), holds, out);
    }

    /// Appends, in ascending order, the indices of the boxes that [overlap](Rect::overlaps) `query`:
    /// touching along a border is not enough.
    pub fn query_box(&self, query: &Rect, out: &mut Vec<u32>) {
        self.collect(query, |b| b.overlaps(query), out);
    }

    /// Appends those of the boxes touching `query` that pass a `test`.
    fn collect(&self, query: &Rect, test: impl Fn(&Rect) -> bool, out: &mut Vec<u32>) {
        let start = out.len();
        let Rect { min, max } = *query;
        self.tree.visit_query(min.x, min.y, max.x, max.y, &mut |index: usize| {
            if is_a_box(&self.boxes[index]) && test(&self.boxes[index]) {
                out.push(index as u32);
            }
        });
        out[start..].sort_unstable();
    }
}

/// False for boxes with their borders in the wrong order, or undefined.
fn is_a_box(b: &Rect) -> bool {
    b.min.x <= b.max.x && b.min.y <= b.max.y
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Problems that are wrong have holes of negative radii; their boxes harm nobody.
    #[test]
    fn empty_and_undefined_boxes_are_found_nowhere() {
        let [unit, nan] = [vec2(1.0, 1.0), vec2(f64::NAN, 0.0)];
        let all = Rect::new(vec2(-1.0, -1.0), unit);
        let tree = BoxTree::new(&[Rect::new(unit, -unit), all, Rect::new(nan, nan)]);
        let mut found = Vec::new();
        tree.query_box(&Rect::new(vec2(-3.0, -3.0), vec2(3.0, 3.0)), &mut found);
        tree.query_point(Vec2::ZERO, &mut found);
        assert_eq!(found, [1, 1]);
    }
    use crate::vec2::vec2;
    use ppum_testkit::random::Random;

    /// Boxes of very different sizes; every fourth is on a coarse lattice so that borders coincide.
    fn random_boxes(n: usize, random: &mut Random) -> Vec<Rect> {
        let lattice = |v: Vec2| vec2((v.x * 8.0).floor() / 8.0, (v.y * 8.0).floor() / 8.0);
        (0..n)
            .map(|k| {
                let (p, size) =
                    (vec2(random.unit(), random.unit()), vec2(random.unit(), random.unit()));
                match k % 4 {
                    0 => Rect::new(lattice(p), lattice(p) + vec2(0.125, 0.25)),
                    1 => Rect::around(p, size * 0.3),
                    _ => Rect::around(p, size * 1e-3),
                }
            })
            .collect()
    }

    fn containing(boxes: &[Rect], p: Vec2) -> Vec<u32> {
        let holds = |b: &Rect| b.min.x <= p.x && p.x < b.max.x && b.min.y <= p.y && p.y < b.max.y;
        (0u32..).zip(boxes).filter(|(_, b)| holds(b)).map(|(i, _)| i).collect()
    }

    fn overlapping(boxes: &[Rect], q: &Rect) -> Vec<u32> {
        (0u32..).zip(boxes).filter(|(_, b)| b.overlaps(q)).map(|(i, _)| i).collect()
    }

    #[test]
    fn agrees_with_testing_every_box() {
        let mut random = Random(1);
        for n in [1, 2, 3, 4, 5, 8, 17, 100, 1000] {
            let boxes = random_boxes(n, &mut random);
            let tree = BoxTree::new(&boxes);
            for _ in 0..200 {
                let mut found = Vec::new();
                let p = vec2(random.unit(), random.unit());
                tree.query_point(p, &mut found);
                assert_eq!(found, containing(&boxes, p));
                let q = Rect::around(p, vec2(random.unit(), random.unit()) * 0.1);
                found.clear();
                tree.query_box(&q, &mut found);
                assert_eq!(found, overlapping(&boxes, &q));
            }
        }
    }

    /// Whatever the unit, and boxes that shrink towards a point until they are a 10⁻¹⁵th of all.
    #[test]
    fn sizes_do_not_matter() {
        for unit in [1e-280, 1.0, 1e280] {
            let at = |k: i32| 0.5f64.powi(k) * unit;
            let shrinking = (0..50).map(|k| Rect::new(vec2(0.0, 0.0), vec2(at(k), at(k))));
            let boxes: Vec<_> = shrinking.collect();
            let tree = BoxTree::new(&boxes);
            for k in 0..50 {
                let (p, mut found) = (vec2(at(k) * 0.75, 0.0), Vec::new());
                tree.query_point(p, &mut found);
                assert_eq!(found, containing(&boxes, p));
                assert_eq!(found.len() as i32, k + 1);
            }
        }
        let mut found = Vec::new();
        BoxTree::new(&[]).query_point(vec2(0.0, 0.0), &mut found);
        assert_eq!(found, []);
    }

    #[test]
    fn corners_of_boxes_are_ties_to_the_right_and_upper_box() {
        let mut random = Random(2);
        let boxes = random_boxes(300, &mut random);
        let tree = BoxTree::new(&boxes);
        for b in &boxes {
            for p in [b.min, b.max, vec2(b.min.x, b.max.y), vec2(b.max.x, b.min.y)] {
                let mut found = Vec::new();
                tree.query_point(p, &mut found);
                assert_eq!(found, containing(&boxes, p));
            }
        }
        let halves =
            [Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0)), Rect::new(vec2(1.0, 0.0), vec2(2.0, 1.0))];
        let mut found = Vec::new();
        BoxTree::new(&halves).query_point(vec2(1.0, 0.0), &mut found);
        assert_eq!(found, [1]);
        found.clear();
        BoxTree::new(&halves).query_box(&halves[0], &mut found);
        assert_eq!(found, [0]);
    }

    #[test]
    fn nothing_duplicates_and_appending() {
        let mut found = vec![7];
        BoxTree::new(&[]).query_point(Vec2::ZERO, &mut found);
        BoxTree::new(&[]).query_box(&Rect::around(Vec2::ZERO, vec2(1.0, 1.0)), &mut found);
        assert_eq!(found, [7]);
        let same = [Rect::around(vec2(0.5, 0.5), vec2(0.1, 0.1)); 50];
        BoxTree::new(&same).query_point(vec2(0.5, 0.5), &mut found);
        assert_eq!(found[0], 7);
        assert!(found[1..].iter().copied().eq(0..50));
        // Boxes without extent contain no point, and do not hide others.
        let mixed = [Rect::around(vec2(0.5, 0.5), Vec2::ZERO), same[0]];
        found.clear();
        BoxTree::new(&mixed).query_point(vec2(0.5, 0.5), &mut found);
        assert_eq!(found, [1]);
    }

    #[test]
    fn a_million_patches_and_a_graded_set() {
        // Cells (i, j) of a 1024² lattice, stretched by 1.3: 1, 2 or 4 cover a point.
        let n = 1024u32;
        let centre = |k: u32| vec2(f64::from(k % n) + 0.5, f64::from(k / n) + 0.5);
        let boxes: Vec<_> = (0..n * n).map(|k| Rect::around(centre(k), vec2(0.65, 0.65))).collect();
        let tree = BoxTree::new(&boxes);
        let mut found = Vec::new();
        tree.query_point(vec2(500.5, 300.5), &mut found);
        assert_eq!(found, [300 * n + 500]);
        found.clear();
        tree.query_point(vec2(500.1, 300.0), &mut found);
        assert_eq!(found, [299 * n + 499, 299 * n + 500, 300 * n + 499, 300 * n + 500]);
        // Boxes halving towards a point: far below the resolution of the Morton codes.
        let nested: Vec<_> = (0..300)
            .map(|k| 0.5f64.powi(k))
            .map(|h| Rect::new(vec2(h, 0.0), vec2(2.0 * h, h)))
            .collect();
        let tree = BoxTree::new(&nested);
        for (k, b) in (0u32..).zip(&nested) {
            found.clear();
            tree.query_point(b.center(), &mut found);
            assert_eq!(found, [k]);
        }
    }
}
