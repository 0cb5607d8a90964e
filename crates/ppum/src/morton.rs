//! Morton (Z) order: the bits of x and y interleaved, x in the even places.

/// The Morton code of a pair: sorting by it walks the plane along nested Z shapes.
pub(crate) fn morton(x: u32, y: u32) -> u64 {
    spread(x) | spread(y) << 1
}

/// Moves bit k to bit 2k.
fn spread(v: u32) -> u64 {
    let mut v = u64::from(v);
    v = (v | v << 16) & 0x0000_ffff_0000_ffff;
    v = (v | v << 8) & 0x00ff_00ff_00ff_00ff;
    v = (v | v << 4) & 0x0f0f_0f0f_0f0f_0f0f;
    v = (v | v << 2) & 0x3333_3333_3333_3333;
    (v | v << 1) & 0x5555_5555_5555_5555
}

#[cfg(test)]
mod tests {
    use super::morton;

    #[test]
    fn bits_are_interleaved() {
        assert_eq!(morton(0b101, 0b011), 0b01_10_11);
        for bit in 0..32 {
            assert_eq!(morton(1 << bit, 0), 1 << (2 * bit));
            assert_eq!(morton(0, 1 << bit), 2 << (2 * bit));
        }
    }
}
