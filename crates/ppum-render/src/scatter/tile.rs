//! A tile of pixels: which functions it needs, and the sums over its patches.

use std::ops::Range;

use ppum::crack::Side;
use ppum::formula::Scratch as FormulaScratch;
use ppum::function::{GROUP, Slot};
use ppum::jet::Jet;
use ppum::real::{Job, Real, Scalar};

use super::Scene;
use super::collapse::{ROWS, splat};
use super::plan::{COLUMNS, Patch, Tiles};
use super::spread::{Collapsed, size};

/// Vectors of points at which formulas are evaluated at a time.
const VECTORS: usize = 32;

/// Groups of functions that are kept at a time for the patches of a tile, more if one patch has them: 25 MB.
const MOST_ACTIVE: usize = 256;

/// Buffers of one thread.
#[derive(Debug, Default)]
pub(super) struct Scratch<T> {
    /// Σ W, then Σ W v of each component, each with derivatives, at the vectors of points of a tile,
    /// column by column. Zero between tiles.
    pub(super) sums: Vec<T>,
    /// The functions of each active group with derivatives, at the same points.
    pub(super) basis: Vec<T>,
    /// Working space of formulas.
    pub(super) formulas: FormulaScratch<T>,
    /// The groups in `basis`.
    pub(super) active: Vec<Active>,
    /// Of each group its place among the active ones, if it is one of them.
    pub(super) places: Vec<u32>,
    /// The patch at hand.
    pub(super) collapsed: Collapsed<T>,
    /// Subtracted from each component.
    pub(super) shift: Vec<f64>,
}

/// A rectangle of a tile: vectors of columns, and rows.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) vectors: Range<usize>,
    pub(super) rows: Range<usize>,
}

/// A group of functions needed on a part of a tile.
#[derive(Debug)]
pub(super) struct Active {
    pub(super) group: u32,
    part: Part,
}

/// Draws a band: the tiles of some rows, with `D` derivatives.
pub(super) struct Band<'a, 'f, T, const D: usize> {
    pub(super) scene: &'a Scene<'f, T>,
    pub(super) tiles: &'a Tiles,
    pub(super) band: usize,
    pub(super) scratch: &'a mut Scratch<T>,
    /// The band's rows of the raster.
    pub(super) out: &'a mut [T],
}

impl<T: Scalar, const D: usize> Job<T> for Band<'_, '_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real<Scalar = T>>(self, zero: R) {
        let mut column = 0;
        while column < self.tiles.columns {
            let tile = Tile::<T, D> { scene: self.scene, column, band: self.band };
            tile.sum(self.tiles, self.scratch, zero);
            tile.finish(self.scratch, self.out, zero);
            column += 1;
        }
    }
}

/// One tile.
pub(super) struct Tile<'a, 'f, T, const D: usize> {
    pub(super) scene: &'a Scene<'f, T>,
    column: usize,
    band: usize,
}

impl<T: Scalar, const D: usize> Tile<'_, '_, T, D> {
    /// First column and row.
    #[inline(always)]
    pub(super) fn corner(&self) -> [usize; 2] {
        [self.column * COLUMNS, self.band * ROWS]
    }

    /// Sums over the patches.
    #[inline(always)]
    fn sum<R: Real<Scalar = T>>(&self, tiles: &Tiles, scratch: &mut Scratch<T>, zero: R) {
        let plan = &self.scene.plan;
        let mut list = tiles.of(self.column, self.band);
        let len = points::<R>() * size::<R, D>() * (1 + plan.coefficients.len());
        scratch.sums.resize(len, T::default());
        self.choose_shift(list, &mut scratch.shift);
        let has_functions = tiles.has_functions(self.column, self.band);
        scratch.places.resize(self.scene.functions.table().groups(), 0);
        while !list.is_empty() {
            scratch.active.clear();
            let count = if has_functions { self.activate::<R>(list, scratch) } else { list.len() };
            self.evaluate_functions(scratch, zero);
            for &index in &list[..count] {
                let patch = &plan.patches[index as usize];
                let part = self.part::<R>(patch);
                self.collapse(patch, &part, scratch, zero);
                self.spread(patch, &part, scratch, zero);
            }
            list = &list[count..];
        }
    }

