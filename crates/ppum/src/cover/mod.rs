//! Covers: quadtrees over the domain whose leaf cells, stretched by α, are the patches.
//!
//! ```text
//! C_i = c_i ± h_i      the leaf cells, which tile the domain
//! ω_i = c_i ± α h_i    the patches                                  1 < α < 2
//! ```
//!
//! A tree has one root cell or a grid of them, and is made from scattered points (cells are halved
//! until each holds at most one; empty cells stay) \[GS00\] or uniformly, then refined where
//! wanted. It is 2:1 balanced at all times: leaves that touch, if only at a corner, differ by at
//! most one level, also across root cells. Then every patch has a part that no other patch covers
//! (its *flat top*) as long as α < 5/3.
//!
//! ```
//! use ppum::cover::Cover;
//! use ppum::vec2::{Rect, vec2};
//! use ppum::weight::WeightFunction;
//!
//! let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
//! let mut cover = Cover::uniform(domain, 3)?;
//! let tip = vec2(0.3, 0.0);
//! while cover.refine(|cell, level| level < 6 && cell.contains(tip))? > 0 {}
//! let partition = cover.partition(1.3, WeightFunction::Linear)?;
//! assert_eq!(partition.level.iter().max(), Some(&6));
//! # Ok::<(), ppum::cover::CoverError>(())
//! ```

mod coarser;
mod grid;
#[cfg(test)]
mod tests;

use crate::dataset::BoxPartition;
use crate::morton::morton;
use crate::vec2::{Rect, Vec2};
use crate::weight::WeightFunction;
use grid::{RootGrid, TreeCell};
use std::ops::RangeInclusive;

/// Deepest level of a cell, that is how often a root cell can be halved: a 10⁻⁹th of its width,
/// finer than any cover needs.
pub const MAX_LEVEL: u8 = 30;

/// The largest number of cells: 4¹², some two gigabytes for the partition alone.
pub const MAX_CELLS: usize = 1 << 24;

/// Largest absolute value of a domain's coordinates: their products with grid indices stay finite.
const MAX_COORDINATE: f64 = 1e280;

/// Overlaps α that the numbers bear. ∇φ is of the size 1/((α − 1) h): below, the patches are glued
/// along lines, which costs more of the accuracy than digits, and in the end all digits; above,
/// patches meet the neighbours of their neighbours.
pub const OVERLAP: RangeInclusive<f64> = 1.01..=1.99;

/// A cover that cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CoverError {
    /// The overlap α is not in [`OVERLAP`].
    #[error("overlap {0} is not between {least} and {most}: 1.3 suits most problems",
        least = OVERLAP.start(), most = OVERLAP.end())]
    Overlap(f64),
    /// The domain is empty, not finite or too far out.
    #[error("the domain x {} … {}, y {} … {} is not a finite box with max above min",
        .0.min.x, .0.max.x, .0.min.y, .0.max.y)]
    Domain(Rect),
    /// A grid of root cells with none in a direction.
    #[error("a grid of {} x {} cells has no cells: each number must be at least 1", .0[0], .0[1])]
    NoCells([u32; 2]),
    /// More than [`MAX_CELLS`].
    #[error("the cover needs more than {MAX_CELLS} cells: lower the level or refine less")]
    TooManyCells,
    /// A cell cannot be halved: it is at [`MAX_LEVEL`], or as small as f64 resolves there.
    #[error("the cell at ({}, {}) of level {level} is too small to be halved: refine less there",
        .at.x, .at.y)]
    TooSmall {
        /// Lower left corner of the cell.
        at: Vec2,
        /// Its level.
        level: u8,
    },
    /// A point, perhaps not finite, lies outside the domain.
    #[error("point {index} at ({}, {}) is outside the domain: enlarge the domain or drop it",
        .at.x, .at.y)]
    PointOutside {
        /// Index of the point, from 0.
        index: u32,
        /// Its place.
        at: Vec2,
    },
    /// Two points coincide, or lie so close that no cells separate them.
    #[error("points {first} and {second} at ({}, {}), {distance} apart, cannot be put into \
        different cells: drop one of them", .at.x, .at.y)]
    CoincidentPoints {
        /// Index of the first of them, from 0.
        first: u32,
        /// Index of the second.
        second: u32,
        /// Position of the second.
        at: Vec2,
        /// Their distance, 0 for duplicates.
        distance: f64,
    },
    /// A leaf was named that does not exist.
    #[error("leaf {leaf} does not exist: the cover has {count}")]
    NoSuchLeaf {
        /// The index asked for.
        leaf: usize,
        /// Number of leaves.
        count: usize,
    },
}

