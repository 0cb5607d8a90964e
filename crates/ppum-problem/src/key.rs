//! Paths of keys, by which the checks of a problem name a place without knowing of files, and what
//! is wrong there.

use std::fmt;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::keys::{KeyRow, ROOT};

/// The path from the root of a problem file to a value, e.g. `crack[0].points[1]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Key(Vec<KeySegment>);

#[derive(Clone, Debug, PartialEq, Eq)]
enum KeySegment {
    Name(&'static str),
    Index(usize),
}

impl Key {
    pub(super) fn new(name: &'static str) -> Self {
        Self(vec![KeySegment::Name(name)])
    }

    /// The path of names that points separate, e.g. `growth.paris.c`.
    pub(super) fn of(path: &'static str) -> Self {
        Self(path.split('.').map(KeySegment::Name).collect())
    }

    /// The points of a crack.
    pub(super) fn points(crack: usize) -> Self {
        Self::new("crack").index(crack).name("points")
    }

    pub(super) fn name(mut self, name: &'static str) -> Self {
        self.0.push(KeySegment::Name(name));
        self
    }

    pub(super) fn index(mut self, index: usize) -> Self {
        self.0.push(KeySegment::Index(index));
        self
    }

    /// The error of the value, with a message.
    pub(super) fn mistake(self, message: impl Into<String>) -> InvalidValue {
        InvalidValue { key: self, message: message.into(), other: None }
    }

    /// The error of a number that is out of the range of its key.
    pub(super) fn out_of_range(self, value: f64) -> Option<InvalidValue> {
        let row = self.row()?;
        let message = row.mistake(value)?;
        Some(self.mistake(format!("`{}` {message}", row.name)))
    }

    fn row(&self) -> Option<&'static KeyRow> {
        let names = self.0.iter().filter_map(|segment| match segment {
            KeySegment::Name(name) => Some(*name),
            KeySegment::Index(_) => None,
        });
        let mut table = Some(&ROOT);
        let mut found = None;
        for name in names {
            found = table?.row(name);
            table = found?.kind.table();
        }
        found
    }

    /// True if it leads into one of some tables of the file.
    pub(super) fn is_in_any(&self, tables: &[&str]) -> bool {
        matches!(self.0.first(), Some(KeySegment::Name(name)) if tables.contains(name))
    }

    /// The bytes of the value; those of the deepest value on the way that exists if it does not.
    pub(super) fn span(&self, root: &DeTable<'_>) -> Range<usize> {
        let mut steps = self.0.iter();
        let first = steps.next().and_then(|step| match step {
            KeySegment::Name(name) => root.get(*name),
            KeySegment::Index(_) => None,
        });
        let Some(first) = first else { return 0..0 };
        let descend = |value, step| child(value, step).ok_or(value);
        steps.try_fold(first, descend).unwrap_or_else(|deepest| deepest).span()
    }
}

fn child<'a, 'i>(
    value: &'a Spanned<DeValue<'i>>,
    step: &KeySegment,
) -> Option<&'a Spanned<DeValue<'i>>> {
    match step {
        KeySegment::Name(name) => value.get_ref().get(*name),
        KeySegment::Index(index) => value.get_ref().get(*index),
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, step) in self.0.iter().enumerate() {
            match step {
                KeySegment::Name(name) if place == 0 => write!(f, "{name}")?,
                KeySegment::Name(name) => write!(f, ".{name}")?,
                KeySegment::Index(index) => write!(f, "[{index}]")?,
            }
        }
        Ok(())
    }
}

/// A rule that is broken.
pub(super) struct InvalidValue {
    pub(super) key: Key,
    pub(super) message: String,
    /// The other of two values that contradict each other.
    pub(super) other: Option<Key>,
}

impl InvalidValue {
    pub(super) fn with_other(self, other: Key) -> Self {
        Self { other: Some(other), ..self }
    }
}

/// Returns the message about a hole or a crack that is not among so many.
pub(super) fn no_such(what: &str, index: usize, count: usize) -> String {
    let those = match count {
        0 => format!("the problem has no [[{what}]]"),
        1 => format!("the only [[{what}]] has the number 0"),
        n => format!("the [[{what}]] are numbered from 0 to {}", n - 1),
    };
    format!("there is no {what} {index}; {those}")
}
