//! The filters that chunks went through when they were written, and how each is undone.

use std::borrow::Cow;

use super::super::budget::ReadBudget;
use super::chunks::ChunkLocation;
use super::error::{ReadResult, fail};
use super::inflate;
use super::packing::{scale_offset, unpacked};
use super::shuffle::unshuffle;
use super::source::Cursor;

/// Numbers under which filters are registered.
const DEFLATE: u16 = 1;
const SHUFFLE: u16 = 2;
const FLETCHER32: u16 = 3;
const SCALE_OFFSET: u16 = 6;
const LZF: u16 = 32000;

/// Smallest number of a filter whose name is always given.
const NAMED: u16 = 256;

/// A filter, and what it was told.
pub(super) struct Filter {
    id: u16,
    parameters: Vec<u32>,
}

/// The filters of an array, in the order in which they were applied.
pub(super) fn filters(mut message: Cursor) -> ReadResult<Vec<Filter>> {
    let (version, count) = (message.u8()?, message.u8()?);
    match version {
        1 => drop(message.skip(6)?),
        2 => {}
        _ => return fail(format!("its filters have version {version}, which is not known")),
    }
    (0..count).map(|_| filter(&mut message, version == 1)).collect()
}

fn filter(message: &mut Cursor, is_old: bool) -> ReadResult<Filter> {
    let id = message.u16()?;
    let name = if is_old || id >= NAMED { usize::from(message.u16()?) } else { 0 };
    let count = message.skip(2)?.u16()?;
    message.skip(if is_old { name.next_multiple_of(8) } else { name })?;
    let parameters = (0..count).map(|_| message.u32()).collect::<ReadResult<_>>()?;
    message.skip(if is_old && count % 2 == 1 { 4 } else { 0 })?;
    Ok(Filter { id, parameters })
}

/// The filters of the chunks of an array.
pub(super) struct Pipeline {
    pub(super) filters: Vec<Filter>,
    /// Bytes of an element and of a chunk.
    pub(super) size: usize,
    pub(super) bytes: u64,
}

/// Bytes by which a filter may lengthen a chunk: checksums, headers of packed numbers.
const LENGTHENING: u64 = 1024;

/// The result of deflation for a chunk.
enum InflateResult {
    /// The first bytes of each of so many planes of a length, which make up the chunk. One is a
    /// chunk that is not divided.
    Planes { count: u64, length: u64, keep: u64 },
    /// All of what other filters have made of it.
    All,
}

impl Pipeline {
    /// The filters that were applied to a chunk.
    fn applied(&self, mask: u32) -> Vec<&Filter> {
        let is_left_out = |k: usize| 1_u32.checked_shl(k as u32).is_some_and(|bit| mask & bit != 0);
        let filters = self.filters.iter().enumerate();
        filters.filter(|(k, _)| !is_left_out(*k)).map(|(_, filter)| filter).collect()
    }

    /// True if a chunk went through any of them.
    pub(super) fn applies(&self, mask: u32) -> bool {
        !self.applied(mask).is_empty()
    }

    /// Pays for what [`undo`](Self::undo) does with a chunk: for the bytes that filters give, and
    /// for those of them that are kept for a while.
    pub(super) fn charge(
        &self,
        stored: ChunkLocation,
        keep: u64,
        budget: &ReadBudget,
    ) -> ReadResult<()> {
        let applied = self.applied(stored.mask);
        for (k, filter) in applied.iter().enumerate().rev() {
            let (expanded, kept) = match filter.id {
                DEFLATE => self.inflated(&applied[..k], keep).cost(self.bytes),
                SCALE_OFFSET | LZF => (self.bytes, self.most()),
                _ => (0, stored.bytes),
            };
            if !(budget.expanded.charge(expanded) && budget.has_memory(kept)) {
                return fail(TOO_LARGE);
            }
        }
        Ok(())
    }

    /// Most bytes of a chunk that has to be there as a whole.
    fn most(&self) -> u64 {
        self.bytes.saturating_add(LENGTHENING)
    }

    fn whole(&self) -> ReadResult<usize> {
        usize::try_from(self.most()).or(fail(TOO_LARGE))
    }

