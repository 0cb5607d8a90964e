//! Arrays as indexes of chunks: of fixed length, and those that grow.

use std::collections::BTreeMap;

use super::error::{ReadResult, fail};
use super::source::{Cursor, Hdf5Source};

/// Parts of an array, each read and checked once.
struct Blocks<'f> {
    source: Hdf5Source<'f>,
    known: BTreeMap<u64, Cursor<'f>>,
    /// Bytes of an entry.
    entry: usize,
}

/// Bytes of a checksum.
const CHECKSUM: u64 = 4;

impl<'f> Blocks<'f> {
    /// The block of so many bytes, its checksum not counted, at an address.
    fn get(&mut self, address: u64, length: u64) -> ReadResult<Cursor<'f>> {
        if let Some(block) = self.known.get(&address) {
            return Ok(*block);
        }
        let block = self.source.with_checksum(address, length.saturating_add(CHECKSUM))?;
        self.known.insert(address, block);
        Ok(block)
    }

    /// Bytes of entries, and of what stands before them.
    fn bytes(&self, before: u64, count: u64) -> u64 {
        count.saturating_mul(self.entry as u64).saturating_add(before)
    }

    /// An entry of a block of them.
    fn pick(&self, block: Cursor<'f>, at: u64) -> ReadResult<Option<Cursor<'f>>> {
        slice(block, self.bytes(0, at), self.entry).map(Some)
    }

    /// An entry of a page: pages of so many entries each stand one behind the other.
    fn page(
        &mut self,
        first: u64,
        size: u64,
        at: u64,
        used: u64,
    ) -> ReadResult<Option<Cursor<'f>>> {
        let (page, within) = (at / size, at % size);
        let address = page.saturating_mul(self.bytes(CHECKSUM, size)).saturating_add(first);
        let block = self.get(address, self.bytes(0, used.min(size)))?;
        self.pick(block, within)
    }
}

/// A few bytes of a block, which count as a reading.
fn slice(mut block: Cursor, at: u64, length: usize) -> ReadResult<Cursor> {
    let source = block.source;
    if !source.budget.charge_reading(length as u64) {
        return fail("it takes more readings than the file is worth");
    }
    let at = usize::try_from(at).or(fail("an index is too large"))?;
    Ok(source.cursor(block.skip(at)?.take(length)?))
}

/// True if a bit is set, counted from the highest of the first byte.
fn is_set(bits: &[u8], at: u64) -> bool {
    bits.get((at / 8) as usize).is_some_and(|byte| byte & (0x80 >> (at % 8)) != 0)
}

/// Bytes before the entries of a block: signature, version, kind, address of the header.
fn prefix(source: Hdf5Source) -> u64 {
    6 + source.offset_size() as u64
}

/// An array of fixed length.
pub(super) struct FixedArray<'f> {
    blocks: Blocks<'f>,
    count: u64,
    page: u64,
    data: Option<u64>,
}

impl<'f> FixedArray<'f> {
    pub(super) fn open(source: Hdf5Source<'f>, address: u64) -> ReadResult<Self> {
        let length = 12 + source.offset_size() + source.length_size();
        let mut header = source.with_checksum(address, length as u64)?;
        header.signature(b"FAHD")?;
        header.version(0, "the index of its chunks is")?;
        let (entry, page_bits) = (header.skip(1)?.u8()?, header.u8()?);
        let (count, data) = (header.length()?, header.offset()?);
        if entry == 0 || page_bits >= 32 {
            return fail("the index of its chunks has impossible sizes");
        }
        let blocks = Blocks { source, known: BTreeMap::new(), entry: entry.into() };
        Ok(Self { blocks, count, page: 1 << page_bits, data })
    }

    pub(super) fn entry(&mut self, number: u64) -> ReadResult<Option<Cursor<'f>>> {
        let Some(data) = self.data else { return Ok(None) };
        if number >= self.count {
            return fail("the index of its chunks is too short");
        }
        let prefix = prefix(self.blocks.source);
        if self.count <= self.page {
            let mut block = self.blocks.get(data, self.blocks.bytes(prefix, self.count))?;
            block.skip(prefix as usize)?;
            return self.blocks.pick(block, number);
        }
        self.paged(data, prefix, number)
    }

    /// Long arrays come in pages, with a bit for each that is in use.
    fn paged(&mut self, data: u64, prefix: u64, number: u64) -> ReadResult<Option<Cursor<'f>>> {
        let page = number / self.page;
        let bits = self.count.div_ceil(self.page).div_ceil(8);
        let mut block = self.blocks.get(data, prefix + bits)?;
        if !is_set(block.skip(prefix as usize)?.rest(), page) {
            return Ok(None);
        }
        let first = data.saturating_add(prefix + bits + CHECKSUM);
        self.blocks.page(first, self.page, number, self.count - page * self.page)
    }
}

/// An array that grows: some entries in the index block, then data blocks of growing size, first
/// found through the index block and then through super blocks.
pub(super) struct ExtensibleArray<'f> {
    blocks: Blocks<'f>,
    index: Option<u64>,
    /// Entries in the index block, in the smallest data block, and in a page of a large one.
    direct: u64,
    smallest: u64,
    page: u64,
    /// Groups of data blocks whose addresses stand in the index block; number of these addresses.
    near_groups: u64,
    near: u64,
    groups: u64,
    /// Bytes of the number of an entry.
    width: u64,
}

