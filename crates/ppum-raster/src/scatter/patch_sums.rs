//! Separate sums for patches of a few pixels each.
//!
//! A row span is not worth its tables there. Each tile asks the search tree for its patches, so
//! nothing is made for all of them at once, and evaluates each row by row,
//!
//! ```text
//! W = a(ξ) b(η)     v = Σ_e f_e p_e(ξ, η)
//! ```
//!
//! pixel by pixel where it has few columns, else on vectors that may reach beyond them: the weight
//! is zero there. W and W v are added to sums in memory, in the order of the patches, so a pixel's
//! sums do not depend on the number of lanes. They are then what a batch of spans leaves; the last
//! batch, of no spans, finishes them.

use ppum::crack::Side;
use ppum::dataset::monomials;
use ppum::function::{GROUP, Slot};
use ppum::jet::Jet;
use ppum::polynomial::polynomial;
use ppum::real::{LaneNumber, Real};
use ppum::vec2::{Vec2, vec2};

use super::collapse::{ROWS, numbers};
use super::plan::{Affine, COLUMNS, PatchBlock, VisiblePatch, add_blocks};
use super::tile::{PatchSums, Tile, TileScratch};
use crate::pixels::Pixels;

/// Columns of a patch up to which its pixels are taken one by one.
const NARROW: usize = 2;

/// Components that are summed together.
const TOGETHER: usize = 2;

/// Numbers of a row of sums: vectors begin anywhere in the tile.
const WIDTH: usize = COLUMNS + 16;

/// Pixels of a row of a patch.
#[derive(Clone, Copy, Debug)]
struct RowSpan {
    /// Column and row of the first in the view, and its offset from the view's centre.
    pixel: [usize; 2],
    offset: Vec2,
    /// Columns of the patch from there on.
    columns: usize,
    /// The first of their sums of W.
    cell: usize,
}

impl<T: LaneNumber, const D: usize> Tile<'_, '_, T, D> {
    /// Sums over all patches of the tile.
    #[inline(always)]
    pub(super) fn sum_patches<R: Real<Scalar = T>>(&self, scratch: &mut TileScratch<T>, zero: R) {
        self.find_patches(scratch);
        let pixels = Pixels::new(&self.scene.view);
        let mut k = 0;
        while k < scratch.patch_sums.found.len() {
            let patch = self.scene.plan.patch(scratch.patch_sums.found[k], &pixels);
            self.add_patch(&patch, scratch, zero);
            k += 1;
        }
        self.spread_sums::<R>(scratch, zero);
    }

    /// Finds the patches of the tile, chooses the constants to subtract, and begins the sums.
    fn find_patches(&self, scratch: &mut TileScratch<T>) {
        let TileScratch { patch_sums, shift, .. } = scratch;
        let (scene, corner) = (self.scene, self.corner());
        let end = |k: usize, size: usize| (corner[k] + size).min(scene.view.pixels[k] as usize);
        let window = Pixels::new(&scene.view)
            .window_of([corner[0]..end(0, COLUMNS), corner[1]..end(1, ROWS)]);
        patch_sums.found.clear();
        scene.field.tree.query_box(&window, &mut patch_sums.found);
        scene.plan.middle(&patch_sums.found, shift);
        patch_sums.sums.clear();
        patch_sums.sums.resize(ROWS * WIDTH * self.numbers(), T::default());
    }

    /// Numbers at a point.
    fn numbers(&self) -> usize {
        numbers::<D>() * (1 + self.scene.plan.coefficients.len())
    }

    /// Adds a patch.
    #[inline(always)]
    fn add_patch<R: Real<Scalar = T>>(
        &self,
        patch: &VisiblePatch,
        scratch: &mut TileScratch<T>,
        zero: R,
    ) {
        let [columns, rows] = self.within(patch);
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        self.take_blocks(patch, scratch);
        let ([left, top], view) = (self.corner(), &self.scene.view);
        for row in rows {
            let y = view.row_offset((top + row) as u32);
            let mut column = columns.start;
            while column < columns.end {
                let span = RowSpan {
                    pixel: [left + column, top + row],
                    offset: vec2(view.column_offset((left + column) as u32), y),
                    columns: columns.end - column,
                    cell: row * self.numbers() * WIDTH + column,
                };
                if columns.len() <= NARROW {
                    self.add_pixels(patch, span, &mut scratch.patch_sums, T::default());
                    column += 1;
                } else {
                    self.add_pixels(patch, span, &mut scratch.patch_sums, zero);
                    column += R::LANES;
                }
            }
        }
    }

