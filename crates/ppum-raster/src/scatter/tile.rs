//! A tile of pixels, and the buffers of the thread that draws it.

use std::ops::Range;

use ppum::formula::BlockScratch as FormulaScratch;
use ppum::real::{LaneNumber, Real};

use super::collapse::{ROWS, fill_lanes};
use super::layout::size;
use super::plan::{COLUMNS, PatchBlock, VisiblePatch};
use super::spans::ColumnSpans;
use super::view_data::PreparedView;

/// Buffers of one thread.
#[derive(Debug, Default)]
pub(super) struct TileScratch<T> {
    /// At the vectors of points of a column: Σ W, then Σ W v of each component, each with
    /// derivatives; when all patches are there, the field's components in place of these. Sums of
    /// all columns where patches come in batches.
    pub(super) sums: Vec<T>,
    /// The functions of each active group with derivatives, at the vectors of a column.
    pub(super) basis: Vec<T>,
    /// Working space of formulas.
    pub(super) formulas: FormulaScratch<T>,
    /// The groups in `basis`.
    pub(super) active: Vec<ActiveGroup>,
    /// The position of each group among the active ones, if it is one of them.
    pub(super) places: Vec<u32>,
    /// The patches at hand.
    pub(super) spans: ColumnSpans<T>,
    pub(super) patch_sums: PatchSums<T>,
    /// Those of the spans that cover some rows.
    pub(super) here: Vec<usize>,
    /// Subtracted from each component.
    pub(super) shift: Vec<f64>,
    /// For each patch of the tile, then for each component, the coefficients of its blocks.
    pub(super) coefficients: Vec<T>,
    pub(super) listed: Vec<TilePatch>,
}

/// The sums of a tile, and the patch at hand. Memory that a thread uses again.
#[derive(Debug, Default)]
pub(super) struct PatchSums<T> {
    pub(super) found: Vec<u32>,
    /// The blocks of the patch; the first is of function 1.
    pub(super) blocks: Vec<PatchBlock>,
    /// For each component, the coefficients of the first block, less the constant that the tile
    /// subtracts.
    pub(super) smooth: Vec<T>,
    /// By rows, then numbers: W with derivatives, then W v of each component.
    pub(super) sums: Vec<T>,
}

/// A patch of a tile.
#[derive(Clone, Copy, Debug)]
pub(super) struct TilePatch {
    /// A bit for each column of the tile that it covers.
    pub(super) columns: u64,
    pub(super) patch: u32,
    /// The first of its coefficients.
    pub(super) start: usize,
}

/// A group of functions needed on some rows of a tile.
#[derive(Debug)]
pub(super) struct ActiveGroup {
    pub(super) group: u32,
    pub(super) rows: Range<usize>,
}

/// Patches of a tile that are summed together.
#[derive(Clone, Copy, Debug)]
pub(super) struct PatchBatch {
    /// Nothing is summed before it, or after it.
    pub(super) is_first: bool,
    pub(super) is_last: bool,
}

/// One tile.
pub(super) struct Tile<'a, 'f, T, const D: usize> {
    pub(super) scene: &'a PreparedView<'f, T>,
    pub(super) column: usize,
    pub(super) band: usize,
}

impl<'a, 'f, T: LaneNumber, const D: usize> Tile<'a, 'f, T, D> {
    #[inline(always)]
    pub(super) fn new(scene: &'a PreparedView<'f, T>, column: usize, band: usize) -> Self {
        Self { scene, column, band }
    }

    /// First column and row.
    #[inline(always)]
    pub(super) fn corner(&self) -> [usize; 2] {
        [self.column * COLUMNS, self.band * ROWS]
    }

    /// Numbers at a vector of points.
    #[inline(always)]
    pub(super) fn stride<R: Real<Scalar = T>>(&self) -> usize {
        size::<R, D>() * (1 + self.scene.plan.coefficients.len())
    }

    /// The columns and rows of the tile that a patch may cover.
    #[inline(always)]
    pub(super) fn within(&self, patch: &VisiblePatch) -> [Range<usize>; 2] {
        let [column, row] = self.corner();
        [within(&patch.columns, column, COLUMNS), within(&patch.rows, row, ROWS)]
    }

    /// A vector of points relative to the view's centre.
    #[inline(always)]
    pub(super) fn offset<R: Real<Scalar = T>>(&self, vector: usize, row: usize, zero: R) -> [R; 2] {
        let [column, first_row] = self.corner();
        let x = zero.load(&self.scene.xs[column + vector * R::LANES..]);
        [x, fill_lanes(zero, self.scene.ys[first_row + row])]
    }
}

/// The part of a range in `start .. start + count`, relative to the start.
#[inline(always)]
fn within(range: &Range<u32>, start: usize, count: usize) -> Range<usize> {
    let [from, to] =
        [range.start as usize, range.end as usize].map(|k| k.clamp(start, start + count));
    from - start..to - start
}
