//! The cost of reading a file: bytes read of it, bytes that they expand to, and memory for what is
//! in it.

use std::cell::Cell;

use crate::content::{Array, ArrayValues};

/// Memory that the arrays of any file may take, beside [`EXPANSION`] times its length: 64 MiB.
const FREE_BYTES: u64 = 1 << 26;

/// Coefficients do not shrink, geometry and indices to some percent: real files have up to three.
const EXPANSION: u64 = 4;

/// Memory of a text beside its characters: a `String`, and what the allocator adds.
const TEXT_BYTES: u64 = 64;

/// Memory of a named array beside its values: name, shape, place in the map.
const ARRAY_BYTES: u64 = 256;

/// Times the length of the file that may be read of it, and that filters may expand it to. Headers
/// are read up to four times.
const READINGS: u64 = 16;

/// Bytes that may be read of any file.
const FREE_READINGS: u64 = 1 << 24;

/// Times the length of the file that its structures may take in memory where it is read in
/// parts, beside
/// [`FREE_READINGS`]: they are read once, except for those on the border of two pages.
const LOADINGS: u64 = 2;

/// A reading costs as much as this many bytes at least.
const READING: u64 = 16;

/// Bytes that the filters of any file may expand to: most of a chunk that is larger than its array
/// is thrown away at once, so it takes time (about a second for 4 GiB of what shrinks a
/// thousandfold) and no memory.
const FREE_EXPANDED: u64 = 1 << 32;

/// Smallest number of bytes an object of a file takes, with its link.
const OBJECT_BYTES: u64 = 64;

/// Objects that any file may have: the smallest datasets are mostly objects.
const FREE_OBJECTS: u64 = 256;

/// Arrays that take less than this together are always within the budget: none has to be
/// stored plain.
pub(super) const PLAIN_BYTES: u64 = FREE_BYTES / 2;

/// The rest of an allowance.
pub(super) struct Allowance(Cell<u64>);

impl Allowance {
    /// Takes a cost from it; false if there is not enough, and nothing is taken.
    #[must_use]
    pub(super) fn charge(&self, cost: u64) -> bool {
        let left = self.0.get().checked_sub(cost);
        self.0.set(left.unwrap_or(self.0.get()));
        left.is_some()
    }
}

/// The budget that is left of a file of some length.
pub(super) struct ReadBudget {
    /// Memory for what is loaded and stays.
    pub(super) memory: Allowance,
    readings: Allowance,
    /// Bytes of the file's structures that stay in memory as long as it is read.
    pub(super) loaded: Allowance,
    /// Bytes that filters give.
    pub(super) expanded: Allowance,
    /// Visits to objects.
    pub(super) objects: Allowance,
}

impl ReadBudget {
    pub(super) fn for_file(length: u64) -> Self {
        let times = |times: u64, free| {
            Allowance(Cell::new(length.saturating_mul(times).saturating_add(free)))
        };
        Self {
            memory: times(EXPANSION, FREE_BYTES),
            readings: times(READINGS, FREE_READINGS),
            loaded: times(LOADINGS, FREE_READINGS),
            expanded: times(READINGS, FREE_EXPANDED),
            objects: Allowance(Cell::new(FREE_OBJECTS + length / OBJECT_BYTES)),
        }
    }

    /// True if so many bytes may be there for a while.
    pub(super) fn has_memory(&self, bytes: u64) -> bool {
        bytes <= self.memory.0.get()
    }

    /// Charges one reading of the file.
    #[must_use]
    pub(super) fn charge_reading(&self, bytes: u64) -> bool {
        self.readings.charge(bytes.max(READING))
    }
}

/// Memory of an array of `count` elements of `size` bytes.
pub(super) fn memory(count: u64, size: u64, is_text: bool) -> Option<u64> {
    let size = if is_text { size.checked_add(TEXT_BYTES)? } else { size };
    count.checked_mul(size)?.checked_add(ARRAY_BYTES)
}

/// Memory of an array that is there.
pub(super) fn memory_of(array: &Array) -> u64 {
    let bytes = match &array.values {
        ArrayValues::Text(v) => v.iter().map(|text| text.len() + TEXT_BYTES as usize).sum(),
        numbers => numbers.little_endian().map_or(0, |bytes| bytes.len()),
    };
    ARRAY_BYTES + bytes as u64
}
