//! The start of a file: widths of numbers, and where the root group is.

use super::super::account::Account;
use super::error::{ReadResult, fail};
use super::source::{Cursor, Hdf5Source};
use super::store::{Bytes, Ranges, ReadRanges, StoredParts};

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
    sizes: (u8, u8),
    pub(super) root: u64,
    /// The end of the file: counted from the signature, or by some programs from the start of
    /// the file.
    end: u64,
}

impl Superblock {
    /// The start of a file in memory.
    pub(super) fn of_bytes(bytes: &[u8]) -> ReadResult<Self> {
        let start = Self::parse(bytes)?;
        start.check(bytes.len() as u64)?;
        Ok(start)
    }

    /// The start of a file of so many bytes, read at once: another program may change it.
    pub(super) fn of_file(file: &dyn Ranges, length: u64) -> ReadResult<Self> {
        let mut head = vec![0; length.min((PLACES[3] + LONGEST) as u64) as usize];
        if let Err(error) = file.read(0, &mut head) {
            return fail(format!("it cannot be read: {error}"));
        }
        let start = Self::parse(&head)?;
        start.check(length)?;
        Ok(start)
    }

    fn check(&self, length: u64) -> ReadResult<()> {
        if self.end > length { fail("it is truncated") } else { Ok(()) }
    }

    fn parse(bytes: &[u8]) -> ReadResult<Self> {
        let has_signature =
            |at: &&usize| bytes.get(**at..).is_some_and(|b| b.starts_with(SIGNATURE));
        let Some(&before) = PLACES.iter().find(has_signature) else {
            return fail("the signature of HDF5 is missing");
        };
        let bytes = &bytes[before..];
        let account = Account::for_file(bytes.len() as u64);
        let version = at(bytes, SIGNATURE.len(), u8::MAX);
        let (sizes, end, root) = match version {
            0 | 1 => old(bytes, version, &account)?,
            2 | 3 => new(bytes, &account)?,
            _ => return fail(format!("its superblock has version {version}, which is not known")),
        };
        Ok(Self { before: before as u64, sizes, root, end })
    }

    /// The file without the user's bytes.
    pub(super) fn memory<'f>(
        self,
        bytes: &'f [u8],
        account: &'f Account,
    ) -> ReadResult<Hdf5Source<'f>> {
        Hdf5Source::new(Bytes::Memory(&bytes[self.before as usize..]), self.sizes, account)
    }

    /// The parts of a file of so many bytes.
    pub(super) fn parts<'f>(
        self,
        file: &'f dyn Ranges,
        length: u64,
        chain: &'f StoredParts,
    ) -> ReadRanges<'f> {
        ReadRanges::new(file, self.before, length.saturating_sub(self.before), chain)
    }

    pub(super) fn source<'f>(
        self,
        parts: &'f ReadRanges<'f>,
        account: &'f Account,
    ) -> ReadResult<Hdf5Source<'f>> {
        Hdf5Source::new(Bytes::File(parts), self.sizes, account)
    }
}

/// The widths of addresses and lengths, the end and the root.
type SuperblockFields = ((u8, u8), u64, u64);

fn old(bytes: &[u8], version: u8, account: &Account) -> ReadResult<SuperblockFields> {
    let sizes = (at(bytes, 13, 0), at(bytes, 14, 0));
    let source = Hdf5Source::new(Bytes::Memory(bytes), sizes, account)?;
    let mut start = source.cursor(bytes);
    // sizes of the nodes of trees, flags
    start.skip(24 + if version == 1 { 4 } else { 0 })?;
    // base, free space; after the end the driver, and the name of the root
    let (end, root) = end_and_root(start, 2, 2)?;
    Ok((sizes, end, root))
}

fn new(bytes: &[u8], account: &Account) -> ReadResult<SuperblockFields> {
    let sizes = (at(bytes, 9, 0), at(bytes, 10, 0));
    let source = Hdf5Source::new(Bytes::Memory(bytes), sizes, account)?;
    let mut start = source.with_checksum(0, (16 + 4 * source.offset_size()) as u64)?;
    start.skip(12)?;
    // base, extension
    let (end, root) = end_and_root(start, 2, 0)?;
    Ok((sizes, end, root))
}

/// Two addresses, after so many others before each.
fn end_and_root(
    mut start: Cursor,
    before_end: usize,
    before_root: usize,
) -> ReadResult<(u64, u64)> {
    let width = start.source.offset_size();
    let end = start.skip(before_end * width)?.address()?;
    let root = start.skip(before_root * width)?.address()?;
    Ok((end, root))
}

fn at(bytes: &[u8], place: usize, otherwise: u8) -> u8 {
    bytes.get(place).copied().unwrap_or(otherwise)
}
