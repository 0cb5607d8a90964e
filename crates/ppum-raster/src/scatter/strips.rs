//! Patches at a column of vectors that are the same in y, collapsed together.
//!
//! The weight is a product, W = a(x) b(y). Patches beside each other mostly have the same b, the
//! same coordinate η and the same functions. What they collapse to at a vector of columns,
//! polynomials in y, is then added coefficient by coefficient: a strip of patches costs a pixel
//! what one patch does, however narrow they are. Whether patches are the same is asked of their
//! numbers, so any cover is drawn, and where neighbours differ each is a strip of its own.
//!
//! Where a strip is alone, its b(y) cancels: the field is what its tables hold over Σ a.

use std::ops::Range;

use ppum::dataset::monomials;
use ppum::function::Slot;
use ppum::real::{Real, Scalar};

use super::collapse::{Across, Factor, ROWS, collapse, put_sum, table_len};
use super::plan::{Affine, COLUMNS, Patch};
use super::sums::{basis_len, size};
use super::tile::{Active, Listed, Scratch, Tile, union};
use crate::summation::Savings;

/// Groups of functions that are kept at a time for the strips of a tile, more if one strip has
/// them: 6 MB.
const MOST_ACTIVE: usize = 256;

/// Places to look for a strip, and how many of them before it is given up: patches that begin at
/// different rows of a tile never meet there.
const SLOTS: usize = 256;
const TRIES: usize = 4;

/// The strips at a column of vectors.
#[derive(Debug, Default)]
pub(super) struct Strips<T> {
    pub(super) all: Vec<Strip>,
    pub(super) terms: Vec<BlockTerm>,
    /// Of each strip the weight's factor and slope in x, then for each component the tables of
    /// its blocks.
    pub(super) tables: Vec<T>,
    /// The same over the weight's factor, of strips that are alone somewhere.
    pub(super) alone: Vec<T>,
    /// Of each strip the weight's factor and slope in y and η, by rows.
    pub(super) down: Vec<T>,
    /// The numbers in use.
    used: usize,
    /// The strips by the first row of their patches.
    slots: Vec<u32>,
}

/// Numbers of a strip in `down`.
pub(super) const DOWN: usize = 3 * ROWS;

/// Patches that are the same in y.
#[derive(Clone, Debug)]
pub(super) struct Strip {
    /// Coordinates in y, of the support and of the polynomials.
    support: Affine,
    pub(super) frame: Affine,
    kind: u32,
    /// The rows of the tile that they may cover.
    pub(super) rows: Range<usize>,
    /// Its tables.
    pub(super) table: usize,
    /// Length of a component's tables.
    pub(super) len: usize,
    pub(super) terms: Range<usize>,
    /// True if they cover the whole vector.
    pub(super) is_full: bool,
    /// True if its tables over the weight's factor are there.
    pub(super) is_divided: bool,
}

impl Strip {
    /// True if a patch has the same b(y), η(y), functions and degrees.
    fn joins(&self, patch: &Patch) -> bool {
        self.kind == patch.kind && self.support == patch.support[1] && self.frame == patch.frame[1]
    }
}

/// A block.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockTerm {
    pub(super) degree: usize,
    /// Length of its table.
    pub(super) len: usize,
    /// First number of its function in the basis; none for function 1.
    pub(super) function: Option<usize>,
}

impl<T: Scalar> Strips<T> {
    fn clear(&mut self) {
        self.all.clear();
        self.terms.clear();
        self.used = 0;
        self.slots.clear();
        self.slots.resize(SLOTS, u32::MAX);
    }

    /// The strip of a patch, or the slot for one.
    fn find(&self, patch: &Patch, joins: bool) -> Result<usize, usize> {
        let first = patch.rows.start as usize * TRIES % SLOTS;
        for slot in first..first + TRIES {
            let place = self.slots[slot] as usize;
            match self.all.get(place).filter(|_| joins) {
                None => return Err(slot),
                Some(strip) if strip.joins(patch) => return Ok(place),
                Some(_) => {}
            }
        }
        Err(first)
    }