    /// Takes the constants to subtract: midway between those of the first and the last patch, which
    /// lie in opposite corners if the patches follow the Morton curve. The partition of unity
    /// reproduces constants, and ∇U − u ∇S loses the fewer digits the smaller u is.
    #[inline(always)]
    fn choose_shift(&self, list: &[u32], shift: &mut Vec<f64>) {
        let plan = &self.scene.plan;
        shift.clear();
        shift.resize(plan.coefficients.len(), 0.0);
        let (Some(&first), Some(&last)) = (list.first(), list.last()) else { return };
        for (component, shift) in shift.iter_mut().enumerate() {
            *shift = 0.5 * (plan.constant(first, component) + plan.constant(last, component));
        }
    }

    /// The part of the tile a patch may cover.
    #[inline(always)]
    fn part<R: Real<Scalar = T>>(&self, patch: &Patch) -> Part {
        let [column, row] = self.corner();
        let columns = within(&patch.columns, column, COLUMNS);
        Part {
            vectors: columns.start / R::LANES..columns.end.div_ceil(R::LANES),
            rows: within(&patch.rows, row, ROWS),
        }
    }

    /// Finds the groups of functions the patches need, and where; returns for how many of the patches: all,
    /// unless they need more than there is room for.
    #[inline(always)]
    fn activate<R: Real<Scalar = T>>(&self, list: &[u32], scratch: &mut Scratch<T>) -> usize {
        let plan = &self.scene.plan;
        for (count, &index) in list.iter().enumerate() {
            let patch = &plan.patches[index as usize];
            let (known, part) = (scratch.active.len(), self.part::<R>(patch));
            let mut last = None;
            for block in &plan.blocks[patch.blocks()] {
                if let Slot::Jet { group, .. } = block.function
                    && last != Some(group)
                {
                    need(scratch, group, &part);
                    last = Some(group);
                }
            }
            if scratch.active.len() > MOST_ACTIVE && count > 0 {
                // the parts of those before may have grown: that does no harm
                scratch.active.truncate(known);
                return count;
            }
        }
        list.len()
    }

    /// Fills the basis.
    #[inline(always)]
    fn evaluate_functions<R: Real<Scalar = T>>(&self, scratch: &mut Scratch<T>, zero: R) {
        let len = basis_len::<R, D>() * scratch.active.len();
        if scratch.basis.len() < len {
            scratch.basis.resize(len, T::default());
        }
        let groups = scratch.basis.chunks_exact_mut(basis_len::<R, D>());
        for (active, basis) in scratch.active.iter().zip(groups) {
            if self.scene.functions.is_native(active.group as usize) {
                self.evaluate_group(active, basis, zero);
            } else {
                self.evaluate_formulas(active, (&mut scratch.formulas, basis), zero);
            }
        }
    }

    /// Formulas at many vectors at a time, so that what a step of them costs is shared.
    #[inline(always)]
    fn evaluate_formulas<R: Real<Scalar = T>>(
        &self,
        active: &Active,
        (memory, basis): (&mut FormulaScratch<T>, &mut [T]),
        zero: R,
    ) {
        let [column, row] = self.corner();
        let mut offsets = [[zero; 2]; VECTORS];
        let mut places = [0; VECTORS];
        let mut jets = [[Jet::constant(zero); GROUP]; VECTORS];
        let (vectors, rows) = (active.part.vectors.clone(), active.part.rows.clone());
        let count = vectors.len() * rows.len();
        let mut done = 0;
        while done < count {
            let n = VECTORS.min(count - done);
            let mut k = 0;
            while k < n {
                let vector = vectors.start + (done + k) / rows.len();
                let at = rows.start + (done + k) % rows.len();
                let x = zero.load(&self.scene.xs[column + vector * R::LANES..]);
                offsets[k] = [x, splat(zero, self.scene.ys[row + at])];
                places[k] = (vector * ROWS + at) * basis_stride::<R, D>();
                k += 1;
            }
            let group = active.group as usize;
            let functions = &self.scene.functions;
            functions.fill::<R, D>(group, &offsets[..n], Side::Above, memory, &mut jets);
            let mut k = 0;
            while k < n {
                store_jets::<R, D>(&jets[k], &mut basis[places[k]..]);
                k += 1;
            }
            done += n;
        }
    }

