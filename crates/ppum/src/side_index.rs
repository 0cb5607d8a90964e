//! The sides of a rim with many, in a search tree that is made when first asked for.

use crate::box_tree::BoxTree;
use crate::edge::Edge;
use crate::vec2::{Rect, Vec2, vec2};
use std::sync::OnceLock;

/// Sides of a rim from which on those that matter are looked up.
pub(crate) const MANY: usize = 32;

/// Margin of the boxes of sides for rounding, in parts of the largest coordinate of a rim.
const MARGIN: f64 = 1e-12;

/// Part of a distance that is more than its rounding.
const SLACK: f64 = 1e-9;

/// The search tree of a rim, which follows from its sides: all are equal. A clone, whose sides may
/// be changed, makes its own.
#[derive(Debug, Default)]
pub struct SideIndex(OnceLock<SideTree>);

impl Clone for SideIndex {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl PartialEq for SideIndex {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl SideIndex {
    /// The tree of these sides; none if they are few.
    pub(crate) fn of(&self, sides: impl Iterator<Item = Edge>, count: usize) -> Option<&SideTree> {
        (count > MANY).then(|| self.0.get_or_init(|| SideTree::new(sides.collect())))
    }
}

/// Sides, found by the boxes around them.
#[derive(Debug)]
pub(crate) struct SideTree {
    sides: Vec<Edge>,
    tree: BoxTree,
}

impl SideTree {
    fn new(sides: Vec<Edge>) -> Self {
        let boxes: Vec<Rect> = sides.iter().map(Edge::reach).collect();
        let margin = MARGIN * boxes.iter().map(Rect::max_norm).fold(0.0, f64::max);
        let margin = vec2(margin, margin);
        let wider = |b: Rect| Rect::new(b.min - margin, b.max + margin);
        let tree = BoxTree::from(boxes.into_iter().map(wider).collect::<Vec<_>>());
        Self { sides, tree }
    }

    /// The sides that may meet a closed box with their numbers, in order.
    pub(crate) fn near(&self, rect: &Rect) -> Vec<(usize, Edge)> {
        let mut found = Vec::new();
        self.tree.query_box(rect, &mut found);
        found.into_iter().map(|k| (k as usize, self.sides[k as usize])).collect()
    }

    /// Distance of a point from the closest side, which is no farther than the closest corner.
    pub(crate) fn distance(&self, p: Vec2) -> f64 {
        let squares = self.sides.iter().map(|side| (side.from - p).dot(side.from - p));
        let reach = squares.fold(f64::INFINITY, f64::min).sqrt() * (1.0 + SLACK);
        let near = self.near(&Rect::around(p, vec2(reach, reach)));
        near.iter().map(|(_, side)| side.distance(p)).fold(f64::INFINITY, f64::min)
    }
}
