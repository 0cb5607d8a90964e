//! Patches of a tile that are the same in x, collapsed together.
//!
//! The weight is a product, W = a(x) b(y). Patches above each other mostly have the same a, the same coordinate ξ and the
//! same functions. What they collapse to on a row, polynomials in x, is then added coefficient by coefficient: a strip
//! of patches costs a pixel what one patch does. Whether patches are the same is asked of their numbers, so any
//! cover is drawn, and where neighbours differ each is a strip of its own.
//!
//! Where a strip is alone, its a(x) cancels: the field is what its tables hold over Σ b.

use std::ops::Range;

use ppum::function::Slot;
use ppum::real::{Real, Scalar};

use super::collapse::{Factor, ROWS, Rows, collapse, polynomials, put, table_len};
use super::plan::{Affine, Block, Patch, Plan};
use super::sums::{basis_len, size};
use super::tile::{Active, Part, Scratch, Tile, union};

/// Groups of functions that are kept at a time for the strips of a tile, more if one strip has them: 6 MB.
const MOST_ACTIVE: usize = 256;

/// Places to look for a strip, and how many of them before it is given up: patches that begin at different columns of a tile
/// never meet there.
const SLOTS: usize = 256;
const TRIES: usize = 4;

/// The strips of a tile.
#[derive(Debug, Default)]
pub(super) struct Strips<T> {
    pub(super) all: Vec<Strip>,
    pub(super) terms: Vec<Term>,
    /// Of each strip the weight's factor and slope in y, then for each component the tables of its blocks.
    pub(super) tables: Vec<T>,
    /// The same over the weight's factor, of strips that are alone somewhere.
    pub(super) alone: Vec<T>,
    /// The numbers in use.
    used: usize,
    /// The strips by the first column of their patches.
    slots: Vec<u32>,
}

/// Patches that are the same in x.
#[derive(Clone, Debug)]
pub(super) struct Strip {
    /// The first of them.
    patch: u32,
    pub(super) support: Affine,
    pub(super) frame: Affine,
    /// The part of the tile that they may cover.
    pub(super) part: Part,
    /// Its tables.
    pub(super) table: usize,
    /// Length of a component's tables.
    pub(super) len: usize,
    pub(super) terms: Range<usize>,
    /// True if its tables over the weight's factor are there.
    pub(super) is_divided: bool,
}