    #[inline(always)]
    fn evaluate_group<R: Real<Scalar = T>>(&self, active: &Active, basis: &mut [T], zero: R) {
        let stride = basis_stride::<R, D>();
        let [column, row] = self.corner();
        let functions = &self.scene.functions;
        let group = active.group as usize;
        for vector in active.part.vectors.clone() {
            let x = zero.load(&self.scene.xs[column + vector * R::LANES..]);
            for k in active.part.rows.clone() {
                let y = splat(zero, self.scene.ys[row + k]);
                // All are stored, however many the group has: so they stay in registers.
                let mut jets = [Jet::constant(zero); GROUP];
                functions.evaluate::<R, D>(group, [x, y], Side::Above, &mut jets);
                let start = (vector * ROWS + k) * stride;
                store_jets::<R, D>(&jets, &mut basis[start..start + stride]);
            }
        }
    }
}

/// The part of a range in `start .. start + count`, relative to the start.
#[inline(always)]
fn within(range: &Range<u32>, start: usize, count: usize) -> Range<usize> {
    let [from, to] = [range.start as usize, range.end as usize];
    from.max(start) - start..to.min(start + count) - start
}

/// Vectors of points of a tile.
#[inline(always)]
const fn points<R: Real>() -> usize {
    COLUMNS / R::LANES * ROWS
}

/// Numbers a group has at a vector of points.
#[inline(always)]
pub(super) const fn basis_stride<R: Real, const D: usize>() -> usize {
    GROUP * size::<R, D>()
}

/// Numbers a group has in the basis.
#[inline(always)]
pub(super) const fn basis_len<R: Real, const D: usize>() -> usize {
    points::<R>() * basis_stride::<R, D>()
}

#[inline(always)]
pub(super) fn load_jet<R: Real, const D: usize>(from: &[R::Scalar], like: R) -> Jet<R> {
    let mut jet = Jet::constant(like.load(from));
    if D >= 1 {
        jet.x = like.load(&from[R::LANES..]);
        jet.y = like.load(&from[2 * R::LANES..]);
    }
    jet
}

#[inline(always)]
fn store_jets<R: Real, const D: usize>(jets: &[Jet<R>; GROUP], to: &mut [R::Scalar]) {
    let to = &mut to[..basis_stride::<R, D>()];
    let mut k = 0;
    while k < GROUP {
        let to = &mut to[k * size::<R, D>()..];
        jets[k].v.store(to);
        if D >= 1 {
            jets[k].x.store(&mut to[R::LANES..]);
            jets[k].y.store(&mut to[2 * R::LANES..]);
        }
        k += 1;
    }
}

/// Notes that a group is needed on a part.
fn need<T>(scratch: &mut Scratch<T>, group: u32, part: &Part) {
    let place = &mut scratch.places[group as usize];
    match scratch.active.get_mut(*place as usize).filter(|known| known.group == group) {
        None => {
            *place = scratch.active.len() as u32;
            scratch.active.push(Active { group, part: part.clone() });
        }
        Some(known) => {
            known.part.vectors = union(&known.part.vectors, &part.vectors);
            known.part.rows = union(&known.part.rows, &part.rows);
        }
    }
}

fn union(a: &Range<usize>, b: &Range<usize>) -> Range<usize> {
    a.start.min(b.start)..a.end.max(b.end)
}
