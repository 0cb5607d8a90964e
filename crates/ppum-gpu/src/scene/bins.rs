//! Finding the patches of a pixel: a grid of bins over a region, halved where a bin meets
//! many patches.
//!
//! ```text
//! node   below INNER       a leaf, by the page at which its patches begin
//!        INNER + texel     halved in x and y: its children are the four nodes of that texel, by x + 2 y
//! ```
//!
//! The bins are as large as the largest cells, or smaller by a power of two as long as there are no
//! more bins than patches, and their borders run through the centre of one of these cells: on a
//! uniform cover a bin between four centres is met by their four patches and no other, so a patch
//! is found in one step. Elsewhere a few steps down lead to at most a handful.

use std::ops::Range;

use ppum::vec2::{Rect, Vec2, vec2};
use ppum_render::pieces::quarters;

/// The first number of a node with children.
pub(crate) const INNER: u32 = 1 << 31;

/// Patches of a page. A bin with no more is not halved.
pub(crate) const FEW: usize = 4;

/// Halvings of a bin of the grid.
const MAX_DEPTH: u32 = 24;

/// Bins over a region. Positions are relative to the region's anchor.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bins {
    /// Lower left corner of the grid.
    pub(crate) origin: Vec2,
    /// Size of a bin of the grid.
    pub(crate) pitch: Vec2,
    /// Columns and rows of the grid.
    pub(crate) size: [u32; 2],
    /// Nodes; those of the grid first, row by row. The nodes between them and the first children do
    /// not matter.
    pub(crate) nodes: Vec<u32>,
    /// Leaves that meet patches, page by page.
    pub(crate) leaves: Vec<BinLeaf>,
    /// Patches of the leaves.
    pub(crate) list: Vec<u32>,
    /// Pages of the leaves; the first is of all leaves that meet none.
    pub(crate) pages: u32,
}

/// A bin that is not halved.
#[derive(Clone, Debug)]
pub(crate) struct BinLeaf {
    /// Its lower left corner.
    pub(crate) corner: Vec2,
    /// Its patches in the list.
    pub(crate) patches: Range<usize>,
}

/// A patch as bins see it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BinPatch {
    /// Its support.
    pub(crate) support: Rect,
    /// Size of its cell.
    pub(crate) cell: Vec2,
}

impl Bins {
    /// Bins over `bounds`, which holds all positions that will be looked up, give or take `margin`.
    pub(crate) fn new(bounds: Rect, patches: &[BinPatch], margin: f64) -> Self {
        let mut bins = Self { pages: 1, ..Self::grid(bounds, patches) };
        let lists = bins.lists(patches, margin);
        bins.nodes = vec![0; lists.len().next_multiple_of(4)];
        for (node, list) in lists.iter().enumerate() {
            let bin = bins.bin(node);
            bins.fill(node, bin, list, patches, margin, 0);
        }
        bins
    }

    /// The grid without nodes.
    fn grid(bounds: Rect, patches: &[BinPatch]) -> Self {
        let widest = patches.iter().max_by(|a, b| a.cell.x.total_cmp(&b.cell.x));
        let size = bounds.size();
        // Inside a cell one bin does, placed by the region itself: it may be tiny beside the cell.
        let is_cut = |patch: &&BinPatch| patch.cell.x < size.x || patch.cell.y < size.y;
        let (mut pitch, center) = match widest.filter(is_cut) {
            Some(patch) => (patch.cell, patch.support.center()),
            None => (size, bounds.min),
        };
        // Cells of unlike shapes could make far more bins than patches.
        let most = (2 * patches.len() + 64) as f64;
        let count = |pitch: Vec2| (size.x / pitch.x + 2.0) * (size.y / pitch.y + 2.0);
        if count(pitch) > most {
            pitch = pitch * (count(pitch) / most);
        }
        let is_one = pitch == size;
        while !is_one && count(pitch * 0.5) <= 0.5 * most {
            pitch = pitch * 0.5;
        }
        let before = |low: f64, at: f64, step: f64| at - ((at - low) / step).ceil() * step;
        let origin =
            vec2(before(bounds.min.x, center.x, pitch.x), before(bounds.min.y, center.y, pitch.y));
        let cells = |low: f64, high: f64, step: f64| ((high - low) / step).ceil().max(1.0) as u32;
        let size = [cells(origin.x, bounds.max.x, pitch.x), cells(origin.y, bounds.max.y, pitch.y)];
        Self { origin, pitch, size, ..Self::default() }
    }

