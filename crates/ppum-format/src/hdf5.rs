//! Content ↔ the bytes of an HDF5 file. Nothing outside this module knows the HDF5 library.

use std::collections::BTreeMap;

use hdf5_pure::{
    AttrValue, DType, Dataset, DatasetBuilder, File, FileBuilder, FinishedGroup, FormatError,
    Group, GroupBuilder, Layout, VlenStringReadOptions,
};

use crate::content::{Array, Content, Element, Values, join};
use crate::error::{ReadError, WriteError};

/// Root group that is neither read nor part of the checksum: for additions by anybody.
const USER: &str = "user";

/// Groups are at most this deep; a deeper walk means links that go round in a circle.
const DEPTH: usize = 8;

/// Smallest number of bytes an object of a file takes.
const OBJECT_BYTES: u64 = 32;

/// Deflate cannot shrink data by more than this.
const DEFLATE_RATIO: u64 = 1032;

/// Limit of what compressed arrays may grow to; plain ones are limited by the file's length.
const EXPANDED_BYTES: u64 = 1 << 32;

/// Arrays from this length on are stored in chunks, shuffled and deflated. Geometry and indices shrink
/// to a few percent, coefficients to some 80 %.
const COMPRESSED_ELEMENTS: u64 = 1 << 12;

/// Elements of a chunk: 1 MiB of doubles, which h5py's default cache just holds.
const CHUNK_ELEMENTS: u64 = 1 << 17;

/// Higher levels take longer and gain nothing on these data.
const DEFLATE_LEVEL: u32 = 4;

pub(crate) fn to_bytes(content: &Content) -> Result<Vec<u8>, WriteError> {
    let mut file = FileBuilder::new();
    let entries: Vec<Entry> = content.iter().map(|(k, a)| (k.as_str(), k.as_str(), a)).collect();
    fill(&mut file, &entries)?;
    file.finish().map_err(|e| WriteError::Hdf5 { message: e.to_string() })
}

/// Full name, name inside the group at hand, array.
type Entry<'a> = (&'a str, &'a str, &'a Array);

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

fn fill(parent: &mut impl Parent, entries: &[Entry]) -> Result<(), WriteError> {
    let mut children: BTreeMap<&str, Vec<Entry>> = BTreeMap::new();
    for &(full, name, array) in entries {
        if let Some(name) = name.strip_prefix('@') {
            parent.attribute(name, attribute_value(full, array)?);
        } else if let Some(at) = name.find(['/', '@']) {
            let inside = name[at..].strip_prefix('/').unwrap_or(&name[at..]);
            children.entry(&name[..at]).or_default().push((full, inside, array));
        } else {
            store(parent.dataset(name), full, array)?;
        }
    }
    for (name, entries) in children {
        let mut child = parent.child(name);
        fill(&mut child, &entries)?;
        parent.adopt(child.finish());
    }
    Ok(())
}

/// Strings are padded with NUL in the file, so none may hold one.
fn check_text<'a>(name: &str, texts: &'a [String]) -> Result<Vec<&'a str>, WriteError> {
    if texts.iter().any(|t| t.contains('\0')) {
        return Err(WriteError::object(name, "texts must not contain the character NUL"));
    }
    Ok(texts.iter().map(String::as_str).collect())
}

