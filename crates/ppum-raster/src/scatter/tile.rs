//! A tile of pixels: which functions it needs, and its patches, batch by batch.

use std::ops::Range;

use ppum::crack::{LocalTip, Side};
use ppum::formula::Scratch as FormulaScratch;
use ppum::function::{GROUP, at_tip};
use ppum::jet::Jet;
use ppum::real::{Job, Real, Scalar};

use super::PreparedView;
use super::collapse::{ROWS, Slopes, splat};
use super::grains::Grains;
use super::plan::{COLUMNS, Patch, Tiles};
use super::strips::Strips;
use super::sums::{basis_len, basis_stride, size, store_slopes};

/// Buffers of one thread.
#[derive(Debug, Default)]
pub(super) struct Scratch<T> {
    /// At the vectors of points of a column: Σ W, then Σ W v of each component, each with
    /// derivatives; when all patches are there, the field's components in place of these. Of all
    /// columns where patches come in batches.
    pub(super) sums: Vec<T>,
    /// The functions of each active group with derivatives, at the vectors of a column.
    pub(super) basis: Vec<T>,
    /// Working space of formulas.
    pub(super) formulas: FormulaScratch<T>,
    /// The groups in `basis`.
    pub(super) active: Vec<Active>,
    /// Of each group its place among the active ones, if it is one of them.
    pub(super) places: Vec<u32>,
    /// The patches at hand.
    pub(super) strips: Strips<T>,
    pub(super) grains: Grains<T>,
    /// Those of the strips that cover some rows.
    pub(super) here: Vec<usize>,
    /// Subtracted from each component.
    pub(super) shift: Vec<f64>,
    /// Of each patch of the tile, then of each component the coefficients of its blocks.
    pub(super) coefficients: Vec<T>,
    pub(super) listed: Vec<Listed>,
}

/// A patch of a tile.
#[derive(Clone, Copy, Debug)]
pub(super) struct Listed {
    /// A bit for each column of the tile that it covers.
    pub(super) columns: u64,
    pub(super) patch: u32,
    /// The first of its coefficients.
    pub(super) start: usize,
}

/// A group of functions needed on some rows of a tile.
#[derive(Debug)]
pub(super) struct Active {
    pub(super) group: u32,
    pub(super) rows: Range<usize>,
}

/// Patches of a tile that are summed together.
#[derive(Clone, Copy, Debug)]
pub(super) struct Batch {
    /// Nothing is summed before it, or after it.
    pub(super) is_first: bool,
    pub(super) is_last: bool,
}

/// Draws a band: the tiles of some rows, with `D` derivatives.
pub(super) struct Band<'a, 'f, T, const D: usize> {
    pub(super) scene: &'a PreparedView<'f, T>,
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
            let tile = Tile::<T, D>::new(self.scene, column, self.band);
            tile.draw(self.tiles, self.scratch, self.out, zero);
            column += 1;
        }
    }
}

/// One tile.
pub(super) struct Tile<'a, 'f, T, const D: usize> {
    pub(super) scene: &'a PreparedView<'f, T>,
    column: usize,
    band: usize,
}

impl<'a, 'f, T: Scalar, const D: usize> Tile<'a, 'f, T, D> {
    #[inline(always)]
    pub(super) fn new(scene: &'a PreparedView<'f, T>, column: usize, band: usize) -> Self {
        Self { scene, column, band }
    }

    /// First column and row.
    #[inline(always)]
    pub(super) fn corner(&self) -> [usize; 2] {
        [self.column * COLUMNS, self.band * ROWS]
    }

    /// Draws column by column.
    #[inline(always)]
    fn draw<R: Real<Scalar = T>>(
        &self,
        tiles: &Tiles,
        scratch: &mut Scratch<T>,
        out: &mut [T],
        zero: R,
    ) {
        let list = tiles.of(self.column, self.band);
        if self.scene.plan.has_grains {
            self.sum_grains(scratch, zero);
            scratch.listed.clear();
        } else {
            self.choose_shift(list, &mut scratch.shift);
            self.take_patches(list, scratch);
        }
        scratch.places.resize(self.scene.functions.table().groups(), 0);
        let width = self.scene.view.pixels[0] as usize;
        let vectors = (width - self.corner()[0]).min(COLUMNS).div_ceil(R::LANES);
        let mut vector = 0;
        while vector < vectors {
            self.draw_vector(vector, scratch, out, zero);
            vector += 1;
        }
    }

    /// A column of vectors: adds its strips, some at a time, and finishes it.
    #[inline(always)]
    fn draw_vector<R: Real<Scalar = T>>(
        &self,
        vector: usize,
        scratch: &mut Scratch<T>,
        out: &mut [T],
        zero: R,
    ) {
        let len = ROWS * self.stride::<R>();
        let start = if self.scene.plan.has_grains { vector * len } else { 0 };
        if scratch.sums.len() < start + len {
            scratch.sums.resize(start + len, T::default());
        }
        let (mut is_first, mut from) = (!self.scene.plan.has_grains, 0);
        loop {
            from = self.gather(vector, from, scratch, zero);
            let batch = Batch { is_first, is_last: from == scratch.listed.len() };
            self.evaluate_functions(vector, scratch, zero);
            self.sweep(start, batch, scratch, zero);
            if batch.is_last {
                break;
            }
            is_first = false;
        }
        self.finish(vector, start, scratch, out, zero);
    }

