//! The content of a file: named arrays, free of both the data model and HDF5.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::{Deref, DerefMut};

use crate::error::ReadError;

/// All arrays and attributes of a file, in the order of their names, and its groups.
///
/// A dataset's name is its path without the leading slash (`steps/0000/partition/center`), an
/// attribute's is that of its object, `@` and its own (`steps/0000@load`; of the root: `@title`).
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ObjectTree {
    arrays: BTreeMap<String, Array>,
    /// Paths of the groups but the root, also of those with nothing in them.
    groups: BTreeSet<String>,
}

impl Deref for ObjectTree {
    type Target = BTreeMap<String, Array>;

    fn deref(&self) -> &Self::Target {
        &self.arrays
    }
}

impl DerefMut for ObjectTree {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.arrays
    }
}

/// The kinds of objects in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ObjectKind {
    Attribute,
    Dataset,
    Group,
}

impl ObjectKind {
    const ALL: [Self; 3] = [Self::Attribute, Self::Dataset, Self::Group];

    fn words(self) -> &'static str {
        match self {
            Self::Attribute => "an attribute",
            Self::Dataset => "a dataset",
            Self::Group => "a group",
        }
    }
}

impl ObjectTree {
    pub(crate) fn new() -> Self {
        Self::default()
    }

    /// Adds an array or attribute, and the groups that it is in.
    pub(crate) fn insert(&mut self, name: String, array: Array) -> Option<Array> {
        if let Some(at) = name.rfind(['/', '@']) {
            self.insert_group(&name[..at]);
        }
        self.arrays.insert(name, array)
    }

    /// Adds a group, and those that it is in; the root, without a name, is always there.
    pub(crate) fn insert_group(&mut self, path: &str) {
        if path.is_empty() || !self.groups.insert(path.to_owned()) {
            return;
        }
        if let Some(at) = path.rfind('/') {
            self.insert_group(&path[..at]);
        }
    }

    /// The paths of all groups but the root.
    pub(crate) fn groups(&self) -> impl Iterator<Item = &str> {
        self.groups.iter().map(String::as_str)
    }

    /// True if there is a group of this path, which is not the root's.
    pub(crate) fn has_group(&self, path: &str) -> bool {
        self.groups.contains(path)
    }

    /// True if a group has an object of this name and kind.
    ///
    /// # Errors
    ///
    /// There is none, but one of this name and another kind.
    pub(crate) fn holds(
        &self,
        group: &str,
        name: &str,
        kind: ObjectKind,
    ) -> Result<bool, ReadError> {
        let is_there = |kind: ObjectKind| match kind {
            ObjectKind::Group => self.groups.contains(&join(group, name)),
            _ => self.arrays.contains_key(&key(group, name, kind)),
        };
        if is_there(kind) {
            return Ok(true);
        }
        match ObjectKind::ALL.into_iter().find(|&other| is_there(other)) {
            None => Ok(false),
            Some(other) => Err(ReadError::object(
                &key(group, name, other),
                format!("is {}, but must be {}", other.words(), kind.words()),
            )),
        }
    }

    /// The arrays and attributes whose names begin so.
    pub(crate) fn beginning<'c>(
        &'c self,
        begin: &'c str,
    ) -> impl Iterator<Item = (&'c String, &'c Array)> {
        let from = self.arrays.range(begin.to_owned()..);
        from.take_while(move |(name, _)| name.starts_with(begin))
    }

    /// The names of the attributes of a group.
    pub(crate) fn attributes<'c>(&'c self, group: &str) -> impl Iterator<Item = &'c str> {
        let prefix = join(group, "@");
        let names = self.arrays.range(prefix.clone()..).map(|(name, _)| name);
        names.map_while(move |name| name.strip_prefix(&*prefix))
    }

    /// The names of the groups and datasets in a group.
    pub(crate) fn members<'c>(&'c self, group: &str) -> impl Iterator<Item = &'c str> {
        let prefix = join(group, "");
        let groups = self.groups.range(prefix.clone()..);
        let arrays = self.arrays.range(prefix.clone()..).map(|(name, _)| name);
        let (in_groups, in_arrays) = (prefix.clone(), prefix);
        let groups = groups.map_while(move |path| path.strip_prefix(&*in_groups));
        let arrays = arrays.map_while(move |name| name.strip_prefix(&*in_arrays));
        groups.chain(arrays).filter(|name| !name.contains(['/', '@']))
    }
}

/// The full name of an object of a group; the root's path is empty.
pub(crate) fn key(group: &str, name: &str, kind: ObjectKind) -> String {
    match kind {
        ObjectKind::Attribute => join(group, &format!("@{name}")),
        ObjectKind::Dataset | ObjectKind::Group => join(group, name),
    }
}