/// A balanced quadtree, or a grid of them, over a box.
///
/// Leaves are numbered in Morton order, which depends on nothing but the set of leaves. After an
/// error while refining the cover is valid but perhaps not balanced.
#[derive(Clone, Debug)]
pub struct Cover {
    grid: RootGrid,
    /// Root cells first, row by row; children follow in groups of four as cells are split.
    nodes: Vec<CoverNode>,
    /// The root cells in Morton order.
    roots: Vec<TreeCell>,
    n_leaves: usize,
    points: Vec<Vec2>,
}

/// A node of the tree; its cell follows from the way down.
#[derive(Clone, Copy, Debug, Default)]
struct CoverNode {
    /// The first of its four children; 0, which is a root, for a leaf.
    children: u32,
    /// The point in a leaf.
    point: Option<u32>,
}

impl CoverNode {
    fn is_leaf(self) -> bool {
        self.children == 0
    }
}

/// A node together with its cell.
#[derive(Clone, Copy, Debug)]
struct NodeCell {
    node: usize,
    cell: TreeCell,
}

impl Cover {
    /// A grid of `cells[0]` × `cells[1]` cells, each the root of a quadtree of its own.
    ///
    /// # Errors
    /// An unusable domain, no cells or too many.
    pub fn grid(domain: Rect, cells: [u32; 2]) -> Result<Self, CoverError> {
        let finite = domain.min.max(-domain.min).max(domain.max).max(-domain.max);
        let usable = domain.min.is_finite()
            && domain.max.is_finite()
            && finite.x.max(finite.y) < MAX_COORDINATE
            && domain.min.x < domain.max.x
            && domain.min.y < domain.max.y;
        if !usable {
            return Err(CoverError::Domain(domain));
        }
        let n_leaves = cells[0] as usize * cells[1] as usize;
        match n_leaves {
            0 => return Err(CoverError::NoCells(cells)),
            1..=MAX_CELLS => {}
            _ => return Err(CoverError::TooManyCells),
        }
        Ok(Self {
            grid: RootGrid { domain, roots: cells },
            nodes: vec![CoverNode::default(); n_leaves],
            roots: roots_in_order(cells),
            n_leaves,
            points: Vec::new(),
        })
    }

    /// The uniform cover of 4^level cells, all halved from one root.
    ///
    /// # Errors
    /// An unusable domain or too many cells.
    pub fn uniform(domain: Rect, level: u8) -> Result<Self, CoverError> {
        let mut cover = Self::grid(domain, [1, 1])?;
        if 2 * u32::from(level) > MAX_CELLS.ilog2() {
            return Err(CoverError::TooManyCells);
        }
        for _ in 0..level {
            cover.split_all(&cover.leaves())?;
        }
        Ok(cover)
    }

    /// The cover generated by scattered points: the cells of a grid, `[1, 1]` for one root, are
    /// halved until each holds at most one point, then balanced. A point on a boundary between
    /// cells belongs to the right and upper one. The order of the points does not matter to the
    /// cells.
    ///
    /// # Errors
    /// As for [`grid`](Self::grid); points outside the domain; points that coincide.
    pub fn scattered(domain: Rect, cells: [u32; 2], points: Vec<Vec2>) -> Result<Self, CoverError> {
        let mut cover = Self::grid(domain, cells)?;
        if points.len() > MAX_CELLS {
            return Err(CoverError::TooManyCells);
        }
        cover.points = points;
        for index in 0..cover.points.len() {
            cover.insert(index as u32)?;
        }
        cover.balance()?;
        Ok(cover)
    }

