//! Places in cells that are smaller than what separates the first places of a search: cells are
//! refined where the field varies.

use ppum::crack::Side;
use ppum::field::LocalField;
use ppum::vec2::{Rect, Vec2, vec2};
use rayon::prelude::*;

use super::curves::best_first;
use super::{ExtremumSearch, Promise, STARTS, climb};

/// Cells wider than so many pixels have enough of them.
const WIDTH: f64 = 2.0;

/// Cells that are looked at, at most; of more every second, third … one.
const CELLS: usize = 1 << 13;

/// Places in a cell along each side, in parts of its size from its centre.
const PLACES: [f64; 3] = [-0.4, 0.03, 0.4];

/// A place and the scale of the steps from it.
type ClimbStart = (Vec2, f64);

impl ExtremumSearch<'_, '_> {
    /// The best place of each small cell, the most promising cells first.
    pub(super) fn in_small_cells(&self, sign: f64) -> Vec<Promise<ClimbStart>> {
        let cells = self.field.step.partition.cells();
        let is_small = |cell: &&Rect| {
            let size = cell.size();
            size.x.min(size.y) < WIDTH * self.pixel && self.region.rect.overlaps(&self.local(cell))
        };
        let small: Vec<&Rect> = cells.iter().filter(is_small).collect();
        let step = small.len().div_ceil(CELLS).max(1);
        let looked = small.into_par_iter().step_by(step).map_init(
            || self.field.at(self.region.anchor),
            |local, cell| self.in_cell(local, cell, sign),
        );
        best_first(looked.flatten_iter().collect(), STARTS)
    }

    /// A cell by offsets from the anchor.
    fn local(&self, cell: &Rect) -> Rect {
        Rect::new(cell.min - self.region.anchor, cell.max - self.region.anchor)
    }

    /// The highest place of a cell, with the height that there may be around it if it rises as it
    /// does from the lowest one.
    fn in_cell(
        &self,
        local: &mut LocalField<'_>,
        cell: &Rect,
        sign: f64,
    ) -> Option<Promise<ClimbStart>> {
        let cell = self.local(cell);
        let (center, size) = (cell.center(), cell.size());
        let (mut best, mut least) = (None, f64::INFINITY);
        for (x, y) in PLACES.iter().flat_map(|x| PLACES.map(|y| (*x, y))) {
            let at = center + vec2(size.x * x, size.y * y);
            if !self.is_seen(at) || self.is_hidden(at) {
                continue;
            }
            let value = self.slope.quantity().at(local, at, Side::Above);
            let height = sign * climb::finite(value);
            least = least.min(height);
            if best.is_none_or(|(highest, _)| height > highest) && !height.is_nan() {
                best = Some((height, at));
            }
        }
        let (highest, at) = best?;
        let scale = PLACES[2] * size.x.min(size.y);
        Some((2.0 * highest - least, (at, scale)))
    }
}
