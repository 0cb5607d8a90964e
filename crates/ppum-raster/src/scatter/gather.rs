//! The patches at a column of vectors, collapsed to spans.

use std::ops::Range;

use ppum::dataset::monomials;
use ppum::function::Slot;
use ppum::real::{LaneNumber, Real};

use super::collapse::{Across, ROWS, WeightFactor, collapse, put_sum, table_len};
use super::layout::{basis_len, size, weight_len};
use super::plan::{Affine, COLUMNS, VisiblePatch};
use super::spans::{BlockTerm, ColumnSpan, ColumnSpans, DOWN};
use super::tile::{ActiveGroup, Tile, TilePatch, TileScratch};
use crate::summation::Savings;

/// Groups of functions that are kept at a time for the spans of a tile, more if one span has
/// them: 6 MB.
const MOST_ACTIVE: usize = 256;

/// True if there is no room for another span.
#[inline]
fn is_full<T>(scratch: &TileScratch<T>, numbers: usize) -> bool {
    let is_full = scratch.spans.used > numbers || scratch.active.len() > MOST_ACTIVE;
    is_full && !scratch.spans.all.is_empty()
}

/// The place of a group among the active ones, with others or as a new one, needed on some rows.
#[inline]
fn need(
    active: &mut Vec<ActiveGroup>,
    places: &mut [u32],
    group: u32,
    rows: &Range<usize>,
) -> usize {
    let place = places[group as usize] as usize;
    if let Some(known) = active.get_mut(place).filter(|known| known.group == group) {
        known.rows = union(&known.rows, rows);
        return place;
    }
    places[group as usize] = active.len() as u32;
    active.push(ActiveGroup { group, rows: rows.clone() });
    active.len() - 1
}

#[inline]
fn union(a: &Range<usize>, b: &Range<usize>) -> Range<usize> {
    a.start.min(b.start)..a.end.max(b.end)
}

impl<T: LaneNumber, const D: usize> Tile<'_, '_, T, D> {
    /// Takes patches with their coefficients, less the constants that the tile subtracts.
    pub(super) fn take_patches(&self, patches: &[u32], scratch: &mut TileScratch<T>) {
        let TileScratch { coefficients, listed, shift, .. } = scratch;
        let plan = &self.scene.plan;
        coefficients.clear();
        listed.clear();
        for &index in patches {
            let patch = &plan.patches[index as usize];
            let [columns, _] = self.within(patch);
            let columns = first_bits(columns.end) & !first_bits(columns.start);
            listed.push(TilePatch { columns, patch: index, start: coefficients.len() });
            let blocks = &plan.blocks[patch.blocks()];
            for (component, &shift) in shift.iter().enumerate() {
                let first = coefficients.len();
                for block in blocks {
                    let all = plan.block_coefficients(block, component);
                    let all = &all[..monomials(block.degree.into())];
                    coefficients.extend(all.iter().map(|&c| T::from_f64(c)));
                }
                let constant = plan.block_coefficients(&blocks[0], component)[0];
                coefficients[first] = T::from_f64(constant - shift);
            }
        }
    }

    /// Collapses patches at a column of vectors to spans, from one of the list on as many as there
    /// is room for; returns the first that is left.
    #[inline(always)]
    pub(super) fn gather<R: Real<Scalar = T>>(
        &self,
        vector: usize,
        from: usize,
        scratch: &mut TileScratch<T>,
        zero: R,
    ) -> usize {
        let plan = &self.scene.plan;
        let Savings { merge_patches, table_numbers, .. } = self.scene.savings;
        scratch.spans.clear();
        scratch.active.clear();
        let pixel = self.corner()[0] + vector * R::LANES;
        let x = zero.load(&self.scene.xs[pixel..]);
        let columns = first_bits(R::LANES) << (vector * R::LANES);
        let mut next = from;
        while next < scratch.listed.len() {
            let listed = scratch.listed[next];
            if listed.columns & columns != 0 {
                let patch = (&plan.patches[listed.patch as usize], listed.start);
                match scratch.spans.find(patch.0, merge_patches) {
                    Ok(place) => self.collapse::<R, true>(patch, place, (x, pixel), scratch),
                    Err(_) if is_full(scratch, table_numbers) => break,
                    Err(slot) => {
                        let place = self.add_span(listed.patch, slot, scratch, zero);
                        self.collapse::<R, false>(patch, place, (x, pixel), scratch);
                    }
                }
            }
            next += 1;
        }
        let ColumnSpans { all, tables, .. } = &mut scratch.spans;
        for span in all {
            span.is_full = !R::any(zero.ge(zero.load(&tables[span.table..])));
        }
        next
    }

