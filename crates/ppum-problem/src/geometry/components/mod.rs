//! The connected components of what cracks leave of a box.
//!
//! The box is cut by the lines and circles of edges, one after the other, each within the part of
//! the box that the edge lies in (a binary space partition): no line is drawn farther than the
//! edges behind it ask for, so n edges that do not cross leave about n + 1 parts. Parts cut by
//! circles may consist of several, which count as one: the side of an arc does not tell them apart.
//! Two parts are joined where their common side is not covered by cracks and does not lie in holes.
//! The tree of the cuts, with what is joined taken as one, tells the component of any point of the
//! box, which is what [`FunctionKind::Component`](ppum::function::FunctionKind::Component)
//! evaluates.
//!
//! Ends of cracks within the box need no rule: the parts beside a line are joined beyond the end.

mod coverage;
mod curve;
mod region;
mod tree;

use ppum::crack::SegmentId;
use ppum::domain::Hole;
use ppum::edge::Edge;
use ppum::function::Cut;
use ppum::vec2::Rect;

use coverage::CutSides;
use region::{Region, SegmentPiece};
use tree::{ComponentNode, CutTree};

/// Thickness of parts that are rounding, in sizes of the box; the same as quadrature has.
const THINNEST: f64 = 1e-12;

/// Size of the middle of a box, in its sizes: what a patch has for itself with the default overlap.
const MIDDLE: f64 = 0.5;

/// Weight of areas outside of the middle.
const ELSEWHERE: f64 = 1e-3;

/// Thickness that counts as rounding, relative to the coordinates.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The middle of a box.
pub(crate) fn middle(open: &Rect) -> Rect {
    Rect::around(open.center(), open.size() * (0.5 * MIDDLE))
}

/// The components of a box.
pub(crate) struct Components {
    tree: CutTree,
    /// The component of each leaf of the tree.
    of_leaf: Vec<u32>,
    /// The area of each component in the middle of the box, plus a small weight of its area
    /// elsewhere.
    weights: Vec<f64>,
}

impl Components {
    /// The components of a box, of which `segments` of cracks and the holes are left out. Gaps in
    /// the cracks up to the length `gap` count as closed.
    ///
    /// Takes time in proportion to the square of the number of segments in the box.
    pub(crate) fn new(
        open: &Rect,
        segments: impl Iterator<Item = (SegmentId, Edge)>,
        holes: &[&Hole],
        gap: f64,
    ) -> Self {
        let reach = open.min.length().max(open.max.length());
        let thinnest = (THINNEST * open.size().length()).max(ROUNDING * reach);
        let pieces = segments.flat_map(|(id, edge)| SegmentPiece::inside(id, edge, open, thinnest));
        let mut building = TreeBuilder::new(thinnest);
        let region = Region::of_box(open);
        building.part(region, pieces.collect());
        building.join(open, holes, gap)
    }

    /// Number of components.
    #[cfg(test)]
    pub(crate) fn count(&self) -> usize {
        self.weights.len()
    }

    /// The trees of the indicator functions of all components but that with the most room in the
    /// middle, which a patch has for itself: with the constants they span what is constant on
    /// each component.
    pub(crate) fn indicators(&self) -> Vec<Vec<Cut>> {
        let numbers = 0..self.weights.len();
        let heavier = |a: &usize, b: &usize| self.weights[*a].total_cmp(&self.weights[*b]);
        let heaviest = numbers.clone().max_by(heavier);
        let all = numbers.filter(|&k| Some(k) != heaviest);
        all.map(|k| self.tree.cuts(&|leaf| self.of_leaf[leaf] == k as u32)).collect()
    }
}

/// A tree that is being built.
struct TreeBuilder {
    tree: CutTree,
    /// The parts at the leaves.
    leaves: Vec<Region>,
    /// The sides of each cut.
    sides: Vec<CutSides>,
    thinnest: f64,
}

impl TreeBuilder {
    fn new(thinnest: f64) -> Self {
        Self { tree: CutTree::default(), leaves: Vec::new(), sides: Vec::new(), thinnest }
    }

