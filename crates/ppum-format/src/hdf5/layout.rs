//! Where the values of arrays are, and how they are packed.
//!
//! Arrays are contiguous; long ones of numbers are one chunk, or some with an index of fixed
//! length, shuffled and deflated.

use rayon::prelude::*;
use zlib_rs::{DeflateConfig, ReturnCode, compress_bound, compress_slice};

use super::messages::{ALIGNMENT, Addition, HeaderMessage, NOWHERE, with_checksum};
use super::values::{bytes, number, size};
use crate::content::{Array, ArrayValues};
use crate::error::WriteError;

/// Kinds of messages.
const LAYOUT: u8 = 0x08;
const FILTERS: u8 = 0x0b;

/// Arrays of so many bytes and more stand before all headers, so that these and small arrays are
/// near each other: who reads nothing but stress intensity factors reads a page or two.
const LARGE: usize = 1 << 12;

/// Arrays from this length on are stored in chunks, shuffled and deflated, if they shrink to less
/// than half. Geometry and indices shrink to a few percent; coefficients would to some 80 %, and
/// then take longer to inflate than all else does to read (docs/decisions/0028-opening-files.md).
const COMPRESSED_ELEMENTS: u64 = 1 << 12;

/// Elements of a chunk: 1 MiB of doubles, which h5py's default cache just holds.
const CHUNK_ELEMENTS: u64 = 1 << 17;

/// Higher levels take longer and gain nothing on these data.
const DEFLATE_LEVEL: i32 = 4;

/// True for arrays that are compressed where that is allowed.
fn is_chunked(array: &Array) -> bool {
    let is_large = array.shape.iter().product::<u64>() >= COMPRESSED_ELEMENTS;
    is_large && !matches!(array.values, ArrayValues::Text(_)) && shrinks(array)
}

/// The largest block of whole rows with at most [`CHUNK_ELEMENTS`] elements.
fn chunk(shape: &[u64]) -> Vec<u64> {
    let mut left = CHUNK_ELEMENTS;
    let mut chunk: Vec<u64> = shape
        .iter()
        .rev()
        .map(|&n| {
            let extent = n.min(left).max(1);
            left /= extent;
            extent
        })
        .collect();
    chunk.reverse();
    chunk
}

/// True if deflation makes less than half of an array, as some parts of it show.
fn shrinks(array: &Array) -> bool {
    let (bytes, size) = (bytes(array), size(&array.values));
    let stride = bytes.len().div_ceil(PARTS * size).max(1) * size;
    let parts = bytes.chunks(stride).map(|part| &part[..part.len().min(PART * size)]);
    let parts: Vec<u8> = parts.flatten().copied().collect();
    deflated(&shuffled(&parts, size)).is_some_and(|packed| 2 * packed.len() < parts.len())
}

/// Parts of an array that stand for all of it, and elements of each.
const PARTS: usize = 2;
const PART: usize = 1 << 14;

/// Puts values behind the end. Their layout.
pub(super) fn contiguous(addition: &mut Addition, values: &[u8]) -> HeaderMessage {
    let address = if values.is_empty() { NOWHERE } else { addition.put(values) };
    let place = [address.to_le_bytes(), (values.len() as u64).to_le_bytes()].concat();
    // version and class
    HeaderMessage::new(LAYOUT, [[3, 1].as_slice(), &place].concat())
}

/// Layout and filters of a large array, whose values are put behind the end; none of a small one.
pub(super) fn large(
    addition: &mut Addition,
    name: &str,
    array: &Array,
    compressed: bool,
) -> Result<Option<Vec<HeaderMessage>>, WriteError> {
    if compressed && is_chunked(array) && array.shape.len() <= 2 {
        return chunked(addition, name, array).map(Some);
    }
    let values = bytes(array);
    Ok((values.len() >= LARGE).then(|| vec![contiguous(addition, &values)]))
}

/// A chunk that is stored: its address and length.
type StoredChunk = (u64, u64);

fn chunked(
    addition: &mut Addition,
    name: &str,
    array: &Array,
) -> Result<Vec<HeaderMessage>, WriteError> {
    let (size, shape) = (size(&array.values), chunk(&array.shape));
    let chunk_bytes = size as u64 * shape.iter().product::<u64>();
    let values = bytes(array);
    if values.len() as u64 != size as u64 * array.shape.iter().product::<u64>() {
        return Err(WriteError::object(name, "has another number of values than its shape says"));
    }
    let chunks = chunks(&array.shape, &shape, &values, size);
    let packed = chunks.par_iter().map(|values| deflated(&shuffled(values, size)));
    let packed: Option<Vec<_>> = packed.collect();
    let packed = packed.ok_or_else(|| WriteError::object(name, "cannot be compressed"))?;
    let stored: Vec<StoredChunk> =
        packed.iter().map(|packed| (addition.put(packed), packed.len() as u64)).collect();
    let index = match stored.as_slice() {
        &[(address, length)] => single(address, length),
        many => fixed(addition, many, chunk_bytes),
    };
    // version, class; the only chunk is filtered; directions with that of bytes, as short as HDF5
    // wants them
    let extents: Vec<u64> = shape.iter().copied().chain([size as u64]).collect();
    let width = extents.iter().map(|n| (n.ilog2() as usize + 8) / 8).max().unwrap_or(1);
    let flags = if stored.len() == 1 { 2 } else { 0 };
    let mut layout = vec![4, 2, flags, extents.len() as u8, width as u8];
    layout.extend(extents.iter().flat_map(|n| n.to_le_bytes().into_iter().take(width)));
    layout.extend(index);
    Ok(vec![HeaderMessage::new(FILTERS, filters(size)), HeaderMessage::new(LAYOUT, layout)])
}

