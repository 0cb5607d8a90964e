//! The tree of cuts.

use ppum::crack::SegmentId;
use ppum::function::{Cut, CutSide};

/// Cuts and leaves; the first node is the root.
#[derive(Debug, Default)]
pub(super) struct CutTree(Vec<ComponentNode>);

/// A node of the tree.
#[derive(Clone, Copy, Debug)]
pub(super) enum ComponentNode {
    /// A cut by the line of a segment, and the nodes that follow on its left and right.
    Cut { segment: SegmentId, left: usize, right: usize },
    /// A convex part of the box, by its number.
    Leaf(usize),
}

/// A tree in which equal neighbours are one.
enum PrunedTree {
    Leaf(bool),
    Cut(SegmentId, Box<[PrunedTree; 2]>),
}

impl CutTree {
    pub(super) fn push(&mut self, node: ComponentNode) -> usize {
        self.0.push(node);
        self.0.len() - 1
    }

    pub(super) fn set(&mut self, at: usize, node: ComponentNode) {
        self.0[at] = node;
    }

    /// The cuts that part the leaves inside from the others, each before those that follow from it.
    pub(super) fn cuts(&self, is_inside: &dyn Fn(usize) -> bool) -> Vec<Cut> {
        let mut cuts = Vec::new();
        self.pruned(0, is_inside).write(&mut cuts);
        cuts
    }

    fn pruned(&self, node: usize, is_inside: &dyn Fn(usize) -> bool) -> PrunedTree {
        match self.0[node] {
            ComponentNode::Leaf(leaf) => PrunedTree::Leaf(is_inside(leaf)),
            ComponentNode::Cut { segment, left, right } => {
                match [left, right].map(|next| self.pruned(next, is_inside)) {
                    [PrunedTree::Leaf(a), PrunedTree::Leaf(b)] if a == b => PrunedTree::Leaf(a),
                    both => PrunedTree::Cut(segment, Box::new(both)),
                }
            }
        }
    }
}

impl PrunedTree {
    fn write(&self, cuts: &mut Vec<Cut>) -> CutSide {
        match self {
            Self::Leaf(is_inside) => {
                if *is_inside {
                    CutSide::Inside
                } else {
                    CutSide::Outside
                }
            }
            Self::Cut(segment, both) => {
                let at = cuts.len();
                let new =
                    Cut { segment: *segment, left: CutSide::Outside, right: CutSide::Outside };
                cuts.push(new);
                cuts[at].left = both[0].write(cuts);
                cuts[at].right = both[1].write(cuts);
                CutSide::Cut(at as u32)
            }
        }
    }
}
