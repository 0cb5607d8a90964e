//! Parts of HDF5 files whose own checksums are made right again, as by somebody who means it.

use std::ops::Range;

use super::lookup3::lookup3;

/// Extreme bytes in a part, its checksum recomputed.
pub(super) fn forged(bytes: &mut [u8], below: &mut dyn FnMut(usize) -> usize) {
    let parts = sealed_parts(bytes);
    if parts.is_empty() {
        return number(bytes, below);
    }
    let part = &parts[below(parts.len())];
    let at = part.start + 6 + below(part.len() - 10);
    let width = [1, 1, 2, 4, 8][below(5)].min(part.end - 4 - at);
    let fill = EXTREMES[below(EXTREMES.len())];
    bytes[at..at + width].fill(fill);
    seal(bytes, part);
}

/// Signatures of the parts that end in a checksum: headers of objects and the rest of them, heaps,
/// trees, arrays of chunks.
const SIGNATURES: [&[u8; 4]; 13] = [
    b"OHDR", b"OCHK", b"FRHP", b"FHIB", b"BTHD", b"BTIN", b"BTLF", b"FAHD", b"FADB", b"EAHD",
    b"EAIB", b"EASB", b"EADB",
];

/// The parts of a file that end in a checksum, where it is right.
pub(crate) fn sealed_parts(bytes: &[u8]) -> Vec<Range<usize>> {
    parts(bytes, &SIGNATURES)
}

/// The version 2 object headers of a file whose checksum is where it should be.
pub(crate) fn object_headers(bytes: &[u8]) -> Vec<Range<usize>> {
    parts(bytes, &SIGNATURES[..1])
}

fn parts(bytes: &[u8], signatures: &[&[u8; 4]]) -> Vec<Range<usize>> {
    let is_start = |w: &[u8]| signatures.iter().any(|signature| w == *signature);
    let starts = bytes.windows(4).enumerate().filter(|(_, w)| is_start(w)).map(|(at, _)| at);
    starts
        .filter_map(|start| {
            let sizes = start + 10..=bytes.len().min(start + LONGEST).saturating_sub(4);
            sizes.into_iter().find_map(|end| {
                let stored = u32::from_le_bytes(*bytes[end..].first_chunk()?);
                (lookup3(&bytes[start..end]) == stored).then_some(start..end + 4)
            })
        })
        .collect()
}

/// Longest part that is looked for, in bytes.
const LONGEST: usize = 5000;

/// Makes the checksum of a part right again: the last four bytes of the range.
pub(crate) fn seal(bytes: &mut [u8], part: &Range<usize>) {
    let sum = lookup3(&bytes[part.start..part.end - 4]);
    bytes[part.end - 4..part.end].copy_from_slice(&sum.to_le_bytes());
}

/// Bytes that mean something extreme.
pub(super) const EXTREMES: [u8; 6] = [0x00, 0x01, 0x7f, 0x80, 0xfe, 0xff];

/// Sizes and addresses stand at even places.
pub(super) fn number(bytes: &mut [u8], below: &mut dyn FnMut(usize) -> usize) {
    let number = match below(7) {
        0 => u64::MAX,
        1 => 1 << 63,
        2 => 1 << 32,
        3 => bytes.len() as u64,
        4 => below(bytes.len()) as u64,
        5 => f64::NAN.to_bits(),
        _ => below(3) as u64,
    };
    let width = [1, 2, 4, 8][below(4)];
    let places = (bytes.len() / 2).saturating_sub(4);
    if places > 0 {
        let at = 2 * below(places);
        bytes[at..at + width].copy_from_slice(&number.to_le_bytes()[..width]);
    }
}