/// The path of a step.
pub(crate) fn step_path(number: usize) -> String {
    format!("steps/{number:04}")
}

/// The numbered member of `steps` that an object belongs to or is.
pub(crate) fn step_of(name: &str) -> Option<&str> {
    let rest = name.strip_prefix("steps/")?;
    let number = &rest[..rest.find(['/', '@']).unwrap_or(rest.len())];
    let is_number = !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit());
    is_number.then(|| &name[..name.len() - rest.len() + number.len()])
}

/// Name of an array (`name`) or an attribute (`@name`) of the group at `path`; the root's is empty.
pub(crate) fn join(path: &str, name: &str) -> String {
    let separator = if path.is_empty() || name.starts_with('@') { "" } else { "/" };
    format!("{path}{separator}{name}")
}

/// A rectangular array, row-major. A scalar has the shape `[]`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Array {
    pub(crate) shape: Vec<u64>,
    pub(crate) values: ArrayValues,
}

/// The values of an array, in one of the element types of the format.
#[derive(Clone, Debug, PartialEq)]
pub enum ArrayValues {
    /// Floating-point numbers.
    F64(Vec<f64>),
    /// Bytes.
    U8(Vec<u8>),
    /// Short unsigned numbers.
    U32(Vec<u32>),
    /// Long unsigned numbers.
    U64(Vec<u64>),
    /// Signed numbers.
    I64(Vec<i64>),
    /// Texts.
    Text(Vec<String>),
    /// A type outside the format, by name; its values are not read.
    Other(String),
}

impl ArrayValues {
    /// The bytes of numbers, of each the lowest first; none of texts and types outside the format.
    pub(crate) fn little_endian(&self) -> Option<Cow<'_, [u8]>> {
        match self {
            Self::F64(v) => Some(little_endian(v)),
            Self::U8(v) => Some(little_endian(v)),
            Self::U32(v) => Some(little_endian(v)),
            Self::U64(v) => Some(little_endian(v)),
            Self::I64(v) => Some(little_endian(v)),
            Self::Text(_) | Self::Other(_) => None,
        }
    }
}

fn little_endian<T: bytemuck::Pod>(numbers: &[T]) -> Cow<'_, [u8]> {
    if cfg!(target_endian = "little") {
        return Cow::Borrowed(bytemuck::cast_slice(numbers));
    }
    numbers.iter().flat_map(|number| bytemuck::bytes_of(number).iter().rev().copied()).collect()
}

/// A Rust type that stands for one of the element types.
pub(crate) trait ElementType: Clone + std::fmt::Debug {
    /// Name of the type in messages and in the checksum.
    const NAME: &'static str;
    fn wrap(values: Vec<Self>) -> ArrayValues;
    /// The values, if they are of this type.
    fn of(values: &ArrayValues) -> Option<&[Self]>;
}

macro_rules! elements {
    ($($type:ty, $variant:ident, $name:literal;)*) => {
        $(impl ElementType for $type {
            const NAME: &'static str = $name;
            fn wrap(values: Vec<Self>) -> ArrayValues {
                ArrayValues::$variant(values)
            }
            fn of(values: &ArrayValues) -> Option<&[Self]> {
                match values {
                    ArrayValues::$variant(values) => Some(values),
                    _ => None,
                }
            }
        })*
        impl ArrayValues {
            /// Name of the element type.
            pub(crate) fn type_name(&self) -> &str {
                match self {
                    $(Self::$variant(_) => $name,)*
                    Self::Other(name) => name,
                }
            }
        }
    };
}

elements! {
    f64, F64, "f64";
    u8, U8, "u8";
    u32, U32, "u32";
    u64, U64, "u64";
    i64, I64, "i64";
    String, Text, "str";
}

impl Array {
    /// One value.
    pub(crate) fn scalar<T: ElementType>(value: T) -> Self {
        Self { shape: vec![], values: T::wrap(vec![value]) }
    }

    /// A vector.
    pub(crate) fn vector<T: ElementType>(values: impl IntoIterator<Item = T>) -> Self {
        let values: Vec<T> = values.into_iter().collect();
        Self { shape: vec![values.len() as u64], values: T::wrap(values) }
    }

    /// A matrix of the given rows, all of `columns` entries.
    pub(crate) fn matrix<R: AsRef<[f64]>>(rows: &[R], columns: usize) -> Self {
        let shape = vec![rows.len() as u64, columns as u64];
        let values = rows.iter().flat_map(R::as_ref).copied().collect();
        Self { shape, values: ArrayValues::F64(values) }
    }
}
