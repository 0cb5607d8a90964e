//! The tree of cuts.

use ppum::crack::SegmentId;
use ppum::function::{Cut, CutBranch};

/// Cuts and leaves; the first node is the root.
#[derive(Debug, Default)]
pub(super) struct CutTree(Vec<ComponentNode>);

/// A node of the tree.
#[derive(Clone, Copy, Debug)]
pub(super) enum ComponentNode {
    /// A cut by the line or circle of an edge, and the nodes that follow on its left and right.
    Cut { segment: SegmentId, left: usize, right: usize },
    /// A part of the box, by its number.
    Leaf(usize),
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
        self.write(0, is_inside, &mut cuts);
        cuts
    }

    /// Adds the cuts from a node on, without those that part nothing.
    fn write(
        &self,
        node: usize,
        is_inside: &dyn Fn(usize) -> bool,
        cuts: &mut Vec<Cut>,
    ) -> CutBranch {
        let (segment, next) = match self.0[node] {
            ComponentNode::Leaf(leaf) if is_inside(leaf) => return CutBranch::Inside,
            ComponentNode::Leaf(_) => return CutBranch::Outside,
            ComponentNode::Cut { segment, left, right } => (segment, [left, right]),
        };
        let at = cuts.len();
        cuts.push(Cut { segment, left: CutBranch::Outside, right: CutBranch::Outside });
        let [left, right] = next.map(|node| self.write(node, is_inside, cuts));
        if left == right && !matches!(left, CutBranch::Cut(_)) {
            cuts.truncate(at);
            return left;
        }
        cuts[at] = Cut { segment, left, right };
        CutBranch::Cut(at as u32)
    }
}
