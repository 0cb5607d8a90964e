//! Things found by their places, so that work on a cell or patch sees what is near it and no more.

use ppum::box_tree::BoxTree;
use ppum::vec2::{Rect, Vec2, vec2};

/// Margin of boxes, in parts of what all take up: those that only touch are found as well.
const MARGIN: f64 = 1e-12;

/// Things in boxes.
#[derive(Debug)]
pub struct BoxList<T> {
    tree: BoxTree,
    all: Vec<T>,
}

impl<T> BoxList<T> {
    /// Things with the closed boxes that hold them.
    pub fn new(things: impl IntoIterator<Item = (Rect, T)>) -> Self {
        let (boxes, all): (Vec<Rect>, Vec<T>) = things.into_iter().unzip();
        let largest = |p: Vec2| p.x.abs().max(p.y.abs());
        let extent = boxes.iter().fold(0.0f64, |m, b| m.max(largest(b.min)).max(largest(b.max)));
        let boxes: Vec<_> = boxes.iter().map(|b| wider(b, MARGIN * extent)).collect();
        Self { tree: BoxTree::new(&boxes), all }
    }

    /// The things whose boxes meet a box, and some that only nearly do, in the order they were
    /// given.
    pub fn near<'a>(&'a self, rect: &Rect) -> impl Iterator<Item = &'a T> + use<'a, T> {
        let mut found = Vec::new();
        self.tree.query_box(rect, &mut found);
        found.into_iter().map(|index| &self.all[index as usize])
    }
}

/// A box with a margin on all sides.
pub fn wider(b: &Rect, margin: f64) -> Rect {
    let margin = vec2(margin, margin);
    Rect::new(b.min - margin, b.max + margin)
}

/// The box around some points; around none the origin.
pub fn around(points: &[Vec2]) -> Rect {
    let first = points.first().copied().unwrap_or(Vec2::ZERO);
    points.iter().fold(Rect::new(first, first), |b, &p| Rect::new(b.min.min(p), b.max.max(p)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    /// All that is not found lies apart; also boxes without extent, and those that touch.
    #[test]
    fn all_that_meets_a_box_is_found() {
        let mut random = Random(3);
        let mut point = || {
            vec2(
                (8.0 * random.between(-1.0, 1.0)).round(),
                (8.0 * random.between(-1.0, 1.0)).round(),
            )
        };
        let boxes: Vec<Rect> = (0..80).map(|_| around(&[point(), point()])).collect();
        let placed = BoxList::new(boxes.iter().copied().zip(0..));
        for _ in 0..200 {
            let query = around(&[point(), point()]);
            let query = wider(&query, 1e-6);
            let meets = |b: &Rect| {
                b.min.x <= query.max.x
                    && b.max.x >= query.min.x
                    && b.min.y <= query.max.y
                    && b.max.y >= query.min.y
            };
            let expected: Vec<usize> = (0..80).filter(|&k| meets(&boxes[k])).collect();
            assert_eq!(placed.near(&query).copied().collect::<Vec<_>>(), expected);
        }
    }
}
