//! HDF5 → content.

use hdf5_pure::{
    AttrValue, DType, Dataset, Datatype, File, FormatError, Group, Layout, Superblock,
    VlenStringReadOptions,
};

use super::account::{Memory, Metered, memory, memory_of};
use super::links::{Links, Raw};
use crate::content::{Array, Content, Element, Values, join};
use crate::error::ReadError;

/// Root group that is neither read nor part of the checksum: for additions by anybody.
const USER: &str = "user";

/// Groups are at most this deep; a deeper walk means links that go round in a circle.
const DEPTH: usize = 8;

/// Smallest number of bytes an object of a file takes, with its link.
const OBJECT_BYTES: u64 = 64;

/// Most texts of variable length in an array: the library takes time as their square at worst.
const MAX_LONG_TEXTS: usize = 1 << 15;

/// What stands in a text for bytes that are not UTF-8.
const REPLACEMENT: char = char::REPLACEMENT_CHARACTER;

/// All arrays and attributes of a file, whatever they mean.
pub(crate) fn from_bytes(bytes: Vec<u8>) -> Result<Content, ReadError> {
    let length = bytes.len() as u64;
    let source = Metered::new(bytes);
    let file = File::from_source(source.clone())
        .map_err(|e| ReadError::Hdf5 { message: e.to_string() })?;
    let mut walk = Walk {
        content: Content::new(),
        superblock: file.superblock().clone(),
        source,
        length,
        objects: length / OBJECT_BYTES,
        memory: Memory::for_file(length),
    };
    walk.group(&file.root(), "", DEPTH)?;
    Ok(walk.content)
}

/// A walk over a file that is not trusted: each object and array is paid for out of what a file of
/// this length can hold, before anything is allocated.
struct Walk {
    content: Content,
    superblock: Superblock,
    source: Metered,
    length: u64,
    /// Objects that may still be visited.
    objects: u64,
    memory: Memory,
}

impl Walk {
    fn group(&mut self, group: &Group, path: &str, depth: usize) -> Result<(), ReadError> {
        let at = |e| object_error(path, e);
        self.visit(path)?;
        if depth == 0 {
            return Err(error(path, "groups are nested too deeply"));
        }
        let (attributes, header) = self.source.watch(|| group.attrs());
        self.attributes(path, attributes.map_err(at)?)?;
        self.unread_attributes(path, group.attr_datatypes().map_err(at)?);
        let (datasets, groups) =
            (group.iter_datasets().map_err(at)?, group.iter_groups().map_err(at)?);
        self.no_other_links(path, group, header, datasets.len() + groups.len())?;
        for (name, dataset) in datasets {
            let inner = self.inner(path, &name)?;
            if inner != USER {
                let array = self.load(&dataset, &inner)?;
                self.insert(inner, array)?;
            }
        }
        for (name, child) in groups {
            let inner = self.inner(path, &name)?;
            if inner != USER {
                self.content.insert_group(&inner);
                self.group(&child, &inner, depth - 1)?;
            }
        }
        Ok(())
    }

    /// Refuses links that the library passes over; `found` is the number of those that it follows.
    fn no_other_links(
        &self,
        path: &str,
        group: &Group,
        header: u64,
        found: usize,
    ) -> Result<(), ReadError> {
        let links = Raw::new(self.source.bytes(), &self.superblock).links(header);
        let Some(Links { count, others }) = links else {
            let named = group.named_datatypes().map_err(|e| object_error(path, e))?;
            let first = named.first().map(|name| join(path, name));
            return first.map_or(Ok(()), |name| Err(error(&name, "is a named type: leave it out")));
        };
        if count == found as u64 {
            return Ok(());
        }
        let name = others.first().map_or(String::new(), |name| format!(" (`{name}`)"));
        let problem = format!(
            "{} of its {count} links{name} lead to no group or dataset of this file: soft and external \
             links and named types are not read; copy into the file what they lead to, or leave them out",
            count.saturating_sub(found as u64)
        );
        Err(error(path, problem))
    }

    /// Attributes of types that the library has no values for, which it leaves out, and enumerations, which
    /// it takes for numbers.
    fn unread_attributes(
        &mut self,
        path: &str,
        types: impl IntoIterator<Item = (String, Datatype)>,
    ) {
        for (name, datatype) in types {
            let name = join(path, &format!("@{name}"));
            if matches!(datatype, Datatype::Enumeration { .. }) || !self.content.contains_key(&name)
            {
                let values = Values::Other(datatype.to_string());
                self.content.insert(name, Array { shape: vec![], values });
            }
        }
    }

    /// The path of a member of a group, which is visited now.
    fn inner(&mut self, path: &str, name: &str) -> Result<String, ReadError> {
        let inner = join(path, name);
        self.visit(&inner)?;
        if name.is_empty() || name.contains(['/', '@', '\0']) || name.starts_with('.') {
            return Err(error(&inner, "is no name of an object"));
        }
        Ok(inner)
    }

    fn visit(&mut self, path: &str) -> Result<(), ReadError> {
        let left = self.objects.checked_sub(1);
        self.objects = left.ok_or_else(|| error(path, "more objects than the file can hold"))?;
        Ok(())
    }

