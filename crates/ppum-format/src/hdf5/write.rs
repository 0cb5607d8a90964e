//! Content → HDF5.

use std::collections::BTreeMap;

use hdf5_pure::{AttrValue, DatasetBuilder, FileBuilder, FinishedGroup, GroupBuilder};

use super::account::{PLAIN_BYTES, memory_of};
use super::values::shrinks;
use crate::content::{Array, ArrayValues, Content, join};
use crate::error::WriteError;

/// Arrays from this length on are stored in chunks, shuffled and deflated, if they shrink to less
/// than half. Geometry and indices shrink to a few percent; coefficients would to some 80 %, and
/// then take longer to inflate than all else does to read (docs/decisions/0028-opening-files.md).
const COMPRESSED_ELEMENTS: u64 = 1 << 12;

/// Elements of a chunk: 1 MiB of doubles, which h5py's default cache just holds.
const CHUNK_ELEMENTS: u64 = 1 << 17;

/// Higher levels take longer and gain nothing on these data.
pub(super) const DEFLATE_LEVEL: u32 = 4;

/// The bytes of a file, compressed as long as they can be read again: a reader bounds what a file
/// expands to.
pub(crate) fn to_bytes(content: &Content) -> Result<Vec<u8>, WriteError> {
    let memory: u64 = content.values().map(memory_of).sum();
    let compressed = to_compressed_bytes(content)?;
    if memory <= PLAIN_BYTES.saturating_add(2 * compressed.len() as u64) {
        return Ok(compressed);
    }
    stored(content, false)
}

/// The same, whether it can be read again or not.
pub(crate) fn to_compressed_bytes(content: &Content) -> Result<Vec<u8>, WriteError> {
    stored(content, true)
}

fn stored(content: &Content, compressed: bool) -> Result<Vec<u8>, WriteError> {
    let mut file = FileBuilder::new();
    let groups: Vec<String> = content.groups().map(|path| join(path, "")).collect();
    let groups = groups.iter().map(|path| (path.as_str(), path.as_str(), None));
    let arrays = content.iter().map(|(name, array)| (name.as_str(), name.as_str(), Some(array)));
    let entries: Vec<NamedArray> = groups.chain(arrays).collect();
    fill(&mut file, &entries, compressed)?;
    file.finish().map_err(|e| WriteError::Hdf5 { message: e.to_string() })
}

/// Full name, name inside the group at hand, array. The names of groups, which have none, end in
/// a slash.
type NamedArray<'a> = (&'a str, &'a str, Option<&'a Array>);

/// The root and other groups, which the library builds by different types.
trait Parent {
    fn dataset(&mut self, name: &str) -> &mut DatasetBuilder;
    fn attribute(&mut self, name: &str, value: AttrValue);
    fn child(&mut self, name: &str) -> GroupBuilder;
    fn adopt(&mut self, child: FinishedGroup);
}

macro_rules! parent {
    ($type:ty) => {
        impl Parent for $type {
            fn dataset(&mut self, name: &str) -> &mut DatasetBuilder {
                self.create_dataset(name)
            }
            fn attribute(&mut self, name: &str, value: AttrValue) {
                self.set_attr(name, value);
            }
            fn child(&mut self, name: &str) -> GroupBuilder {
                self.create_group(name)
            }
            fn adopt(&mut self, child: FinishedGroup) {
                self.add_group(child);
            }
        }
    };
}

parent!(FileBuilder);
parent!(GroupBuilder);

fn fill(
    parent: &mut impl Parent,
    entries: &[NamedArray],
    compressed: bool,
) -> Result<(), WriteError> {
    let mut children: BTreeMap<&str, Vec<NamedArray>> = BTreeMap::new();
    for &(full, name, array) in entries {
        match (name.find(['/', '@']), array) {
            (Some(0), Some(array)) => parent.attribute(&name[1..], attribute_value(full, array)?),
            (Some(at), _) => {
                let inside = name[at..].strip_prefix('/').unwrap_or(&name[at..]);
                children.entry(&name[..at]).or_default().push((full, inside, array));
            }
            (None, Some(array)) => store(parent.dataset(name), full, array, compressed)?,
            // the group itself
            (None, None) => {}
        }
    }
    for (name, entries) in children {
        let mut child = parent.child(name);
        fill(&mut child, &entries, compressed)?;
        parent.adopt(child.finish());
    }
    Ok(())
}

/// Makes sure that all texts can be stored.
pub(crate) fn check_texts(content: &Content) -> Result<(), WriteError> {
    content.iter().try_for_each(|(name, array)| match &array.values {
        ArrayValues::Text(texts) => check_text(name, texts).map(drop),
        _ => Ok(()),
    })
}

/// Strings are padded with NUL in the file, and where a reader finds U+FFFD something was
/// not UTF-8.
pub(super) fn check_text<'a>(name: &str, texts: &'a [String]) -> Result<Vec<&'a str>, WriteError> {
    if texts.iter().any(|t| t.contains(['\0', char::REPLACEMENT_CHARACTER])) {
        return Err(WriteError::object(
            name,
            "texts must not contain the characters NUL and U+FFFD",
        ));
    }
    Ok(texts.iter().map(String::as_str).collect())
}

fn store(
    builder: &mut DatasetBuilder,
    name: &str,
    array: &Array,
    compressed: bool,
) -> Result<(), WriteError> {
    match &array.values {
        ArrayValues::F64(v) => builder.with_f64_data(v),
        ArrayValues::U8(v) => builder.with_u8_data(v),
        ArrayValues::U32(v) => builder.with_u32_data(v),
        ArrayValues::U64(v) => builder.with_u64_data(v),
        ArrayValues::I64(v) => builder.with_i64_data(v),
        ArrayValues::Text(v) => builder
            .with_strings(&check_text(name, v)?)
            .map_err(|e| WriteError::object(name, e.to_string()))?,
        ArrayValues::Other(t) => return Err(WriteError::object(name, format!("cannot store {t}"))),
    }
    .with_shape(&array.shape);
    if compressed && is_chunked(array) {
        builder.with_chunks(&chunk(&array.shape)).with_shuffle().with_deflate(DEFLATE_LEVEL);
    }
    Ok(())
}

/// True for arrays that are compressed where that is allowed.
pub(super) fn is_chunked(array: &Array) -> bool {
    let is_large = array.shape.iter().product::<u64>() >= COMPRESSED_ELEMENTS;
    is_large && !matches!(array.values, ArrayValues::Text(_)) && shrinks(array)
}

/// The largest block of whole rows with at most [`CHUNK_ELEMENTS`] elements.
pub(super) fn chunk(shape: &[u64]) -> Vec<u64> {
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

/// Attributes of the format are scalars of text or f64, or short vectors; damaged files
/// have others.
fn attribute_value(name: &str, array: &Array) -> Result<AttrValue, WriteError> {
    match (&array.values, array.shape.len()) {
        (ArrayValues::Text(v), 0) => {
            check_text(name, v)?;
            Ok(AttrValue::String(v.concat()))
        }
        (ArrayValues::Text(v), 1) => {
            check_text(name, v)?;
            Ok(AttrValue::StringArray(v.clone()))
        }
        (ArrayValues::F64(v), 0) => Ok(AttrValue::F64(v[0])),
        (ArrayValues::F64(v), _) => Ok(AttrValue::F64Array(v.clone())),
        (ArrayValues::U32(v), 1) => Ok(AttrValue::U32Array(v.clone())),
        (other, _) => Err(WriteError::object(name, format!("cannot store {}", other.type_name()))),
    }
}
