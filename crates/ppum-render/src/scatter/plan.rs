//! What all bands of one view have in common, and the numbers of a patch as the view sees it.

use std::ops::Range;

use ppum::dataset::FieldData;
use ppum::domain::{Hole, LocalHole};
use ppum::field::Field;
use ppum::function::Slot;
use ppum::quantity::Quantity;
use ppum::vec2::{Rect, Vec2};

use super::collapse::ROWS;
use super::lists::Seen;
use crate::pixels::Pixels;
use crate::view::View;

/// Columns of a tile: with the rows of one vector the sums of a tile stay near the first cache.
pub(super) const COLUMNS: usize = 64;

/// ξ = `scale` · offset + `shift` in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine {
    pub(super) scale: f64,
    pub(super) shift: f64,
    /// Of a support, where its factors of the weight are, see [`Weights`](super::weights::Weights).
    pub(super) table: Option<u32>,
}

/// A function × polynomial.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    pub(super) function: Slot,
    pub(super) degree: u8,
    /// The polynomial is 0; there are no coefficients.
    zero: bool,
    /// First coefficient.
    offset: u64,
}

impl Block {
    const NOTHING: Self = Self { function: Slot::One, degree: 0, zero: true, offset: 0 };
}

/// A patch that is ready for strips.
#[derive(Clone, Debug)]
pub(super) struct Patch {
    /// Its index in the field.
    pub(super) index: u32,
    /// Coordinates of the support, [−1, 1]².
    pub(super) support: [Affine; 2],
    /// Coordinates of the polynomials.
    pub(super) frame: [Affine; 2],
    /// Columns of pixels that may be covered.
    pub(super) columns: Range<u32>,
    /// Rows of the bands that may be covered.
    pub(super) rows: Range<u32>,
    /// Its blocks; the first is of function 1, unless the plan has no components.
    pub(super) blocks: Range<u32>,
}

impl Patch {
    /// Its blocks in the bands' list.
    #[inline(always)]
    pub(super) fn blocks(&self) -> Range<usize> {
        self.blocks.start as usize..self.blocks.end as usize
    }
}

/// What all bands of one view have in common. The anchor is the view's centre.
#[derive(Debug)]
pub(super) struct Plan<'f> {
    pub(super) field: &'f Field<'f>,
    pub(super) view: View,
    quantity: &'f Quantity,
    /// Coefficients of each component.
    pub(super) coefficients: Vec<&'f [f64]>,
    /// Pixels inside the domain.
    pub(super) inside: [Range<usize>; 2],
    /// The holes in sight.
    pub(super) holes: Vec<HolePixels>,
    /// Columns of tiles.
    pub(super) columns: usize,
    /// Offsets of the columns and rows of pixels from the view's centre, up to full tiles.
    pub(super) offsets: [Vec<f64>; 2],
}

/// A hole seen from the view's centre, and the columns and rows of pixels that may lie in it.
#[derive(Debug)]
pub(super) struct HolePixels {
    pub(super) hole: LocalHole,
    pub(super) columns: Range<usize>,
    pub(super) rows: Range<usize>,
}

impl<'f> Plan<'f> {
    pub(super) fn new(field: &'f Field<'f>, view: &View, quantity: &'f Quantity) -> Self {
        let [columns, rows] = [COLUMNS, ROWS].map(|n| n as u32);
        let columns = 0..view.pixels[0].next_multiple_of(columns);
        let rows = 0..view.pixels[1].next_multiple_of(rows);
        Self {
            field,
            view: *view,
            quantity,
            coefficients: coefficients(field.data, quantity),
            inside: view.inside(&field.domain.bounds),
            holes: holes(&field.domain.holes, view.center, &Pixels::new(view)),
            columns: columns.len() / COLUMNS,
            offsets: [
                columns.map(|k| view.column_offset(k)).collect(),
                rows.map(|k| view.row_offset(k)).collect(),
            ],
        }
    }

    /// Coefficients of a block for one component.
    #[inline(always)]
    pub(super) fn block_coefficients(&self, block: &Block, component: usize) -> &'f [f64] {
        if block.zero {
            return &[0.0];
        }
        &self.coefficients[component][block.offset as usize..]
    }

    /// The constant coefficient of a patch's first block of function 1.
    #[inline(always)]
    pub(super) fn constant(&self, patch: u32, component: usize) -> f64 {
        let mut blocks = self.of_field(patch).map(|block| self.block(block));
        let smooth = blocks.find(|block| block.function == Slot::One);
        let smooth = smooth.or_else(|| self.of_partition(patch));
        smooth.map_or(0.0, |block| self.block_coefficients(&block, component)[0])
    }

    /// The blocks of a patch in the field.
    #[inline(always)]
    pub(super) fn of_field(&self, patch: u32) -> Range<usize> {
        let is_other = matches!(self.quantity, Quantity::PartitionFunction(_));
        if is_other || self.coefficients.is_empty() {
            return 0..0;
        }
        self.field.data.blocks(patch as usize)
    }

    /// A block of the field.
    #[inline(always)]
    pub(super) fn block(&self, block: usize) -> Block {
        let data = self.field.data;
        Block {
            function: self.field.functions.of(data.block_function[block]),
            degree: data.block_degree[block],
            zero: false,
            offset: data.block_offset[block],
        }
    }

    /// The block of a patch where the field is a partition function.
    #[inline(always)]
    pub(super) fn of_partition(&self, patch: u32) -> Option<Block> {
        let Quantity::PartitionFunction(of) = self.quantity else { return None };
        Some(Block { zero: *of != patch, ..Block::NOTHING })
    }

    /// Adds the blocks of a patch, one of function 1 first.
    pub(super) fn add_blocks(&self, patch: u32, blocks: &mut Vec<Block>) {
        if self.coefficients.is_empty() {
            return;
        }
        let start = blocks.len();
        blocks.extend(self.of_field(patch).map(|block| self.block(block)));
        blocks.extend(self.of_partition(patch));
        let smooth = |block: &Block| block.function == Slot::One;
        match blocks[start..].iter().position(smooth) {
            Some(at) => blocks.swap(start, start + at),
            None => blocks.insert(start, Block::NOTHING),
        }
    }

    /// A patch with its blocks.
    pub(super) fn patch(&self, seen: &Seen, blocks: Range<u32>) -> Patch {
        let (partition, anchor) = (&self.field.step.partition, self.view.center);
        let k = seen.patch as usize;
        Patch {
            index: seen.patch,
            support: affine(partition.center[k] - anchor, partition.half[k]),
            frame: affine(partition.origin[k] - anchor, partition.scale[k]),
            columns: seen.columns.clone(),
            rows: seen.rows.clone(),
            blocks,
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