    /// Makes room for a strip; the numbers in its tables are left over from others.
    fn push(&mut self, strip: Strip, len: usize, slot: usize) -> usize {
        let place = self.all.len();
        self.used += len;
        if self.tables.len() < self.used {
            self.tables.resize(self.used, T::default());
            self.alone.resize(self.used, T::default());
        }
        if self.down.len() < DOWN * (place + 1) {
            self.down.resize(DOWN * (place + 1), T::default());
        }
        self.slots[slot] = place as u32;
        self.all.push(strip);
        place
    }
}

/// True if there is no room for another strip.
fn is_full<T>(scratch: &Scratch<T>, numbers: usize) -> bool {
    let is_full = scratch.strips.used > numbers || scratch.active.len() > MOST_ACTIVE;
    is_full && !scratch.strips.all.is_empty()
}

/// The place of a group among the active ones, with others or as a new one, needed on some rows.
fn need(active: &mut Vec<Active>, places: &mut [u32], group: u32, rows: &Range<usize>) -> usize {
    let place = places[group as usize] as usize;
    if let Some(known) = active.get_mut(place).filter(|known| known.group == group) {
        known.rows = union(&known.rows, rows);
        return place;
    }
    places[group as usize] = active.len() as u32;
    active.push(Active { group, rows: rows.clone() });
    active.len() - 1
}