fn store(builder: &mut DatasetBuilder, name: &str, array: &Array) -> Result<(), WriteError> {
    match &array.values {
        Values::F64(v) => builder.with_f64_data(v),
        Values::U8(v) => builder.with_u8_data(v),
        Values::U32(v) => builder.with_u32_data(v),
        Values::U64(v) => builder.with_u64_data(v),
        Values::I64(v) => builder.with_i64_data(v),
        Values::Text(v) => builder
            .with_strings(&check_text(name, v)?)
            .map_err(|e| WriteError::object(name, e.to_string()))?,
        Values::Other(t) => return Err(WriteError::object(name, format!("cannot store {t}"))),
    }
    .with_shape(&array.shape);
    if array.len() >= COMPRESSED_ELEMENTS && !matches!(array.values, Values::Text(_)) {
        builder.with_chunks(&chunk(&array.shape)).with_shuffle().with_deflate(DEFLATE_LEVEL);
    }
    Ok(())
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

/// Attributes of the format are scalars of text or f64, or short vectors.
fn attribute_value(name: &str, array: &Array) -> Result<AttrValue, WriteError> {
    match (&array.values, array.shape.len()) {
        (Values::Text(v), 0) => {
            check_text(name, v)?;
            Ok(AttrValue::String(v.concat()))
        }
        (Values::F64(v), 0) => Ok(AttrValue::F64(v[0])),
        (Values::F64(v), _) => Ok(AttrValue::F64Array(v.clone())),
        (Values::U32(v), 1) => Ok(AttrValue::U32Array(v.clone())),
        (other, _) => Err(WriteError::object(name, format!("cannot store {}", other.type_name()))),
    }
}

/// All arrays and attributes of a file, whatever they mean.
pub(crate) fn from_bytes(bytes: Vec<u8>) -> Result<Content, ReadError> {
    let length = bytes.len() as u64;
    let file = File::from_bytes(bytes).map_err(damaged)?;
    let expanded = length.saturating_mul(DEFLATE_RATIO).min(EXPANDED_BYTES);
    let mut walk = Walk {
        content: Content::new(),
        length,
        objects: length / OBJECT_BYTES,
        bytes: expanded.max(length),
    };
    walk.group(&file.root(), "", DEPTH)?;
    Ok(walk.content)
}

fn damaged(e: hdf5_pure::Error) -> ReadError {
    ReadError::Hdf5 { message: e.to_string() }
}

/// A walk over a file that is not trusted: each object and array is paid for out of what a file of
/// this length can hold, before anything is allocated.
struct Walk {
    content: Content,
    length: u64,
    /// Objects that may still be visited.
    objects: u64,
    /// Bytes that may still be loaded.
    bytes: u64,
}

impl Walk {
    fn group(&mut self, group: &Group, path: &str, depth: usize) -> Result<(), ReadError> {
        let at = |e| object_error(path, e);
        self.visit(path)?;
        if depth == 0 {
            return Err(ReadError::object(path, "groups are nested too deeply"));
        }
        self.attributes(path, group.attrs().map_err(at)?);
        for name in group.datasets().map_err(at)? {
            let inner = join(path, &name);
            let dataset = group.dataset(&name).map_err(|e| object_error(&inner, e))?;
            self.visit(&inner)?;
            let array = self.load(&dataset, &inner)?;
            self.content.insert(inner, array);
        }
        for name in group.groups().map_err(at)? {
            let inner = join(path, &name);
            if inner != USER {
                let child = group.group(&name).map_err(|e| object_error(&inner, e))?;
                self.group(&child, &inner, depth - 1)?;
            }
        }
        Ok(())
    }

    fn visit(&mut self, path: &str) -> Result<(), ReadError> {
        let left = self.objects.checked_sub(1);
        self.objects =
            left.ok_or_else(|| ReadError::object(path, "more objects than the file can hold"))?;
        Ok(())
    }

    fn attributes(
        &mut self,
        path: &str,
        attributes: impl IntoIterator<Item = (String, AttrValue)>,
    ) {
        for (name, value) in attributes {
            self.content.insert(join(path, &format!("@{name}")), attribute_array(value));
        }
    }

    fn load(&mut self, dataset: &Dataset, path: &str) -> Result<Array, ReadError> {
        let at = |e| object_error(path, e);
        let shape = dataset.shape().map_err(at)?;
        self.pay(dataset, path, &shape)?;
        let values = match dataset.dtype().map_err(at)? {
            DType::F64 => f64::wrap(dataset.read_f64().map_err(at)?),
            DType::U8 => u8::wrap(dataset.read_u8().map_err(at)?),
            DType::U32 => u32::wrap(dataset.read_u32().map_err(at)?),
            DType::U64 => u64::wrap(dataset.read_u64().map_err(at)?),
            DType::I64 => i64::wrap(dataset.read_i64().map_err(at)?),
            DType::String => String::wrap(dataset.read_string().map_err(at)?),
            DType::VariableLengthString => String::wrap(self.long_strings(dataset, path)?),
            other => return Ok(Array { shape, values: Values::Other(other.to_string()) }),
        };
        let array = Array { shape, values };
        if array.len() == array.shape.iter().product::<u64>() {
            Ok(array)
        } else {
            Err(ReadError::object(path, "holds fewer values than its shape says"))
        }
    }

    /// Takes the size of an array from the account.
    fn pay(&mut self, dataset: &Dataset, path: &str, shape: &[u64]) -> Result<(), ReadError> {
        let at = |e| object_error(path, e);
        let element = dataset.element_size().map_err(at)?;
        let size = shape.iter().try_fold(element, |size, &n| size.checked_mul(n));
        let plain = !matches!(dataset.layout().map_err(at)?, Layout::Chunked { .. });
        let limit = if plain { self.length } else { self.bytes };
        match size.filter(|&size| size <= limit).and_then(|size| self.bytes.checked_sub(size)) {
            Some(left) => self.bytes = left,
            None => {
                return Err(ReadError::object(
                    path,
                    format!("its shape {shape:?} is too large for the file's length"),
                ));
            }
        }
        Ok(())
    }

    fn long_strings(&mut self, dataset: &Dataset, path: &str) -> Result<Vec<String>, ReadError> {
        let limit = usize::try_from(self.length).unwrap_or(usize::MAX);
        let options = VlenStringReadOptions::new().with_max_payload_bytes(limit);
        dataset.read_vlen_strings(options).map_err(|e| object_error(path, e))
    }
}

impl Array {
    fn len(&self) -> u64 {
        let length = match &self.values {
            Values::F64(v) => v.len(),
            Values::U8(v) => v.len(),
            Values::U32(v) => v.len(),
            Values::U64(v) => v.len(),
            Values::I64(v) => v.len(),
            Values::Text(v) => v.len(),
            Values::Other(_) => 0,
        };
        length as u64
    }
}

fn object_error(path: &str, e: hdf5_pure::Error) -> ReadError {
    let remedy = match e {
        hdf5_pure::Error::Format(FormatError::InvalidLayoutVersion(_)) => {
            "; its layout is newer than HDF5 1.14 (h5py: libver=\"latest\"), copy the file with \
             h5repack or write it without `latest`"
        }
        _ => "",
    };
    ReadError::object(if path.is_empty() { "/" } else { path }, format!("{e}{remedy}"))
}

fn attribute_array(value: AttrValue) -> Array {
    match value {
        AttrValue::F64(v) => Array::scalar(v),
        AttrValue::F64Array(v) => Array::vector(v),
        AttrValue::U8(v) => Array::scalar(v),
        AttrValue::U8Array(v) => Array::vector(v),
        AttrValue::U32(v) => Array::scalar(v),
        AttrValue::U32Array(v) => Array::vector(v),
        AttrValue::U64(v) => Array::scalar(v),
        AttrValue::U64Array(v) => Array::vector(v),
        AttrValue::I64(v) => Array::scalar(v),
        AttrValue::I64Array(v) => Array::vector(v),
        AttrValue::String(_)
        | AttrValue::StringSized { .. }
        | AttrValue::AsciiString(_)
        | AttrValue::AsciiStringSized { .. }
        | AttrValue::VarLenString(_)
        | AttrValue::VarLenAsciiString(_) => {
            Array::scalar(value.as_str().unwrap_or_default().to_owned())
        }
        other => match other.as_strings() {
            Some(strings) => Array::vector(strings.to_vec()),
            None => Array { shape: vec![], values: Values::Other(other.type_name().to_owned()) },
        },
    }
}
