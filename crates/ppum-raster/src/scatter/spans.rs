//! Patches at a column of vectors that are the same in y, collapsed together.
//!
//! The weight is a product, W = a(x) b(y). Patches beside each other mostly have the same b, the
//! same coordinate η and the same functions. The polynomials in y that they collapse to at a vector
//! of columns are then added coefficient by coefficient: a span of patches costs a pixel what one
//! patch does, however narrow they are. Whether patches are the same is asked of their numbers, so
//! any cover is drawn, and where neighbours differ each is a span of its own.
//!
//! Where a span is alone, its b(y) cancels: the field is what its tables hold over Σ a.

use std::ops::Range;

use ppum::real::LaneNumber;

use super::collapse::ROWS;
use super::plan::{Affine, VisiblePatch};

/// Places to look for a span, and how many of them before it is given up: patches that begin at
/// different rows of a tile never meet there.
const SLOTS: usize = 256;
const TRIES: usize = 4;

/// The spans at a column of vectors.
#[derive(Debug, Default)]
pub(super) struct ColumnSpans<T> {
    pub(super) all: Vec<ColumnSpan>,
    pub(super) terms: Vec<BlockTerm>,
    /// For each span, the weight's factor and slope in x, then for each component the tables of
    /// its blocks.
    pub(super) tables: Vec<T>,
    /// The values over the weight's factor, for spans that are alone somewhere.
    pub(super) alone: Vec<T>,
    /// For each span, the weight's factor and slope in y and η, by rows.
    pub(super) down: Vec<T>,
    /// The numbers in use.
    pub(super) used: usize,
    /// The spans by the first row of their patches.
    slots: Vec<u32>,
}

/// Numbers of a span in `down`.
pub(super) const DOWN: usize = 3 * ROWS;

/// Patches that are the same in y.
#[derive(Clone, Debug)]
pub(super) struct ColumnSpan {
    /// Coordinates in y, of the support and of the polynomials.
    pub(super) support: Affine,
    pub(super) frame: Affine,
    pub(super) kind: u32,
    /// The rows of the tile that they may cover.
    pub(super) rows: Range<usize>,
    /// Its tables.
    pub(super) table: usize,
    /// Length of a component's tables.
    pub(super) len: usize,
    pub(super) terms: Range<usize>,
    /// True if they cover the whole vector.
    pub(super) is_full: bool,
    /// True if its tables over the weight's factor are there.
    pub(super) is_divided: bool,
}

impl ColumnSpan {
    /// True if a patch has the same b(y), η(y), functions and degrees.
    #[inline]
    fn joins(&self, patch: &VisiblePatch) -> bool {
        self.kind == patch.kind && self.support == patch.support[1] && self.frame == patch.frame[1]
    }
}

/// A block.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockTerm {
    pub(super) degree: usize,
    /// Length of its table.
    pub(super) len: usize,
    /// First number of its function in the basis; none for function 1.
    pub(super) function: Option<usize>,
}

impl<T: LaneNumber> ColumnSpans<T> {
    #[inline]
    pub(super) fn clear(&mut self) {
        self.all.clear();
        self.terms.clear();
        self.used = 0;
        self.slots.clear();
        self.slots.resize(SLOTS, u32::MAX);
    }

    /// The span of a patch, or the slot for one.
    #[inline]
    pub(super) fn find(&self, patch: &VisiblePatch, joins: bool) -> Result<usize, usize> {
        let first = patch.rows.start as usize * TRIES % SLOTS;
        for slot in first..first + TRIES {
            let place = self.slots[slot] as usize;
            match self.all.get(place).filter(|_| joins) {
                None => return Err(slot),
                Some(span) if span.joins(patch) => return Ok(place),
                Some(_) => {}
            }
        }
        Err(first)
    }

    /// Makes room for a span; the numbers in its tables are left over from others.
    #[inline]
    pub(super) fn push(&mut self, span: ColumnSpan, len: usize, slot: usize) -> usize {
        let place = self.all.len();
        self.used += len;
        if self.tables.len() < self.used {
            self.tables.resize(self.used, T::default());
            self.alone.resize(self.used, T::default());
        }
        if self.down.len() < DOWN * (place + 1) {
            self.down.resize(DOWN * (place + 1), T::default());
        }
        self.slots[slot] = place as u32;
        self.all.push(span);
        place
    }
}
