//! The parts of a field that one view needs: the patches in sight, their pixels, their blocks,
//! their tiles.

use std::collections::HashMap;
use std::ops::Range;

use ppum::dataset::FieldData;
use ppum::domain::{Hole, LocalHole};
use ppum::field::Field;
use ppum::function::Slot;
use ppum::quantity::Quantity;
use ppum::vec2::{Rect, Vec2};
use ppum::weight::WeightFunction;
use rayon::prelude::*;

use crate::pixels::Pixels;
use crate::view::View;

/// Columns of a tile, at most as many as a number has bits.
pub(super) const COLUMNS: usize = 64;

/// Patches whose pixels are counted, at most, to choose how an image is drawn.
const SAMPLE: usize = 1000;

/// ξ = `scale` · offset + `shift` in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine {
    pub(super) scale: f64,
    pub(super) shift: f64,
    /// For a support, the index of its factors of the weight, see
    /// [`PixelWeights`](super::weights::PixelWeights).
    pub(super) table: Option<u32>,
}

/// A function × polynomial.
#[derive(Clone, Copy, Debug)]
pub(super) struct PatchBlock {
    pub(super) function: Slot,
    pub(super) degree: u8,
    /// The polynomial is 0; there are no coefficients.
    zero: bool,
    /// First coefficient.
    offset: u64,
}

impl PatchBlock {
    const NOTHING: Self = Self { function: Slot::One, degree: 0, zero: true, offset: 0 };

    /// Its function and degree.
    fn kind(&self) -> [u32; 3] {
        let degree = self.degree.into();
        match self.function {
            Slot::One => [0, 0, degree],
            Slot::Jet { group, entry } => [group + 1, entry, degree],
        }
    }
}

/// A patch in sight.
#[derive(Clone, Debug)]
pub(super) struct VisiblePatch {
    /// Its index in the field.
    pub(super) index: u32,
    /// Coordinates of the support, [−1, 1]².
    pub(super) support: [Affine; 2],
    /// Coordinates of the polynomials.
    pub(super) frame: [Affine; 2],
    /// Columns of pixels that may be covered.
    pub(super) columns: Range<u32>,
    /// Rows of pixels that may be covered.
    pub(super) rows: Range<u32>,
    /// Its blocks; the first is of function 1, unless the plan has no components.
    pub(super) blocks: Range<u32>,
    /// Which functions and degrees its blocks have: the same number, the same list.
    pub(super) kind: u32,
}

impl VisiblePatch {
    /// Its blocks in the plan's list.
    #[inline(always)]
    pub(super) fn blocks(&self) -> Range<usize> {
        self.blocks.start as usize..self.blocks.end as usize
    }
}

/// All data of one view, made once in f64. The anchor is the view's centre.
#[derive(Debug)]
pub(super) struct ViewPlan<'f> {
    field: &'f Field<'f>,
    view: View,
    quantity: &'f Quantity,
    /// The size of a pixel.
    pub(super) pixel: f64,
    /// True if the patches at a point are counted: their weights are 1.
    pub(super) is_overlap: bool,
    /// True if the patches are summed one by one (`patch_sums`): then none is listed here.
    pub(super) is_per_patch: bool,
    pub(super) patches: Vec<VisiblePatch>,
    pub(super) blocks: Vec<PatchBlock>,
    /// Coefficients of each component.
    pub(super) coefficients: Vec<&'f [f64]>,
    /// Pixels inside the domain.
    pub(super) inside: [Range<usize>; 2],
    /// The holes in sight.
    pub(super) holes: Vec<HolePixels>,
    /// Columns of tiles, and rows of them: bands.
    tiles: [usize; 2],
    /// Rows of a tile.
    rows: usize,
}

/// A hole seen from the view's centre, and the columns and rows of pixels that may lie in it.
#[derive(Debug)]
pub(super) struct HolePixels {
    pub(super) hole: LocalHole,
    pub(super) columns: Range<usize>,
    pub(super) rows: Range<usize>,
}