    /// A bin of the grid.
    fn bin(&self, node: usize) -> Rect {
        let columns = self.size[0] as usize;
        let index = vec2((node % columns) as f64, (node / columns) as f64);
        let min =
            vec2(self.origin.x + index.x * self.pitch.x, self.origin.y + index.y * self.pitch.y);
        Rect::new(min, min + self.pitch)
    }

    /// The patches that meet each bin of the grid.
    fn lists(&self, patches: &[BinPatch], margin: f64) -> Vec<Vec<u32>> {
        let mut lists = vec![Vec::new(); self.size[0] as usize * self.size[1] as usize];
        let range = |low: f64, high: f64, count: u32| {
            // Casts saturate: what is left of the grid begins with its first bin.
            let (first, last) = (low.floor() as usize, high.floor().max(-1.0) + 1.0);
            first.min(count as usize)..(last as usize).min(count as usize)
        };
        for (index, patch) in (0u32..).zip(patches) {
            let (low, high) = (patch.support.min - self.origin, patch.support.max - self.origin);
            let (px, py) = (self.pitch.x, self.pitch.y);
            for row in range((low.y - margin) / py, (high.y + margin) / py, self.size[1]) {
                for column in range((low.x - margin) / px, (high.x + margin) / px, self.size[0]) {
                    lists[row * self.size[0] as usize + column].push(index);
                }
            }
        }
        lists
    }

    /// Makes a node of a bin and the patches that meet it.
    fn fill(
        &mut self,
        node: usize,
        bin: Rect,
        list: &[u32],
        patches: &[BinPatch],
        margin: f64,
        depth: u32,
    ) {
        let quarters = quarters(&bin);
        if may_split(bin, list, patches, margin, depth) {
            let children = quarters.map(|quarter| meeting(quarter, list, patches, margin));
            if children.iter().any(|child| child.len() < list.len()) {
                let first = self.nodes.len();
                self.nodes[node] = INNER + first as u32 / 4;
                self.nodes.resize(first + 4, 0);
                for (k, child) in children.iter().enumerate() {
                    self.fill(first + k, quarters[k], child, patches, margin, depth + 1);
                }
                return;
            }
        }
        if !list.is_empty() {
            self.nodes[node] = self.pages;
            self.pages += list.len().div_ceil(FEW) as u32;
            let patches = self.list.len()..self.list.len() + list.len();
            self.leaves.push(BinLeaf { corner: bin.min, patches });
            self.list.extend_from_slice(list);
        }
    }
}

/// True if halving a bin may help: it meets many patches and is not small beside their cells, nor
/// beside the accuracy of positions.
fn may_split(bin: Rect, list: &[u32], patches: &[BinPatch], margin: f64, depth: u32) -> bool {
    if list.len() <= FEW || depth >= MAX_DEPTH {
        return false;
    }
    let size = bin.size();
    let smallest = list.iter().map(|&p| patches[p as usize].cell).fold(size, Vec2::min);
    size.x > 0.5 * smallest.x && size.y > 0.5 * smallest.y && size.x.min(size.y) > 8.0 * margin
}

