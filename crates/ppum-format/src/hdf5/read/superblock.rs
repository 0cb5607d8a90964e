//! The start of a file: widths of numbers, and where the root group is.

use super::super::budget::ReadBudget;
use super::error::{ReadResult, fail};
use super::pages::{PageCache, PageChain, Ranges};
use super::source::{Hdf5Source, little};
use crate::lookup3::lookup3;

const SIGNATURE: &[u8; 8] = b"\x89HDF\r\n\x1a\n";

/// Places of the signature: bytes of the user's before it are 0, 512, 1024 or 2048.
const PLACES: [usize; 4] = [0, 512, 1024, 2048];

/// Longest superblock, in bytes: the oldest with the entry of its root.
const LONGEST: usize = 128;

/// The content of a superblock.
#[derive(Clone, Copy, Debug)]
pub(super) struct Superblock {
    /// Bytes of the user's before it: addresses count from the signature, whatever the file says.
    before: u64,
    sizes: [usize; 2],
    pub(super) root: u64,
    /// The end of the file: counted from the signature, or by some programs from the start of
    /// the file.
    end: u64,
}

impl Superblock {
    /// The start of a file of so many bytes, read at once: another program may change it.
    pub(super) fn read(file: &dyn Ranges, length: u64) -> ReadResult<Self> {
        let mut head = vec![0; length.min((PLACES[3] + LONGEST) as u64) as usize];
        if let Err(error) = file.read(0, &mut head) {
            return fail(format!("it cannot be read: {error}"));
        }
        let start = Self::parse(&head)?;
        if start.end > length { fail("it is truncated") } else { Ok(start) }
    }

    fn parse(bytes: &[u8]) -> ReadResult<Self> {
        let has_signature =
            |at: &&usize| bytes.get(**at..).is_some_and(|b| b.starts_with(SIGNATURE));
        let Some(&before) = PLACES.iter().find(has_signature) else {
            return fail("the signature of HDF5 is missing");
        };
        let bytes = &bytes[before..];
        let byte = |at: usize| bytes.get(at).copied().unwrap_or(u8::MAX);
        // the places of the widths and of the first address; addresses from the end to the root:
        // of old files those of the driver and of the root's name stand between
        let (widths, first, step) = match byte(SIGNATURE.len()) {
            0 => (13, 24, 3),
            1 => (13, 28, 3),
            2 | 3 => (9, 12, 1),
            version => {
                return fail(format!("its superblock has version {version}, which is not known"));
            }
        };
        let sizes = [byte(widths), byte(widths + 1)].map(usize::from);
        if sizes.iter().any(|size| ![2, 4, 8].contains(size)) {
            return fail("its addresses or lengths have an unknown width");
        }
        // after the base and the free space, or the extension
        let end = first + 2 * sizes[0];
        let root = end + step * sizes[0];
        let body = bytes.get(..root + sizes[0]).unwrap_or_default();
        let sum = bytes.get(body.len()..).and_then(<[u8]>::first_chunk);
        if step == 1 && sum.is_none_or(|sum| lookup3(body) != u32::from_le_bytes(*sum)) {
            return fail("the checksum of a part of its description is wrong");
        }
        let [end, root] = [end, root].map(|at| address(bytes, at, sizes[0]));
        Ok(Self { before: before as u64, sizes, root: root?, end: end? })
    }

    /// The parts of a file of so many bytes, without the user's bytes.
    pub(super) fn parts<'f>(
        self,
        file: &'f dyn Ranges,
        length: u64,
        chain: &'f PageChain,
    ) -> PageCache<'f> {
        PageCache::new(file, self.before, length.saturating_sub(self.before), chain)
    }

    pub(super) fn source<'f>(
        self,
        parts: &'f PageCache<'f>,
        budget: &'f ReadBudget,
    ) -> Hdf5Source<'f> {
        Hdf5Source::new(parts, self.sizes, budget)
    }
}

fn address(bytes: &[u8], at: usize, width: usize) -> ReadResult<u64> {
    match bytes.get(at..at + width) {
        Some(bytes) if bytes.iter().any(|&byte| byte != u8::MAX) => Ok(little(bytes)),
        _ => fail("an address is missing"),
    }
}
