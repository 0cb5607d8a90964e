//! Messages, the headers that they stand in, and the bytes that come behind the end of a file.

use crate::error::WriteError;
use crate::lookup3::lookup3;

/// Kinds of messages that say where others are.
pub(super) const LINK: u8 = 0x06;
pub(super) const CONTINUATION: u8 = 0x10;

/// The message that says how links are kept, and its body if they are in the header: version,
/// flags, no heap and no index.
pub(super) const LINK_INFO: u8 = 0x02;
pub(super) const NO_HEAP: [u8; 18] =
    [0, 0, !0, !0, !0, !0, !0, !0, !0, !0, !0, !0, !0, !0, !0, !0, !0, !0];

/// The address that leads nowhere.
pub(super) const NOWHERE: u64 = u64::MAX;

/// A message of a header.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct HeaderMessage {
    pub(super) kind: u8,
    pub(super) flags: u8,
    pub(super) body: Vec<u8>,
}

impl HeaderMessage {
    pub(super) fn new(kind: u8, body: Vec<u8>) -> Self {
        Self { kind, flags: 0, body }
    }

    /// A hard link.
    pub(super) fn link(name: &str, address: u64) -> Self {
        // version; flags: whether a character set follows, and the bytes of the name's length, as a
        // power of two
        let power: u8 = if name.len() < 1 << 8 { 0 } else { 2 };
        let mut body = if name.is_ascii() { vec![1, power] } else { vec![1, 0x10 | power, 1] };
        body.extend(&(name.len() as u32).to_le_bytes()[..1 << power]);
        body.extend(name.as_bytes());
        body.extend(address.to_le_bytes());
        Self::new(LINK, body)
    }

    /// The address that it leads to, if it is a hard link of this name as [`HeaderMessage::link`]
    /// makes it, or with the character set of the name.
    pub(super) fn link_to(&self, name: &str) -> Option<u64> {
        let rest = match self.body.as_slice() {
            [1, 0, rest @ ..] | [1, 0x10, _, rest @ ..] if self.kind == LINK => rest,
            _ => return None,
        };
        let (length, rest) = rest.split_first()?;
        let address = rest.strip_prefix(name.as_bytes())?;
        let is_name = usize::from(*length) == name.len();
        is_name.then_some(u64::from_le_bytes(*address.first_chunk()?))
    }

    /// The place of more messages.
    pub(super) fn continuation(address: u64, length: u64) -> Self {
        Self::new(CONTINUATION, [address.to_le_bytes(), length.to_le_bytes()].concat())
    }
}

/// Messages, each with its kind, size and flags in front.
fn encoded(messages: &[HeaderMessage]) -> Result<Vec<u8>, WriteError> {
    let mut bytes = Vec::new();
    for HeaderMessage { kind, flags, body } in messages {
        let Ok(size) = u16::try_from(body.len()) else {
            let message =
                "an attribute or the name of an array has more than 65,000 bytes".to_owned();
            return Err(WriteError::Hdf5 { message });
        };
        bytes.push(*kind);
        bytes.extend(size.to_le_bytes());
        bytes.push(*flags);
        bytes.extend(body);
    }
    Ok(bytes)
}

/// A header of version 2 whose length takes four bytes, without times.
const HEADER: [u8; 6] = *b"OHDR\x02\x02";

/// The header of an object.
pub(super) fn header(messages: &[HeaderMessage]) -> Result<Vec<u8>, WriteError> {
    let messages = encoded(messages)?;
    let length = (messages.len() as u32).to_le_bytes();
    Ok(with_checksum([HEADER.as_slice(), &length, &messages].concat()))
}

/// A block in which a header continues.
pub(super) fn block(messages: &[HeaderMessage]) -> Result<Vec<u8>, WriteError> {
    Ok(with_checksum([b"OCHK".as_slice(), &encoded(messages)?].concat()))
}

/// Returns the bytes with their checksum.
pub(super) fn with_checksum(mut bytes: Vec<u8>) -> Vec<u8> {
    let sum = lookup3(&bytes);
    bytes.extend(sum.to_le_bytes());
    bytes
}

/// Bytes that come behind the end of a file.
pub(super) struct Addition {
    end: u64,
    bytes: Vec<u8>,
}

/// Objects start at multiples of this, as HDF5 has it.
pub(super) const ALIGNMENT: u64 = 8;

impl Addition {
    pub(super) fn new(end: u64) -> Self {
        Self { end, bytes: Vec::new() }
    }

    /// Puts a part behind the others. Its address.
    pub(super) fn put(&mut self, part: &[u8]) -> u64 {
        let address = self.next();
        self.bytes.resize((address - self.end) as usize, 0);
        self.bytes.extend(part);
        address
    }

    /// The address of the next part.
    pub(super) fn next(&self) -> u64 {
        (self.end + self.bytes.len() as u64).next_multiple_of(ALIGNMENT)
    }

    pub(super) fn end(&self) -> u64 {
        self.end + self.bytes.len() as u64
    }

    pub(super) fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }
}
