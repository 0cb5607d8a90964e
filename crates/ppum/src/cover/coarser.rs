//! Coarser covers: cells twice as wide where that can be.

use super::{Cover, CoverError, CoverNode, NodeCell};
use crate::vec2::{Rect, Vec2};

impl Cover {
    /// The cover whose cells are twice as wide as the ones of this cover in their places, as far as
    /// balance allows; none if this one is a single cell.
    ///
    /// A grid of root cells becomes one of half as many in each direction, with the depths of the
    /// trees kept; where it is one cell wide, four sibling leaves become one. Each cell holds whole
    /// cells of this cover. So where a number is odd the last cells reach beyond the domain: it
    /// grows by one cell. Points that generated cells are forgotten.
    #[must_use]
    pub fn coarser(&self) -> Option<Self> {
        let [columns, rows] = self.grid.roots;
        if columns.min(rows) > 1 || self.nodes.len() == self.n_leaves && columns.max(rows) > 1 {
            self.on_coarser_grid().ok()
        } else if self.n_leaves > 1 {
            self.merged().ok()
        } else {
            None
        }
    }

    /// Half as many root cells in each direction.
    fn on_coarser_grid(&self) -> Result<Self, CoverError> {
        let roots = self.grid.roots.map(|n| n.div_ceil(2));
        let mut coarse = Self::grid(self.whole(roots), roots)?;
        let leaves = self.leaves();
        loop {
            // of each node, the level of the widest cell of this cover in it
            let mut widest = vec![u8::MAX; coarse.nodes.len()];
            for leaf in &leaves {
                let place = coarse.leaf_at(self.grid.middle(leaf.cell));
                widest[place.node] = widest[place.node].min(leaf.cell.level);
            }
            let mut deeper = coarse.leaves();
            deeper
                .retain(|leaf| widest[leaf.node] != u8::MAX && widest[leaf.node] > leaf.cell.level);
            if deeper.is_empty() {
                return Ok(coarse);
            }
            coarse.split_all(&deeper)?;
            coarse.balance()?;
        }
    }

    /// The box of so many cells twice as wide.
    fn whole(&self, roots: [u32; 2]) -> Rect {
        let Rect { min, max } = self.grid.domain;
        let end = |min: f64, max: f64, own: u32, wide: u32| match 2 * wide == own {
            true => max,
            false => min + (max - min) * (2.0 * f64::from(wide) / f64::from(own)),
        };
        let [columns, rows] = self.grid.roots;
        let max =
            Vec2 { x: end(min.x, max.x, columns, roots[0]), y: end(min.y, max.y, rows, roots[1]) };
        Rect { min, max }
    }

    /// The leaf that holds a point of the closed domain.
    fn leaf_at(&self, p: Vec2) -> NodeCell {
        let mut place = self.root(self.grid.root_of(p));
        while !self.nodes[place.node].is_leaf() {
            place = self.child(place, self.grid.quadrant_of(place.cell, p));
        }
        place
    }

    /// Four sibling leaves become one.
    fn merged(&self) -> Result<Self, CoverError> {
        let mut coarse = Self::grid(self.grid.domain, self.grid.roots)?;
        let mut waiting: Vec<_> =
            self.roots.iter().map(|&cell| (self.root(cell), coarse.root(cell))).collect();
        while let Some((old, new)) = waiting.pop() {
            let children = || (0..4).map(|quadrant| self.child(old, quadrant));
            let stays = |node: CoverNode| !node.is_leaf();
            if stays(self.nodes[old.node]) && children().any(|c| stays(self.nodes[c.node])) {
                coarse.split(new)?;
                let pairs = children().zip((0..4).map(|quadrant| coarse.child(new, quadrant)));
                waiting.extend(pairs.collect::<Vec<_>>());
            }
        }
        coarse.balance()?;
        Ok(coarse)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vec2::vec2;

    fn domain() -> Rect {
        Rect::new(vec2(-1.0, 0.0), vec2(2.0, 1.5))
    }

    #[test]
    fn uniform_covers_lose_a_level() {
        let mut cover = Cover::uniform(domain(), 4).expect("a cover");
        for level in (0..4).rev() {
            cover = cover.coarser().expect("a coarser cover");
            let expected = Cover::uniform(domain(), level).expect("a cover");
            assert_eq!(cover.cells(), expected.cells());
        }
        assert!(cover.coarser().is_none());
    }

    /// Odd numbers: the last cells reach beyond the domain, which has the corners (−1, 0) and
    /// (2, 1.5).
    #[test]
    fn grids_have_half_as_many_cells_in_each_direction() {
        for (cells, coarse, end) in [
            ([6, 4], [3, 2], vec2(2.0, 1.5)),
            ([5, 3], [3, 2], vec2(-1.0 + 3.0 * 6.0 / 5.0, 2.0)),
            ([3, 1], [2, 1], vec2(3.0, 3.0)),
        ] {
            let found = Cover::grid(domain(), cells).expect("a grid").coarser();
            let found = found.expect("a coarser grid").cells();
            let expected =
                Cover::grid(Rect::new(domain().min, end), coarse).expect("a grid").cells();
            assert_eq!(found.len(), expected.len());
            for ((a, _), (b, _)) in found.iter().zip(&expected) {
                assert!(
                    (a.min - b.min).length() + (a.max - b.max).length() < 1e-14,
                    "{a:?}, not {b:?}"
                );
            }
        }
    }

    /// Towards a point: each cell of the coarser cover holds cells no wider than itself, and half
    /// of them at least are less wide; the cover stays balanced; in the end there is one cell.
    #[test]
    fn graded_covers_become_coarser_everywhere() {
        for roots in [[1, 1], [4, 2], [5, 3]] {
            let mut cover = Cover::grid(domain(), roots).expect("a grid");
            let tip = vec2(0.2137, 0.841);
            for depth in 2..9 {
                cover
                    .refine(|cell, level| level < 2 || cell.contains(tip) && level < depth)
                    .expect("a cover");
            }
            while let Some(coarse) = cover.coarser() {
                assert!(coarse.n_cells() < cover.n_cells());
                let wide = |cell: &Rect| cell.size().x;
                for (cell, _) in coarse.cells() {
                    let inside: Vec<_> = cover
                        .cells()
                        .into_iter()
                        .filter(|(c, _)| cell.contains(c.center()))
                        .collect();
                    assert!(
                        !inside.is_empty() || !domain().contains(cell.min + cell.size() * 1e-9)
                    );
                    assert!(inside.iter().all(|(c, _)| wide(c) <= 1.01 * wide(&cell)));
                }
                let mut balanced = coarse.clone();
                balanced.balance().expect("room");
                assert_eq!(balanced.n_cells(), coarse.n_cells());
                cover = coarse;
            }
            assert_eq!(cover.n_cells(), 1);
        }
    }
}
