//! The filters that chunks went through when they were written, and how each is undone.

use std::borrow::Cow;
use std::io::{Read as _, copy, sink};

use flate2::read::ZlibDecoder;

use super::super::account::Account;
use super::packing::{scale_offset, unpacked};
use super::source::{Cursor, Parsed, fail};

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
pub(super) fn filters(mut message: Cursor) -> Parsed<Vec<Filter>> {
    let (version, count) = (message.u8()?, message.u8()?);
    match version {
        1 => drop(message.skip(6)?),
        2 => {}
        _ => return fail(format!("its filters have version {version}, which is not known")),
    }
    (0..count).map(|_| filter(&mut message, version == 1)).collect()
}

fn filter(message: &mut Cursor, is_old: bool) -> Parsed<Filter> {
    let id = message.u16()?;
    let name = if is_old || id >= NAMED { usize::from(message.u16()?) } else { 0 };
    let count = message.skip(2)?.u16()?;
    message.skip(if is_old { name.next_multiple_of(8) } else { name })?;
    let parameters = (0..count).map(|_| message.u32()).collect::<Parsed<_>>()?;
    message.skip(if is_old && count % 2 == 1 { 4 } else { 0 })?;
    Ok(Filter { id, parameters })
}

/// The filters of the chunks of an array.
pub(super) struct Pipeline<'f> {
    pub(super) filters: Vec<Filter>,
    /// Bytes of an element and of a chunk.
    pub(super) size: usize,
    pub(super) bytes: u64,
    pub(super) account: &'f Account,
}

/// Bytes by which a filter may lengthen a chunk: checksums, headers of packed numbers.
const LENGTHENING: u64 = 1024;

impl Pipeline<'_> {
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

    /// The bytes of a chunk as they were before the filters, of the first `keep` elements at least.
    pub(super) fn undo<'r>(&self, raw: &'r [u8], mask: u32, keep: u64) -> Parsed<Cow<'r, [u8]>> {
        let (applied, mut data) = (self.applied(mask), Cow::Borrowed(raw));
        let mut rest = applied.as_slice();
        while let Some((filter, before)) = rest.split_last() {
            data = match filter.id {
                DEFLATE => self.inflate(&data, before, keep)?.into(),
                SHUFFLE => self.unshuffle(&data, filter)?.into(),
                FLETCHER32 => checked(data)?,
                SCALE_OFFSET => scale_offset(&data, &filter.parameters, self.whole()?)?.into(),
                LZF => unpacked(&data, self.whole()?)?.into(),
                id => return fail(other(id)),
            };
            rest = before;
        }
        Ok(data)
    }

    /// Most bytes of a chunk that has to be there as a whole, which are paid for.
    fn whole(&self) -> Parsed<usize> {
        let most = self.bytes.saturating_add(LENGTHENING);
        self.pay(self.bytes, most)?;
        usize::try_from(most).or(fail(TOO_LARGE))
    }

    /// Pays for bytes that a filter gives, and for those of them that are kept for a while.
    fn pay(&self, expanded: u64, kept: u64) -> Parsed<()> {
        if self.account.pay_expanded(expanded) && self.account.has_memory(kept) {
            return Ok(());
        }
        fail(TOO_LARGE)
    }

    /// Undoes deflation. Of a chunk that is larger than its array only the beginning is kept: of its bytes,
    /// or of each of the planes that shuffling divides it into.
    fn inflate(&self, data: &[u8], before: &[&Filter], keep: u64) -> Parsed<Vec<u8>> {
        let size = self.size as u64;
        match before {
            [] => self.planes(data, 1, keep * size, self.bytes),
            [one] if one.id == SHUFFLE => self.planes(data, size, keep, self.bytes / size),
            _ => self.all(data),
        }
    }

    /// The first `keep` bytes of each of `count` planes of `length` bytes.
    fn planes(&self, data: &[u8], count: u64, keep: u64, length: u64) -> Parsed<Vec<u8>> {
        let is_whole = keep == length;
        self.pay(length * (count - 1) + keep, keep * count)?;
        let mut planes = Vec::with_capacity((keep * count) as usize);
        let mut stream = ZlibDecoder::new(data);
        for plane in 1..=count {
            let read = stream.by_ref().take(keep).read_to_end(&mut planes);
            let skip = if plane < count { length - keep } else { 0 };
            let skipped = copy(&mut stream.by_ref().take(skip), &mut sink());
            if read.ok() != Some(keep as usize) || skipped.ok() != Some(skip) {
                return fail("a chunk cannot be decompressed");
            }
        }
        // at the end is a checksum, which is looked at if more is asked for
        if is_whole && stream.read(&mut [0]).ok() != Some(0) {
            return fail("a chunk cannot be decompressed");
        }
        Ok(planes)
    }

    fn all(&self, data: &[u8]) -> Parsed<Vec<u8>> {
        let (most, mut all) = (self.whole()?, Vec::new());
        match ZlibDecoder::new(data).take(most as u64).read_to_end(&mut all) {
            Ok(_) => Ok(all),
            Err(_) => fail("a chunk cannot be decompressed"),
        }
    }

    /// Undoes shuffling, by which the first bytes of all elements come first, then the second ones.
    fn unshuffle(&self, data: &[u8], filter: &Filter) -> Parsed<Vec<u8>> {
        let size = filter.parameters.first().map_or(self.size, |&size| size as usize);
        if size != self.size {
            return fail("its chunks are shuffled by elements of another size");
        }
        if !self.account.has_memory(data.len() as u64) {
            return fail(TOO_LARGE);
        }
        let mut elements = vec![0; data.len()];
        let count = data.len() / size;
        for (k, plane) in data.chunks_exact(count.max(1)).take(size).enumerate() {
            for (element, byte) in elements.chunks_exact_mut(size).zip(plane) {
                element[k] = *byte;
            }
        }
        // what does not make a whole element stays as it is
        let whole = count * size;
        elements[whole..].copy_from_slice(&data[whole..]);
        Ok(elements)
    }
}

const TOO_LARGE: &str = "its chunks are too large for the file's length";

/// Takes a checksum off the end.
fn checked(data: Cow<'_, [u8]>) -> Parsed<Cow<'_, [u8]>> {
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
         filters, for instance by h5repack -f GZIP=4"
    )
}