    /// Numbers at a vector of points.
    #[inline(always)]
    pub(super) fn stride<R: Real<Scalar = T>>(&self) -> usize {
        size::<R, D>() * (1 + self.scene.plan.coefficients.len())
    }

    /// Takes the constants to subtract.
    fn choose_shift(&self, list: &[u32], shift: &mut Vec<f64>) {
        let plan = &self.scene.plan;
        let ends = [list.first(), list.last()].into_iter().flatten();
        let ends: Vec<_> = ends.map(|&place| plan.patches[place as usize].index).collect();
        plan.middle(&ends, shift);
    }

    /// The columns and rows of the tile that a patch may cover.
    #[inline(always)]
    pub(super) fn within(&self, patch: &Patch) -> [Range<usize>; 2] {
        let [column, row] = self.corner();
        [within(&patch.columns, column, COLUMNS), within(&patch.rows, row, ROWS)]
    }

    /// Fills the basis at a column of vectors.
    #[inline(always)]
    fn evaluate_functions<R: Real<Scalar = T>>(
        &self,
        vector: usize,
        scratch: &mut Scratch<T>,
        zero: R,
    ) {
        let len = basis_len::<R, D>() * scratch.active.len();
        if scratch.basis.len() < len {
            scratch.basis.resize(len, T::default());
        }
        let groups = scratch.basis.chunks_exact_mut(basis_len::<R, D>());
        for (active, basis) in scratch.active.iter().zip(groups) {
            let functions = &self.scene.functions;
            if let Some(tip) = functions.tip(active.group as usize) {
                self.evaluate_tip(tip, active, vector, basis, zero);
            } else if functions.is_native(active.group as usize) {
                self.evaluate_one(active, vector, basis, zero);
            } else {
                self.evaluate_formulas(active, vector, (&mut scratch.formulas, basis), zero);
            }
        }
    }

    /// Formulas at all rows at a time, so that what a step of them costs is shared.
    #[inline(always)]
    fn evaluate_formulas<R: Real<Scalar = T>>(
        &self,
        active: &Active,
        vector: usize,
        (memory, basis): (&mut FormulaScratch<T>, &mut [T]),
        zero: R,
    ) {
        let mut offsets = [[zero; 2]; ROWS];
        let mut jets = [[Jet::constant(zero); GROUP]; ROWS];
        let Range { start, end } = active.rows;
        let mut row = start;
        while row < end {
            offsets[row - start] = self.offset(vector, row, zero);
            row += 1;
        }
        let functions = &self.scene.functions;
        let offsets = &offsets[..end - start];
        functions.fill::<R, D>(active.group as usize, offsets, Side::Above, memory, &mut jets);
        let mut row = start;
        while row < end {
            store_jets::<R, D>(&jets[row - start], &mut basis[row * basis_stride::<R, D>()..]);
            row += 1;
        }
    }

    #[inline(always)]
    fn evaluate_tip<R: Real<Scalar = T>>(
        &self,
        tip: &LocalTip,
        active: &Active,
        vector: usize,
        basis: &mut [T],
        zero: R,
    ) {
        for row in active.rows.clone() {
            let jets = at_tip::<R, D>(tip, self.offset(vector, row, zero), Side::Above);
            store_jets::<R, D>(&jets, &mut basis[row * basis_stride::<R, D>()..]);
        }
    }

    /// A group of one function: a side or a component.
    #[inline(always)]
    fn evaluate_one<R: Real<Scalar = T>>(
        &self,
        active: &Active,
        vector: usize,
        basis: &mut [T],
        zero: R,
    ) {
        let group = active.group as usize;
        for row in active.rows.clone() {
            let mut jet = [Jet::constant(zero)];
            let offset = self.offset(vector, row, zero);
            self.scene.functions.evaluate::<R, D>(group, offset, Side::Above, &mut jet);
            store_slopes::<R, D>(Slopes::of(jet[0]), &mut basis[row * basis_stride::<R, D>()..]);
        }
    }

    /// A vector of points relative to the view's centre.
    #[inline(always)]
    pub(super) fn offset<R: Real<Scalar = T>>(&self, vector: usize, row: usize, zero: R) -> [R; 2] {
        let [column, first_row] = self.corner();
        let x = zero.load(&self.scene.xs[column + vector * R::LANES..]);
        [x, splat(zero, self.scene.ys[first_row + row])]
    }
}

/// The part of a range in `start .. start + count`, relative to the start.
#[inline(always)]
fn within(range: &Range<u32>, start: usize, count: usize) -> Range<usize> {
    let [from, to] =
        [range.start as usize, range.end as usize].map(|k| k.clamp(start, start + count));
    from - start..to - start
}

#[inline(always)]
pub(super) fn load_slopes<R: Real, const D: usize>(from: &[R::Scalar], like: R) -> Slopes<R> {
    let mut slopes = Slopes::constant(like.load(from));
    if D >= 1 {
        slopes.x = like.load(&from[R::LANES..]);
        slopes.y = like.load(&from[2 * R::LANES..]);
    }
    slopes
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
        store_slopes::<R, D>(Slopes::of(jets[k]), &mut to[k * size::<R, D>()..]);
        k += 1;
    }
}

pub(super) fn union(a: &Range<usize>, b: &Range<usize>) -> Range<usize> {
    a.start.min(b.start)..a.end.max(b.end)
}