impl<'f> ViewPlan<'f> {
    /// The plan for tiles of `rows` rows.
    pub(super) fn new(
        field: &'f Field<'f>,
        view: &View,
        quantity: &'f Quantity,
        rows: usize,
        most_pixels: usize,
    ) -> Self {
        let pixels = Pixels::new(view);
        let mut visible = Vec::new();
        field.tree.query_box(&pixels.window(), &mut visible);
        let is_per_patch = is_per_patch(field, view.center, &pixels, &visible, most_pixels);
        if is_per_patch {
            visible.clear();
        }
        let count = visible.iter().map(|&i| 1 + field.data.blocks(i as usize).len()).sum();
        let mut plan = Self {
            field,
            view: *view,
            quantity,
            pixel: view.pixel_size(),
            is_overlap: *quantity == Quantity::Overlap,
            is_per_patch,
            patches: Vec::new(),
            blocks: Vec::with_capacity(count),
            coefficients: coefficients(field.data, quantity),
            inside: view.inside(&field.domain.bounds),
            holes: holes(&field.domain.holes, view.center, &pixels),
            tiles: [
                (view.pixels[0] as usize).div_ceil(COLUMNS),
                (view.pixels[1] as usize).div_ceil(rows),
            ],
            rows,
        };
        plan.patches = visible.par_iter().map(|&index| plan.patch(index, &pixels)).collect();
        let mut kinds = ListNumbers::default();
        for patch in &mut plan.patches {
            let start = plan.blocks.len();
            add_blocks(field, patch.index as usize, quantity, &mut plan.blocks);
            patch.kind = kinds.number(&plan.blocks[start..]);
            patch.blocks = start as u32..plan.blocks.len() as u32;
        }
        plan
    }

    /// Number of patches of the tiles of each band.
    pub(super) fn entries_of_bands(&self) -> Vec<usize> {
        let mut changes = vec![0i64; self.tiles[1] + 1];
        for patch in &self.patches {
            let (bands, columns) = (tiles(&patch.rows, self.rows), tiles(&patch.columns, COLUMNS));
            if !bands.is_empty() {
                changes[bands.start] += columns.len() as i64;
                changes[bands.end] -= columns.len() as i64;
            }
        }
        changes.pop();
        let sums = changes.into_iter().scan(0, |sum, change| {
            *sum += change;
            Some(*sum as usize)
        });
        sums.collect()
    }

    /// The tiles of some bands.
    pub(super) fn tiles(&self, bands: &Range<usize>) -> Tiles {
        Tiles::new(&self.patches, self.tiles[0], bands, self.rows)
    }

    /// Coefficients of a block for one component.
    #[inline(always)]
    pub(super) fn block_coefficients(&self, block: &PatchBlock, component: usize) -> &'f [f64] {
        if block.zero {
            return &[0.0];
        }
        &self.coefficients[component][block.offset as usize..]
    }

    /// The constants of patches that a tile subtracts: midway between those of the first and the
    /// last patch, which lie in opposite corners if the patches follow the Morton curve. The
    /// partition of unity reproduces constants, and ∇U − u ∇S loses the fewer digits the smaller
    /// u is.
    pub(super) fn middle(&self, patches: &[u32], shift: &mut Vec<f64>) {
        shift.clear();
        shift.resize(self.coefficients.len(), 0.0);
        let [Some(&first), Some(&last)] = [patches.first(), patches.last()] else { return };
        let mut blocks = Vec::new();
        for patch in [first, last] {
            blocks.clear();
            add_blocks(self.field, patch as usize, self.quantity, &mut blocks);
            for (component, shift) in shift.iter_mut().enumerate() {
                *shift += 0.5 * self.block_coefficients(&blocks[0], component)[0];
            }
        }
    }

    /// A patch, without its blocks.
    #[inline(always)]
    pub(super) fn patch(&self, index: u32, pixels: &Pixels<'_>) -> VisiblePatch {
        let (partition, k, anchor) =
            (self.field.step.partition.boxes(), index as usize, self.view.center);
        let (center, half) = (partition.center[k] - anchor, partition.half[k]);
        let [columns, rows] = pixels.covered(&Rect::around(center, half));
        let support = affine(center, half);
        let has_frame = partition.origin[k] != partition.center[k] || partition.scale[k] != half;
        let frame = if has_frame {
            affine(partition.origin[k] - anchor, partition.scale[k])
        } else {
            support
        };
        VisiblePatch { index, support, frame, columns, rows, blocks: 0..0, kind: 0 }
    }
}

