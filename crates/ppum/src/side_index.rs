//! The sides of a rim with many, in a search tree that is made when first asked for.

use crate::box_tree::BoxTree;
use crate::edge::Edge;
use crate::vec2::{Rect, Vec2, vec2};
use std::sync::{Arc, OnceLock};

/// Sides of a rim from which on those that matter are looked up.
pub(crate) const MANY: usize = 32;

/// Margin of the boxes of sides for rounding, in parts of the largest coordinate of a rim.
const MARGIN: f64 = 1e-12;

/// The search tree of a rim, which follows from its sides: all are equal.
#[derive(Clone, Debug, Default)]
pub struct SideIndex(OnceLock<Option<Arc<SideTree>>>);

impl PartialEq for SideIndex {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl SideIndex {
    /// The tree of these sides; none if they are few.
    pub(crate) fn of(&self, sides: impl Iterator<Item = Edge>, count: usize) -> Option<&SideTree> {
        if count <= MANY {
            return None;
        }
        self.0.get_or_init(|| Some(Arc::new(SideTree::new(sides.collect())))).as_deref()
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
        let extent = |b: &Rect| b.min.max_norm().max(b.max.max_norm());
        let margin = MARGIN * boxes.iter().map(extent).fold(0.0, f64::max);
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

    /// Distance of a point from the closest side.
    pub(crate) fn distance(&self, p: Vec2) -> f64 {
        self.tree.least(p, &|k| self.sides[k as usize].distance(p))
    }
}