/// The patches of a list that meet a bin.
fn meeting(bin: Rect, list: &[u32], patches: &[BinPatch], margin: f64) -> Vec<u32> {
    let margin = vec2(margin, margin);
    let wide = Rect::new(bin.min - margin, bin.max + margin);
    let meets = |&&index: &&u32| patches[index as usize].support.overlaps(&wide);
    list.iter().filter(meets).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::cover::Cover;
    use ppum::dataset::BoxPartition;
    use ppum::weight::WeightFunction;
    use ppum_testkit::random::Random;
    use ppum_testkit::synthetic::Recipe;

    const UNIT: Rect = Rect::new(Vec2::ZERO, vec2(1.0, 1.0));

    fn covered(partition: &BoxPartition) -> Vec<BinPatch> {
        let one = |i| BinPatch { support: partition.support(i), cell: partition.spacing(i) };
        (0..partition.len()).map(one).collect()
    }

    /// The patches of the leaf that holds a point, by the shader's descent.
    fn leaf_patches(bins: &Bins, p: Vec2) -> &[u32] {
        let t = p - bins.origin;
        let (mut x, mut y) = (t.x / bins.pitch.x, t.y / bins.pitch.y);
        let last = bins.size.map(|n| f64::from(n) - 1.0);
        let (i, j) = (x.floor().min(last[0]), y.floor().min(last[1]));
        let mut node = bins.nodes[j as usize * bins.size[0] as usize + i as usize];
        (x, y) = (x - i, y - j);
        while node >= INNER {
            (x, y) = (2.0 * x, 2.0 * y);
            let (right, upper) = (f64::from(x >= 1.0), f64::from(y >= 1.0));
            (x, y) = (x - right, y - upper);
            node = bins.nodes[4 * (node - INNER) as usize + (right + 2.0 * upper) as usize];
        }
        let mut page = 1;
        for leaf in &bins.leaves {
            if page == node {
                return &bins.list[leaf.patches.clone()];
            }
            page += leaf.patches.len().div_ceil(FEW) as u32;
        }
        &[]
    }

    /// Patches of the bin that meets most.
    fn longest(bins: &Bins) -> usize {
        bins.leaves.iter().map(|leaf| leaf.patches.len()).max().unwrap_or_default()
    }

    #[test]
    fn every_covering_patch_is_found() {
        for seed in 0..12 {
            let recipe = Recipe { tip_level: 9, ..Recipe::random(seed) };
            let patches = covered(&recipe.partition());
            let bins = Bins::new(recipe.domain, &patches, 1e-7);
            let mut random = Random(seed);
            for _ in 0..2000 {
                let p = random.point(&recipe.domain);
                let list = leaf_patches(&bins, p);
                let holds = |c: &BinPatch| c.support.contains(p);
                let all = (0u32..).zip(&patches).filter(|(_, c)| holds(c)).map(|(i, _)| i);
                for index in all {
                    assert!(list.contains(&index), "patch {index} at {p:?}");
                }
                assert!(list.is_sorted(), "{list:?}");
            }
        }
    }

    /// One step and four candidates on a uniform cover, whatever the overlap.
    #[test]
    fn uniform_covers_need_no_descent() {
        for (level, overlap) in [(2, 1.3), (5, 1.3), (6, 1.9)] {
            let cover = Cover::uniform(UNIT, level).expect("a cover");
            let partition = cover.partition(overlap, WeightFunction::Linear).expect("an overlap");
            let bins = Bins::new(UNIT, &covered(&partition), 1e-9);
            assert!(
                longest(&bins) <= 4 && bins.nodes.iter().all(|&node| node < INNER),
                "level {level}"
            );
            assert!(bins.leaves.len() <= (1 + (1 << level)) * (1 + (1 << level)), "level {level}");
        }
    }

    /// A cell in four of a graded cover, halved down to a point: lists stay short, nodes few.
    #[test]
    fn graded_covers_have_short_lists() {
        let mut cover = Cover::uniform(UNIT, 3).expect("a cover");
        let tip = vec2(0.3, 0.6);
        while cover.refine(|cell, level| level < 14 && cell.contains(tip)).expect("a cover") > 0 {}
        let partition = cover.partition(1.3, WeightFunction::Linear).expect("an overlap");
        let bins = Bins::new(UNIT, &covered(&partition), 1e-9);
        assert!(longest(&bins) <= 9, "{}", longest(&bins));
        assert!(bins.nodes.len() < 20 * partition.len(), "{} nodes", bins.nodes.len());
    }

    /// No patches, one patch, a region in the middle of one.
    #[test]
    fn small_regions() {
        let none = Bins::new(UNIT, &[], 1e-9);
        assert!(leaf_patches(&none, vec2(0.5, 0.5)).is_empty());
        let large = Rect::around(Vec2::ZERO, vec2(1e9, 1e9));
        let one = [BinPatch { support: large, cell: vec2(1.5e9, 1.5e9) }];
        let bins = Bins::new(UNIT, &one, 1e-9);
        for p in [Vec2::ZERO, vec2(0.5, 0.25), vec2(1.0, 1.0)] {
            assert_eq!(leaf_patches(&bins, p), [0]);
        }
    }
}
