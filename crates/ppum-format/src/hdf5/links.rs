//! The links of a group that the HDF5 library passes over without a word: soft and external ones, and those
//! to named types. What stands behind them would be missing from a dataset that seems whole.

use hdf5_pure::Superblock;

/// Types of messages of an object header.
const LINK_INFO: u16 = 0x02;
const LINK: u16 = 0x06;
const CONTINUATION: u16 = 0x10;

/// Bytes of a signature, as of the parts of a header after the first.
const SIGNATURE: usize = 4;

/// The links of a group.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Links {
    /// All of them, of whatever kind.
    pub(super) count: u64,
    /// Names of those that are not hard, as far as the header tells.
    pub(super) others: Vec<String>,
}

/// A file by the sizes and places that its superblock gives.
pub(super) struct Raw<'b> {
    bytes: &'b [u8],
    base: u64,
    offset_size: usize,
    length_size: usize,
}

impl<'b> Raw<'b> {
    pub(super) fn new(bytes: &'b [u8], superblock: &Superblock) -> Self {
        let (offset_size, length_size) = (superblock.offset_size, superblock.length_size);
        Self {
            bytes,
            base: superblock.base_address.get(),
            offset_size: offset_size.into(),
            length_size: length_size.into(),
        }
    }

    /// The links of the group whose header stands at a place of the file. Nothing of groups in the form of
    /// the first HDF5 versions, where the library refuses soft links, and of headers that it refuses.
    pub(super) fn links(&self, header: u64) -> Option<Links> {
        let mut links = None;
        for (kind, body) in self.messages(header)? {
            match kind {
                LINK_INFO => {
                    let indexed = self.indexed(body)?;
                    links.get_or_insert_with(Links::default).count += indexed;
                }
                LINK => {
                    let links = links.get_or_insert_with(Links::default);
                    links.count += 1;
                    links.others.extend(name_unless_hard(body)?);
                }
                _ => {}
            }
        }
        links
    }

    /// Types and contents of the messages of an object header.
    fn messages(&self, header: u64) -> Option<Vec<(u16, &'b [u8])>> {
        let head = self.bytes.get(usize::try_from(header).ok()?..)?;
        let is_new = head.starts_with(b"OHDR");
        let (first, prefix) = if is_new { new_chunk(head)? } else { (old_chunk(head)?, 8) };
        let (mut found, mut chunks) = (Vec::new(), vec![first]);
        // parts of a header that lead to each other would not end
        let mut left = self.bytes.len();
        while let Some(mut rest) = chunks.pop() {
            left = left.checked_sub(rest.len().max(1))?;
            while rest.len() >= prefix {
                // the type takes two bytes in version 1, then comes the size
                let (kind, size) = rest.split_at(if is_new { 1 } else { 2 });
                let (kind, size) = (number(kind)? as u16, number(&size[..2])? as usize);
                let body = rest.get(prefix..prefix + size)?;
                if kind == CONTINUATION {
                    chunks.push(self.continuation(body, is_new)?);
                } else {
                    found.push((kind, body));
                }
                rest = &rest[prefix + size..];
            }
        }
        Some(found)
    }

    /// The messages of the part of a header that a message leads to.
    fn continuation(&self, body: &[u8], is_new: bool) -> Option<&'b [u8]> {
        let (address, length) = body.split_at_checked(self.offset_size)?;
        let (start, length) = (self.place(address)?, number(length.get(..self.length_size)?)?);
        let part = self.bytes.get(start..)?.get(..usize::try_from(length).ok()?)?;
        if is_new { part.get(SIGNATURE..part.len().checked_sub(SIGNATURE)?) } else { Some(part) }
    }

    /// Number of the links that an index holds, zero if there is none.
    fn indexed(&self, link_info: &[u8]) -> Option<u64> {
        let order = if link_info.get(1)? & 1 == 0 { 0 } else { 8 };
        let addresses = link_info.get(2 + order..)?;
        let (heap, index) = addresses.split_at_checked(self.offset_size)?;
        if heap.iter().all(|&byte| byte == 0xff) {
            return Some(0);
        }
        let tree = self.bytes.get(self.place(index.get(..self.offset_size)?)?..)?;
        // signature, version, type, sizes of nodes and records, depth, two percentages; root; its records
        let total = 16 + self.offset_size + 2;
        number(tree.get(total..total + self.length_size)?)
    }

    /// Where an address of the file leads.
    fn place(&self, address: &[u8]) -> Option<usize> {
        usize::try_from(number(address)?.checked_add(self.base)?).ok()
    }
}

/// The first messages of a header of version 1.
fn old_chunk(head: &[u8]) -> Option<&[u8]> {
    let size = number(head.get(8..12)?)? as usize;
    head.get(16..)?.get(..size)
}

/// The first messages of a header of version 2, and what precedes the content of each.
fn new_chunk(head: &[u8]) -> Option<(&[u8], usize)> {
    let flags = *head.get(5)?;
    let has = |bit: u8, size: usize| if flags & bit == 0 { 0 } else { size };
    let at = 6 + has(0x20, 16) + has(0x10, 4);
    let width = 1 << (flags & 3);
    let size = usize::try_from(number(head.get(at..at + width)?)?).ok()?;
    Some((head.get(at + width..)?.get(..size)?, 4 + has(0x04, 2)))
}

/// The name in a link message, if the link is not a hard one.
fn name_unless_hard(link: &[u8]) -> Option<Option<String>> {
    let flags = *link.get(1)?;
    let has = |bit: u8, size: usize| if flags & bit == 0 { 0 } else { size };
    let is_hard = flags & 0x08 == 0 || *link.get(2)? == 0;
    let at = 2 + has(0x08, 1) + has(0x04, 8) + has(0x10, 1);
    let width = 1 << (flags & 3);
    let length = usize::try_from(number(link.get(at..at + width)?)?).ok()?;
    let name = link.get(at + width..)?.get(..length)?;
    Some((!is_hard).then(|| String::from_utf8_lossy(name).into_owned()))
}

/// A number of at most eight bytes, the lowest first.
fn number(bytes: &[u8]) -> Option<u64> {
    let mut all = [0; 8];
    all.get_mut(..bytes.len())?.copy_from_slice(bytes);
    Some(u64::from_le_bytes(all))
}