/// Numbers for lists of functions and degrees.
#[derive(Debug, Default)]
struct ListNumbers {
    known: HashMap<Vec<[u32; 3]>, u32>,
    /// The last list, which most often comes again.
    last: Vec<[u32; 3]>,
    number: u32,
}

impl ListNumbers {
    fn number(&mut self, blocks: &[PatchBlock]) -> u32 {
        let is_last = self.last.iter().copied().eq(blocks.iter().map(PatchBlock::kind));
        if !is_last || self.known.is_empty() {
            self.last = blocks.iter().map(PatchBlock::kind).collect();
            let next = self.known.len() as u32;
            self.number = *self.known.entry(self.last.clone()).or_insert(next);
        }
        self.number
    }
}

/// True if patches are summed one by one: if on average those of a sample have fewer pixels than so
/// many. Weights by formula are found for many pixels of spans at a time, and would be dear one by
/// one.
fn is_per_patch(
    field: &Field,
    anchor: Vec2,
    pixels: &Pixels<'_>,
    visible: &[u32],
    most: usize,
) -> bool {
    let partition = field.step.partition.boxes();
    let count = |&k: &u32| {
        let (center, half) = (partition.center[k as usize], partition.half[k as usize]);
        let [columns, rows] = pixels.covered(&Rect::around(center - anchor, half));
        columns.len() * rows.len()
    };
    let sample = visible.iter().step_by(visible.len().div_ceil(SAMPLE).max(1));
    let (patches, sum) = (sample.len(), sample.map(count).sum::<usize>());
    !matches!(partition.weight, WeightFunction::Formula(_)) && sum < patches.saturating_mul(most)
}

/// Adds the blocks of a patch, one of function 1 first; none if there is nothing to sum
/// but weights.
#[inline(always)]
pub(super) fn add_blocks(
    field: &Field,
    patch: usize,
    quantity: &Quantity,
    blocks: &mut Vec<PatchBlock>,
) {
    let start = blocks.len();
    if let Quantity::PartitionFunction(of) = quantity {
        blocks.push(PatchBlock { zero: *of as usize != patch, ..PatchBlock::NOTHING });
    } else if !matches!(quantity, Quantity::WeightSum | Quantity::Overlap) {
        let data = field.data;
        blocks.extend(data.blocks(patch).map(|block| PatchBlock {
            function: field.functions.of(data.block_function[block]),
            degree: data.block_degree[block],
            zero: false,
            offset: data.block_offset[block],
        }));
        let smooth = |block: &PatchBlock| block.function == Slot::One;
        match blocks[start..].iter().position(smooth) {
            Some(at) => blocks.swap(start, start + at),
            None => blocks.insert(start, PatchBlock::NOTHING),
        }
    }
}

/// The summands: the field's components, the constant 1 of one patch, or nothing.
fn coefficients<'f>(data: &'f FieldData, quantity: &Quantity) -> Vec<&'f [f64]> {
    match quantity {
        Quantity::PartitionFunction(_) => vec![&[1.0]],
        Quantity::WeightSum | Quantity::Overlap => Vec::new(),
        _ => data.coefficients.iter().map(Vec::as_slice).collect(),
    }
}

