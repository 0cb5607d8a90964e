//! What reading a file may cost: bytes read of it, and memory for what is in it.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use hdf5_pure::{FormatError, Source};

use crate::content::{Array, Values};

/// Memory that the arrays of any file may take, beside [`EXPANSION`] times its length: 64 MiB.
const FREE_BYTES: u64 = 1 << 26;

/// Coefficients do not shrink, geometry and indices to some percent: real files have up to three.
const EXPANSION: u64 = 4;

/// Memory of a text beside its characters: a `String`, and what the allocator adds.
const TEXT_BYTES: u64 = 64;

/// Memory of a named array beside its values: name, shape, place in the map.
const ARRAY_BYTES: u64 = 256;

/// Times the length of the file that may be read of it. Headers are read up to four times, and directories
/// of heaps once for every text that is looked up.
const READINGS: u64 = 16;

/// Bytes that may be read of any file.
const FREE_READINGS: u64 = 1 << 24;

/// A reading costs as much as this many bytes at least.
const READING: u64 = 16;

/// Arrays that take less than this together are always within the account: none has to be stored plain.
pub(super) const PLAIN_BYTES: u64 = FREE_BYTES / 2;

/// The memory that what is loaded may still take.
pub(super) struct Memory(u64);

impl Memory {
    pub(super) fn for_file(length: u64) -> Self {
        Self(length.saturating_mul(EXPANSION).saturating_add(FREE_BYTES))
    }

    pub(super) fn left(&self) -> u64 {
        self.0
    }

    /// Takes from the account; false if it is not enough, or the size is beyond all numbers.
    #[must_use]
    pub(super) fn pay(&mut self, bytes: Option<u64>) -> bool {
        let left = bytes.and_then(|bytes| self.0.checked_sub(bytes));
        self.0 = left.unwrap_or(self.0);
        left.is_some()
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
        Values::F64(v) => size_of_val(v.as_slice()),
        Values::U8(v) => v.len(),
        Values::U32(v) => size_of_val(v.as_slice()),
        Values::U64(v) => size_of_val(v.as_slice()),
        Values::I64(v) => size_of_val(v.as_slice()),
        Values::Text(v) => v.iter().map(|text| text.len() + TEXT_BYTES as usize).sum(),
        Values::Other(_) => 0,
    };
    ARRAY_BYTES + bytes as u64
}

/// The bytes of a file, which can be read until the account is empty, and then no more.
#[derive(Clone)]
pub(super) struct Metered {
    bytes: Arc<Vec<u8>>,
    left: Arc<AtomicU64>,
    /// Where the first reading since [`Metered::watch`] began.
    first: Arc<AtomicU64>,
}

/// No place in a file; HDF5 writes it as the address of what has none.
const NOWHERE: u64 = u64::MAX;

impl Metered {
    pub(super) fn new(bytes: Vec<u8>) -> Self {
        let left = (bytes.len() as u64).saturating_mul(READINGS).saturating_add(FREE_READINGS);
        let first = Arc::new(NOWHERE.into());
        Self { bytes: bytes.into(), left: Arc::new(left.into()), first }
    }

    /// Runs something that begins by reading the header of an object, and tells where that stands: the
    /// library keeps the place to itself.
    pub(super) fn watch<T>(&self, read: impl FnOnce() -> T) -> (T, u64) {
        self.first.store(NOWHERE, Ordering::Relaxed);
        let result = read();
        (result, self.first.load(Ordering::Relaxed))
    }

    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// True once a reading was refused: what was read since is not complete.
    pub(super) fn is_exhausted(&self) -> bool {
        self.left.load(Ordering::Relaxed) == 0
    }
}

impl Source for Metered {
    fn len(&self) -> u64 {
        self.bytes.len() as u64
    }

    fn read_at(&self, offset: u64, buffer: &mut [u8]) -> Result<(), FormatError> {
        if offset == NOWHERE {
            let problem = "an object has no address: soft links are not read; copy into the file what they lead to";
            return Err(FormatError::Source(problem.into()));
        }
        if self.first.load(Ordering::Relaxed) == NOWHERE {
            self.first.store(offset, Ordering::Relaxed);
        }
        let cost = READING.max(buffer.len() as u64);
        let left = self.left.load(Ordering::Relaxed).saturating_sub(cost);
        self.left.store(left, Ordering::Relaxed);
        if left == 0 {
            return Err(FormatError::Source(
                "it takes more readings than the file is worth".into(),
            ));
        }
        let start = usize::try_from(offset).unwrap_or(usize::MAX);
        let range = start..start.saturating_add(buffer.len());
        let (expected, available) = (range.end, self.bytes.len());
        let part =
            self.bytes.get(range).ok_or(FormatError::UnexpectedEof { expected, available })?;
        buffer.copy_from_slice(part);
        Ok(())
    }
}
