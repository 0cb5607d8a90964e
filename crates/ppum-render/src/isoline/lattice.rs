//! The lattice of pixel centres and the image's border.

use ppum::vec2::{Rect, Vec2, vec2};
use ppum_raster::raster::{Raster, RasterValue};
use ppum_raster::view::View;
use rayon::prelude::*;

use crate::pieces::Pieces;

/// A square by its row from below and its column from the left: in this order squares are sorted.
pub(super) type Cell = [u32; 2];

/// Values of a raster in f32 may be wrong by this part of the largest around; of f64 by next to
/// nothing. More does no harm: it only adds squares that are searched.
const DOUBT: f64 = 100.0;

/// Offsets of the lattice's columns and rows from the view's centre, rising: the pixel centres and
/// the image's border.
pub(super) struct SampleLattice {
    x: Vec<f64>,
    y: Vec<f64>,
}

impl SampleLattice {
    pub(super) fn new(view: &View) -> Self {
        let ([columns, rows], half) = (view.pixels, view.half());
        let x = (0..columns).map(|i| view.column_offset(i));
        let y = (0..rows).rev().map(|j| view.row_offset(j));
        let border = |half: f64, middle: Vec<f64>| {
            [-half].into_iter().chain(middle).chain([half]).collect::<Vec<_>>()
        };
        Self { x: border(half.x, x.collect()), y: border(half.y, y.collect()) }
    }

    /// Columns and rows of squares.
    fn size(&self) -> [u32; 2] {
        [self.x.len() as u32 - 1, self.y.len() as u32 - 1]
    }

    /// The square of a place.
    pub(super) fn rect(&self, [j, i]: Cell) -> Rect {
        self.block([j, i], [j + 1, i + 1])
    }

    /// The squares from one place up to another.
    fn block(&self, [j, i]: Cell, [to_j, to_i]: Cell) -> Rect {
        let at = |i: u32, j: u32| vec2(self.x[i as usize], self.y[j as usize]);
        Rect::new(at(i, j), at(to_i, to_j))
    }

    /// The squares that lines may pass through, sorted: those whose values lie on both sides of a
    /// level as far as the raster tells, those it knows nothing of, and those that something cuts.
    pub(super) fn candidates<T: RasterValue>(
        &self,
        raster: &Raster<T>,
        levels: &[f64],
        pieces: &Pieces<'_>,
    ) -> Vec<Cell> {
        let [columns, rows] = self.size();
        let mut cut = Vec::new();
        self.cut([0, 0], [rows, columns], pieces, &mut cut);
        let row = |j: u32| {
            let passes = move |i: &u32| self.may_pass(raster, levels, [j, *i]);
            (0..columns).filter(passes).map(move |i| [j, i])
        };
        let mut all: Vec<Cell> = (0..rows).into_par_iter().flat_map_iter(row).collect();
        all.extend(cut);
        all.sort_unstable();
        all.dedup();
        all
    }

    fn may_pass<T: RasterValue>(&self, raster: &Raster<T>, levels: &[f64], [j, i]: Cell) -> bool {
        let [columns, rows] = raster.size;
        if i == 0 || j == 0 || i == columns || j == rows {
            return true;
        }
        let (right, top) = (i, rows - 1 - j);
        let values = [(right - 1, top + 1), (right, top + 1), (right - 1, top), (right, top)]
            .map(|(column, row)| -> f64 { raster.value(column, row).into() });
        let (lo, hi) =
            values.iter().fold((values[0], values[0]), |(a, b), &v| (a.min(v), b.max(v)));
        let doubt = DOUBT * T::SAME * lo.abs().max(hi.abs());
        if values.iter().any(|v| v.is_nan()) {
            // outside, or cut by what ends the domain
            return false;
        }
        !doubt.is_finite()
            || levels.iter().any(|level| lo - doubt <= *level && *level <= hi + doubt)
    }

    /// The squares of a block that something cuts.
    fn cut(&self, from: Cell, to: Cell, pieces: &Pieces<'_>, out: &mut Vec<Cell>) {
        let size = [to[0] - from[0], to[1] - from[1]];
        if size.contains(&0) || !pieces.may_cut(&self.block(from, to)) {
            return;
        }
        if size == [1, 1] {
            out.push(from);
            return;
        }
        // the longer side is halved
        let axis = usize::from(size[1] > size[0]);
        let (mut end, mut begin) = (to, from);
        end[axis] = from[axis] + size[axis] / 2;
        begin[axis] = end[axis];
        self.cut(from, end, pieces, out);
        self.cut(begin, to, pieces, out);
    }

    /// The squares that have a side in common with one.
    pub(super) fn around(&self, [j, i]: Cell) -> impl Iterator<Item = Cell> {
        let ways = [[-1, 0], [0, -1], [1, 0], [0, 1]];
        ways.into_iter().filter_map(move |way| self.moved([j, i], way))
    }

    /// The square some rows and columns away, if there is one.
    fn moved(&self, [j, i]: Cell, [rows_up, columns_on]: [i32; 2]) -> Option<Cell> {
        let [columns, rows] = self.size();
        let [j, i] = [j.checked_add_signed(rows_up)?, i.checked_add_signed(columns_on)?];
        (j < rows && i < columns).then_some([j, i])
    }

    /// The square on the other side of a side of a square; `None` inside the square and on the
    /// image's border.
    pub(super) fn neighbour(&self, [j, i]: Cell, [a, b]: [Vec2; 2]) -> Option<Cell> {
        let rect = self.rect([j, i]);
        let on = |of: fn(Vec2) -> f64, at: f64| of(a) == at && of(b) == at;
        let (x, y) = (|p: Vec2| p.x, |p: Vec2| p.y);
        let way = match () {
            () if on(x, rect.min.x) => [0, -1],
            () if on(x, rect.max.x) => [0, 1],
            () if on(y, rect.min.y) => [-1, 0],
            () if on(y, rect.max.y) => [1, 0],
            () => return None,
        };
        self.moved([j, i], way)
    }

    /// True if a side lies on the image's border.
    pub(super) fn is_border(&self, [a, b]: [Vec2; 2]) -> bool {
        let ends = |list: &[f64]| [list[0], list[list.len() - 1]];
        ends(&self.x).iter().any(|&x| a.x == x && b.x == x)
            || ends(&self.y).iter().any(|&y| a.y == y && b.y == y)
    }
}
