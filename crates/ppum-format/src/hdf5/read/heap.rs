//! Fractal heaps, where groups with many links or attributes keep them.

use super::error::{ReadResult, fail};
use super::source::{Cursor, Hdf5Source};
use super::trees::{records, width};

/// Types of the objects of a heap, from bits 4 and 5 of the first byte of their identifiers.
const MANAGED: u8 = 0;
const HUGE: u8 = 1;
const TINY: u8 = 2;

/// Largest first block that is taken for one.
const LARGEST_FIRST: u64 = 1 << 32;

/// Kind of the index of huge objects, whose records are found by address, length and number.
const HUGE_INDEX: u8 = 1;

/// A heap: blocks of doubling size, some hold objects and some the addresses of others.
pub(super) struct Heap<'f> {
    source: Hdf5Source<'f>,
    id_length: usize,
    huge: Option<u64>,
    /// Blocks in a row.
    width: u64,
    /// Bytes of the blocks in the first two rows.
    first: u64,
    /// Rows of blocks that hold objects.
    direct_rows: u64,
    offset_width: usize,
    length_width: usize,
    root: Option<u64>,
    /// Rows of the root; none if it holds objects itself.
    root_rows: u64,
}

impl<'f> Heap<'f> {
    pub(super) fn open(source: Hdf5Source<'f>, address: u64) -> ReadResult<Self> {
        let length = 26 + 3 * source.offset_size() + 12 * source.length_size();
        let mut header = source.with_checksum(address, length as u64)?;
        header.signature(b"FRHP")?;
        header.version(0, "a heap is")?;
        let (id_length, filters) = (header.u16()?, header.u16()?);
        if filters > 0 {
            return fail("it has compressed links or attributes, which are not read");
        }
        let largest_object = header.skip(1)?.u32()?;
        header.length()?;
        let huge = header.offset()?;
        header.skip(source.offset_size() + 9 * source.length_size())?;
        let (table, first, largest) = (header.u16()?, header.length()?, header.length()?);
        let (bits, _) = (header.u16()?, header.u16()?);
        let (root, root_rows) = (header.offset()?, header.u16()?);
        if !table.is_power_of_two()
            || !first.is_power_of_two()
            || first > largest.min(LARGEST_FIRST)
        {
            return fail("the blocks of a heap have impossible sizes");
        }
        Ok(Self {
            source,
            id_length: id_length.into(),
            huge,
            width: table.into(),
            first,
            direct_rows: u64::from(largest.ilog2() - first.ilog2()) + 2,
            offset_width: usize::from(bits).div_ceil(8),
            length_width: (largest.ilog2() as usize)
                .div_ceil(8)
                .max(1)
                .min(width(largest_object.into())),
            root,
            root_rows: root_rows.into(),
        })
    }

    /// The object of an identifier, of which there are the first bytes at least.
    pub(super) fn object(&self, id: &'f [u8]) -> ReadResult<&'f [u8]> {
        let Some((&head, rest)) =
            id.get(..id.len().min(self.id_length)).and_then(<[u8]>::split_first)
        else {
            return fail("an object of a heap has no number");
        };
        match head >> 4 & 3 {
            MANAGED if head >> 6 == 0 => {
                let mut place = self.source.cursor(rest);
                let offset = place.number(self.offset_width)?;
                self.managed(offset, place.number(self.length_width)?)
            }
            HUGE if head >> 6 == 0 => self.huge(rest),
            TINY => fail("it has links or attributes within their numbers, which are not read"),
            _ => fail("an object of a heap is of an unknown kind"),
        }
    }

    /// An object in a block of the heap: down from the root, through blocks of addresses.
    fn managed(&self, mut offset: u64, length: u64) -> ReadResult<&'f [u8]> {
        let Some(mut block) = self.root else { return fail("a heap is empty") };
        let (mut rows, mut size) = (self.root_rows, self.first);
        while rows > 0 {
            let (row, start) = self.row(offset, rows)?;
            size = self.block_size(row);
            let column = (offset - start) / size;
            offset = (offset - start) % size;
            block = self.entry(block, row * self.width + column)?;
            // a block of addresses is as large as all that it leads to
            rows = match row < self.direct_rows {
                true => 0,
                false => {
                    u64::from(size.ilog2().saturating_sub((self.first * self.width).ilog2())) + 1
                }
            };
        }
        let end = offset.checked_add(length);
        if end.is_none_or(|end| end > size) {
            return fail("an object of a heap is larger than its block");
        }
        let Some(place) = block.checked_add(offset) else { return fail("a heap is too large") };
        Ok(self.source.at(place, length)?.rest())
    }

    /// The row that holds an offset, and the offset at which it starts.
    fn row(&self, offset: u64, rows: u64) -> ReadResult<(u64, u64)> {
        let row = match offset / self.width / self.first {
            0 => 0,
            n => u64::from(n.ilog2()) + 1,
        };
        if row >= rows {
            return fail("an object of a heap is in none of its blocks");
        }
        let start = if row == 0 { 0 } else { self.width * self.block_size(row) };
        Ok((row, start))
    }

    /// Bytes of a block in a row that an offset has been found in.
    fn block_size(&self, row: u64) -> u64 {
        self.first << row.saturating_sub(1)
    }

    /// The address of a block in a block of addresses.
    fn entry(&self, block: u64, index: u64) -> ReadResult<u64> {
        let address = self.source.offset_size();
        let before = 5 + address + self.offset_width;
        self.source.at(block, 5)?.signature(b"FHIB")?;
        let place = index
            .checked_mul(address as u64)
            .and_then(|n| n.checked_add(before as u64))
            .and_then(|n| n.checked_add(block));
        let Some(place) = place else { return fail("a heap is too large") };
        self.source.at(place, address as u64)?.address()
    }

    /// An object that stands by itself.
    fn huge(&self, id: &'f [u8]) -> ReadResult<&'f [u8]> {
        let (address, length) = (self.source.offset_size(), self.source.length_size());
        // the number is the place itself if there is room for that
        if self.id_length > address + length {
            return self.at_place(id);
        }
        let Some(index) = self.huge else { return fail("a heap lacks its index") };
        let number = id.get(..length.min(self.id_length - 1)).unwrap_or_default();
        let found = records(self.source, index, &[HUGE_INDEX])?.into_iter().find(|record| {
            record.get(address + length..).is_some_and(|tail| tail.starts_with(number))
        });
        match found {
            Some(record) => self.at_place(record),
            None => fail("an object of a heap is not in its index"),
        }
    }

    fn at_place(&self, place: &'f [u8]) -> ReadResult<&'f [u8]> {
        let mut place = self.source.cursor(place);
        Ok(self.source.at(place.address()?, place.length()?)?.rest())
    }
}

/// A heap and its index.
type DenseLinks<'f> = (Heap<'f>, Vec<&'f [u8]>);

/// The heap and the records of the index that goes with it; none if all stands in the
/// header itself.
pub(super) fn dense(mut info: Cursor, order: usize, kind: u8) -> ReadResult<Option<DenseLinks>> {
    info.version(0, "an index is")?;
    if info.u8()? & 1 != 0 {
        info.skip(order)?;
    }
    let (heap, index) = (info.offset()?, info.offset()?);
    let (Some(heap), Some(index)) = (heap, index) else { return Ok(None) };
    let records = records(info.source, index, &[kind])?;
    Ok(Some((Heap::open(info.source, heap)?, records)))
}
