//! The bytes of a file, by address: where all that is read of it is paid for.

use std::borrow::Cow;

use super::super::budget::ReadBudget;
use super::error::{ReadResult, fail};
use super::pages::PageCache;
use crate::lookup3::lookup3;

/// A file, with the widths of addresses and lengths in it.
#[derive(Clone, Copy)]
pub(super) struct Hdf5Source<'f> {
    bytes: &'f PageCache<'f>,
    offset_size: usize,
    length_size: usize,
    pub(super) budget: &'f ReadBudget,
}

/// Bytes of a checksum.
const CHECKSUM: usize = 4;

impl<'f> Hdf5Source<'f> {
    pub(super) fn new(
        bytes: &'f PageCache<'f>,
        [offset_size, length_size]: [usize; 2],
        budget: &'f ReadBudget,
    ) -> Self {
        Self { bytes, offset_size, length_size, budget }
    }

    pub(super) fn length(self) -> u64 {
        self.bytes.length
    }

    /// Bytes of an address.
    pub(super) fn offset_size(self) -> usize {
        self.offset_size
    }

    /// Bytes of a length.
    pub(super) fn length_size(self) -> usize {
        self.length_size
    }

    /// A part of the file, which is read now.
    pub(super) fn at(self, address: u64, length: u64) -> ReadResult<Cursor<'f>> {
        self.charge(address, length)?;
        Ok(Cursor { source: self, left: self.bytes.get(address, length, self.budget)? })
    }

    /// The bytes of values, which are read now and need not stay in memory.
    pub(super) fn values(self, address: u64, length: u64) -> ReadResult<Cow<'f, [u8]>> {
        self.charge(address, length)?;
        self.bytes.values(address, length, self.budget)
    }

    /// Fills a buffer with the bytes of values.
    pub(super) fn fill(self, address: u64, buffer: &mut [u8]) -> ReadResult<()> {
        self.charge(address, buffer.len() as u64)?;
        self.bytes.fill(address, buffer, self.budget)
    }

    fn charge(self, address: u64, length: u64) -> ReadResult<()> {
        if address.checked_add(length).is_none_or(|end| end > self.length()) {
            return fail("it leads beyond the end of the file");
        }
        if self.budget.charge_reading(length) {
            return Ok(());
        }
        fail("it takes more readings than the file is worth")
    }

    /// A part that ends in its checksum, which is looked at and left out.
    pub(super) fn with_checksum(self, address: u64, length: u64) -> ReadResult<Cursor<'f>> {
        let part = self.at(address, length)?.left;
        match part.split_last_chunk::<CHECKSUM>() {
            Some((body, sum)) if lookup3(body) == u32::from_le_bytes(*sum) => Ok(self.cursor(body)),
            _ => fail("the checksum of a part of its description is wrong"),
        }
    }

    /// Bytes of the file that are at hand already.
    pub(super) fn cursor(self, left: &'f [u8]) -> Cursor<'f> {
        Cursor { source: self, left }
    }
}

/// Bytes of the file, taken from the front.
#[derive(Clone, Copy)]
pub(super) struct Cursor<'f> {
    pub(super) source: Hdf5Source<'f>,
    left: &'f [u8],
}

impl<'f> Cursor<'f> {
    pub(super) fn take(&mut self, count: usize) -> ReadResult<&'f [u8]> {
        let Some((taken, left)) = self.left.split_at_checked(count) else {
            return fail("a part of its description is too short");
        };
        self.left = left;
        Ok(taken)
    }

    pub(super) fn rest(&self) -> &'f [u8] {
        self.left
    }

    /// Skips so many bytes, and returns the cursor.
    pub(super) fn skip(&mut self, count: usize) -> ReadResult<&mut Self> {
        self.take(count)?;
        Ok(self)
    }

    /// An unsigned number of so many bytes, at most eight.
    pub(super) fn number(&mut self, width: usize) -> ReadResult<u64> {
        if width > 8 {
            return fail("a number is too wide");
        }
        self.take(width).map(little)
    }

    pub(super) fn u8(&mut self) -> ReadResult<u8> {
        Ok(self.number(1)? as u8)
    }

    pub(super) fn u16(&mut self) -> ReadResult<u16> {
        Ok(self.number(2)? as u16)
    }

    pub(super) fn u32(&mut self) -> ReadResult<u32> {
        Ok(self.number(4)? as u32)
    }

    /// A number that counts bytes in memory.
    pub(super) fn size(&mut self, width: usize) -> ReadResult<usize> {
        usize::try_from(self.number(width)?).or(fail("a size is too large"))
    }

    pub(super) fn length(&mut self) -> ReadResult<u64> {
        self.number(self.source.length_size)
    }

    /// An address; none if it is the one that leads nowhere, all bits set.
    pub(super) fn offset(&mut self) -> ReadResult<Option<u64>> {
        let address = self.number(self.source.offset_size)?;
        let nowhere = u64::MAX >> (64 - 8 * self.source.offset_size);
        Ok((address != nowhere).then_some(address))
    }

    /// An address that must lead somewhere.
    pub(super) fn address(&mut self) -> ReadResult<u64> {
        self.offset()?.ok_or_else(|| "an address is missing".into())
    }

    pub(super) fn signature(&mut self, expected: &[u8; 4]) -> ReadResult<()> {
        if self.take(4)? == expected {
            return Ok(());
        }
        fail(format!("an address does not lead to a structure `{}`", expected.escape_ascii()))
    }

    /// A version, or anything else that has to have this value.
    pub(super) fn version(&mut self, expected: u8, what: &str) -> ReadResult<()> {
        match self.u8()? {
            version if version == expected => Ok(()),
            version => fail(format!("{what} of version {version}, not {expected}")),
        }
    }
}

/// A number whose lowest byte comes first.
pub(super) fn little(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |number, &byte| number << 8 | u64::from(byte))
}
