//! The patches of some bands, listed by tile.
//!
//! Bands find their own, on the thread that draws them, so a picture of a million patches needs no memory for all of them and
//! no thread waits for another. Patches that are drawn as grains are listed by their pixels alone; for the others it is found
//! out once where their coordinates and polynomials are.

use std::ops::Range;

use ppum::real::Scalar;
use ppum::vec2::Rect;

use super::collapse::ROWS;
use super::plan::{Block, COLUMNS, Patch, Plan};
use super::weights::Weights;
use crate::pixels::Pixels;

/// Most pixels of a grain in a tile: to collapse a patch of order 2 and to list it by columns costs what so many pairs do.
pub(super) const MOST_PIXELS: usize = 4;

/// Pairs that grains must save a tile, or else there are none in it: their sums go through memory, which costs what a quarter of a
/// pair does at each of its pixels.
pub(super) const LEAST_SAVING: usize = COLUMNS * ROWS / 4;

/// Bands that find their patches together: of patches as high as a band two find 1.5 times as many as there are, one alone
/// twice as many. More would leave too few parts for many threads.
pub(super) const BANDS: usize = 2;

/// A patch with pixels in the bands.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    /// Its index in the field.
    pub(super) patch: u32,
    /// Its index among the patches that are ready for strips, or [`NONE`].
    ready: u32,
    /// Columns of pixels that may be covered.
    pub(super) columns: Range<u32>,
    /// Rows of the bands that may be covered.
    pub(super) rows: Range<u32>,
    /// True if its polynomials have a frame that is not the support's.
    pub(super) has_frame: bool,
    /// Of a patch that is small enough for a grain in any tile, the constants of the first components, rounded; else NaN.
    constants: [f32; LOOKED_AT],
}

/// Components whose constants are looked at when a patch is found.
const LOOKED_AT: usize = 2;

const NONE: u32 = u32::MAX;

impl Seen {
    /// The columns and rows of its pixels in a tile.
    #[inline(always)]
    pub(super) fn within(&self, [left, top]: [usize; 2]) -> [Range<usize>; 2] {
        let common = |range: &Range<u32>, start: usize, count: usize| {
            start.max(range.start as usize)..(start + count).min(range.end as usize)
        };
        [common(&self.columns, left, COLUMNS), common(&self.rows, top, ROWS)]
    }

    /// Their number.
    #[inline(always)]
    fn pixels(&self, corner: [usize; 2]) -> usize {
        let [columns, rows] = self.within(corner);
        columns.len() * rows.len()
    }

    /// Columns and bands of the tiles that it meets.
    #[inline(always)]
    fn tiles(&self) -> [Range<usize>; 2] {
        let whole = |range: &Range<u32>, size: usize| {
            range.start as usize / size..(range.end as usize).div_ceil(size)
        };
        [whole(&self.columns, COLUMNS), whole(&self.rows, ROWS)]
    }
}

/// The patches of one tile, in the order of the field.
#[derive(Clone, Copy, Debug)]
pub(super) struct List<'a> {
    /// Places among the patches seen.
    pub(super) grains: &'a [u32],
    /// Places among those that are ready.
    pub(super) others: &'a [u32],
}

/// The patches of some bands. Memory that a thread uses again.
#[derive(Debug, Default)]
pub(super) struct Lists<T> {
    pub(super) seen: Vec<Seen>,
    /// The first band, and tiles of a band.
    first: usize,
    columns: usize,
    /// Those that are ready for strips, with their blocks.
    pub(super) patches: Vec<Patch>,
    pub(super) blocks: Vec<Block>,
    /// Factors of their weights.
    pub(super) weights: Weights<T>,
    /// What the search tree has found.
    found: Vec<u32>,
    /// Compressed rows: tile → its grains, then the others.
    starts: Vec<u32>,
    middles: Vec<u32>,
    entries: Vec<u32>,
    /// The others of a tile.
    others: Vec<u32>,
}

impl<T: Scalar> Lists<T> {
    /// Lists the patches of some bands, with grains in tiles where they save enough.
    pub(super) fn fill(&mut self, plan: &Plan<'_>, bands: Range<usize>, least_saving: usize) {
        (self.first, self.columns) = (bands.start, plan.columns);
        self.patches.clear();
        self.blocks.clear();
        self.weights.begin();
        self.find(plan, &bands);
        self.list(bands.len());
        self.middles.clear();
        for band in bands {
            for column in 0..plan.columns {
                self.divide(plan, [column, band], least_saving);
            }
        }
    }

