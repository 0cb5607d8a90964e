//! Paths of keys, by which the checks of a problem name a place without knowing of files.

use std::fmt;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The way from the root of a problem file to a value, e.g. `crack[0].points[1]`.
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

    pub(super) fn name(mut self, name: &'static str) -> Self {
        self.0.push(KeySegment::Name(name));
        self
    }

    pub(super) fn index(mut self, index: usize) -> Self {
        self.0.push(KeySegment::Index(index));
        self
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