    /// Reads the blocks of a patch.
    #[inline(always)]
    fn take_blocks(&self, patch: &VisiblePatch, scratch: &mut TileScratch<T>) {
        let TileScratch { patch_sums, shift, .. } = scratch;
        let plan = &self.scene.plan;
        patch_sums.blocks.clear();
        add_blocks(
            self.scene.field,
            patch.index as usize,
            self.scene.quantity,
            &mut patch_sums.blocks,
        );
        patch_sums.smooth.clear();
        let Some(first) = patch_sums.blocks.first() else { return };
        let count = monomials(first.degree.into());
        for (component, shift) in shift.iter().enumerate() {
            let at = patch_sums.smooth.len();
            let all = &plan.block_coefficients(first, component)[..count];
            patch_sums.smooth.extend(all.iter().map(|&c| T::from_f64(c)));
            patch_sums.smooth[at] = T::from_f64(all[0] - shift);
        }
    }

    /// Adds a vector of pixels of a patch, some components at a time.
    #[inline(always)]
    fn add_pixels<R: Real<Scalar = T>>(
        &self,
        patch: &VisiblePatch,
        span: RowSpan,
        patch_sums: &mut PatchSums<T>,
        zero: R,
    ) {
        let components = self.scene.plan.coefficients.len();
        let size = numbers::<D>() * WIDTH;
        let weight = self.patch_weight(patch, span, zero);
        add_jet::<R, D>(weight, &mut patch_sums.sums[span.cell..], zero);
        let mut component = 0;
        while component < components {
            let count = TOGETHER.min(components - component);
            let v = self.patch_field(patch, span, [component, count], patch_sums, zero);
            let mut c = 0;
            while c < count {
                let cell = span.cell + (1 + component + c) * size;
                add_jet::<R, D>(weight.times::<D>(v[c]), &mut patch_sums.sums[cell..], zero);
                c += 1;
            }
            component += TOGETHER;
        }
    }

    /// W at a vector of pixels.
    #[inline(always)]
    fn patch_weight<R: Real<Scalar = T>>(
        &self,
        patch: &VisiblePatch,
        span: RowSpan,
        zero: R,
    ) -> Jet<R> {
        let [x, y] = &patch.support;
        let xi = self.coordinates(&patch.support, span, zero);
        if self.scene.plan.is_overlap {
            let (one, mut inside) = (zero.broadcast(1.0), zero.broadcast(1.0));
            let mut axis = 0;
            while axis < 2 {
                inside = R::select(xi[axis].ge(-one), inside, zero);
                inside = R::select(one.gt(xi[axis]), inside, zero);
                axis += 1;
            }
            return Jet::constant(inside);
        }
        self.scene.weight.tensor::<R, D>(xi, [x.scale, y.scale])
    }

    /// v of some components at a vector of pixels.
    #[inline(always)]
    fn patch_field<R: Real<Scalar = T>>(
        &self,
        patch: &VisiblePatch,
        span: RowSpan,
        [first, count]: [usize; 2],
        patch_sums: &PatchSums<T>,
        zero: R,
    ) -> [Jet<R>; TOGETHER] {
        let xi = self.coordinates(&patch.frame, span, zero);
        let mut v = [Jet::constant(zero); TOGETHER];
        let Some((smooth, others)) = patch_sums.blocks.split_first() else { return v };
        let degree = smooth.degree.into();
        let mut c = 0;
        while c < count {
            let all = &patch_sums.smooth[(first + c) * monomials(degree)..];
            v[c] = patch_polynomial::<R, D>(all, degree, xi, patch);
            c += 1;
        }
        if !others.is_empty() {
            self.add_functions(patch, (span, xi), (others, first), &mut v[..count]);
        }
        v
    }

