//! B-trees: the indexes of links, attributes and chunks.

use super::error::{ReadResult, fail};
use super::source::{Cursor, Hdf5Source};

/// The uses of B-trees of the first version: the links of groups, and chunks.
pub(super) const GROUPS: u8 = 0;
pub(super) const CHUNKS: u8 = 1;

/// The keys of a tree of version 1, each with the address that belongs to it, in their order.
pub(super) fn entries(
    source: Hdf5Source<'_>,
    root: u64,
    kind: u8,
    key: usize,
) -> ReadResult<Vec<(&[u8], u64)>> {
    let mut found = Vec::new();
    let mut nodes = vec![(root, None)];
    while let Some((address, above)) = nodes.pop() {
        let (level, children) = node(source, address, kind, key)?;
        // levels fall by one, so no tree goes round in a circle
        if above.is_some_and(|above: u8| above.checked_sub(1) != Some(level)) {
            return fail("the levels of an index are not in order");
        }
        if level > 0 {
            nodes.extend(children.iter().rev().map(|&(_, child)| (child, Some(level))));
        } else {
            found.extend(children);
        }
        limit(source, found.len() + nodes.len(), key + source.offset_size())?;
    }
    Ok(found)
}

/// No more of an index than the file can hold.
fn limit(source: Hdf5Source, count: usize, size: usize) -> ReadResult<()> {
    match (count as u64).checked_mul(size as u64) {
        Some(bytes) if bytes <= source.length() => Ok(()),
        _ => fail("an index is larger than the file"),
    }
}

type TreeEntries<'f> = Vec<(&'f [u8], u64)>;

fn node(
    source: Hdf5Source<'_>,
    address: u64,
    kind: u8,
    key: usize,
) -> ReadResult<(u8, TreeEntries<'_>)> {
    let prefix = 8 + 2 * source.offset_size();
    let mut node = source.at(address, prefix as u64)?;
    node.signature(b"TREE")?;
    node.version(kind, "an index of another kind:")?;
    let (level, count) = (node.u8()?, node.u16()?);
    let size = key + source.offset_size();
    let mut rest = source.at(address + prefix as u64, u64::from(count) * size as u64)?;
    let children = (0..count).map(|_| Ok((rest.take(key)?, rest.address()?)));
    Ok((level, children.collect::<ReadResult<_>>()?))
}

/// Smallest record of a tree of version 2: what is shorter would take more memory than the file
/// is long.
const SMALLEST_RECORD: usize = 8;

/// A tree of version 2.
struct BTree2<'f> {
    source: Hdf5Source<'f>,
    kind: u8,
    record: usize,
    /// Widths, at each level above the leaves, of the numbers of records under a child.
    widths: Vec<usize>,
    records: Vec<&'f [u8]>,
}

/// The records of a tree of version 2, of one of these kinds, in their order.
pub(super) fn records<'f>(
    source: Hdf5Source<'f>,
    address: u64,
    kinds: &[u8],
) -> ReadResult<Vec<&'f [u8]>> {
    let length = 22 + source.offset_size() + source.length_size();
    let mut header = source.with_checksum(address, length as u64)?;
    header.signature(b"BTHD")?;
    header.version(0, "an index is")?;
    let kind = header.u8()?;
    let (node, record, depth) = (header.u32()?, header.u16()?, header.u16()?);
    if !kinds.contains(&kind) || usize::from(record) < SMALLEST_RECORD {
        return fail("an index is of an unknown kind");
    }
    let Some(root) = header.skip(2)?.offset()? else { return Ok(Vec::new()) };
    let count = header.u16()?;
    let record = record.into();
    let widths = widths(source, node, record, depth)?;
    let mut tree = BTree2 { source, kind, record, widths, records: Vec::new() };
    tree.visit(root, count.into(), depth.into())?;
    Ok(tree.records)
}

/// Bytes of a node beside its records: signature, version, kind, checksum.
const NODE_BYTES: u64 = 10;

/// Levels of any tree: with two children each it would have more records than a file has bytes.
const MOST_LEVELS: u16 = 64;

/// Widths of the numbers of records that a child has itself (the first) and under it, at
/// each level.
fn widths(source: Hdf5Source, node: u32, record: usize, depth: u16) -> ReadResult<Vec<usize>> {
    if depth > MOST_LEVELS {
        return fail("an index is too deep");
    }
    let (record, address) = (record as u64, source.offset_size() as u64);
    let capacity = |size: u64, pointer: u64| {
        (u64::from(node)).checked_sub(NODE_BYTES + pointer).map(|space| space / (size + pointer))
    };
    let Some(leaf) = capacity(record, 0) else {
        return fail("the nodes of an index are too small");
    };
    let (mut widths, mut total) = (vec![width(leaf), 0], leaf);
    for _ in 1..depth {
        let pointer = address + (widths[0] + widths[widths.len() - 1]) as u64;
        let Some(most) = capacity(record, pointer) else {
            return fail("the nodes of an index are too small");
        };
        total = most.saturating_add(1).saturating_mul(total).saturating_add(most);
        widths.push(width(total));
    }
    Ok(widths)
}

/// Bytes of numbers up to this one.
pub(super) fn width(largest: u64) -> usize {
    (largest.checked_ilog2().unwrap_or(0) / 8 + 1) as usize
}

impl<'f> BTree2<'f> {
    fn visit(&mut self, address: u64, count: usize, depth: usize) -> ReadResult<()> {
        let children = if depth == 0 { 0 } else { count + 1 };
        let pointer = match depth {
            0 => 0,
            _ => self.source.offset_size() + self.widths[0] + self.widths[depth],
        };
        let size = NODE_BYTES as usize + count * self.record + children * pointer;
        let mut node = self.source.with_checksum(address, size as u64)?;
        node.signature(if depth == 0 { b"BTLF" } else { b"BTIN" })?;
        node.version(0, "a node of an index is")?;
        node.version(self.kind, "a node of an index is")?;
        let mut records = self.source.cursor(node.take(count * self.record)?);
        limit(self.source, self.records.len() + count, self.record)?;
        for child in 0..children {
            self.child(&mut node, depth)?;
            if child < count {
                self.records.push(records.take(self.record)?);
            }
        }
        while depth == 0 && !records.rest().is_empty() {
            self.records.push(records.take(self.record)?);
        }
        Ok(())
    }

    fn child(&mut self, node: &mut Cursor<'f>, depth: usize) -> ReadResult<()> {
        let (address, count) = (node.address()?, node.size(self.widths[0])?);
        node.skip(self.widths[depth])?;
        if count > usize::from(u16::MAX) {
            return fail("a node of an index is too large");
        }
        self.visit(address, count, depth - 1)
    }
}
