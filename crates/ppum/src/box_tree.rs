//! A static search tree over axis-parallel boxes: which of them contain a point or meet a box?
//!
//! Boxes that follow each other are a group, groups that follow each other a group of the next
//! level; of each its bounds are kept, and nothing else. Patches come in Morton order, so their
//! groups are compact as they are; boxes that come in another order are sorted into it. The tree
//! serves patches of any cover, graded or not, without looking at the quadtree that made it.

use std::ops::Range;

use crate::morton::morton;
use crate::vec2::{Rect, Vec2};

/// Boxes of a group: a query tests some more than with 4, and passes half as many levels.
const GROUP: usize = 8;

/// Boxes that are found by their places.
///
/// Built in O(N), or O(N log N) if the boxes have to be sorted; a query costs O(log N + k) for k
/// boxes found when the boxes overlap a bounded number of others, as the patches of a cover do. A
/// query takes no memory except for its results.
#[derive(Clone, Debug)]
pub struct BoxTree {
    /// The boxes, then the bounds of their groups, then those of the groups of these, and so on.
    levels: Vec<Vec<Rect>>,
    /// The index of each box, if they had to be sorted.
    order: Option<Vec<u32>>,
}

impl BoxTree {
    /// The tree over `boxes`, which keep their indices. Boxes that are empty or undefined are found
    /// nowhere.
    ///
    /// # Panics
    /// If there are more than `u32::MAX` boxes.
    #[must_use]
    pub fn new(boxes: &[Rect]) -> Self {
        Self::from(boxes.to_vec())
    }

    /// Appends, in ascending order, the indices of the boxes that contain `p`; a box is taken
    /// closed on the left and below, open on the right and above.
    pub fn query_point(&self, p: Vec2, out: &mut Vec<u32>) {
        let holds =
            |b: &Rect| (p.x >= b.min.x) & (p.x < b.max.x) & (p.y >= b.min.y) & (p.y < b.max.y);
        self.collect(holds, out);
    }

    /// Appends, in ascending order, the indices of the boxes that [overlap](Rect::overlaps)
    /// `query`: touching along a boundary is not enough.
    pub fn query_box(&self, query: &Rect, out: &mut Vec<u32>) {
        let Rect { min, max } = *query;
        let overlaps = |b: &Rect| {
            (b.min.x < max.x) & (b.max.x > min.x) & (b.min.y < max.y) & (b.max.y > min.y)
        };
        self.collect(overlaps, out);
    }

    /// Appends the boxes that pass a test, which the bounds of a group pass if a box in it does.
    fn collect(&self, test: impl Fn(&Rect) -> bool, out: &mut Vec<u32>) {
        let start = out.len();
        let top = self.levels.len() - 1;
        self.descend(top, 0..self.levels[top].len(), &test, out);
        if let Some(order) = &self.order {
            out[start..].iter_mut().for_each(|place| *place = order[*place as usize]);
            out[start..].sort_unstable();
        }
    }

    /// Appends the places of boxes below some nodes, at most a group of them.
    fn descend(
        &self,
        level: usize,
        nodes: Range<usize>,
        test: &impl Fn(&Rect) -> bool,
        out: &mut Vec<u32>,
    ) {
        let first = nodes.start;
        // all are tested before one is entered: tests without branches are done side by side
        let mut hits = 0u32;
        for (k, bounds) in self.levels[level][nodes].iter().enumerate() {
            hits |= u32::from(test(bounds)) << k;
        }
        while hits != 0 {
            let node = first + hits.trailing_zeros() as usize;
            hits &= hits - 1;
            if level == 0 {
                out.push(node as u32);
            } else {
                let end = self.levels[level - 1].len().min((node + 1) * GROUP);
                self.descend(level - 1, node * GROUP..end, test, out);
            }
        }
    }
}

