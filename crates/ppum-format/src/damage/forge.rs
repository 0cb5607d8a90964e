//! Headers of HDF5 objects whose own checksums are made right again, as by somebody who means it.

use std::ops::Range;

/// Extreme bytes in a header, its checksum recomputed.
pub(super) fn forged(bytes: &mut [u8], below: &mut dyn FnMut(usize) -> usize) {
    let headers = object_headers(bytes);
    if headers.is_empty() {
        return super::number(bytes, below);
    }
    let header = &headers[below(headers.len())];
    let at = header.start + 6 + below(header.len() - 10);
    let width = [1, 1, 2, 4, 8][below(5)].min(header.end - 4 - at);
    let fill = super::EXTREMES[below(super::EXTREMES.len())];
    bytes[at..at + width].fill(fill);
    seal(bytes, header);
}

/// The version 2 object headers of a file whose checksum is where it should be.
#[must_use]
pub fn object_headers(bytes: &[u8]) -> Vec<Range<usize>> {
    let starts = bytes.windows(4).enumerate().filter(|(_, w)| *w == b"OHDR").map(|(at, _)| at);
    starts
        .filter_map(|start| {
            let sizes = start + 10..bytes.len().min(start + LONGEST).saturating_sub(4);
            sizes.into_iter().find_map(|end| {
                let stored = u32::from_le_bytes(*bytes[end..].first_chunk()?);
                (lookup3(&bytes[start..end]) == stored).then_some(start..end + 4)
            })
        })
        .collect()
}

/// Longest header that is looked for, in bytes.
const LONGEST: usize = 5000;

/// Makes the checksum of an object header right again: the last four bytes of the range.
pub fn seal(bytes: &mut [u8], header: &Range<usize>) {
    let sum = lookup3(&bytes[header.start..header.end - 4]);
    bytes[header.end - 4..header.end].copy_from_slice(&sum.to_le_bytes());
}

/// Jenkins' lookup3 `hashlittle` (2006, public domain) with seed 0: the checksum of HDF5 metadata.
fn lookup3(key: &[u8]) -> u32 {
    let word = |block: &[u8], k: usize| {
        (0..4)
            .fold(0u32, |w, b| w | u32::from(block.get(4 * k + b).copied().unwrap_or(0)) << (8 * b))
    };
    let start = 0xdead_beef_u32.wrapping_add(key.len() as u32);
    let mut s = [start; 3];
    let blocks: Vec<&[u8]> = key.chunks(12).collect();
    for (n, block) in blocks.iter().enumerate() {
        for (k, value) in s.iter_mut().enumerate() {
            *value = value.wrapping_add(word(block, k));
        }
        if n + 1 < blocks.len() {
            mix(&mut s);
        } else {
            finish(&mut s);
        }
    }
    s[2]
}

fn mix(s: &mut [u32; 3]) {
    // (subtracted from, subtracted, rotation, added to)
    for (k, rotation) in [4, 6, 8, 16, 19, 4].into_iter().enumerate() {
        let (a, c, b) = (k % 3, (k + 2) % 3, (k + 1) % 3);
        s[a] = s[a].wrapping_sub(s[c]) ^ s[c].rotate_left(rotation);
        s[c] = s[c].wrapping_add(s[b]);
    }
}

fn finish(s: &mut [u32; 3]) {
    for (k, rotation) in [14, 11, 25, 16, 4, 14, 24].into_iter().enumerate() {
        let (target, from) = ((k + 2) % 3, (k + 1) % 3);
        s[target] = (s[target] ^ s[from]).wrapping_sub(s[from].rotate_left(rotation));
    }
}