/// The position of an entry: its data block, and its number in it.
struct EntryIndex {
    /// Data blocks of a growing size come in groups; the data block in its group; the entry
    /// in that.
    group: u64,
    block: u64,
    entry: u64,
    /// Entries of the data block.
    entries: u64,
}

impl<'f> ExtensibleArray<'f> {
    pub(super) fn open(source: Hdf5Source<'f>, address: u64) -> ReadResult<Self> {
        let length = 16 + source.offset_size() + 6 * source.length_size();
        let mut header = source.with_checksum(address, length as u64)?;
        header.signature(b"EAHD")?;
        header.version(0, "the index of its chunks is")?;
        let (entry, bits, direct) = (header.skip(1)?.u8()?, header.u8()?, header.u8()?);
        let (smallest, pointers, page_bits) = (header.u8()?, header.u8()?, header.u8()?);
        let index = header.skip(6 * source.length_size())?.offset()?;
        let are_powers = smallest.is_power_of_two() && pointers.is_power_of_two();
        if entry == 0 || bits > 64 || page_bits >= 32 || !are_powers {
            return fail("the index of its chunks has impossible sizes");
        }
        Ok(Self {
            blocks: Blocks { source, known: BTreeMap::new(), entry: entry.into() },
            index,
            direct: direct.into(),
            smallest: smallest.into(),
            page: 1 << page_bits,
            near_groups: u64::from(2 * pointers.ilog2()),
            near: 2 * (u64::from(pointers) - 1),
            groups: (1 + u64::from(bits)).saturating_sub(u64::from(smallest.ilog2())),
            width: u64::from(bits).div_ceil(8),
        })
    }

    pub(super) fn entry(&mut self, number: u64) -> ReadResult<Option<Cursor<'f>>> {
        let Some(index) = self.index else { return Ok(None) };
        let offset = self.offset_size();
        let prefix = prefix(self.blocks.source);
        let own = self.blocks.bytes(0, self.direct);
        let far = self.groups.saturating_sub(self.near_groups);
        let mut block = self.blocks.get(index, prefix + own + (self.near + far) * offset)?;
        block.skip(prefix as usize)?;
        if number < self.direct {
            return self.blocks.pick(block, number);
        }
        let place = self.place(number - self.direct);
        block.skip(own as usize)?;
        if place.group >= self.near_groups {
            let at = (self.near + place.group - self.near_groups) * offset;
            let group = slice(block, at, offset as usize)?.offset()?;
            return group.map_or(Ok(None), |group| self.far(group, &place));
        }
        // groups of 1, 1, 2, 2, 4, 4 … data blocks
        let start = [2, 3][(place.group % 2) as usize];
        let before = start * (1 << (place.group / 2)) - 2;
        let data = slice(block, (before + place.block) * offset, offset as usize)?.offset()?;
        data.map_or(Ok(None), |data| self.data(data, &place))
    }

    fn offset_size(&self) -> u64 {
        self.blocks.source.offset_size() as u64
    }

    /// The place of an entry, counted from the first one that is not in the index block.
    fn place(&self, number: u64) -> EntryIndex {
        // group k has 2^k times the entries of the smallest data block
        let group = u64::from((number / self.smallest).saturating_add(1).ilog2());
        let entries = self.smallest << group.div_ceil(2);
        let within = number - self.smallest * ((1 << group) - 1);
        EntryIndex { group, block: within / entries, entry: within % entries, entries }
    }

    /// An entry in a data block of a group that has a super block.
    fn far(&mut self, group: u64, place: &EntryIndex) -> ReadResult<Option<Cursor<'f>>> {
        let (offset, count) = (self.offset_size(), 1_u64 << (place.group / 2));
        let pages = if place.entries > self.page { place.entries / self.page } else { 0 };
        let (prefix, bits) = (self.prefix(), pages.div_ceil(8).saturating_mul(count));
        let length = bits.saturating_add(prefix + count * offset);
        let mut block = self.blocks.get(group, length)?;
        let used = block.skip(prefix as usize)?.take(bits as usize)?;
        let Some(data) = slice(block, place.block * offset, offset as usize)?.offset()? else {
            return Ok(None);
        };
        if pages == 0 {
            return self.data(data, place);
        }
        if !is_set(used, place.block * pages + place.entry / self.page) {
            return Ok(None);
        }
        let first = data.saturating_add(prefix + CHECKSUM);
        self.blocks.page(first, self.page, place.entry, self.page)
    }

    /// Bytes before the entries of super blocks and data blocks.
    fn prefix(&self) -> u64 {
        prefix(self.blocks.source) + self.width
    }

    fn data(&mut self, data: u64, place: &EntryIndex) -> ReadResult<Option<Cursor<'f>>> {
        let prefix = self.prefix();
        let mut block = self.blocks.get(data, self.blocks.bytes(prefix, place.entries))?;
        block.skip(prefix as usize)?;
        self.blocks.pick(block, place.entry)
    }
}
