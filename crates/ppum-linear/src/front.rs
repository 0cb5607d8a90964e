//! The fronts of an elimination: which rows of a dense matrix belong to what.

use super::block_matrix::running_sum;
use std::ops::Range;

/// Blocks that are eliminated together, and those below them.
#[derive(Debug)]
pub(super) struct Front {
    /// Places of the blocks that are eliminated.
    pub(super) pivots: Range<usize>,
    /// Places of the blocks below them, ascending.
    pub(super) below: Vec<u32>,
    pub(super) children: Vec<usize>,
    /// The first row of each block, those of the pivots first, and the number of rows.
    pub(super) starts: Vec<usize>,
    /// The rows below, and in the parent.
    pub(super) runs: Vec<RowRun>,
}

/// Rows below a front that follow each other in its parent, too.
#[derive(Clone, Copy, Debug)]
pub(super) struct RowRun {
    /// The first of them below the front.
    pub(super) from: usize,
    /// The corresponding row of the parent.
    pub(super) to: usize,
    len: usize,
}

impl RowRun {
    /// The row below the front behind the last.
    pub(super) fn end(&self) -> usize {
        self.from + self.len
    }
}

impl Front {
    /// The front of some blocks, with the first unknown of each place.
    pub(super) fn new(
        pivots: Range<usize>,
        below: Vec<u32>,
        children: Vec<usize>,
        offsets: &[usize],
    ) -> Self {
        let places = pivots.clone().chain(below.iter().map(|&place| place as usize));
        let starts = running_sum(places.map(|place| offsets[place + 1] - offsets[place]));
        Self { pivots, below, children, starts, runs: Vec::new() }
    }

    /// Number of rows of its matrix.
    pub(super) fn rows(&self) -> usize {
        self.starts[self.starts.len() - 1]
    }

    /// Number of unknowns that are eliminated.
    pub(super) fn n_pivots(&self) -> usize {
        self.starts[self.pivots.len()]
    }

    /// The number of one of its blocks, given by its place.
    pub(super) fn local(&self, place: usize) -> usize {
        if place < self.pivots.end {
            return place - self.pivots.start;
        }
        let below = self.below.partition_point(|&other| (other as usize) < place);
        self.pivots.len() + below
    }

    /// Its blocks in panels of about one number of rows, none with pivots and others.
    pub(super) fn panels(&self, width: usize) -> Vec<Range<usize>> {
        let (middle, end) = (self.pivots.len(), self.starts.len() - 1);
        let mut panels = Vec::new();
        for blocks in [0..middle, middle..end] {
            self.add_panels(blocks, width, &mut panels);
        }
        panels
    }

    fn add_panels(&self, blocks: Range<usize>, width: usize, panels: &mut Vec<Range<usize>>) {
        let (start, end) = (self.starts[blocks.start], self.starts[blocks.end]);
        let n = (end - start).div_ceil(width);
        let mut from = blocks.start;
        for k in 1..=n {
            let reached = start + (end - start) * k / n;
            let to = match k == n {
                true => blocks.end,
                false => self.starts[..=blocks.end].partition_point(|&row| row <= reached) - 1,
            };
            if self.starts[to] > self.starts[from] {
                panels.push(from..to);
                from = to;
            }
        }
    }
}

/// The rows below a front in its parent.
pub(super) fn runs(front: &Front, parent: &Front) -> Vec<RowRun> {
    let mut runs: Vec<RowRun> = Vec::new();
    let rows = &front.starts[front.pivots.len()..];
    for (rows, &place) in rows.windows(2).zip(&front.below) {
        let (from, len) = (rows[0] - front.n_pivots(), rows[1] - rows[0]);
        let to = parent.starts[parent.local(place as usize)];
        match runs.last_mut() {
            Some(last) if last.to + last.len == to => last.len += len,
            _ => runs.push(RowRun { from, to, len }),
        }
    }
    runs.retain(|run| run.len > 0);
    runs
}

/// The slices of some ranges, which follow each other from the beginning on.
pub(super) fn split_at_ranges<'s, T>(
    mut all: &'s mut [T],
    ranges: &[Range<usize>],
) -> Vec<&'s mut [T]> {
    let mut parts = Vec::new();
    for range in ranges {
        let (part, rest) = all.split_at_mut(range.len());
        parts.push(part);
        all = rest;
    }
    parts
}
