//! Bands of tiles: draws them column by column, and evaluates the functions that they need.

use std::ops::Range;

use ppum::crack::{LocalTip, Side};
use ppum::formula::BlockScratch as FormulaScratch;
use ppum::function::{GROUP, at_tip};
use ppum::jet::Jet;
use ppum::real::{LaneJob, LaneNumber, Real};

use super::collapse::{ROWS, Slopes};
use super::layout::{basis_len, basis_stride, size, store_slopes};
use super::plan::{COLUMNS, Tiles};
use super::tile::{ActiveGroup, PatchBatch, Tile, TileScratch};
use super::view_data::PreparedView;

/// Draws a band: the tiles of some rows, with `D` derivatives.
pub(super) struct Band<'a, 'f, T, const D: usize> {
    pub(super) scene: &'a PreparedView<'f, T>,
    pub(super) tiles: &'a Tiles,
    pub(super) band: usize,
    pub(super) scratch: &'a mut TileScratch<T>,
    /// The band's rows of the raster.
    pub(super) out: &'a mut [T],
}

impl<T: LaneNumber, const D: usize> LaneJob<T> for Band<'_, '_, T, D> {
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

impl<T: LaneNumber, const D: usize> Tile<'_, '_, T, D> {
    /// Draws column by column.
    #[inline(always)]
    fn draw<R: Real<Scalar = T>>(
        &self,
        tiles: &Tiles,
        scratch: &mut TileScratch<T>,
        out: &mut [T],
        zero: R,
    ) {
        let list = tiles.patches_at(self.column, self.band);
        if self.scene.plan.is_per_patch {
            self.sum_patches(scratch, zero);
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

    /// A column of vectors: adds its spans, some at a time, and finishes it.
    #[inline(always)]
    fn draw_vector<R: Real<Scalar = T>>(
        &self,
        vector: usize,
        scratch: &mut TileScratch<T>,
        out: &mut [T],
        zero: R,
    ) {
        let len = ROWS * self.stride::<R>();
        let start = if self.scene.plan.is_per_patch { vector * len } else { 0 };
        if scratch.sums.len() < start + len {
            scratch.sums.resize(start + len, T::default());
        }
        let (mut is_first, mut from) = (!self.scene.plan.is_per_patch, 0);
        loop {
            from = self.gather(vector, from, scratch, zero);
            let batch = PatchBatch { is_first, is_last: from == scratch.listed.len() };
            self.evaluate_functions(vector, scratch, zero);
            self.sweep(start, batch, scratch, zero);
            if batch.is_last {
                break;
            }
            is_first = false;
        }
        self.finish(vector, start, scratch, out, zero);
    }

    /// Takes the constants to subtract.
    fn choose_shift(&self, list: &[u32], shift: &mut Vec<f64>) {
        let plan = &self.scene.plan;
        let ends = [list.first(), list.last()].into_iter().flatten();
        let ends: Vec<_> = ends.map(|&place| plan.patches[place as usize].index).collect();
        plan.middle(&ends, shift);
    }

    /// Fills the basis at a column of vectors.
    #[inline(always)]
    fn evaluate_functions<R: Real<Scalar = T>>(
        &self,
        vector: usize,
        scratch: &mut TileScratch<T>,
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
        active: &ActiveGroup,
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
        active: &ActiveGroup,
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
        active: &ActiveGroup,
        vector: usize,
        basis: &mut [T],
        zero: R,
    ) {
        let group = active.group as usize;
        for row in active.rows.clone() {
            let mut jet = [Jet::constant(zero)];
            let offset = self.offset(vector, row, zero);
            self.scene.functions.evaluate::<R, D>(group, offset, Side::Above, &mut jet);
            store_slopes::<R, D>(
                Slopes::from_jet(jet[0]),
                &mut basis[row * basis_stride::<R, D>()..],
            );
        }
    }
}

#[inline(always)]
fn store_jets<R: Real, const D: usize>(jets: &[Jet<R>; GROUP], to: &mut [R::Scalar]) {
    let to = &mut to[..basis_stride::<R, D>()];
    let mut k = 0;
    while k < GROUP {
        store_slopes::<R, D>(Slopes::from_jet(jets[k]), &mut to[k * size::<R, D>()..]);
        k += 1;
    }
}
