//! The strips at a column of vectors, and the spans of rows that they cover.
//!
//! A column's rows fall into spans with a constant list of strips. Where one strip is alone, it is
//! the field: φ = 1, and neither a weight is needed nor a quotient. Elsewhere they are summed; both
//! in `sums`.

use std::ops::Range;

use ppum::real::{LaneNumber, Real};

use super::collapse::{ANY, ROWS};
use super::strips::{ColumnSpan, DOWN};
use super::sums::RowSums;
use super::tile::{PatchBatch, Tile, TileScratch};

impl<T: LaneNumber, const D: usize> Tile<'_, '_, T, D> {
    /// Adds the strips at a column of vectors to the sums that begin at `start`; behind the last
    /// batch these are quotients.
    #[inline(always)]
    pub(super) fn sweep<R: Real<Scalar = T>>(
        &self,
        start: usize,
        batch: PatchBatch,
        scratch: &mut TileScratch<T>,
        zero: R,
    ) {
        let mut row = 0;
        while row < ROWS {
            let end = choose(&scratch.strips.all, row, &mut scratch.here);
            if self.is_alone(row..end, batch, scratch) {
                self.divide_alone(scratch, zero);
                self.sum::<R, true>(row..end, start, batch, scratch, zero);
            } else {
                self.sum::<R, false>(row..end, start, batch, scratch, zero);
            }
            row = end;
        }
    }

    /// True if rows are covered by one strip, and whole vectors of them.
    #[inline(always)]
    fn is_alone(&self, rows: Range<usize>, batch: PatchBatch, scratch: &TileScratch<T>) -> bool {
        let [at] = *scratch.here else { return false };
        let strips = &scratch.strips;
        // a weight is positive between any two places where it is
        let is_covered = |row: usize| strips.down[DOWN * at + row] > T::default();
        let has_components = !self.scene.plan.coefficients.is_empty();
        let covers = strips.all[at].is_full && is_covered(rows.start) && is_covered(rows.end - 1);
        let is_only = batch.is_first && batch.is_last;
        covers && is_only && has_components && self.scene.savings.cancel_weights
    }

    #[inline(always)]
    fn divide_alone<R: Real<Scalar = T>>(&self, scratch: &mut TileScratch<T>, zero: R) {
        let TileScratch { strips, here, shift, .. } = scratch;
        let strip = &mut strips.all[here[0]];
        if !strip.is_divided {
            let tables = (&*strips.tables, &mut *strips.alone);
            self.divide_strip(strip, tables, shift.len(), zero);
        }
    }

    /// The common cases, gradients of two components of degrees 1 to 4 on vectors, are compiled
    /// with these numbers as constants.
    #[inline(always)]
    fn sum<R: Real<Scalar = T>, const ALONE: bool>(
        &self,
        rows: Range<usize>,
        start: usize,
        batch: PatchBatch,
        scratch: &mut TileScratch<T>,
        zero: R,
    ) {
        let components = self.scene.plan.coefficients.len();
        let TileScratch { strips, here, basis, sums, .. } = scratch;
        let span = RowSums {
            rows,
            strips: &strips.all,
            here,
            terms: &strips.terms,
            tables: if ALONE { &strips.alone } else { &strips.tables },
            down: &strips.down,
            basis,
            sums: &mut sums[start..],
            batch,
        };
        // in other instances constants save nothing that is worth compiling them six times
        if const { D == 0 || R::LANES == 1 } {
            return span.sum::<R, D, ANY, 1, ALONE>(components, zero);
        }
        match (span.common_degree(), components) {
            (1, 2) => span.sum::<R, D, 1, 2, ALONE>(components, zero),
            (2, 2) => span.sum::<R, D, 2, 2, ALONE>(components, zero),
            (3, 2) => span.sum::<R, D, 3, 2, ALONE>(components, zero),
            (4, 2) => span.sum::<R, D, 4, 2, ALONE>(components, zero),
            (_, 2) => span.sum::<R, D, ANY, 2, ALONE>(components, zero),
            _ => span.sum::<R, D, ANY, 1, ALONE>(components, zero),
        }
    }
}

/// Lists the strips that are at a row; returns up to which row there are no others.
fn choose(strips: &[ColumnSpan], row: usize, here: &mut Vec<usize>) -> usize {
    here.clear();
    let mut end = ROWS;
    for (at, strip) in strips.iter().enumerate() {
        let Range { start, end: stop } = strip.rows;
        if start > row {
            end = end.min(start);
        } else if stop > row {
            end = end.min(stop);
            here.push(at);
        }
    }
    end
}