    /// The patches of a tile.
    pub(super) fn of(&self, column: usize, band: usize) -> List<'_> {
        let tile = self.tile(column, band);
        let [start, end] = [self.starts[tile] as usize, self.starts[tile + 1] as usize];
        let (grains, others) = self.entries[start..end].split_at(self.middles[tile] as usize);
        List { grains, others }
    }

    fn tile(&self, column: usize, band: usize) -> usize {
        (band - self.first) * self.columns + column
    }

    /// Midway between the constants of the first and the last patch of a tile, which lie in opposite corners if the patches follow
    /// the Morton curve; or between the least and the greatest of its grains, as far as they were looked at.
    pub(super) fn middle(&self, plan: &Plan<'_>, list: List<'_>, component: usize) -> f64 {
        let mut ends = [f32::INFINITY, f32::NEG_INFINITY];
        for &place in if component < LOOKED_AT { list.grains } else { &[] } {
            let constant = self.seen[place as usize].constants[component];
            ends = [ends[0].min(constant), ends[1].max(constant)];
        }
        let mut ends = ends.map(f64::from);
        if ends[0] > ends[1] {
            let patch = |place: &u32| self.patches[*place as usize].index;
            let grain = |place: &u32| self.seen[*place as usize].patch;
            let first = list.others.first().map(patch).or(list.grains.first().map(grain));
            let last = list.others.last().map(patch).or(list.grains.last().map(grain));
            ends = [first, last].map(|k| k.map_or(0.0, |k| plan.constant(k, component)));
        }
        0.5 * (ends[0] + ends[1])
    }

    /// Finds the patches of some bands and their pixels. What grains will need of the field is read here once, in the order in
    /// which it lies in memory: tile by tile it would come in pieces, and most of the time would go into waiting for them.
    fn find(&mut self, plan: &Plan<'_>, bands: &Range<usize>) {
        let (pixels, partition) = (Pixels::new(&plan.view), &plan.field.step.partition);
        let first = (bands.start * ROWS) as u32;
        let end = plan.view.pixels[1].min((bands.end * ROWS) as u32);
        let components = plan.coefficients.len().min(LOOKED_AT);
        self.found.clear();
        plan.field.tree.query_box(&pixels.window(first..end), &mut self.found);
        self.seen.clear();
        for &patch in &self.found {
            let k = patch as usize;
            let (center, half) = (partition.center[k], partition.half[k]);
            let [columns, rows] = pixels.covered(&Rect::around(center - plan.view.center, half));
            let rows = rows.start.max(first)..rows.end.min(end);
            if columns.is_empty() || rows.is_empty() {
                continue;
            }
            let mut constants = [f32::NAN; LOOKED_AT];
            if columns.len() * rows.len() <= MOST_PIXELS {
                for (component, constant) in constants.iter_mut().enumerate().take(components) {
                    *constant = plan.constant(patch, component) as f32;
                }
            }
            let has_frame = partition.origin[k] != center || partition.scale[k] != half;
            self.seen.push(Seen { patch, ready: NONE, columns, rows, has_frame, constants });
        }
    }

    /// Lists what is seen by tile.
    fn list(&mut self, bands: usize) {
        let Self { seen, starts, entries, first, columns, .. } = self;
        let for_each_tile = |seen: &Seen, f: &mut dyn FnMut(usize)| {
            let [across, down] = seen.tiles();
            for band in down {
                across.clone().for_each(|column| f((band - *first) * *columns + column));
            }
        };
        // Entry t + 2 counts tile t, becomes its start, and, after filling, its end: entry t + 1.
        let tiles = *columns * bands;
        starts.clear();
        starts.resize(tiles + 2, 0);
        for seen in &*seen {
            for_each_tile(seen, &mut |tile| starts[tile + 2] += 1);
        }
        for tile in 0..tiles {
            starts[tile + 2] += starts[tile + 1];
        }
        entries.resize(starts[tiles + 1] as usize, 0);
        for (place, seen) in (0u32..).zip(&*seen) {
            for_each_tile(seen, &mut |tile| {
                entries[starts[tile + 1] as usize] = place;
                starts[tile + 1] += 1;
            });
        }
    }

    /// Divides the list of a tile into grains and others, which are made ready.
    fn divide(&mut self, plan: &Plan<'_>, [column, band]: [usize; 2], least_saving: usize) {
        let (tile, corner) = (self.tile(column, band), [column * COLUMNS, band * ROWS]);
        let [start, end] = [self.starts[tile] as usize, self.starts[tile + 1] as usize];
        let has_grains = self.saves(corner, start..end, least_saving);
        let mut middle = start;
        self.others.clear();
        for at in start..end {
            let place = self.entries[at];
            if has_grains && self.seen[place as usize].pixels(corner) <= MOST_PIXELS {
                self.entries[middle] = place;
                middle += 1;
            } else {
                let ready = self.ready(plan, place as usize);
                self.others.push(ready);
            }
        }
        self.entries[middle..end].copy_from_slice(&self.others);
        self.middles.push((middle - start) as u32);
    }

    /// True if grains save more than so many pairs. A few patches are not asked: there would be little to save.
    fn saves(&self, corner: [usize; 2], entries: Range<usize>, least: usize) -> bool {
        if entries.len() <= least / 4 {
            return false;
        }
        let mut sum = 0;
        self.entries[entries].iter().any(|&place| {
            sum += MOST_PIXELS.saturating_sub(self.seen[place as usize].pixels(corner));
            sum > least
        })
    }

    /// Makes a patch ready for strips, if it is not.
    fn ready(&mut self, plan: &Plan<'_>, place: usize) -> u32 {
        let seen = &mut self.seen[place];
        if seen.ready == NONE {
            seen.ready = self.patches.len() as u32;
            let start = self.blocks.len() as u32;
            plan.add_blocks(seen.patch, &mut self.blocks);
            let blocks = start..self.blocks.len() as u32;
            let mut patch = plan.patch(seen, blocks);
            self.weights.keep(plan, &mut patch);
            self.patches.push(patch);
        }
        seen.ready
    }
}