/// A block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Term {
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
    fn find(&self, plan: &Plan<'_>, patch: &Patch, joins: bool) -> Result<usize, usize> {
        let first = patch.columns.start as usize * TRIES % SLOTS;
        for slot in first..first + TRIES {
            let place = self.slots[slot] as usize;
            match self.all.get(place).filter(|_| joins) {
                None => return Err(slot),
                Some(strip) if are_same(plan, patch, &plan.patches[strip.patch as usize]) => {
                    return Ok(place);
                }
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
        self.slots[slot] = place as u32;
        self.all.push(strip);
        place
    }
}

/// True if two patches have the same a(x), ξ(x), functions and degrees.
fn are_same(plan: &Plan<'_>, a: &Patch, b: &Patch) -> bool {
    let mut blocks = plan.blocks[a.blocks()].iter().zip(&plan.blocks[b.blocks()]);
    let is_same = |(a, b): (&Block, &Block)| a.function == b.function && a.degree == b.degree;
    a.support[0] == b.support[0]
        && a.frame[0] == b.frame[0]
        && a.blocks().len() == b.blocks().len()
        && blocks.all(is_same)
}

/// True if there is no room for another strip.
fn is_full<T>(scratch: &Scratch<T>, numbers: usize) -> bool {
    scratch.strips.used > numbers || scratch.active.len() > MOST_ACTIVE
}

/// The place of a group among the active ones, with others or as a new one that is needed on a part.
fn need(active: &mut Vec<Active>, places: &mut [u32], group: u32, part: &Part) -> usize {
    let place = places[group as usize] as usize;
    if active.get(place).is_some_and(|known| known.group == group) {
        return place;
    }
    places[group as usize] = active.len() as u32;
    active.push(Active { group, part: part.clone() });
    active.len() - 1
}

/// Widens the parts on which groups are needed to those of their strips.
fn widen<T>(scratch: &mut Scratch<T>, basis_len: usize) {
    let Scratch { strips: Strips { all, terms, .. }, active, .. } = scratch;
    for strip in all {
        for offset in terms[strip.terms.clone()].iter().filter_map(|term| term.function) {
            let part = &mut active[offset / basis_len].part;
            part.vectors = union(&part.vectors, &strip.part.vectors);
            part.rows = union(&part.rows, &strip.part.rows);
        }
    }
}

impl<T: Scalar, const D: usize> Tile<'_, '_, T, D> {
    /// Collapses patches to strips, as many as there is room for; returns how many.
    #[inline(always)]
    pub(super) fn gather<R: Real<Scalar = T>>(
        &self,
        patches: &[u32],
        scratch: &mut Scratch<T>,
        zero: R,
    ) -> usize {
        let plan = &self.scene.plan;
        let savings = self.scene.savings;
        scratch.strips.clear();
        scratch.active.clear();
        let mut count = 0;
        for &index in patches {
            let patch = &plan.patches[index as usize];
            let part = self.part::<R>(patch);
            match scratch.strips.find(plan, patch, savings.merge_patches) {
                Ok(place) => {
                    self.collapse::<R, true>((patch, &part), place, scratch, zero);
                    let strip = &mut scratch.strips.all[place];
                    strip.part.rows = union(&strip.part.rows, &part.rows);
                }
                Err(_) if count > 0 && is_full(scratch, savings.table_numbers) => break,
                Err(slot) => {
                    let place = self.add_strip::<R>(index, &part, slot, scratch);
                    self.collapse::<R, false>((patch, &part), place, scratch, zero);
                }
            }
            count += 1;
        }
        widen(scratch, basis_len::<R, D>());
        count
    }

    /// A strip of one patch, whose tables are still to be filled.
    fn add_strip<R: Real<Scalar = T>>(
        &self,
        index: u32,
        part: &Part,
        slot: usize,
        scratch: &mut Scratch<T>,
    ) -> usize {
        let Scratch { strips, places, active, shift, .. } = scratch;
        let patch = &self.scene.plan.patches[index as usize];
        let (first, mut len) = (strips.terms.len(), 0);
        for block in &self.scene.plan.blocks[patch.blocks()] {
            let degree = block.degree.into();
            let function = match block.function {
                Slot::One => None,
                Slot::Jet { group, entry } => {
                    let place = need(active, places, group, part);
                    Some(place * basis_len::<R, D>() + entry as usize * size::<R, D>())
                }
            };
            strips.terms.push(Term { degree, len: table_len::<D>(degree), function });
            len += table_len::<D>(degree);
        }
        let strip = Strip {
            patch: index,
            support: patch.support[0],
            frame: patch.frame[0],
            part: part.clone(),
            table: strips.used,
            len,
            terms: first..strips.terms.len(),
            is_divided: false,
        };
        strips.push(strip, weight_len::<D>() + len * shift.len(), slot)
    }

    /// Writes what a patch collapses to on the rows of its part to the tables of its strip, or adds it; writing fills
    /// all rows.
    #[inline(always)]
    fn collapse<R: Real<Scalar = T>, const ADD: bool>(
        &self,
        (patch, part): (&Patch, &Part),
        place: usize,
        scratch: &mut Scratch<T>,
        zero: R,
    ) {
        let Scratch { strips: Strips { all, terms, tables, .. }, shift, .. } = scratch;
        let (plan, strip) = (&self.scene.plan, &all[place]);
        let blocks = &plan.blocks[patch.blocks()];
        let tables = &mut tables[strip.table..];
        if !ADD && (part.rows.start >= R::LANES || part.rows.end + R::LANES <= ROWS) {
            tables[..weight_len::<D>() + strip.len * shift.len()].fill(T::default());
        }
        let mut lane = part.rows.start / R::LANES * R::LANES;
        while lane < part.rows.end {
            let y = zero.load(&self.scene.ys[self.corner()[1] + lane..]);
            let factor = self.factor(y, patch.support[1], self.corner()[1] + lane);
            put::<R, ADD>(factor.value, &mut tables[lane..]);
            if D >= 1 {
                put::<R, ADD>(factor.slope, &mut tables[ROWS + lane..]);
            }
            let eta = place_of(y, patch.frame[1]);
            let rows = Rows { eta, factor, scale: patch.frame.map(|frame| frame.scale) };
            for (component, &shift) in shift.iter().enumerate() {
                let mut at = weight_len::<D>() + component * strip.len + lane;
                let mut shift = shift;
                for (block, term) in blocks.iter().zip(&terms[strip.terms.clone()]) {
                    let coefficients = plan.block_coefficients(block, component);
                    let table = &mut tables[at..];
                    collapse::<R, D, ADD>(coefficients, term.degree, shift, &rows, table);
                    at += term.len;
                    shift = 0.0;
                }
            }
            lane += R::LANES;
        }
    }

    /// One factor of the weight with its derivative in the world, at a vector of pixels with their offsets.
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

    /// Divides the tables of a strip by the weight's factor. Where that is zero no patch is, and nothing is a number.
    #[inline(always)]
    pub(super) fn divide_strip<R: Real<Scalar = T>>(
        &self,
        strip: &mut Strip,
        (from, to): (&[T], &mut [T]),
        components: usize,
        zero: R,
    ) {
        strip.is_divided = true;
        let len = weight_len::<D>() + strip.len * components;
        let (from, to) = (&from[strip.table..][..len], &mut to[strip.table..][..len]);
        let mut lane = 0;
        while lane < ROWS {
            let inverse = zero.lit(1.0) / zero.load(&from[lane..]);
            let mut at = weight_len::<D>() + lane;
            while at < len {
                let a = zero.load(&from[at..]) * inverse;
                a.store(&mut to[at..]);
                if D >= 1 {
                    let slope = zero.load(&from[ROWS + lane..]);
                    let b = (zero.load(&from[at + ROWS..]) - a * slope) * inverse;
                    b.store(&mut to[at + ROWS..]);
                    (zero.load(&from[at + 2 * ROWS..]) * inverse).store(&mut to[at + 2 * ROWS..]);
                }
                at += polynomials::<D>() * ROWS;
            }
            lane += R::LANES;
        }
    }
}

/// Length of the weight's part of a table.
#[inline(always)]
pub(super) const fn weight_len<const D: usize>() -> usize {
    if D >= 1 { 2 * ROWS } else { ROWS }
}

/// ξ of an offset.
#[inline(always)]
pub(super) fn place_of<R: Real>(offset: R, affine: Affine) -> R {
    offset.mul_add(offset.lit(affine.scale), offset.lit(affine.shift))
}
