//! Paths of keys, by which the checks of a problem name a place without knowing of files, and what
//! is wrong there.

use std::fmt;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::keys::{KeyRow, ROOT};

/// The path from the root of a problem file to a value, e.g. `crack[0].points[1]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Key(String);

impl Key {
    pub(crate) fn new(path: impl Into<String>) -> Self {
        Self(path.into())
    }

    /// The points of a crack.
    pub(crate) fn points(crack: usize) -> Self {
        Self::new("crack").index(crack).name("points")
    }

    pub(crate) fn name(self, name: &str) -> Self {
        Self(format!("{}.{name}", self.0))
    }

    pub(crate) fn index(self, index: usize) -> Self {
        Self(format!("{}[{index}]", self.0))
    }

    /// The error of the value, with a message.
    pub(crate) fn error(self, message: impl Into<String>) -> KeyError {
        KeyError { key: self, message: message.into(), other: None }
    }

    /// The error of a number that is out of the range of its key.
    pub(crate) fn out_of_range(self, value: f64) -> Option<KeyError> {
        let row = self.row()?;
        let message = row.range_error(value)?;
        Some(self.error(format!("`{}` {message}", row.name)))
    }

    /// The names on the way, and the indices with a bracket behind them.
    fn steps(&self) -> impl Iterator<Item = &str> {
        self.0.split(['.', '['])
    }

    fn row(&self) -> Option<&'static KeyRow> {
        let (mut table, mut found) = (Some(&ROOT), None);
        for name in self.steps().filter(|step| !step.ends_with(']')) {
            found = table?.row(name);
            table = found?.kind.table();
        }
        found
    }

    /// True if it leads into one of some tables of the file.
    pub(crate) fn is_in_any(&self, tables: &[&str]) -> bool {
        self.steps().next().is_some_and(|table| tables.contains(&table))
    }

    /// The bytes of the value; those of the deepest value on the way that exists if it does not.
    pub(crate) fn span(&self, root: &DeTable<'_>) -> Range<usize> {
        let mut steps = self.steps();
        let Some(first) = steps.next().and_then(|name| root.get(name)) else { return 0..0 };
        let descend = |value, step| child(value, step).ok_or(value);
        steps.try_fold(first, descend).unwrap_or_else(|deepest| deepest).span()
    }
}

fn child<'a, 'i>(value: &'a Spanned<DeValue<'i>>, step: &str) -> Option<&'a Spanned<DeValue<'i>>> {
    match step.strip_suffix(']') {
        Some(index) => value.get_ref().get(index.parse::<usize>().ok()?),
        None => value.get_ref().get(step),
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// A rule that is broken.
pub(crate) struct KeyError {
    pub(crate) key: Key,
    pub(crate) message: String,
    /// The other of two values that contradict each other.
    pub(crate) other: Option<Key>,
}

impl KeyError {
    pub(crate) fn with_other(self, other: Key) -> Self {
        Self { other: Some(other), ..self }
    }
}

/// Returns the message about a hole or a crack that is not among so many.
pub(crate) fn no_such(what: &str, index: usize, count: usize) -> String {
    let those = match count {
        0 => format!("the problem has no [[{what}]]"),
        1 => format!("the only [[{what}]] has the number 0"),
        n => format!("the [[{what}]] are numbered from 0 to {}", n - 1),
    };
    format!("there is no {what} {index}; {those}")
}