impl From<Vec<Rect>> for BoxTree {
    /// As [`BoxTree::new`], without a copy.
    fn from(mut boxes: Vec<Rect>) -> Self {
        assert!(u32::try_from(boxes.len()).is_ok(), "at most 2^32 - 1 boxes");
        for b in &mut boxes {
            if !is_a_box(b) {
                *b = Rect::EMPTY;
            }
        }
        let levels = levels(boxes);
        if is_compact(&levels) {
            return Self { levels, order: None };
        }
        let order = morton_order(&levels);
        let sorted = order.iter().map(|&k| levels[0][k as usize]).collect();
        Self { levels: self::levels(sorted), order: Some(order) }
    }
}

/// False for boxes with bounds in the wrong order, or undefined.
fn is_a_box(b: &Rect) -> bool {
    b.min.x <= b.max.x && b.min.y <= b.max.y
}

/// The boxes and their groups, up to a level of one group.
fn levels(boxes: Vec<Rect>) -> Vec<Vec<Rect>> {
    let mut levels = vec![boxes];
    while levels[levels.len() - 1].len() > GROUP {
        let below = &levels[levels.len() - 1];
        levels.push(below.chunks(GROUP).map(bounds).collect());
    }
    levels
}

/// The box around some.
fn bounds(boxes: &[Rect]) -> Rect {
    boxes.iter().fold(Rect::EMPTY, |all, b| all.union(b))
}

/// True if the perimeters of all groups together are no longer than those of the boxes. Those of n
/// cells in Morton order are some n · (8^−½ + 8^−1 + …), half as long; groups of far boxes have
/// longer ones.
fn is_compact(levels: &[Vec<Rect>]) -> bool {
    let border = |b: &Rect| if is_a_box(b) { b.max.x - b.min.x + (b.max.y - b.min.y) } else { 0.0 };
    let borders = |level: &Vec<Rect>| level.iter().map(border).sum::<f64>();
    levels[1..].iter().map(borders).sum::<f64>() <= borders(&levels[0])
}

/// The boxes in the Morton order of their centres.
fn morton_order(levels: &[Vec<Rect>]) -> Vec<u32> {
    let all = bounds(&levels[levels.len() - 1]);
    // saturates; undefined centres come first
    let digits = |x: f64, lo: f64, hi: f64| (f64::from(u32::MAX) * ((x - lo) / (hi - lo))) as u32;
    let code = |b: &Rect| {
        let center = b.center();
        morton(digits(center.x, all.min.x, all.max.x), digits(center.y, all.min.y, all.max.y))
    };
    let mut order: Vec<_> = levels[0].iter().map(code).zip(0u32..).collect();
    order.sort_unstable();
    order.into_iter().map(|(_, index)| index).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vec2::vec2;
    use ppum_testkit::random::Random;

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

    /// Boxes of very different sizes; every fourth is on a coarse lattice so that boundaries
    /// coincide.
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
        for n in [1, 2, 3, 4, 5, 7, 8, 9, 17, 63, 64, 65, 100, 512, 513, 1000] {
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

    /// Cells in Morton order are left as they are, and are found in any other order too.
    #[test]
    fn order_is_made_where_it_is_missing() {
        let cell = |code: u32| {
            let bit = |k: u32| (code >> k) & 1;
            let number = |first: u32| (0..5).map(|k| bit(first + 2 * k) << k).sum::<u32>();
            Rect::around(vec2(f64::from(number(0)), f64::from(number(1))), vec2(0.65, 0.65))
        };
        let mut boxes: Vec<_> = (0..1024).map(cell).collect();
        assert!(BoxTree::new(&boxes).order.is_none());
        let mut random = Random(3);
        for k in (1..boxes.len()).rev() {
            boxes.swap(k, random.below(k + 1));
        }
        let tree = BoxTree::new(&boxes);
        assert!(tree.order.is_some() && is_compact(&tree.levels));
        for _ in 0..100 {
            let (p, mut found) = (vec2(random.unit(), random.unit()) * 31.0, Vec::new());
            tree.query_point(p, &mut found);
            assert_eq!(found, containing(&boxes, p));
        }
    }
}
