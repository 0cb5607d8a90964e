//! Attributes of a group.

use super::error::{ReadResult, fail};
use super::header::{ATTRIBUTE, ATTRIBUTE_INFO, DATATYPE, Header, shared};
use super::heap::dense;
use super::source::Cursor;
use super::texts::{TextCollections, end_without, text};
use super::types::{Dataspace, Type};
use crate::content::Array;

/// Kind of the index of attributes by name.
const INDEX: u8 = 8;

/// Bytes of a record of the index: identifier in the heap, flags, order of creation, hash of
/// the name.
const RECORD: usize = 8 + 1 + 4 + 4;

/// Flag of a record: the attribute stands elsewhere.
const SHARED: u8 = 1 << 1;

/// An attribute that is not read yet: its name and where it is described.
pub(super) struct AttributeEntry<'f> {
    pub(super) name: String,
    kind: Type,
    space: Option<Dataspace>,
    data: Cursor<'f>,
}

/// All attributes of an object.
pub(super) fn attributes<'f>(header: &Header<'f>) -> ReadResult<Vec<AttributeEntry<'f>>> {
    let mut found: Vec<_> =
        header.all(ATTRIBUTE).map(|message| attribute(message?)).collect::<ReadResult<_>>()?;
    if let Some(info) = header.find(ATTRIBUTE_INFO)?
        && let Some((heap, records)) = dense(info, 2, INDEX)?
    {
        for record in records {
            if record.len() != RECORD || record[8] & SHARED != 0 {
                return fail("its attributes are shared in a heap, which is not read");
            }
            let message = heap.object(&record[..8])?;
            found.push(attribute(header.source.cursor(message))?);
        }
    }
    Ok(found)
}

fn attribute(mut message: Cursor) -> ReadResult<AttributeEntry> {
    let (version, flags) = (message.u8()?, message.u8()?);
    let (name, kind, space) = (message.u16()?, message.u16()?, message.u16()?);
    let padded = |size: u16| match version {
        1 => usize::from(size).next_multiple_of(8),
        _ => size.into(),
    };
    match version {
        1 | 2 => {}
        // the encoding of the name
        3 => drop(message.skip(1)?),
        _ => return fail(format!("an attribute has version {version}, which is not known")),
    }
    let source = message.source;
    let name = message.take(padded(name))?;
    let name = text(&name[..end_without(name, 0)])?;
    let kind = source.cursor(message.take(padded(kind))?);
    let kind = if version > 1 && flags & 1 != 0 { shared(kind, DATATYPE)? } else { kind };
    if version > 1 && flags & 2 != 0 {
        return fail("an attribute shares its shape, which is not read");
    }
    let space = Dataspace::parse(source.cursor(message.take(padded(space))?))?;
    Ok(AttributeEntry { name, kind: Type::parse(kind)?, space, data: message })
}

impl AttributeEntry<'_> {
    pub(super) fn read(mut self, texts: &mut TextCollections) -> ReadResult<Array> {
        self.kind.array(self.space, texts, |_, bytes| {
            bytes.copy_from_slice(self.data.take(bytes.len())?);
            Ok(())
        })
    }
}
