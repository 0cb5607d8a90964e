//! The strips at a column of vectors, and the spans of rows that they cover.
//!
//! A column's rows fall into spans with a constant list of strips. Where one strip is alone, it is the field: φ = 1, and
//! neither a weight is needed nor a quotient. Elsewhere they are summed; both in `sums`.

use std::ops::Range;

use ppum::real::{Real, Scalar};

use super::collapse::{ANY, ROWS};
use super::strips::{Strip, Term, place_of};
use super::sums::{Entry, Span};
use super::tile::{Batch, Scratch, Tile};

impl<T: Scalar, const D: usize> Tile<'_, '_, T, D> {
    /// Adds the strips at a column of vectors to the sums that begin at `start`; behind the last batch these are quotients.
    #[inline(always)]
    pub(super) fn sweep<R: Real<Scalar = T>>(
        &self,
        vector: usize,
        start: usize,
        batch: Batch,
        scratch: &mut Scratch<T>,
        zero: R,
    ) {
        self.list(vector, scratch, zero);
        let mut row = 0;
        while row < ROWS {
            let end = choose(&scratch.entries, row, &mut scratch.here);
            if self.is_alone(batch, &scratch.entries, &scratch.here) {
                self.divide_alone(scratch, zero);
                self.sum::<R, true>(row..end, start, batch, scratch, zero);
            } else {
                self.sum::<R, false>(row..end, start, batch, scratch, zero);
            }
            row = end;
        }
    }

    /// Lists the strips at a column of vectors.
    #[inline(always)]
    fn list<R: Real<Scalar = T>>(&self, vector: usize, scratch: &mut Scratch<T>, zero: R) {
        let Scratch { strips, entries, across, .. } = scratch;
        entries.clear();
        let len = 3 * R::LANES;
        if across.len() < len * strips.all.len() {
            across.resize(len * strips.all.len(), T::default());
        }
        let pixel = self.corner()[0] + vector * R::LANES;
        let x = zero.load(&self.scene.xs[pixel..]);
        for (index, strip) in strips.all.iter().enumerate() {
            if !strip.part.vectors.contains(&vector) {
                continue;
            }
            let at = len * entries.len();
            let across = &mut across[at..][..len];
            let a = self.factor(x, strip.support, pixel);
            a.value.store(across);
            a.slope.store(&mut across[R::LANES..]);
            place_of(x, strip.frame).store(&mut across[2 * R::LANES..]);
            // a weight is positive between any two places where it is
            let [first, last] = [across[0], across[R::LANES - 1]];
            let is_full = first > T::default() && last > T::default();
            entries.push(entry(index, strip, &strips.terms, at, is_full));
        }
    }

    /// True if rows are covered by one strip, and whole vectors of them.
    #[inline(always)]
    fn is_alone(&self, batch: Batch, entries: &[Entry], here: &[usize]) -> bool {
        let has_components = !self.scene.plan.coefficients.is_empty();
        let is_only = batch.is_first && batch.is_last;
        let covers = matches!(*here, [at] if entries[at].is_full);
        covers && is_only && has_components && self.scene.savings.cancel_weights
    }

    #[inline(always)]
    fn divide_alone<R: Real<Scalar = T>>(&self, scratch: &mut Scratch<T>, zero: R) {
        let Scratch { strips, entries, here, shift, .. } = scratch;
        let strip = &mut strips.all[entries[here[0]].strip];
        if !strip.is_divided {
            let tables = (&*strips.tables, &mut *strips.alone);
            self.divide_strip(strip, tables, shift.len(), zero);
        }
    }

    /// The common cases, gradients of two components of degrees 1 to 4 on vectors, are compiled with these numbers as
    /// constants.
    #[inline(always)]
    fn sum<R: Real<Scalar = T>, const ALONE: bool>(
        &self,
        rows: Range<usize>,
        start: usize,
        batch: Batch,
        scratch: &mut Scratch<T>,
        zero: R,
    ) {
        let components = self.scene.plan.coefficients.len();
        let Scratch { strips, entries, here, across, basis, sums, .. } = scratch;
        let span = Span {
            rows,
            entries,
            here,
            terms: &strips.terms,
            tables: if ALONE { &strips.alone } else { &strips.tables },
            across,
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

fn entry(index: usize, strip: &Strip, terms: &[Term], across: usize, is_full: bool) -> Entry {
    Entry {
        strip: index,
        rows: strip.part.rows.clone(),
        table: strip.table,
        len: strip.len,
        terms: strip.terms.clone(),
        degree: terms.get(strip.terms.start).map_or(0, |term| term.degree),
        across,
        is_full,
    }
}

/// Lists the entries that are at a row; returns up to which row there are no others.
fn choose(entries: &[Entry], row: usize, here: &mut Vec<usize>) -> usize {
    here.clear();
    let mut end = ROWS;
    for (at, entry) in entries.iter().enumerate() {
        let Range { start, end: stop } = entry.rows;
        if start > row {
            end = end.min(start);
        } else if stop > row {
            end = end.min(stop);
            here.push(at);
        }
    }
    end
}
