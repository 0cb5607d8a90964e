//! The links of a group, in the three ways that HDF5 keeps them.

use super::error::{ReadResult, fail};
use super::header::{Header, LINK, LINK_INFO, SYMBOL_TABLE};
use super::heap::dense;
use super::source::{Cursor, Hdf5Source};
use super::trees::{GROUPS, entries};

/// The end of a link: an object of this file, or nothing that is read.
pub(super) enum LinkTarget {
    Object(u64),
    Elsewhere,
}

/// Kind of the index of links by name.
const INDEX: u8 = 5;

/// Names and targets of all links of a group.
pub(super) fn links(header: &Header) -> ReadResult<Vec<(String, LinkTarget)>> {
    let mut found = Vec::new();
    if let Some(table) = header.find(SYMBOL_TABLE)? {
        old(table, &mut found)?;
    }
    for message in header.all(LINK) {
        found.push(link(message?)?);
    }
    if let Some(info) = header.find(LINK_INFO)?
        && let Some((heap, records)) = dense(info, 8, INDEX)?
    {
        for record in records {
            // after a hash of the name
            let message = heap.object(&record[4..])?;
            found.push(link(header.source.cursor(message))?);
        }
    }
    Ok(found)
}

fn link(mut message: Cursor) -> ReadResult<(String, LinkTarget)> {
    message.version(1, "a link is")?;
    let flags = message.u8()?;
    let has = |bit: u8| flags & bit != 0;
    let kind = if has(0x08) { message.u8()? } else { 0 };
    message.skip(if has(0x04) { 8 } else { 0 } + usize::from(has(0x10)))?;
    let length = message.size(1 << (flags & 3))?;
    let name = name(message.take(length)?)?;
    let target =
        if kind == 0 { LinkTarget::Object(message.address()?) } else { LinkTarget::Elsewhere };
    Ok((name, target))
}

fn name(raw: &[u8]) -> ReadResult<String> {
    match std::str::from_utf8(raw) {
        Ok(name) => Ok(name.to_owned()),
        Err(_) => fail("the name of a link is not UTF-8"),
    }
}

/// Links of the first versions of HDF5: a tree of tables, names in a heap of their own.
fn old(mut table: Cursor, found: &mut Vec<(String, LinkTarget)>) -> ReadResult<()> {
    let source = table.source;
    let (tree, names) = (table.address()?, names(source, table.address()?)?);
    for (_, node) in entries(source, tree, GROUPS, source.length_size())? {
        let mut node_prefix = source.at(node, 8)?;
        node_prefix.signature(b"SNOD")?;
        node_prefix.version(1, "a table of links is")?;
        let count = node_prefix.skip(1)?.u16()?;
        let size = 24 + 2 * source.offset_size() as u64;
        let mut rest = source.at(node + 8, u64::from(count) * size)?;
        for _ in 0..count {
            let start = rest.size(source.offset_size())?;
            let (address, kind) = (rest.offset()?, rest.u32()?);
            rest.skip(20)?;
            let raw = names
                .get(start..)
                .unwrap_or_default()
                .split(|&byte| byte == 0)
                .next()
                .unwrap_or_default();
            let target = match address {
                Some(address) if kind != SOFT => LinkTarget::Object(address),
                _ => LinkTarget::Elsewhere,
            };
            if !source.budget.charge_reading(raw.len() as u64) {
                return fail("its names are longer than the file is worth");
            }
            found.push((name(raw)?, target));
        }
    }
    Ok(())
}

/// Kind of the entry of a soft link in a table.
const SOFT: u32 = 2;

/// The names of the links of a group.
fn names(source: Hdf5Source<'_>, address: u64) -> ReadResult<&[u8]> {
    let mut heap =
        source.at(address, 8 + 2 * source.length_size() as u64 + source.offset_size() as u64)?;
    heap.signature(b"HEAP")?;
    heap.version(0, "a heap of names is")?;
    let length = heap.skip(3)?.length()?;
    let data = heap.skip(source.length_size())?.address()?;
    Ok(source.at(data, length)?.rest())
}