    /// A span of one patch, whose tables are still to be filled.
    #[inline(always)]
    fn add_span<R: Real<Scalar = T>>(
        &self,
        index: u32,
        slot: usize,
        scratch: &mut TileScratch<T>,
        zero: R,
    ) -> usize {
        let TileScratch { spans, places, active, shift, .. } = scratch;
        let patch = &self.scene.plan.patches[index as usize];
        let [_, rows] = self.within(patch);
        let (first, mut len) = (spans.terms.len(), 0);
        for block in &self.scene.plan.blocks[patch.blocks()] {
            let degree = block.degree.into();
            let function = match block.function {
                Slot::One => None,
                Slot::Jet { group, entry } => {
                    let place = need(active, places, group, &rows);
                    Some(place * basis_len::<R, D>() + entry as usize * size::<R, D>())
                }
            };
            spans.terms.push(BlockTerm { degree, len: table_len::<R, D>(degree), function });
            len += table_len::<R, D>(degree);
        }
        let span = ColumnSpan {
            support: patch.support[1],
            frame: patch.frame[1],
            kind: patch.kind,
            rows: rows.clone(),
            table: spans.used,
            len,
            terms: first..spans.terms.len(),
            is_full: false,
            is_divided: false,
        };
        let place = spans.push(span, weight_len::<R, D>() + len * shift.len(), slot);
        let down = &mut spans.down[DOWN * place..][..DOWN];
        let mut lane = rows.start / R::LANES * R::LANES;
        while lane < rows.end {
            let first = self.corner()[1] + lane;
            let y = zero.load(&self.scene.ys[first..]);
            let b = self.factor(y, patch.support[1], first);
            b.value.store(&mut down[lane..]);
            b.slope.store(&mut down[ROWS + lane..]);
            place_of(y, patch.frame[1]).store(&mut down[2 * ROWS + lane..]);
            lane += R::LANES;
        }
        place
    }

    /// Writes what a patch, whose coefficients begin at a place, collapses to at a vector of
    /// columns to the tables of its span, or adds it.
    #[inline(always)]
    fn collapse<R: Real<Scalar = T>, const ADD: bool>(
        &self,
        (patch, from): (&VisiblePatch, usize),
        place: usize,
        (x, pixel): (R, usize),
        scratch: &mut TileScratch<T>,
    ) {
        let TileScratch {
            spans: ColumnSpans { all, terms, tables, .. }, coefficients, shift, ..
        } = scratch;
        let span = &all[place];
        let terms = &terms[span.terms.clone()];
        let tables = &mut tables[span.table..];
        let factor = self.factor(x, patch.support[0], pixel);
        put_sum::<R, ADD>(factor.value, tables);
        if D >= 1 {
            put_sum::<R, ADD>(factor.slope, &mut tables[R::LANES..]);
        }
        let scaled = factor.value * x.broadcast(patch.frame[0].scale);
        let across = Across { xi: place_of(x, patch.frame[0]), factor, scaled };
        let (mut at, mut coefficients) = (weight_len::<R, D>(), &coefficients[from..]);
        for _ in 0..shift.len() {
            for term in terms {
                let (of_term, others) = coefficients.split_at(monomials(term.degree));
                collapse::<R, D, ADD>(of_term, term.degree, &across, &mut tables[at..]);
                at += term.len;
                coefficients = others;
            }
        }
    }

    /// One factor of the weight with its derivative in the world, at a vector of pixels with
    /// their offsets.
    #[inline(always)]
    fn factor<R: Real<Scalar = T>>(
        &self,
        offset: R,
        support: Affine,
        pixel: usize,
    ) -> WeightFactor<R> {
        let xi = place_of(offset, support);
        if self.scene.plan.is_overlap {
            let (zero, one) = (xi.broadcast(0.0), xi.broadcast(1.0));
            let inside = R::select(xi.ge(-one), R::select(one.gt(xi), one, zero), zero);
            return WeightFactor { value: inside, slope: zero };
        }
        if let Some(factor) = self.scene.weights.factor(support, pixel, offset) {
            return factor;
        }
        let [value, slope, _] = self.scene.weight.spline(xi);
        WeightFactor { value, slope: slope * xi.broadcast(support.scale) }
    }

    /// Divides the tables of a span by the weight's factor.
    #[inline(always)]
    pub(super) fn divide_span<R: Real<Scalar = T>>(
        &self,
        span: &mut ColumnSpan,
        (from, to): (&[T], &mut [T]),
        components: usize,
        zero: R,
    ) {
        span.is_divided = true;
        let len = weight_len::<R, D>() + span.len * components;
        let (from, to) = (&from[span.table..][..len], &mut to[span.table..][..len]);
        let inverse = zero.broadcast(1.0) / zero.load(from);
        let slope = if D >= 1 { zero.load(&from[R::LANES..]) } else { zero };
        let mut at = weight_len::<R, D>();
        while at < len {
            let a = zero.load(&from[at..]) * inverse;
            a.store(&mut to[at..]);
            if D >= 1 {
                let b = (zero.load(&from[at + R::LANES..]) - a * slope) * inverse;
                b.store(&mut to[at + R::LANES..]);
            }
            at += (1 + D) * R::LANES;
        }
    }
}

/// A number whose lowest bits are set, at most all of them.
#[inline(always)]
const fn first_bits(count: usize) -> u64 {
    if count < COLUMNS { (1 << count) - 1 } else { u64::MAX }
}

/// A coordinate at an offset.
#[inline(always)]
fn place_of<R: Real>(offset: R, affine: Affine) -> R {
    offset.mul_add(offset.broadcast(affine.scale), offset.broadcast(affine.shift))
}