/// The filters: shuffle, which is told the size of elements, and deflate, which is told its level.
fn filters(size: usize) -> Vec<u8> {
    let filter = |id: u8, value: usize| [[id, 0, 0, 0, 1, 0].as_slice(), &number(value)].concat();
    [vec![2, 2], filter(2, size), filter(1, DEFLATE_LEVEL as usize)].concat()
}

/// The values of each chunk, those on the border filled up with zeros.
fn chunks(shape: &[u64], chunk: &[u64], values: &[u8], size: usize) -> Vec<Vec<u8>> {
    let matrix = |shape: &[u64]| match *shape {
        [rows, columns] => (rows, columns),
        _ => (1, shape.iter().product()),
    };
    let ((rows, columns), (height, width)) = (matrix(shape), matrix(chunk));
    let mut all = Vec::new();
    for top in (0..rows).step_by(height as usize) {
        for left in (0..columns).step_by(width as usize) {
            let mut one = vec![0; (height * width) as usize * size];
            let count = width.min(columns - left) as usize * size;
            for row in top..rows.min(top + height) {
                let from = (row * columns + left) as usize * size;
                let to = ((row - top) * width) as usize * size;
                one[to..to + count].copy_from_slice(&values[from..from + count]);
            }
            all.push(one);
        }
    }
    all
}

/// The first bytes of all elements, then the second ones, and so on.
fn shuffled(values: &[u8], size: usize) -> Vec<u8> {
    (0..size).flat_map(|plane| values.iter().skip(plane).step_by(size).copied()).collect()
}

/// The bytes as a zlib stream, which there always is.
pub(super) fn deflated(values: &[u8]) -> Option<Vec<u8>> {
    let mut packed = vec![0; compress_bound(values.len())];
    let (stream, code) = compress_slice(&mut packed, values, DeflateConfig::new(DEFLATE_LEVEL));
    let length = stream.len();
    packed.truncate(length);
    (code == ReturnCode::Ok).then_some(packed)
}

/// The index of the only chunk: its length, no filter left out, its address.
fn single(address: u64, length: u64) -> Vec<u8> {
    [[1].as_slice(), &length.to_le_bytes(), &[0; 4], &address.to_le_bytes()].concat()
}

/// Logarithm of the entries of a page, from which on an index comes in pages: HDF5's own, unless
/// there are more.
const PAGE_BITS: u8 = 10;

/// An index of fixed length.
fn fixed(addition: &mut Addition, chunks: &[StoredChunk], chunk_bytes: u64) -> Vec<u8> {
    let count = chunks.len() as u64;
    let page_bits = PAGE_BITS.max((count - 1).ilog2() as u8 + 1);
    // as wide as HDF5 has it: room for what filters lengthen
    let width = (1 + (chunk_bytes.ilog2() as usize + 8) / 8).min(8);
    let header = addition.next();
    let mut head = b"FAHD\0\x01".to_vec();
    head.extend([(8 + width + 4) as u8, page_bits]);
    head.extend(count.to_le_bytes());
    // the block of entries comes next
    let block = (header + head.len() as u64 + 8 + 4).next_multiple_of(ALIGNMENT);
    head.extend(block.to_le_bytes());
    addition.put(&with_checksum(head));
    let mut body = b"FADB\0\x01".to_vec();
    body.extend(header.to_le_bytes());
    for (address, length) in chunks {
        body.extend(address.to_le_bytes());
        body.extend(&length.to_le_bytes()[..width]);
        body.extend([0; 4]);
    }
    addition.put(&with_checksum(body));
    [[3, page_bits].as_slice(), &header.to_le_bytes()].concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    /// Borders of cells and indices shrink, numbers without a pattern do not, wherever in an array
    /// they are.
    #[test]
    fn what_shrinks() {
        let mut random = Random(4);
        let n = 40_000_u32;
        let corner = |k: u32| [f64::from(k % 160) / 160.0, f64::from(k / 160) / 125.0];
        let cells = Array::vector((0..n).flat_map(corner));
        let cells = Array { shape: vec![n.into(), 2], ..cells };
        let indices = Array::vector((0..n).map(|k| 6 * u64::from(k)));
        assert!(shrinks(&cells) && shrinks(&indices));
        let mut numbers: Vec<f64> = (0..n).map(|_| random.unit() - 0.5).collect();
        assert!(!shrinks(&Array::vector(numbers.clone())));
        numbers[..2000].fill(1.0);
        assert!(!shrinks(&Array::vector(numbers)));
    }
}
