//! Chunks on their way into an array.

use std::borrow::Cow;
use std::ops::Range;

use rayon::prelude::*;

use super::chunks::{ChunkGrid, ChunkLocation};
use super::error::{ReadResult, fail};
use super::filters::{Pipeline, UnfilteredChunk};
use super::source::Hdf5Source;
use super::types::step;

/// Chunks whose filters are undone together, on several threads.
pub(super) struct ChunkBatch<'a, 'f> {
    source: Hdf5Source<'f>,
    pipeline: &'a Pipeline,
    array: &'a mut [u8],
    waiting: Vec<StoredBytes<'a, 'f>>,
}

/// A chunk as it is stored.
struct StoredBytes<'a, 'f> {
    slab: Hyperslab<'a>,
    raw: Cow<'f, [u8]>,
    mask: u32,
}

/// Most chunks of a batch, and most bytes that they have together, with and without filters, unless
/// one has more.
const BATCH_CHUNKS: usize = 16;
const BATCH_BYTES: u64 = 1 << 24;

impl<'a, 'f> ChunkBatch<'a, 'f> {
    pub(super) fn new(source: Hdf5Source<'f>, pipeline: &'a Pipeline, array: &'a mut [u8]) -> Self {
        Self { source, pipeline, array, waiting: Vec::new() }
    }

    pub(super) fn add(
        &mut self,
        slab: Hyperslab<'a>,
        stored: ChunkLocation,
        is_plain: bool,
    ) -> ReadResult<()> {
        if is_plain || !self.pipeline.applies(stored.mask) {
            return self.copy(&slab, stored.address);
        }
        let cost = |raw: u64, slab: &Hyperslab| raw.saturating_add(self.kept(slab));
        let waiting = self.waiting.iter().map(|w| cost(w.raw.len() as u64, &w.slab)).sum::<u64>();
        let is_full = waiting.saturating_add(cost(stored.bytes, &slab)) > BATCH_BYTES;
        if is_full || self.waiting.len() == BATCH_CHUNKS {
            self.finish()?;
        }
        let raw = self.source.values(stored.address, stored.bytes)?;
        self.pipeline.charge(stored, slab.keep(), self.source.budget)?;
        self.waiting.push(StoredBytes { slab, raw, mask: stored.mask });
        Ok(())
    }

    /// Bytes of the elements of a chunk that are kept.
    fn kept(&self, slab: &Hyperslab) -> u64 {
        slab.keep() * self.pipeline.size as u64
    }

    /// Copies a chunk without filters.
    fn copy(&mut self, slab: &Hyperslab, address: u64) -> ReadResult<()> {
        let size = self.pipeline.size;
        if let Some(place) = slab.place(size) {
            return self.source.fill(address, &mut self.array[place]);
        }
        let values = self.source.values(address, self.kept(slab))?;
        slab.copy(&values, self.array, size);
        Ok(())
    }

    /// Undoes the filters of the chunks that wait. If there are several errors, that of the first
    /// chunk is returned.
    pub(super) fn finish(&mut self) -> ReadResult<()> {
        let (pipeline, waiting) = (self.pipeline, std::mem::take(&mut self.waiting));
        let undone: Vec<_> = waiting
            .par_iter()
            .map(|StoredBytes { slab, raw, mask }| pipeline.undo(raw, *mask, slab.keep()))
            .collect();
        for (StoredBytes { slab, .. }, undone) in waiting.iter().zip(undone) {
            self.put(slab, &undone?)?;
        }
        Ok(())
    }

    /// Puts the elements of a chunk where they belong.
    fn put(&mut self, slab: &Hyperslab, undone: &UnfilteredChunk) -> ReadResult<()> {
        let bytes = self.kept(slab) as usize;
        let size = self.pipeline.size;
        if undone.len() < bytes {
            return fail("a chunk holds fewer values than its shape says");
        }
        match slab.place(size) {
            Some(place) => undone.put(&mut self.array[place]),
            None => {
                let mut elements = vec![0; bytes];
                undone.put(&mut elements);
                slab.copy(&elements, self.array, size);
            }
        }
        Ok(())
    }
}

/// The part of an array that is in a chunk.
pub(super) struct Hyperslab<'a> {
    grid: &'a ChunkGrid<'a>,
    start: Vec<u64>,
    pub(super) extent: Vec<u64>,
}

impl<'a> Hyperslab<'a> {
    /// None for a chunk outside the array.
    pub(super) fn new(grid: &'a ChunkGrid<'a>, start: &[u64]) -> Option<Self> {
        let shape = grid.space.shape.iter().zip(grid.chunk).zip(start);
        let extent: Vec<u64> =
            shape.map(|((n, chunk), start)| n.saturating_sub(*start).min(*chunk)).collect();
        (!extent.contains(&0)).then(|| Self { grid, start: start.to_vec(), extent })
    }

    /// The bytes of the array in which the part lies in one piece, as it does in the chunk: it is
    /// one row, or some whole rows that the chunk has as whole ones, too.
    fn place(&self, size: usize) -> Option<Range<usize>> {
        let (chunk, shape) = (self.grid.chunk, &self.grid.space.shape);
        let first = self.extent.iter().take_while(|n| **n == 1).count();
        let is_whole = |k: usize| self.extent[k] == chunk[k] && self.extent[k] == shape[k];
        let start = place(&[], &self.start, shape) * size;
        (first + 1..shape.len()).all(is_whole).then(|| start..start + self.keep() as usize * size)
    }

    /// Elements of the chunk up to the last one in the array.
    fn keep(&self) -> u64 {
        let shape = self.grid.chunk.iter().zip(&self.extent);
        shape.fold(0, |last, (chunk, extent)| last * chunk + extent - 1) + 1
    }

    /// Copies the rows of the part to where they belong.
    fn copy(&self, chunk: &[u8], array: &mut [u8], size: usize) {
        let (outer, row) = match self.extent.split_last() {
            Some((row, outer)) => (outer, *row as usize * size),
            None => (&[][..], size),
        };
        let mut at = vec![0; outer.len()];
        loop {
            let from = place(&at, &[], self.grid.chunk) * size;
            let to = place(&at, &self.start, &self.grid.space.shape) * size;
            array[to..to + row].copy_from_slice(&chunk[from..from + row]);
            if !step(&mut at, outer) {
                break;
            }
        }
    }
}

/// The place of an element in a row-major array; coordinates that are left out are zero.
fn place(at: &[u64], start: &[u64], shape: &[u64]) -> usize {
    let coordinate = |k: usize, of: &[u64]| of.get(k).copied().unwrap_or(0);
    let sum = |sum: u64, (k, n): (usize, &u64)| sum * n + coordinate(k, at) + coordinate(k, start);
    shape.iter().enumerate().fold(0, sum) as usize
}
