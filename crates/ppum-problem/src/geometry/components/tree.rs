//! The tree of cuts.

use ppum::crack::SegmentId;
use ppum::function::{Cut, Part};

/// Cuts and leaves; the first node is the root.
#[derive(Debug, Default)]
pub(super) struct Tree(Vec<Node>);

/// A node of the tree.
#[derive(Clone, Copy, Debug)]
pub(super) enum Node {
    /// A cut by the line of a segment, and the nodes that follow on its left and right.
    Cut { segment: SegmentId, left: usize, right: usize },
    /// A convex part of the box, by its number.
    Leaf(usize),
}

/// A tree in which equal neighbours are one.
enum Pruned {
    Leaf(bool),
    Cut(SegmentId, Box<[Pruned; 2]>),
}

impl Tree {
    pub(super) fn push(&mut self, node: Node) -> usize {
        self.0.push(node);
        self.0.len() - 1
    }

    pub(super) fn set(&mut self, at: usize, node: Node) {
        self.0[at] = node;
    }

    /// The cuts that part the leaves inside from the others, each before those that follow from it.
    pub(super) fn cuts(&self, is_inside: &dyn Fn(usize) -> bool) -> Vec<Cut> {
        let mut cuts = Vec::new();
        self.pruned(0, is_inside).write(&mut cuts);
        cuts
    }

    fn pruned(&self, node: usize, is_inside: &dyn Fn(usize) -> bool) -> Pruned {
        match self.0[node] {
            Node::Leaf(leaf) => Pruned::Leaf(is_inside(leaf)),
            Node::Cut { segment, left, right } => {
                match [left, right].map(|next| self.pruned(next, is_inside)) {
                    [Pruned::Leaf(a), Pruned::Leaf(b)] if a == b => Pruned::Leaf(a),
                    both => Pruned::Cut(segment, Box::new(both)),
                }
            }
        }
    }
}

impl Pruned {
    fn write(&self, cuts: &mut Vec<Cut>) -> Part {
        match self {
            Self::Leaf(is_inside) => {
                if *is_inside {
                    Part::Inside
                } else {
                    Part::Outside
                }
            }
            Self::Cut(segment, both) => {
                let at = cuts.len();
                let new = Cut { segment: *segment, left: Part::Outside, right: Part::Outside };
                cuts.push(new);
                cuts[at].left = both[0].write(cuts);
                cuts[at].right = both[1].write(cuts);
                Part::Cut(at as u32)
            }
        }
    }
}