impl<T: Scalar, const D: usize> Tile<'_, '_, T, D> {
    /// Takes patches with their coefficients, less the constants that the tile subtracts.
    pub(super) fn take_patches(&self, patches: &[u32], scratch: &mut Scratch<T>) {
        let Scratch { coefficients, listed, shift, .. } = scratch;
        let plan = &self.scene.plan;
        coefficients.clear();
        listed.clear();
        for &index in patches {
            let patch = &plan.patches[index as usize];
            let [columns, _] = self.within(patch);
            let columns = first_bits(columns.end) & !first_bits(columns.start);
            listed.push(Listed { columns, patch: index, start: coefficients.len() });
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

    /// Collapses patches at a column of vectors to strips, from one of the list on as many as there
    /// is room for; returns the first that is left.
    #[inline(always)]
    pub(super) fn gather<R: Real<Scalar = T>>(
        &self,
        vector: usize,
        from: usize,
        scratch: &mut Scratch<T>,
        zero: R,
    ) -> usize {
        let plan = &self.scene.plan;
        let Savings { merge_patches, table_numbers, .. } = self.scene.savings;
        scratch.strips.clear();
        scratch.active.clear();
        let pixel = self.corner()[0] + vector * R::LANES;
        let x = zero.load(&self.scene.xs[pixel..]);
        let columns = first_bits(R::LANES) << (vector * R::LANES);
        let mut next = from;
        while next < scratch.listed.len() {
            let listed = scratch.listed[next];
            if listed.columns & columns != 0 {
                let patch = (&plan.patches[listed.patch as usize], listed.start);
                match scratch.strips.find(patch.0, merge_patches) {
                    Ok(place) => self.collapse::<R, true>(patch, place, (x, pixel), scratch),
                    Err(_) if is_full(scratch, table_numbers) => break,
                    Err(slot) => {
                        let place = self.add_strip(listed.patch, slot, scratch, zero);
                        self.collapse::<R, false>(patch, place, (x, pixel), scratch);
                    }
                }
            }
            next += 1;
        }
        let Strips { all, tables, .. } = &mut scratch.strips;
        for strip in all {
            strip.is_full = !R::any(zero.ge(zero.load(&tables[strip.table..])));
        }
        next
    }

    /// A strip of one patch, whose tables are still to be filled.
    #[inline(always)]
    fn add_strip<R: Real<Scalar = T>>(
        &self,
        index: u32,
        slot: usize,
        scratch: &mut Scratch<T>,
        zero: R,
    ) -> usize {
        let Scratch { strips, places, active, shift, .. } = scratch;
        let patch = &self.scene.plan.patches[index as usize];
        let [_, rows] = self.within(patch);
        let (first, mut len) = (strips.terms.len(), 0);
        for block in &self.scene.plan.blocks[patch.blocks()] {
            let degree = block.degree.into();
            let function = match block.function {
                Slot::One => None,
                Slot::Jet { group, entry } => {
                    let place = need(active, places, group, &rows);
                    Some(place * basis_len::<R, D>() + entry as usize * size::<R, D>())
                }
            };
            strips.terms.push(BlockTerm { degree, len: table_len::<R, D>(degree), function });
            len += table_len::<R, D>(degree);
        }
        let strip = Strip {
            support: patch.support[1],
            frame: patch.frame[1],
            kind: patch.kind,
            rows: rows.clone(),
            table: strips.used,
            len,
            terms: first..strips.terms.len(),
            is_full: false,
            is_divided: false,
        };
        let place = strips.push(strip, weight_len::<R, D>() + len * shift.len(), slot);
        let down = &mut strips.down[DOWN * place..][..DOWN];
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
    /// columns to the tables of its strip, or adds it.
    #[inline(always)]
    fn collapse<R: Real<Scalar = T>, const ADD: bool>(
        &self,
        (patch, from): (&Patch, usize),
        place: usize,
        (x, pixel): (R, usize),
        scratch: &mut Scratch<T>,
    ) {
        let Scratch { strips: Strips { all, terms, tables, .. }, coefficients, shift, .. } =
            scratch;
        let strip = &all[place];
        let terms = &terms[strip.terms.clone()];
        let tables = &mut tables[strip.table..];
        let factor = self.factor(x, patch.support[0], pixel);
        put_sum::<R, ADD>(factor.value, tables);
        if D >= 1 {
            put_sum::<R, ADD>(factor.slope, &mut tables[R::LANES..]);
        }
        let scaled = factor.value * x.lit(patch.frame[0].scale);
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
    pub(super) fn factor<R: Real<Scalar = T>>(
        &self,
        offset: R,
        support: Affine,
        pixel: usize,
    ) -> Factor<R> {
        let xi = place_of(offset, support);
        if self.scene.plan.is_overlap {
            let (zero, one) = (xi.lit(0.0), xi.lit(1.0));
            let inside = R::select(xi.ge(-one), R::select(one.gt(xi), one, zero), zero);
            return Factor { value: inside, slope: zero };
        }
        if let Some(factor) = self.scene.weights.factor(support, pixel, offset) {
            return factor;
        }
        let [value, slope, _] = self.scene.weight.spline(xi);
        Factor { value, slope: slope * xi.lit(support.scale) }
    }

    /// Divides the tables of a strip by the weight's factor.
    #[inline(always)]
    pub(super) fn divide_strip<R: Real<Scalar = T>>(
        &self,
        strip: &mut Strip,
        (from, to): (&[T], &mut [T]),
        components: usize,
        zero: R,
    ) {
        strip.is_divided = true;
        let len = weight_len::<R, D>() + strip.len * components;
        let (from, to) = (&from[strip.table..][..len], &mut to[strip.table..][..len]);
        let inverse = zero.lit(1.0) / zero.load(from);
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

/// Length of the weight's part of a table.
#[inline(always)]
pub(super) const fn weight_len<R: Real, const D: usize>() -> usize {
    (1 + D) * R::LANES
}

/// A number whose lowest bits are set, at most all of them.
#[inline(always)]
const fn first_bits(count: usize) -> u64 {
    if count < COLUMNS { (1 << count) - 1 } else { u64::MAX }
}

/// A coordinate at an offset.
#[inline(always)]
pub(super) fn place_of<R: Real>(offset: R, affine: Affine) -> R {
    offset.mul_add(offset.lit(affine.scale), offset.lit(affine.shift))
}
