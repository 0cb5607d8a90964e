//! The checksum of HDF5's own structures.

/// Jenkins' lookup3 `hashlittle` (2006, public domain) with seed 0.
pub(crate) fn lookup3(key: &[u8]) -> u32 {
    let mut s = [0xdead_beef_u32.wrapping_add(key.len() as u32); 3];
    let mut rest = key;
    while rest.len() > 12 {
        let (block, after) = rest.split_at(12);
        add(&mut s, block);
        mix(&mut s);
        rest = after;
    }
    if !rest.is_empty() {
        add(&mut s, rest);
        finish(&mut s);
    }
    s[2]
}

/// Adds up to three words, the last one filled up with zeros.
fn add(s: &mut [u32; 3], block: &[u8]) {
    for (value, bytes) in s.iter_mut().zip(block.chunks(4)) {
        let mut word = [0; 4];
        word[..bytes.len()].copy_from_slice(bytes);
        *value = value.wrapping_add(u32::from_le_bytes(word));
    }
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

#[cfg(test)]
mod tests {
    use super::lookup3;

    /// The values that the author of the function prints in his own test program.
    #[test]
    fn values_of_its_author() {
        assert_eq!(lookup3(b""), 0xdead_beef);
        assert_eq!(lookup3(b"Four score and seven years ago"), 0x1777_0551);
    }
}
