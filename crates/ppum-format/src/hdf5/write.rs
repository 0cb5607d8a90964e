//! Content → HDF5.

use super::budget::{PLAIN_BYTES, memory_of};
use super::messages::{Addition, NOWHERE, with_checksum};
use super::objects::group;
use super::values::check_text;
use crate::content::{ArrayValues, ObjectTree};
use crate::error::WriteError;

/// Bytes of a superblock of version 3, with numbers of eight bytes, and the places of the file's
/// end and of the root in it.
pub(super) const SUPERBLOCK: usize = 48;
pub(super) const END: usize = 28;
pub(super) const ROOT: usize = 36;

/// The bytes of a file, compressed as long as they can be read again: a reader bounds what a file
/// expands to.
pub(crate) fn to_bytes(content: &ObjectTree) -> Result<Vec<u8>, WriteError> {
    let memory: u64 = content.values().map(memory_of).sum();
    let compressed = to_compressed_bytes(content)?;
    if memory <= PLAIN_BYTES.saturating_add(2 * compressed.len() as u64) {
        return Ok(compressed);
    }
    stored(content, false)
}

/// Writes the bytes, whether they can be read again or not.
pub(crate) fn to_compressed_bytes(content: &ObjectTree) -> Result<Vec<u8>, WriteError> {
    stored(content, true)
}

fn stored(content: &ObjectTree, compressed: bool) -> Result<Vec<u8>, WriteError> {
    let mut file = Addition::new(0);
    file.put(&superblock(0, 0));
    let root = group(&mut file, content, "", compressed)?;
    let start = superblock(file.end(), root);
    let mut bytes = file.into_bytes();
    bytes[..SUPERBLOCK].copy_from_slice(&start);
    Ok(bytes)
}

/// The start of a file: where it ends, and where the header of its root is.
pub(super) fn superblock(end: u64, root: u64) -> [u8; SUPERBLOCK] {
    // version; bytes of addresses and lengths; nobody is writing
    let head = *b"\x89HDF\r\n\x1a\n\x03\x08\x08\0";
    let places = [0, NOWHERE, end, root].map(u64::to_le_bytes);
    let mut block = [0; SUPERBLOCK];
    block.copy_from_slice(&with_checksum([head.as_slice(), places.as_flattened()].concat()));
    block
}

/// Makes sure that all texts can be stored.
pub(crate) fn check_texts(content: &ObjectTree) -> Result<(), WriteError> {
    content.iter().try_for_each(|(name, array)| match &array.values {
        ArrayValues::Text(texts) => check_text(name, texts),
        _ => Ok(()),
    })
}
