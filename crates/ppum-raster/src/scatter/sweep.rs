//! The spans at a column of vectors, and the spans of rows that they cover.
//!
//! A column's rows fall into spans with a constant list of spans. Where one span is alone, it is
//! the field: φ = 1, and neither a weight is needed nor a quotient. Elsewhere they are summed; both
//! in `sums`.

use std::ops::Range;

use ppum::real::{LaneNumber, Real};

use super::collapse::{ANY, ROWS};
use super::spans::{ColumnSpan, DOWN};
use super::sums::RowSums;
use super::tile::{PatchBatch, Tile, TileScratch};

impl<T: LaneNumber, const D: usize> Tile<'_, '_, T, D> {
    /// Adds the spans at a column of vectors to the sums that begin at `start`; behind the last
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
            let end = choose(&scratch.spans.all, row, &mut scratch.here);
            if self.is_alone(row..end, batch, scratch) {
                self.divide_alone(scratch, zero);
                self.sum::<R, true>(row..end, start, batch, scratch, zero);
            } else {
                self.sum::<R, false>(row..end, start, batch, scratch, zero);
            }
            row = end;
        }
    }

    /// True if rows are covered by one span, and whole vectors of them.
    #[inline(always)]
    fn is_alone(&self, rows: Range<usize>, batch: PatchBatch, scratch: &TileScratch<T>) -> bool {
        let [at] = *scratch.here else { return false };
        let spans = &scratch.spans;
        // a weight is positive between any two places where it is
        let is_covered = |row: usize| spans.down[DOWN * at + row] > T::default();
        let has_components = !self.scene.plan.coefficients.is_empty();
        let covers = spans.all[at].is_full && is_covered(rows.start) && is_covered(rows.end - 1);
        let is_only = batch.is_first && batch.is_last;
        covers && is_only && has_components && self.scene.savings.cancel_weights
    }

    #[inline(always)]
    fn divide_alone<R: Real<Scalar = T>>(&self, scratch: &mut TileScratch<T>, zero: R) {
        let TileScratch { spans, here, shift, .. } = scratch;
        let span = &mut spans.all[here[0]];
        if !span.is_divided {
            let tables = (&*spans.tables, &mut *spans.alone);
            self.divide_span(span, tables, shift.len(), zero);
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
        let TileScratch { spans, here, basis, sums, .. } = scratch;
        let span = RowSums {
            rows,
            spans: &spans.all,
            here,
            terms: &spans.terms,
            tables: if ALONE { &spans.alone } else { &spans.tables },
            down: &spans.down,
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

/// Lists the spans that are at a row; returns up to which row there are no others.
fn choose(spans: &[ColumnSpan], row: usize, here: &mut Vec<usize>) -> usize {
    here.clear();
    let mut end = ROWS;
    for (at, span) in spans.iter().enumerate() {
        let Range { start, end: stop } = span.rows;
        if start > row {
            end = end.min(start);
        } else if stop > row {
            end = end.min(stop);
            here.push(at);
        }
    }
    end
}