    fn insert(&mut self, name: String, array: Array) -> Result<(), ReadError> {
        if let Values::Text(texts) = &array.values
            && texts.iter().any(|text| text.contains([REPLACEMENT, '\0']))
        {
            return Err(error(
                &name,
                "a text holds NUL, is not UTF-8, or holds U+FFFD, which stands for that",
            ));
        }
        match self.content.insert(name.clone(), array) {
            None => Ok(()),
            Some(_) => Err(error(&name, "occurs twice")),
        }
    }

    fn attributes(
        &mut self,
        path: &str,
        attributes: impl IntoIterator<Item = (String, AttrValue)>,
    ) -> Result<(), ReadError> {
        if self.source.is_exhausted() {
            return Err(error(path, "its attributes are larger than the file"));
        }
        for (name, value) in attributes {
            let name = join(path, &format!("@{name}"));
            let array = attribute_array(value);
            self.pay(&name, Some(memory_of(&array)), &array.shape)?;
            self.insert(name, array)?;
        }
        Ok(())
    }

    fn load(&mut self, dataset: &Dataset, path: &str) -> Result<Array, ReadError> {
        let at = |e| object_error(path, e);
        let shape = dataset.shape().map_err(at)?;
        let dtype = dataset.dtype().map_err(at)?;
        self.pay_dataset(dataset, &dtype, path, &shape)?;
        let values = match dtype {
            DType::F64 => f64::wrap(dataset.read_f64().map_err(at)?),
            DType::U8 => u8::wrap(dataset.read_u8().map_err(at)?),
            DType::U32 => u32::wrap(dataset.read_u32().map_err(at)?),
            DType::U64 => u64::wrap(dataset.read_u64().map_err(at)?),
            DType::I64 => i64::wrap(dataset.read_i64().map_err(at)?),
            DType::String => String::wrap(dataset.read_string().map_err(at)?),
            DType::VariableLengthString => String::wrap(self.long_texts(dataset, path)?),
            other => return Ok(Array { shape, values: Values::Other(other.to_string()) }),
        };
        let array = Array { shape, values };
        if array.values.len() as u64 == array.shape.iter().product::<u64>() {
            Ok(array)
        } else {
            Err(error(path, "holds fewer values than its shape says"))
        }
    }

    /// Takes the size of an array from the account, and looks at its parts: each is expanded as a whole.
    fn pay_dataset(
        &mut self,
        dataset: &Dataset,
        dtype: &DType,
        path: &str,
        shape: &[u64],
    ) -> Result<(), ReadError> {
        let at = |e| object_error(path, e);
        let size = dataset.element_size().map_err(at)?;
        let count = product(shape);
        let is_text = matches!(dtype, DType::String | DType::VariableLengthString);
        let cost = count.and_then(|count| memory(count, size, is_text));
        let stored = count.and_then(|count| count.checked_mul(size));
        let fits = match dataset.layout().map_err(at)? {
            Layout::Chunked { chunk_shape, .. } => {
                let part = product(&chunk_shape).and_then(|n| n.checked_mul(size));
                let parts = parts(shape, &chunk_shape);
                let expanded = parts.zip(part).and_then(|(n, part)| n.checked_mul(part));
                expanded.is_some_and(|bytes| bytes <= self.memory.left())
            }
            _ => stored.is_some_and(|bytes| bytes <= self.length),
        };
        self.pay(path, cost.filter(|_| fits), shape)
    }

    fn pay(&mut self, path: &str, cost: Option<u64>, shape: &[u64]) -> Result<(), ReadError> {
        if self.memory.pay(cost) {
            return Ok(());
        }
        Err(error(path, format!("its shape {shape:?} is too large for the file's length")))
    }

    /// Texts of variable length, whose characters are paid for as well.
    fn long_texts(&mut self, dataset: &Dataset, path: &str) -> Result<Vec<String>, ReadError> {
        let limit = usize::try_from(self.memory.left()).unwrap_or(usize::MAX);
        let options = VlenStringReadOptions::new()
            .with_max_elements(MAX_LONG_TEXTS)
            .with_max_payload_bytes(limit);
        let texts = dataset.read_vlen_strings(options).map_err(|e| object_error(path, e))?;
        let characters = texts.iter().map(|text| text.len() as u64).sum();
        self.pay(path, Some(characters), &[texts.len() as u64])?;
        Ok(texts)
    }
}

fn product(shape: &[u64]) -> Option<u64> {
    shape.iter().try_fold(1_u64, |product, &n| product.checked_mul(n))
}

/// Number of chunks that an array of this shape is divided into.
fn parts(shape: &[u64], chunk: &[u64]) -> Option<u64> {
    if shape.len() != chunk.len() || chunk.contains(&0) {
        return None;
    }
    let parts: Vec<u64> = shape.iter().zip(chunk).map(|(n, chunk)| n.div_ceil(*chunk)).collect();
    product(&parts)
}

/// An error at an object; the root is `/`.
fn error(path: &str, problem: impl Into<String>) -> ReadError {
    ReadError::object(if path.is_empty() { "/" } else { path }, problem)
}

fn object_error(path: &str, e: hdf5_pure::Error) -> ReadError {
    let remedy = match e {
        hdf5_pure::Error::Format(FormatError::InvalidLayoutVersion(_)) => {
            "; its layout is newer than HDF5 1.14 (h5py: libver=\"latest\"), copy the file with \
             h5repack or write it without `latest`"
        }
        _ => "",
    };
    error(path, format!("{e}{remedy}"))
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