    /// Splits, once, every leaf for which `wanted(cell, level)` holds, then balances. Returns how
    /// many leaves were wanted, so that a loop can refine until none is.
    ///
    /// # Errors
    /// Too many cells, or cells too small to be halved.
    pub fn refine(
        &mut self,
        mut wanted: impl FnMut(Rect, u8) -> bool,
    ) -> Result<usize, CoverError> {
        let mut leaves = self.leaves();
        leaves.retain(|leaf| wanted(self.grid.rect(leaf.cell), leaf.cell.level));
        self.split_all(&leaves)?;
        self.balance()?;
        Ok(leaves.len())
    }

    /// Splits, once, the leaves with the given indices (those of the patches), then balances.
    ///
    /// # Errors
    /// As for [`refine`](Self::refine), and leaves that do not exist.
    pub fn refine_leaves(&mut self, indices: &[usize]) -> Result<(), CoverError> {
        let count = self.n_cells();
        let mut wanted = vec![false; count];
        for &leaf in indices {
            *wanted.get_mut(leaf).ok_or(CoverError::NoSuchLeaf { leaf, count })? = true;
        }
        let mut wanted = wanted.into_iter();
        self.refine(|_, _| wanted.next() == Some(true))?;
        Ok(())
    }

    /// Number of leaf cells, hence of patches.
    #[must_use]
    pub fn n_cells(&self) -> usize {
        self.n_leaves
    }

    /// The leaf cells and their levels, in Morton order. They tile the domain: cells that share a
    /// boundary have the same bits for it.
    #[must_use]
    pub fn cells(&self) -> Vec<(Rect, u8)> {
        let leaves = self.leaves();
        leaves.iter().map(|leaf| (self.grid.rect(leaf.cell), leaf.cell.level)).collect()
    }

    /// The partition of unity over the patches ω_i = c_i ± α h_i, one per leaf, in Morton order.
    /// The polynomial frame is the patch: origin c_i, scale α h_i.
    ///
    /// # Errors
    /// α not in [`OVERLAP`].
    pub fn partition(
        &self,
        alpha: f64,
        weight: WeightFunction,
    ) -> Result<BoxPartition, CoverError> {
        if !OVERLAP.contains(&alpha) {
            return Err(CoverError::Overlap(alpha));
        }
        let leaves = self.leaves();
        let cell: Vec<_> = leaves.iter().map(|leaf| self.grid.rect(leaf.cell)).collect();
        let center: Vec<_> = cell.iter().map(Rect::center).collect();
        let half: Vec<_> = cell.iter().map(|c| c.size() * (0.5 * alpha)).collect();
        Ok(BoxPartition {
            weight,
            origin: center.clone(),
            center,
            scale: half.clone(),
            half,
            cell,
            level: leaves.iter().map(|leaf| leaf.cell.level).collect(),
            point: leaves.iter().map(|leaf| self.nodes[leaf.node].point).collect(),
            points: self.points.clone(),
        })
    }

    /// Puts a point into its leaf, splitting while another is there.
    fn insert(&mut self, index: u32) -> Result<(), CoverError> {
        let p = self.points[index as usize];
        if !self.grid.domain.contains(p) {
            return Err(CoverError::PointOutside { index, at: p });
        }
        let mut place = self.root(self.grid.root_of(p));
        loop {
            let node = &mut self.nodes[place.node];
            match node.point {
                None if node.is_leaf() => {
                    node.point = Some(index);
                    return Ok(());
                }
                None => {}
                Some(other) => {
                    self.split(place).map_err(|e| self.coincident(e, other, index))?;
                }
            }
            place = self.child(place, self.grid.quadrant_of(place.cell, p));
        }
    }

    /// The error for two points whose common cell cannot be split.
    fn coincident(&self, error: CoverError, first: u32, second: u32) -> CoverError {
        let [a, at] = [first, second].map(|i| self.points[i as usize]);
        match error {
            CoverError::TooSmall { .. } => {
                CoverError::CoincidentPoints { first, second, at, distance: (at - a).length() }
            }
            other => other,
        }
    }