    /// Adds the blocks behind the first. Functions beyond the patch may be no number.
    #[inline(always)]
    fn add_functions<R: Real<Scalar = T>>(
        &self,
        patch: &VisiblePatch,
        (span, xi): (RowSpan, [R; 2]),
        (blocks, first): (&[PatchBlock], usize),
        v: &mut [Jet<R>],
    ) {
        let plan = &self.scene.plan;
        let is_patch = xi[0].broadcast(span.columns as f64).gt(ramp(xi[0]));
        let mut jets = [Jet::constant(xi[0].broadcast(0.0)); GROUP];
        let mut group = None;
        for block in blocks {
            let degree = block.degree.into();
            let mut c = 0;
            while c < v.len() {
                let all = plan.block_coefficients(block, first + c);
                let mut p = patch_polynomial::<R, D>(all, degree, xi, patch);
                if let Slot::Jet { group: of, entry } = block.function {
                    if group != Some(of) {
                        self.functions_at(of, span, &mut jets);
                        group = Some(of);
                    }
                    p = p.times::<D>(jets[entry as usize]).only::<D>(is_patch);
                }
                v[c] = v[c].plus::<D>(p);
                c += 1;
            }
        }
    }

    /// The functions of a group.
    #[inline(always)]
    fn functions_at<R: Real<Scalar = T>>(
        &self,
        group: u32,
        span: RowSpan,
        jets: &mut [Jet<R>; GROUP],
    ) {
        let (zero, view) = (jets[0].v.broadcast(0.0), &self.scene.view);
        let x = zero.with_lanes(|k| view.column_offset((span.pixel[0] + k) as u32));
        let offset = [x, zero.broadcast(span.offset.y)];
        self.scene.functions.evaluate::<R, D>(group as usize, offset, Side::Above, jets);
    }

    /// Coordinates of a vector of pixels. Those of the first are found in f64: far from the view's
    /// centre f32 has too few digits for cells of a pixel.
    #[inline(always)]
    fn coordinates<R: Real<Scalar = T>>(
        &self,
        [x, y]: &[Affine; 2],
        span: RowSpan,
        zero: R,
    ) -> [R; 2] {
        let xi = span.offset.x * x.scale + x.shift;
        let eta = span.offset.y * y.scale + y.shift;
        let step = zero.broadcast(self.scene.plan.pixel * x.scale);
        [ramp(zero).mul_add(step, zero.broadcast(xi)), zero.broadcast(eta)]
    }

    /// Puts the sums where spans leave theirs.
    #[inline(always)]
    fn spread_sums<R: Real<Scalar = T>>(&self, scratch: &mut TileScratch<T>, zero: R) {
        let TileScratch { patch_sums, sums, .. } = scratch;
        let (vectors, numbers) = (COLUMNS / R::LANES, self.numbers());
        if sums.len() < vectors * ROWS * self.stride::<R>() {
            sums.resize(vectors * ROWS * self.stride::<R>(), T::default());
        }
        for (line, from) in patch_sums.sums.chunks_exact(WIDTH).enumerate() {
            let mut vector = 0;
            while vector < vectors {
                let to = (vector * ROWS * numbers + line) * R::LANES;
                zero.load(&from[vector * R::LANES..]).store(&mut sums[to..]);
                vector += 1;
            }
        }
    }
}

/// 0, 1, 2, … on lanes.
#[inline(always)]
fn ramp<R: Real>(like: R) -> R {
    like.with_lanes(|k| k as f64)
}

/// A polynomial with derivatives in the world.
#[inline(always)]
fn patch_polynomial<R: Real, const D: usize>(
    coefficients: &[impl LaneNumber],
    degree: usize,
    xi: [R; 2],
    patch: &VisiblePatch,
) -> Jet<R> {
    let mut p = match degree {
        0 => Jet::constant(xi[0].broadcast(coefficients[0].to_f64())),
        1 => polynomial::<R, D>(coefficients, 1, xi),
        2 => polynomial::<R, D>(coefficients, 2, xi),
        _ => polynomial::<R, D>(coefficients, degree, xi),
    };
    if D >= 1 {
        p.x = p.x * xi[0].broadcast(patch.frame[0].scale);
        p.y = p.y * xi[0].broadcast(patch.frame[1].scale);
    }
    p
}

/// Adds to a vector of sums.
#[inline(always)]
fn add_jet<R: Real, const D: usize>(jet: Jet<R>, sums: &mut [R::Scalar], zero: R) {
    let sums = &mut sums[..(numbers::<D>() - 1) * WIDTH + R::LANES];
    (zero.load(sums) + jet.v).store(sums);
    if D >= 1 {
        (zero.load(&sums[WIDTH..]) + jet.x).store(&mut sums[WIDTH..]);
        (zero.load(&sums[2 * WIDTH..]) + jet.y).store(&mut sums[2 * WIDTH..]);
    }
}
