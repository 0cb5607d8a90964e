//! Filters that pack numbers and texts: LZF of h5py, scale-offset of HDF5.

use super::error::{ReadResult, fail};

/// Undoes LZF (Marc Lehmann's liblzf): runs of literals, and references to what is there already.
pub(super) fn unpacked(data: &[u8], most: usize) -> ReadResult<Vec<u8>> {
    let (mut rest, mut out) = (data, Vec::new());
    while !rest.is_empty() {
        if out.len() > most || token(&mut rest, &mut out).is_none() {
            return fail("a chunk cannot be decompressed");
        }
    }
    Ok(out)
}

fn token(rest: &mut &[u8], out: &mut Vec<u8>) -> Option<()> {
    let control = usize::from(*rest.split_off_first()?);
    if control < 32 {
        out.extend_from_slice(rest.split_off(..=control)?);
        return Some(());
    }
    let mut length = control >> 5;
    if length == 7 {
        length += usize::from(*rest.split_off_first()?);
    }
    let distance = ((control & 31) << 8 | usize::from(*rest.split_off_first()?)) + 1;
    let start = out.len().checked_sub(distance)?;
    for k in start..start + length + 2 {
        out.push(out[k]);
    }
    Some(())
}

/// Parameters of scale-offset.
const SCALE_TYPE: usize = 0;
const SCALE: usize = 1;
const COUNT: usize = 2;
const SIZE: usize = 4;
const ORDER: usize = 6;
const HAS_FILL: usize = 7;
const FILL: usize = 8;

/// Kinds of scales: decimal digits of floating-point numbers, integers as they are.
const DECIMAL: u32 = 0;
const INTEGER: u32 = 2;

/// Bytes before the packed numbers: bits of each, width of the smallest, the smallest, nothing.
const HEADER: usize = 4 + 1 + 16;

/// Undoes scale-offset: numbers are packed as their differences to the smallest one.
pub(super) fn scale_offset(data: &[u8], parameters: &[u32], most: usize) -> ReadResult<Vec<u8>> {
    match numbers(data, parameters, most) {
        Some(numbers) => Ok(numbers),
        None => fail("a chunk cannot be unpacked (scale-offset)"),
    }
}

fn numbers(data: &[u8], parameters: &[u32], most: usize) -> Option<Vec<u8>> {
    let parameter = |k: usize| parameters.get(k).copied();
    let (count, size) = (parameter(COUNT)? as usize, parameter(SIZE)? as usize);
    let is_known =
        matches!((parameter(SCALE_TYPE)?, size), (INTEGER, 1 | 2 | 4 | 8) | (DECIMAL, 8));
    if !is_known || parameter(ORDER)? != 0 || count.checked_mul(size)? > most {
        return None;
    }
    // all bits asked for: nothing is packed
    if parameter(SCALE_TYPE)? == INTEGER && parameter(SCALE)? as usize == 8 * size {
        return Some(data.to_vec());
    }
    let bits = u32::from_le_bytes(*data.first_chunk()?) as usize;
    let smallest = u64::from_le_bytes(*data.get(5..)?.first_chunk()?);
    let packed = data.get(HEADER..)?;
    if bits >= 8 * size {
        return Some(packed.get(..count * size)?.to_vec());
    }
    if packed.len() < (count * bits).div_ceil(8) {
        return None;
    }
    let [low, high] = [parameter(FILL)?, parameter(FILL + 1).unwrap_or(0)].map(u64::from);
    let fill = (parameter(HAS_FILL)? == 1).then_some(low | high << 32);
    let value = |difference: u64| match fill {
        // the largest difference stands for the value of what is not there
        Some(fill) if difference == (1 << bits) - 1 => fill,
        _ if parameters[SCALE_TYPE] == INTEGER => difference.wrapping_add(smallest),
        _ => decimal(difference, smallest, parameters[SCALE] as i32).to_bits(),
    };
    let value = |k: usize| value(difference(packed, k * bits, bits)).to_le_bytes();
    Some((0..count).flat_map(|k| value(k).into_iter().take(size)).collect())
}

fn decimal(difference: u64, smallest: u64, digits: i32) -> f64 {
    difference as i64 as f64 / 10_f64.powi(digits) + f64::from_bits(smallest)
}

/// A number of so many bits, the highest first, at a bit.
fn difference(packed: &[u8], at: usize, bits: usize) -> u64 {
    let bit = |k: usize| u64::from(packed[k / 8] >> (7 - k % 8) & 1);
    (at..at + bits).fold(0, |number, k| number << 1 | bit(k))
}
