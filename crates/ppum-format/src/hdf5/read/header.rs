//! Headers of objects: what a file says of a group or an array is a list of messages.

use super::error::{ReadResult, fail};
use super::source::{Cursor, Hdf5Source};

/// Kinds of messages.
pub(super) const DATASPACE: u16 = 0x01;
pub(super) const LINK_INFO: u16 = 0x02;
pub(super) const DATATYPE: u16 = 0x03;
pub(super) const OLD_FILL_VALUE: u16 = 0x04;
pub(super) const FILL_VALUE: u16 = 0x05;
pub(super) const LINK: u16 = 0x06;
pub(super) const EXTERNAL_FILES: u16 = 0x07;
pub(super) const LAYOUT: u16 = 0x08;
pub(super) const GROUP_INFO: u16 = 0x0a;
pub(super) const FILTERS: u16 = 0x0b;
pub(super) const ATTRIBUTE: u16 = 0x0c;
const CONTINUATION: u16 = 0x10;
pub(super) const SYMBOL_TABLE: u16 = 0x11;
pub(super) const ATTRIBUTE_INFO: u16 = 0x15;
const LAST: u16 = 0x18;

/// Flags of a message: it stands elsewhere; it must be understood.
const SHARED: u8 = 1 << 1;
const ESSENTIAL: u8 = 1 << 7;

struct RawMessage<'f> {
    kind: u16,
    is_shared: bool,
    body: &'f [u8],
}

/// The messages of an object.
pub(super) struct Header<'f> {
    pub(super) source: Hdf5Source<'f>,
    messages: Vec<RawMessage<'f>>,
}

impl<'f> Header<'f> {
    pub(super) fn read(source: Hdf5Source<'f>, address: u64) -> ReadResult<Self> {
        let mut header = Self { source, messages: Vec::new() };
        let is_new = source.at(address, 4)?.rest() == b"OHDR";
        if is_new {
            header.read_new(address)?
        } else {
            header.read_old(address)?
        }
        Ok(header)
    }

    /// Version 1: a prefix of 16 bytes, messages with prefixes of eight.
    fn read_old(&mut self, address: u64) -> ReadResult<()> {
        let mut prefix = self.source.at(address, 16)?;
        prefix.version(1, "its header is")?;
        let length = prefix.skip(7)?.u32()?;
        let first = self.source.at(address + 16, length.into())?;
        self.blocks(
            first,
            |source, address, length| source.at(address, length),
            |block| {
                let (kind, size, flags) = (block.u16()?, block.u16()?, block.u8()?);
                block.skip(3)?;
                Ok((kind, size, flags))
            },
        )
    }

    /// Version 2: checksums, and prefixes that depend on flags.
    fn read_new(&mut self, address: u64) -> ReadResult<()> {
        let mut prefix = self.source.at(address, 6)?;
        prefix.skip(4)?.version(2, "its header is")?;
        let flags = prefix.u8()?;
        let has = |bit: u8, size| if flags & bit == 0 { 0 } else { size };
        let (width, before) = (1 << (flags & 3), 6 + has(0x20, 16) + has(0x10, 4));
        let size = self
            .source
            .at(address, before + width)?
            .skip(before as usize)?
            .number(width as usize)?;
        let Some(length) = size.checked_add(before + width + 4) else {
            return fail("its header is too long");
        };
        let mut first = self.source.with_checksum(address, length)?;
        first.skip((before + width) as usize)?;
        let next = |source: Hdf5Source<'f>, address, length| {
            let mut block = source.with_checksum(address, length)?;
            block.signature(b"OCHK")?;
            Ok(block)
        };
        let creation = has(0x04, 2) as usize;
        self.blocks(first, next, |block| {
            let (kind, size, flags) = (block.u8()?, block.u16()?, block.u8()?);
            block.skip(creation)?;
            Ok((kind.into(), size, flags))
        })
    }

    /// All messages, block by block: a message can say where there are more.
    fn blocks(
        &mut self,
        first: Cursor<'f>,
        next: impl Fn(Hdf5Source<'f>, u64, u64) -> ReadResult<Cursor<'f>>,
        prefix: impl Fn(&mut Cursor<'f>) -> ReadResult<(u16, u16, u8)>,
    ) -> ReadResult<()> {
        let (mut blocks, mut total) = (vec![first], 0);
        while let Some(mut block) = blocks.pop() {
            total += block.rest().len() as u64;
            if total > self.source.length() {
                return fail("its header goes round in a circle");
            }
            // what is shorter than a prefix is a gap
            while let Ok((kind, size, flags)) = prefix(&mut block) {
                let body = block.take(size.into())?;
                if kind == CONTINUATION {
                    let mut place = self.source.cursor(body);
                    blocks.push(next(self.source, place.address()?, place.length()?)?);
                } else {
                    self.add(kind, flags, body)?;
                }
            }
        }
        Ok(())
    }

    fn add(&mut self, kind: u16, flags: u8, body: &'f [u8]) -> ReadResult<()> {
        if kind > LAST && flags & ESSENTIAL != 0 {
            return fail(format!("it has a property of HDF5 that is not known ({kind})"));
        }
        self.messages.push(RawMessage { kind, is_shared: flags & SHARED != 0, body });
        Ok(())
    }

    pub(super) fn has(&self, kind: u16) -> bool {
        self.messages.iter().any(|message| message.kind == kind)
    }

    /// The first message of a kind.
    pub(super) fn find(&self, kind: u16) -> ReadResult<Option<Cursor<'f>>> {
        self.all(kind).next().transpose()
    }

    /// The message of a kind that there must be.
    pub(super) fn get(&self, kind: u16) -> ReadResult<Cursor<'f>> {
        self.find(kind)?.ok_or_else(|| "a part of its description is missing".into())
    }

    /// All messages of a kind.
    pub(super) fn all(&self, kind: u16) -> impl Iterator<Item = ReadResult<Cursor<'f>>> {
        self.messages.iter().filter(move |message| message.kind == kind).map(|message| {
            let body = self.source.cursor(message.body);
            if message.is_shared { shared(body, message.kind) } else { Ok(body) }
        })
    }
}

/// A message that stands in the header of another object, such as a named type.
pub(super) fn shared(mut place: Cursor, kind: u16) -> ReadResult<Cursor> {
    let (version, of) = (place.u8()?, place.u8()?);
    let address = match (version, of) {
        (1, _) => place.skip(6)?.address()?,
        (2, _) | (3, 2) => place.address()?,
        (3, 1) => return fail("a part of its description is shared in a heap, which is not read"),
        _ => return fail("a part of its description is shared in an unknown way"),
    };
    let header = Header::read(place.source, address)?;
    let message = header.messages.iter().find(|m| m.kind == kind && !m.is_shared);
    match message {
        Some(message) => Ok(place.source.cursor(message.body)),
        None => fail("a part of its description is missing where it should be shared"),
    }
}
