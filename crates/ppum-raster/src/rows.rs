//! The rows of a view that are evaluated, and how many of them at a time.

use std::ops::Range;

use crate::view::View;

/// Rows of a band: what one thread evaluates at a time.
pub const BAND: u32 = 32;

/// The rows that are evaluated, and how many of them at a time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowBatches {
    /// The rows; the first is a multiple of [`BAND`].
    rows: Range<u32>,
    /// Rows of a batch, rounded up to whole bands.
    height: u32,
}

impl RowBatches {
    /// Some rows, so many at a time.
    pub(crate) fn new(rows: Range<u32>, height: u32) -> Self {
        Self { rows, height }
    }

    /// All rows of a view.
    pub(crate) fn whole(view: &View, height: u32) -> Self {
        Self { rows: 0..view.pixels[1], height }
    }

    /// The batches, each a range of rows.
    pub(crate) fn each(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        let (first, end) = (self.rows.start as usize, self.rows.end as usize);
        let band = BAND as usize;
        let height = (self.height as usize).div_ceil(band).max(1) * band;
        (first..end).step_by(height).map(move |row| row..end.min(row + height))
    }

    /// The number of bands.
    pub(crate) fn bands(&self) -> usize {
        self.rows.len().div_ceil(BAND as usize)
    }
}
