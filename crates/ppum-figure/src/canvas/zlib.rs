//! Compressed bytes, RFC 1950.

/// Level of compression: the library's own choice between time and size.
const LEVEL: u8 = 6;

/// The bytes as a zlib stream.
#[must_use]
pub fn zlib(bytes: &[u8]) -> Vec<u8> {
    miniz_oxide::deflate::compress_to_vec_zlib(bytes, LEVEL)
}