    fn split_all(&mut self, leaves: &[NodeCell]) -> Result<(), CoverError> {
        leaves.iter().try_for_each(|&leaf| self.split(leaf))
    }

    /// Replaces a leaf by its four quadrants; its point moves down.
    fn split(&mut self, leaf: NodeCell) -> Result<(), CoverError> {
        let (cell, middle) = (self.grid.rect(leaf.cell), self.grid.middle(leaf.cell));
        let inside = |min, mid, max| min < mid && mid < max;
        if leaf.cell.level == MAX_LEVEL
            || !inside(cell.min.x, middle.x, cell.max.x)
            || !inside(cell.min.y, middle.y, cell.max.y)
        {
            return Err(CoverError::TooSmall { at: cell.min, level: leaf.cell.level });
        }
        if self.n_leaves + 3 > MAX_CELLS {
            return Err(CoverError::TooManyCells);
        }
        let children = self.nodes.len();
        self.nodes.extend([CoverNode::default(); 4]);
        self.n_leaves += 3;
        // At most 4/3 MAX_CELLS nodes: the index fits.
        let node = &mut self.nodes[leaf.node];
        node.children = children as u32;
        if let Some(point) = node.point.take() {
            let quadrant = self.grid.quadrant_of(leaf.cell, self.points[point as usize]);
            self.nodes[children + quadrant as usize].point = Some(point);
        }
        Ok(())
    }

    /// Splits leaves until any two that touch differ by at most one level.
    ///
    /// The children of a cell touch all of its eight neighbours. So the tree is balanced if and
    /// only if, for each cell that has children, its neighbours of the same level exist.
    fn balance(&mut self) -> Result<(), CoverError> {
        let mut parents = self.places(|node| !node.is_leaf());
        while let Some(parent) = parents.pop() {
            for neighbour in self.grid.neighbours(parent.cell) {
                self.ensure(neighbour, &mut parents)?;
            }
        }
        Ok(())
    }

    /// Splits leaves until `target` is a cell of the tree; those split are appended.
    fn ensure(&mut self, target: TreeCell, split: &mut Vec<NodeCell>) -> Result<(), CoverError> {
        let mut place = self.root(target.ancestor(0));
        while place.cell.level < target.level {
            if self.nodes[place.node].is_leaf() {
                self.split(place)?;
                split.push(place);
            }
            place = self.child(place, target.ancestor(place.cell.level + 1).quadrant());
        }
        Ok(())
    }

    /// The leaves in Morton order.
    fn leaves(&self) -> Vec<NodeCell> {
        self.places(CoverNode::is_leaf)
    }

    /// The nodes that pass a test, in Morton order.
    fn places(&self, wanted: impl Fn(CoverNode) -> bool) -> Vec<NodeCell> {
        let mut found = Vec::with_capacity(self.n_leaves);
        let mut waiting = Vec::new();
        for &root in &self.roots {
            waiting.push(self.root(root));
            while let Some(place) = waiting.pop() {
                let node = self.nodes[place.node];
                if wanted(node) {
                    found.push(place);
                }
                if !node.is_leaf() {
                    waiting.extend((0..4).rev().map(|quadrant| self.child(place, quadrant)));
                }
            }
        }
        found
    }

    fn root(&self, cell: TreeCell) -> NodeCell {
        let node = (cell.y * u64::from(self.grid.roots[0]) + cell.x) as usize;
        NodeCell { node, cell }
    }

    fn child(&self, parent: NodeCell, quadrant: u32) -> NodeCell {
        let node = (self.nodes[parent.node].children + quadrant) as usize;
        NodeCell { node, cell: parent.cell.child(quadrant) }
    }
}

/// The root cells in Morton order.
fn roots_in_order([columns, rows]: [u32; 2]) -> Vec<TreeCell> {
    let mut roots: Vec<_> = (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y))).collect();
    roots.sort_unstable_by_key(|&(x, y)| morton(x, y));
    roots.into_iter().map(|(x, y)| TreeCell { level: 0, x: x.into(), y: y.into() }).collect()
}
