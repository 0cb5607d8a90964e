//! Shuffling: the first bytes of all elements come first, then the second ones, and so on.

/// Puts the first elements of a shuffled chunk in order, as many as there is room for. Elements
/// have as many bytes as the chunk has planes; the room is for whole elements, but where it is for
/// all of the chunk.
pub(super) fn unshuffle(chunk: &[u8], planes: usize, elements: &mut [u8]) {
    let count = chunk.len() / planes;
    match planes {
        1 => elements.copy_from_slice(&chunk[..elements.len()]),
        4 => in_eights::<4>(chunk, count, elements),
        8 => in_eights::<8>(chunk, count, elements),
        _ => one_by_one(chunk, count, planes, elements),
    }
    // what does not make a whole element stays as it is
    let rest = elements.iter_mut().zip(chunk).skip(count * planes);
    rest.for_each(|(element, byte)| *element = *byte);
}

fn one_by_one(chunk: &[u8], count: usize, planes: usize, elements: &mut [u8]) {
    for (k, plane) in chunk.chunks_exact(count.max(1)).take(planes).enumerate() {
        for (element, byte) in elements.chunks_exact_mut(planes).zip(plane) {
            element[k] = *byte;
        }
    }
}

/// Eight elements of `N` bytes at once: a word of each plane, turned.
fn in_eights<const N: usize>(chunk: &[u8], count: usize, elements: &mut [u8]) {
    let planes: [&[u8]; N] = std::array::from_fn(|k| &chunk[k * count..(k + 1) * count]);
    let elements = elements.as_chunks_mut::<N>().0;
    let (eights, rest) = elements.as_chunks_mut::<8>();
    let begun = 8 * eights.len();
    let words = planes.map(|plane| plane.as_chunks::<8>().0);
    for (k, eight) in eights.iter_mut().enumerate() {
        let mut rows = [0; 8];
        for (row, words) in rows.iter_mut().zip(&words) {
            *row = u64::from_le_bytes(words[k]);
        }
        for (element, column) in eight.iter_mut().zip(turned(rows)) {
            *element = *column.to_le_bytes().first_chunk().unwrap_or(element);
        }
    }
    for (k, element) in (begun..count).zip(rest) {
        *element = planes.map(|plane| plane[k]);
    }
}

/// A square of eight by eight bytes, its rows as columns: squares of four by four bytes are
/// exchanged across the diagonal, in each those of two by two, and in these the bytes.
fn turned(mut rows: [u64; 8]) -> [u64; 8] {
    for (size, mask) in [(4, 0xffff_ffff), (2, 0xffff_0000_ffff), (1, 0x00ff_00ff_00ff_00ff)] {
        for k in (0..8).filter(|k| k & size == 0) {
            let exchanged = (rows[k] >> (8 * size) ^ rows[k + size]) & mask;
            rows[k + size] ^= exchanged;
            rows[k] ^= exchanged << (8 * size);
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    /// Whatever was shuffled is as before, or its first elements are.
    #[test]
    fn chunks_are_put_in_order() {
        let mut random = Random(3);
        for size in [1, 2, 3, 4, 8, 12] {
            for length in [0, 1, 7, 8, 63, 64, 65, 8 * 31 + 5, 4099] {
                let bytes: Vec<u8> = (0..length).map(|_| (256.0 * random.unit()) as u8).collect();
                let (whole, rest) = bytes.split_at(length / size * size);
                let plane = |k: usize| whole.iter().skip(k).step_by(size);
                let shuffled: Vec<u8> = (0..size).flat_map(plane).chain(rest).copied().collect();
                let first = length / size / 3 * size;
                for room in [length, length / size * size, first] {
                    let mut elements = vec![0; room];
                    unshuffle(&shuffled, size, &mut elements);
                    assert_eq!(elements, bytes[..room], "{room} of {length}, by {size}");
                }
            }
        }
    }
}
