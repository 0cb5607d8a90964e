//! Types and values of arrays as HDF5 stores them.

use std::borrow::Cow;

use super::messages::Addition;
use crate::content::{Array, ArrayValues};
use crate::error::WriteError;

/// Bytes of the texts of an array, all of the same length.
fn text_length(texts: &[String]) -> usize {
    texts.iter().map(String::len).max().unwrap_or(0).max(1)
}

/// Bytes of an element.
pub(super) fn size(values: &ArrayValues) -> usize {
    match values {
        ArrayValues::F64(_) | ArrayValues::U64(_) | ArrayValues::I64(_) => 8,
        ArrayValues::U32(_) => 4,
        ArrayValues::U8(_) | ArrayValues::Other(_) => 1,
        ArrayValues::Text(texts) => text_length(texts),
    }
}

/// The message of a type.
pub(super) fn datatype(name: &str, array: &Array) -> Result<Vec<u8>, WriteError> {
    let size = size(&array.values);
    let whole = |flags: u8| {
        [[0x10, flags, 0, 0].as_slice(), &number(size), &[0, 0], &[8 * size as u8, 0]].concat()
    };
    Ok(match &array.values {
        ArrayValues::U8(_) | ArrayValues::U32(_) | ArrayValues::U64(_) => whole(0),
        ArrayValues::I64(_) => whole(8),
        // little-endian, its sign the last bit; bits, place and length of exponent and
        // mantissa, bias
        ArrayValues::F64(_) => [
            [0x11, 0x20, 0x3f, 0].as_slice(),
            &number(size),
            &[0, 0, 64, 0, 52, 11, 0, 52, 0xff, 0x03, 0, 0],
        ]
        .concat(),
        ArrayValues::Text(texts) => {
            check_text(name, texts)?;
            // padded with NUL, UTF-8
            [[0x13, 0x11, 0, 0].as_slice(), &number(size)].concat()
        }
        ArrayValues::Other(t) => return Err(WriteError::object(name, format!("cannot store {t}"))),
    })
}

pub(super) fn number(n: usize) -> [u8; 4] {
    (n as u32).to_le_bytes()
}

/// The values of an array, row-major.
pub(super) fn bytes(array: &Array) -> Cow<'_, [u8]> {
    let ArrayValues::Text(texts) = &array.values else {
        return array.values.little_endian().unwrap_or_default();
    };
    let length = text_length(texts);
    let padded = |text: &String| [text.as_bytes(), &vec![0; length - text.len()]].concat();
    texts.iter().flat_map(padded).collect()
}

/// Bytes of a text that an attribute holds itself: a message has at most 64 KiB.
const LONGEST_TEXT: usize = 60_000;

/// The type and the bytes of a text too long for a message, which is put behind the end, in a heap
/// of its own; none of other values.
pub(super) fn long_text(addition: &mut Addition, array: &Array) -> Option<(Vec<u8>, Vec<u8>)> {
    let ArrayValues::Text(texts) = &array.values else { return None };
    let ([text], []) = (texts.as_slice(), array.shape.as_slice()) else { return None };
    if text.len() <= LONGEST_TEXT {
        return None;
    }
    let padding = vec![0; text.len().next_multiple_of(8) - text.len()];
    let length = (text.len() as u64).to_le_bytes();
    // version; one object, named once; no room is left
    let size = (32 + text.len() + padding.len()) as u64;
    let head = [b"GCOL\x01\0\0\0".as_slice(), &size.to_le_bytes(), &[1, 0, 1, 0, 0, 0, 0, 0]];
    let heap =
        addition.put(&[&head.concat(), length.as_slice(), text.as_bytes(), &padding].concat());
    let value = [&length[..4], &heap.to_le_bytes(), &number(1)].concat();
    // a sequence of characters of UTF-8
    let kind = [[0x19, 1, 1, 0], number(16), [0x10, 0, 0, 0], number(1), [0, 0, 8, 0]].concat();
    Some((kind, value))
}

/// Makes sure that texts can be stored: they are padded with NUL in the file, and where a reader
/// finds U+FFFD something was not UTF-8.
pub(super) fn check_text(name: &str, texts: &[String]) -> Result<(), WriteError> {
    if texts.iter().any(|t| t.contains(['\0', char::REPLACEMENT_CHARACTER])) {
        let message = "texts must not contain the characters NUL and U+FFFD";
        return Err(WriteError::object(name, message));
    }
    Ok(())
}