    /// The elements of a chunk as they were before the filters, the first `keep` at least. It has
    /// been paid for.
    pub(super) fn undo<'r>(
        &self,
        raw: &'r [u8],
        mask: u32,
        keep: u64,
    ) -> ReadResult<UnfilteredChunk<'r>> {
        let (applied, mut data) = (self.applied(mask), Cow::Borrowed(raw));
        for (k, filter) in applied.iter().enumerate().rev() {
            data = match filter.id {
                DEFLATE => self.inflate(&data, &applied[..k], keep)?.into(),
                SHUFFLE if self.is_other_size(filter) => {
                    return fail("its chunks are shuffled by elements of another size");
                }
                SHUFFLE if k == 0 => return Ok(UnfilteredChunk { data, planes: self.size }),
                SHUFFLE => UnfilteredChunk { data, planes: self.size }.all().into(),
                FLETCHER32 => checked(data)?,
                SCALE_OFFSET => scale_offset(&data, &filter.parameters, self.whole()?)?.into(),
                LZF => unpacked(&data, self.whole()?)?.into(),
                id => return fail(other(id)),
            };
        }
        Ok(UnfilteredChunk { data, planes: 1 })
    }

    fn is_other_size(&self, shuffle: &Filter) -> bool {
        shuffle.parameters.first().is_some_and(|&size| size as usize != self.size)
    }

    /// Returns the result of deflation, which came after some other filters. If a chunk is larger
    /// than its array, only the beginning is kept: of its bytes, or of each of the planes that
    /// shuffling divides it into.
    fn inflated(&self, before: &[&Filter], keep: u64) -> InflateResult {
        let size = self.size as u64;
        match before {
            [] => InflateResult::Planes { count: 1, length: self.bytes, keep: keep * size },
            [one] if one.id == SHUFFLE => {
                InflateResult::Planes { count: size, length: self.bytes / size, keep }
            }
            _ => InflateResult::All,
        }
    }

    fn inflate(&self, data: &[u8], before: &[&Filter], keep: u64) -> ReadResult<Vec<u8>> {
        let inflated = match self.inflated(before, keep) {
            InflateResult::Planes { count, length, keep } => planes(data, [count, length, keep]),
            InflateResult::All => inflate::all(data, self.whole()?),
        };
        inflated.ok_or_else(|| "a chunk cannot be decompressed".into())
    }
}

impl InflateResult {
    /// The bytes that are made, and those of them that are kept.
    fn cost(&self, chunk: u64) -> (u64, u64) {
        match *self {
            Self::Planes { count, length, keep } => (length * (count - 1) + keep, keep * count),
            Self::All => (chunk, chunk.saturating_add(LENGTHENING)),
        }
    }
}

fn planes(data: &[u8], [count, length, keep]: [u64; 3]) -> Option<Vec<u8>> {
    inflate::planes(data, count as usize, length, usize::try_from(keep).ok()?)
}

/// A chunk before its filters, but that it may still be shuffled.
pub(super) struct UnfilteredChunk<'r> {
    data: Cow<'r, [u8]>,
    /// Planes that it is divided into: one if it is not shuffled.
    planes: usize,
}

impl UnfilteredChunk<'_> {
    pub(super) fn len(&self) -> usize {
        self.data.len()
    }

    /// Puts the first elements where they belong, as many as there is room for.
    pub(super) fn put(&self, elements: &mut [u8]) {
        unshuffle(&self.data, self.planes, elements);
    }

    fn all(&self) -> Vec<u8> {
        let mut elements = vec![0; self.data.len()];
        self.put(&mut elements);
        elements
    }
}

const TOO_LARGE: &str = "its chunks are too large for the file's length";

/// Takes a checksum off the end.
fn checked(data: Cow<'_, [u8]>) -> ReadResult<Cow<'_, [u8]>> {
    match data.split_last_chunk() {
        Some((body, sum)) if fletcher32(body) == u32::from_le_bytes(*sum) => {}
        _ => return fail("the checksum of a chunk is wrong"),
    }
    let length = data.len() - 4;
    Ok(match data {
        Cow::Borrowed(data) => data[..length].into(),
        Cow::Owned(mut data) => {
            data.truncate(length);
            data.into()
        }
    })
}

/// Fletcher's checksum of words of two bytes, the higher one first.
fn fletcher32(data: &[u8]) -> u32 {
    let fold = |sum: u32| (sum & 0xffff) + (sum >> 16);
    let (mut a, mut b) = (0_u32, 0_u32);
    // so many words can be added before the sums are too large
    for block in data.chunks(2 * 360) {
        for word in block.chunks(2) {
            a += u32::from(word[0]) << 8 | u32::from(word.get(1).copied().unwrap_or(0));
            b += a;
        }
        (a, b) = (fold(a), fold(b));
    }
    fold(b) << 16 | fold(a)
}

fn other(id: u16) -> String {
    let name = match id {
        4 => " (szip)",
        5 => " (n-bit)",
        32001 => " (blosc)",
        32004 => " (lz4)",
        32008 => " (bitshuffle)",
        32013 => " (zfp)",
        32015 => " (zstd)",
        _ => "",
    };
    format!(
        "its chunks went through filter {id}{name}, which is not read; store it with gzip or without \
         filters, for instance by h5repack -f NONE"
    )
}
