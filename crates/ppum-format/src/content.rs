//! The content of a file: named arrays, free of both the data model and HDF5.

use std::collections::BTreeMap;

/// All arrays and attributes of a file, in the order of their names.
///
/// A dataset's name is its path without the leading slash (`steps/0000/partition/center`), an
/// attribute's is that of its object, `@` and its own (`steps/0000@load`; of the root: `@title`).
pub(crate) type Content = BTreeMap<String, Array>;

/// Name of an array (`name`) or an attribute (`@name`) of the group at `path`; the root's is empty.
pub(crate) fn join(path: &str, name: &str) -> String {
    let separator = if path.is_empty() || name.starts_with('@') { "" } else { "/" };
    format!("{path}{separator}{name}")
}

/// A rectangular array, row-major. A scalar has the shape `[]`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Array {
    pub(crate) shape: Vec<u64>,
    pub(crate) values: Values,
}

/// The element types of the format.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Values {
    F64(Vec<f64>),
    U8(Vec<u8>),
    U32(Vec<u32>),
    U64(Vec<u64>),
    I64(Vec<i64>),
    Text(Vec<String>),
    /// A type outside the format, by name; its values are not read.
    Other(String),
}

impl Values {
    /// Number of values; none of a type outside the format.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::F64(v) => v.len(),
            Self::U8(v) => v.len(),
            Self::U32(v) => v.len(),
            Self::U64(v) => v.len(),
            Self::I64(v) => v.len(),
            Self::Text(v) => v.len(),
            Self::Other(_) => 0,
        }
    }
}

/// A Rust type that stands for one of the element types.
pub(crate) trait Element: Sized {
    /// Name of the type in messages and in the checksum.
    const NAME: &'static str;
    fn wrap(values: Vec<Self>) -> Values;
    fn unwrap(values: Values) -> Result<Vec<Self>, Values>;
}

macro_rules! elements {
    ($($type:ty, $variant:ident, $name:literal;)*) => {
        $(impl Element for $type {
            const NAME: &'static str = $name;
            fn wrap(values: Vec<Self>) -> Values {
                Values::$variant(values)
            }
            fn unwrap(values: Values) -> Result<Vec<Self>, Values> {
                match values {
                    Values::$variant(values) => Ok(values),
                    other => Err(other),
                }
            }
        })*
        impl Values {
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
    pub(crate) fn scalar<T: Element>(value: T) -> Self {
        Self { shape: vec![], values: T::wrap(vec![value]) }
    }

    /// A vector.
    pub(crate) fn vector<T: Element>(values: impl IntoIterator<Item = T>) -> Self {
        let values: Vec<T> = values.into_iter().collect();
        Self { shape: vec![values.len() as u64], values: T::wrap(values) }
    }

    /// A matrix of `N` columns.
    pub(crate) fn rows<T: Element, const N: usize>(rows: impl IntoIterator<Item = [T; N]>) -> Self {
        let values: Vec<T> = rows.into_iter().flatten().collect();
        Self { shape: vec![(values.len() / N) as u64, N as u64], values: T::wrap(values) }
    }

    /// A matrix of the given rows, all of `columns` entries.
    pub(crate) fn matrix(rows: &[Vec<f64>], columns: usize) -> Self {
        let shape = vec![rows.len() as u64, columns as u64];
        Self { shape, values: Values::F64(rows.concat()) }
    }
}