/// (x − origin) / scale as multiplication and addition.
fn affine(origin: Vec2, scale: Vec2) -> [Affine; 2] {
    let one = |origin: f64, scale: f64| {
        let scale = 1.0 / scale;
        Affine { scale, shift: -origin * scale, table: None }
    };
    [one(origin.x, scale.x), one(origin.y, scale.y)]
}

/// The holes in sight.
fn holes(holes: &[Hole], anchor: Vec2, pixels: &Pixels) -> Vec<HolePixels> {
    let seen = holes.iter().map(|hole| {
        let bounds = hole.bounds();
        let relative = Rect::new(bounds.min - anchor, bounds.max - anchor);
        let [columns, rows] =
            pixels.covered(&relative).map(|range| range.start as usize..range.end as usize);
        HolePixels { hole: hole.at(anchor), columns, rows }
    });
    seen.filter(|hole| !hole.columns.is_empty() && !hole.rows.is_empty()).collect()
}

/// Most patches in the lists of a batch's tiles, unless one band has more: 128 MiB. A million
/// patches that an image resolves have two million entries.
const MOST_ENTRIES: usize = 1 << 25;

/// Some bands in batches whose lists of patches, of so many entries a band, are short enough to be
/// kept; all of them where they can be.
pub(super) fn band_batches(bands: Range<usize>, entries: &[usize]) -> Vec<Range<usize>> {
    let (mut batches, mut start, mut sum) = (Vec::new(), bands.start, 0);
    for band in bands.clone() {
        if band > start && sum + entries[band] > MOST_ENTRIES {
            batches.push(start..band);
            (start, sum) = (band, 0);
        }
        sum += entries[band];
    }
    batches.push(start..bands.end);
    batches
}

/// The patches of each tile of a batch in compressed rows.
#[derive(Debug)]
pub(super) struct Tiles {
    /// Number of tiles in a band.
    pub(super) columns: usize,
    first: usize,
    starts: Vec<u32>,
    patches: Vec<u32>,
}

impl Tiles {
    fn new(patches: &[VisiblePatch], columns: usize, bands: &Range<usize>, rows: usize) -> Self {
        let count = columns * bands.len();
        let for_each_tile = |patch: &VisiblePatch, f: &mut dyn FnMut(usize)| {
            let of = tiles(&patch.rows, rows);
            for band in of.start.max(bands.start)..of.end.min(bands.end) {
                tiles(&patch.columns, COLUMNS).for_each(|c| f((band - bands.start) * columns + c));
            }
        };
        // Entry t + 2 counts tile t, becomes its start, and, after filling, its end: entry t + 1.
        let mut starts = vec![0; count + 2];
        for patch in patches {
            for_each_tile(patch, &mut |tile| starts[tile + 2] += 1);
        }
        for tile in 0..count {
            starts[tile + 2] += starts[tile + 1];
        }
        let mut entries = vec![0; starts[count + 1] as usize];
        for (index, patch) in (0u32..).zip(patches) {
            for_each_tile(patch, &mut |tile| {
                entries[starts[tile + 1] as usize] = index;
                starts[tile + 1] += 1;
            });
        }
        Self { columns, first: bands.start, starts, patches: entries }
    }

    /// The patches that meet a tile, ascending.
    pub(super) fn patches_at(&self, column: usize, band: usize) -> &[u32] {
        let tile = self.index(column, band);
        &self.patches[self.starts[tile] as usize..self.starts[tile + 1] as usize]
    }

    fn index(&self, column: usize, band: usize) -> usize {
        (band - self.first) * self.columns + column
    }
}

/// The tiles of `size` pixels that a range meets.
fn tiles(pixels: &Range<u32>, size: usize) -> Range<usize> {
    pixels.start as usize / size..(pixels.end as usize).div_ceil(size)
}
