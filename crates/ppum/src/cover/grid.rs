//! Integer coordinates of quadtree cells, and the one place where they become coordinates of edges.

use crate::vec2::{Rect, Vec2, vec2};

/// A cell of level `level`: column `x` and row `y` of the root grid halved `level` times.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct TreeCell {
    pub(super) level: u8,
    pub(super) x: u64,
    pub(super) y: u64,
}

impl TreeCell {
    /// The quadrant 0 … 3 in Z order: lower left, lower right, upper left, upper right.
    pub(super) fn child(self, quadrant: u32) -> Self {
        let (right, upper) = (u64::from(quadrant & 1), u64::from(quadrant >> 1));
        Self { level: self.level + 1, x: 2 * self.x + right, y: 2 * self.y + upper }
    }

    /// The cell of a coarser level that holds this one.
    pub(super) fn ancestor(self, level: u8) -> Self {
        let up = self.level - level;
        Self { level, x: self.x >> up, y: self.y >> up }
    }

    /// The quadrant of its parent that this cell is.
    pub(super) fn quadrant(self) -> u32 {
        (self.x & 1) as u32 + 2 * (self.y & 1) as u32
    }
}

/// The box of the domain, cut into `roots[0]` × `roots[1]` root cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct RootGrid {
    pub(super) domain: Rect,
    pub(super) roots: [u32; 2],
}

impl RootGrid {
    /// The cell as a box. Cells of any levels that share a boundary get the same bits for it.
    pub(super) fn rect(&self, cell: TreeCell) -> Rect {
        let corner = |x, y| vec2(self.border(0, x, cell.level), self.border(1, y, cell.level));
        Rect::new(corner(cell.x, cell.y), corner(cell.x + 1, cell.y + 1))
    }

    /// Position of grid line `k` of `level`: (min (n − k) + max k) / n with n lines in all.
    ///
    /// k and n are exact in f64, and going down a level doubles both and so changes no bit. Exact
    /// on lattices that f64 can hold, mirrored domains have mirrored lines.
    fn border(&self, axis: usize, k: u64, level: u8) -> f64 {
        let [min, max]: [f64; 2] = match axis {
            0 => [self.domain.min.x, self.domain.max.x],
            _ => [self.domain.min.y, self.domain.max.y],
        };
        let n = u64::from(self.roots[axis]) << level;
        match k {
            0 => min,
            _ if k == n => max,
            _ => (min * (n - k) as f64 + max * k as f64) / n as f64,
        }
    }

    /// The corner that the four quadrants of a cell share.
    pub(super) fn middle(&self, cell: TreeCell) -> Vec2 {
        let centre = cell.child(3);
        vec2(self.border(0, centre.x, centre.level), self.border(1, centre.y, centre.level))
    }

    /// The quadrant of `cell` that holds `p`; boundaries belong to the right and upper one.
    pub(super) fn quadrant_of(&self, cell: TreeCell, p: Vec2) -> u32 {
        let middle = self.middle(cell);
        u32::from(p.x >= middle.x) + 2 * u32::from(p.y >= middle.y)
    }

    /// The root cell that holds a point of the closed domain.
    pub(super) fn root_of(&self, p: Vec2) -> TreeCell {
        TreeCell { level: 0, x: self.root_line(0, p.x), y: self.root_line(1, p.y) }
    }

    /// The last root grid line at or below `v`, by bisection.
    fn root_line(&self, axis: usize, v: f64) -> u64 {
        let (mut low, mut high) = (0, u64::from(self.roots[axis]));
        while high - low > 1 {
            let line = u64::midpoint(low, high);
            if v >= self.border(axis, line, 0) { low = line } else { high = line }
        }
        low
    }

    /// The up to eight cells of the same level that touch `cell`.
    pub(super) fn neighbours(self, cell: TreeCell) -> impl Iterator<Item = TreeCell> {
        let [columns, rows] = self.roots.map(|n| u64::from(n) << cell.level);
        let around = |k: u64, n: u64| k.saturating_sub(1)..(k + 2).min(n);
        around(cell.y, rows)
            .flat_map(move |y| around(cell.x, columns).map(move |x| TreeCell { x, y, ..cell }))
            .filter(move |c| *c != cell)
    }
}
