//! Texts, and where those of variable length stand: in the collections of the global heap.

use std::collections::BTreeMap;

use super::error::{ReadResult, fail};
use super::source::{Hdf5Source, little};

/// The characters of a text of the format.
pub(super) fn text(raw: &[u8]) -> ReadResult<String> {
    match std::str::from_utf8(raw) {
        Ok(text) if !text.contains(['\0', char::REPLACEMENT_CHARACTER]) => Ok(text.to_owned()),
        _ => fail("a text holds NUL, is not UTF-8, or holds U+FFFD, which stands for that"),
    }
}

/// Smallest number of bytes of an object in a collection.
const OBJECT_BYTES: u64 = 16;

/// The collections that texts were found in, each parsed once as long as they fit.
pub(super) struct TextCollections<'f> {
    pub(super) source: Hdf5Source<'f>,
    collections: BTreeMap<u64, BTreeMap<u16, &'f [u8]>>,
    /// Objects in the collections.
    known: u64,
}

impl<'f> TextCollections<'f> {
    pub(super) fn new(source: Hdf5Source<'f>) -> Self {
        Self { source, collections: BTreeMap::new(), known: 0 }
    }

    /// The text that an element refers to: its length, and address of a collection and number
    /// in it.
    pub(super) fn read(&mut self, element: &'_ [u8]) -> ReadResult<String> {
        let (length, place) = element.split_at_checked(4).unwrap_or_default();
        let (address, number) =
            place.split_at_checked(self.source.offset_size()).unwrap_or_default();
        let (length, address, number) = (little(length), little(address), little(number));
        if length == 0 {
            return Ok(String::new());
        }
        let found = self.collection(address)?.get(&(number as u16)).copied();
        let Some(raw) = found.and_then(|raw| raw.get(..length as usize)) else {
            return fail("a text is not where it should be");
        };
        if !self.source.budget.memory.charge(length) {
            return fail("its texts are too long for the file's length");
        }
        text(&raw[..end_without(raw, 0)])
    }

    fn collection(&mut self, address: u64) -> ReadResult<&BTreeMap<u16, &'f [u8]>> {
        if !self.collections.contains_key(&address) {
            let objects = collection(self.source, address)?;
            self.known += objects.len() as u64;
            if self.known > self.source.length() / OBJECT_BYTES {
                self.collections.clear();
                self.known = objects.len() as u64;
            }
            self.collections.insert(address, objects);
        }
        Ok(&self.collections[&address])
    }
}

fn collection(source: Hdf5Source<'_>, address: u64) -> ReadResult<BTreeMap<u16, &[u8]>> {
    let prefix = 8 + source.length_size();
    let mut start = source.at(address, prefix as u64)?;
    start.signature(b"GCOL")?;
    start.version(1, "a collection of texts is")?;
    let mut rest = source.at(address, start.skip(3)?.length()?)?;
    rest.skip(prefix)?;
    let mut objects = BTreeMap::new();
    // number 0 is the free space at the end
    while let Ok(number @ 1..) = rest.u16() {
        let size = rest.skip(6)?.length()?;
        let size = usize::try_from(size).or(fail("a text is too long"))?;
        objects.insert(number, rest.take(size)?);
        // the last one may lack its padding
        let padding = (size.wrapping_neg() % 8).min(rest.rest().len());
        rest.skip(padding)?;
    }
    Ok(objects)
}

/// The end of the text without its padding.
pub(super) fn end_without(raw: &[u8], pad: u8) -> usize {
    raw.iter().rposition(|&byte| byte != pad).map_or(0, |last| last + 1)
}