    /// Cuts a part of the box by the pieces in it; returns its node.
    fn part(&mut self, region: Region, mut pieces: Vec<SegmentPiece>) -> usize {
        while let Some(chosen) = choose(&pieces, self.thinnest) {
            if region.is_split_by(&pieces[chosen], self.thinnest) {
                return self.cut(region, pieces, chosen);
            }
            // it runs along a side of the region
            let along = pieces.swap_remove(chosen);
            region.cuts_along(&along, self.thinnest).for_each(|cut| self.sides[cut].cover(&along));
        }
        self.leaves.push(region);
        self.tree.push(ComponentNode::Leaf(self.leaves.len() - 1))
    }

    fn cut(&mut self, region: Region, pieces: Vec<SegmentPiece>, chosen: usize) -> usize {
        let SegmentPiece { id, curve, .. } = pieces[chosen];
        let number = self.sides.len();
        self.sides.push(CutSides::new(curve));
        let node = self.tree.push(ComponentNode::Cut { segment: id, left: 0, right: 0 });
        let (mut left, mut right) = (Vec::new(), Vec::new());
        self.sides[number].cover(&pieces[chosen]);
        for (_, piece) in pieces.iter().enumerate().filter(|(k, _)| *k != chosen) {
            let parts = piece.split(&curve, self.thinnest);
            if parts.iter().all(Option::is_none) {
                self.sides[number].cover(piece);
            }
            for (is_left, part) in parts.into_iter().flatten() {
                if is_left { left.push(part) } else { right.push(part) }
            }
        }
        let [on_left, on_right] = region.split(&pieces[chosen], number, self.thinnest);
        let left = self.part(on_left, left);
        let right = self.part(on_right, right);
        self.tree.set(node, ComponentNode::Cut { segment: id, left, right });
        node
    }

    /// Joins the parts that no crack parts.
    fn join(mut self, open: &Rect, holes: &[&Hole], gap: f64) -> Components {
        for (leaf, region) in self.leaves.iter().enumerate() {
            for (cut, side) in region.sides() {
                self.sides[cut].add(leaf, &side);
            }
        }
        let mut joined: Vec<usize> = (0..self.leaves.len()).collect();
        for sides in &self.sides {
            for [a, b] in sides.open(holes, gap) {
                let (a, b) = (root(&joined, a), root(&joined, b));
                joined[a] = b;
            }
        }
        self.join_crumbs(&mut joined, gap);
        let middle = middle(open);
        let (mut weights, mut of_leaf, mut numbers) =
            (Vec::new(), Vec::new(), vec![None; joined.len()]);
        for leaf in 0..joined.len() {
            let first = root(&joined, leaf);
            let number = *numbers[first].get_or_insert_with(|| {
                weights.push(0.0);
                weights.len() - 1
            });
            of_leaf.push(number as u32);
            let (leaf, inner) =
                (&self.leaves[leaf], self.leaves[leaf].within(&middle, self.thinnest));
            weights[number] += inner.area(holes) + ELSEWHERE * leaf.area(holes);
        }
        Components { tree: self.tree, of_leaf, weights }
    }

    /// Joins what is not larger than a gap, where ends that are meant to meet miss each other, to
    /// what lies beside it.
    fn join_crumbs(&self, joined: &mut [usize], gap: f64) {
        let mut areas = vec![0.0; joined.len()];
        for (leaf, region) in self.leaves.iter().enumerate() {
            areas[root(joined, leaf)] += region.area(&[]);
        }
        let is_crumb = |part: usize| areas[part] <= gap * gap;
        for [a, b] in self.sides.iter().flat_map(CutSides::beside) {
            let (a, b) = (root(joined, a), root(joined, b));
            if is_crumb(a) || is_crumb(b) {
                let (crumb, other) = if is_crumb(a) { (a, b) } else { (b, a) };
                joined[crumb] = other;
            }
        }
    }
}

/// The first of those that are joined with a part.
fn root(joined: &[usize], mut part: usize) -> usize {
    while joined[part] != part {
        part = joined[part];
    }
    part
}

/// Pieces among which the next one to cut by is chosen.
const CANDIDATES: usize = 8;

/// The piece whose line or circle cuts the fewest others.
fn choose(pieces: &[SegmentPiece], thinnest: f64) -> Option<usize> {
    let step = pieces.len().div_ceil(CANDIDATES).max(1);
    let cuts = |&k: &usize| {
        let cut = |piece: &&SegmentPiece| piece.is_split_by(&pieces[k].curve, thinnest);
        pieces.iter().filter(cut).count()
    };
    (0..pieces.len()).step_by(step).min_by_key(cuts)
}

#[cfg(test)]
mod tests;
