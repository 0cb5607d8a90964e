//! Damaged copies of files, for tests of programs that read them, which include this module by its
//! path.
//!
//! [`damaged`] changes the bytes of a file, or what they mean: an array of another type, shape or
//! length, indices and offsets that lead nowhere, numbers that are none, words and formulas that
//! are wrong, arrays of zeros that shrink to nothing, with the checksum missing, wrong or
//! right again.

#![allow(dead_code, unused_imports, reason = "each program of tests uses a part of it")]

mod content;
mod forge;
#[path = "../../src/lookup3.rs"]
mod lookup3;

pub(crate) use content::DamagedFile;
use forge::{EXTREMES, number};
pub(crate) use forge::{object_headers, seal, sealed_parts};

/// A copy of a file with one to three damages of one kind. `below(n)` is a random number below n;
/// the same numbers make the same damage.
pub(crate) fn damaged(file: &[u8], below: &mut dyn FnMut(usize) -> usize) -> DamagedFile {
    if below(2) == 0
        && let Some(damaged) = content::damaged(file, below)
    {
        return damaged;
    }
    let mut bytes = file.to_vec();
    let change = CHANGES[below(CHANGES.len())];
    for _ in 0..=below(3) {
        (change.1)(&mut bytes, below);
    }
    let is_sealed = change.0 == FORGED || checksums(&bytes) < checksums(file);
    DamagedFile { bytes, what: change.0.to_owned(), is_sealed }
}

/// The number of places in a file that are called like an attribute with a checksum.
fn checksums(bytes: &[u8]) -> usize {
    bytes.windows(6).filter(|w| w == b"sha256").count()
}

type ByteDamage = fn(&mut Vec<u8>, &mut dyn FnMut(usize) -> usize);

/// Kind of a damage that may hide the checksum.
const FORGED: &str = "forged header";

const CHANGES: [(&str, ByteDamage); 9] = [
    ("bits", |bytes, below| bits(bytes, below)),
    ("run of bytes", |bytes, below| run(bytes, below)),
    ("truncated", truncated),
    ("swapped blocks", |bytes, below| swapped(bytes, below)),
    ("copied block", |bytes, below| copied(bytes, below)),
    ("inserted bytes", inserted),
    ("numbers", |bytes, below| number(bytes, below)),
    ("text that is not UTF-8", |bytes, below| not_utf8(bytes, below)),
    (FORGED, |bytes, below| forge::forged(bytes, below)),
];

fn bits(bytes: &mut [u8], below: &mut dyn FnMut(usize) -> usize) {
    for _ in 0..=below(8) {
        let at = below(bytes.len());
        bytes[at] ^= 1 << below(8);
    }
}

/// A random range of at most `longest` bytes.
fn range(
    bytes: &[u8],
    longest: usize,
    below: &mut dyn FnMut(usize) -> usize,
) -> std::ops::Range<usize> {
    let start = below(bytes.len());
    start..bytes.len().min(start + 1 + below(longest))
}

fn run(bytes: &mut [u8], below: &mut dyn FnMut(usize) -> usize) {
    let range = range(bytes, 64, below);
    let fill = EXTREMES[below(EXTREMES.len())];
    bytes[range].fill(fill);
}

fn truncated(bytes: &mut Vec<u8>, below: &mut dyn FnMut(usize) -> usize) {
    bytes.truncate(1 + below(bytes.len()));
}

fn swapped(bytes: &mut [u8], below: &mut dyn FnMut(usize) -> usize) {
    let (a, b) = (below(bytes.len()), below(bytes.len()));
    let (a, b) = (a.min(b), a.max(b));
    let length = (b - a).min(bytes.len() - b).min(1 << below(12));
    let (left, right) = bytes.split_at_mut(b);
    left[a..a + length].swap_with_slice(&mut right[..length]);
}

fn copied(bytes: &mut [u8], below: &mut dyn FnMut(usize) -> usize) {
    let from = range(bytes, 4096, below);
    let to = below(bytes.len() - from.len() + 1);
    bytes.copy_within(from, to);
}

fn inserted(bytes: &mut Vec<u8>, below: &mut dyn FnMut(usize) -> usize) {
    let (at, fill) = (below(bytes.len() + 1), EXTREMES[below(EXTREMES.len())]);
    bytes.splice(at..at, vec![fill; 1 + below(40)]);
}

/// One byte in a run of letters.
fn not_utf8(bytes: &mut [u8], below: &mut dyn FnMut(usize) -> usize) {
    let start = below(bytes.len());
    let letters = bytes[start..].windows(4).position(|w| w.iter().all(u8::is_ascii_alphanumeric));
    if let Some(at) = letters {
        bytes[start + at + below(4)] = [0xff, 0xc3, 0x80, 0xed][below(4)];
    }
}
