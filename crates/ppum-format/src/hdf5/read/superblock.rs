//! The start of a file: widths of numbers, and where the root group is.

use super::super::account::Account;
use super::source::{Parsed, Source, fail};

const SIGNATURE: &[u8; 8] = b"\x89HDF\r\n\x1a\n";

/// Places of the signature: bytes of the user's before it are 0, 512, 1024 or 2048.
const PLACES: [usize; 4] = [0, 512, 1024, 2048];

/// The file without the user's bytes, and the address of the root group.
pub(super) fn open<'f>(bytes: &'f [u8], account: &'f Account) -> Parsed<(Source<'f>, u64)> {
    let has_signature = |at: &&usize| bytes.get(**at..).is_some_and(|b| b.starts_with(SIGNATURE));
    let Some(&start) = PLACES.iter().find(has_signature) else {
        return fail("the signature of HDF5 is missing");
    };
    // addresses count from the signature, whatever the file says
    let bytes = &bytes[start..];
    let version = bytes.get(SIGNATURE.len()).copied().unwrap_or(u8::MAX);
    let (source, end, root) = match version {
        0 | 1 => old(bytes, version, account)?,
        2 | 3 => new(bytes, account)?,
        _ => return fail(format!("its superblock has version {version}, which is not known")),
    };
    // the end is counted from the signature, or by some programs from the start of the file
    if end > source.length() + start as u64 {
        return fail("it is truncated");
    }
    Ok((source, root))
}

/// The file, its end and its root.
type Start<'f> = Parsed<(Source<'f>, u64, u64)>;

fn old<'f>(bytes: &'f [u8], version: u8, account: &'f Account) -> Start<'f> {
    let source = Source::new(bytes, (at(bytes, 13), at(bytes, 14)), account)?;
    let mut start = source.cursor(bytes);
    // sizes of the nodes of trees, flags
    start.skip(24 + if version == 1 { 4 } else { 0 })?;
    let width = source.offset_size();
    // base, free space; after the end the driver, and the name of the root
    let end = start.skip(2 * width)?.address()?;
    let root = start.skip(2 * width)?.address()?;
    Ok((source, end, root))
}

fn new<'f>(bytes: &'f [u8], account: &'f Account) -> Start<'f> {
    let source = Source::new(bytes, (at(bytes, 9), at(bytes, 10)), account)?;
    let width = source.offset_size();
    let mut start = source.sealed(0, (16 + 4 * width) as u64)?;
    // base, extension
    let end = start.skip(12 + 2 * width)?.address()?;
    let root = start.address()?;
    Ok((source, end, root))
}

fn at(bytes: &[u8], place: usize) -> u8 {
    bytes.get(place).copied().unwrap_or_default()
}
