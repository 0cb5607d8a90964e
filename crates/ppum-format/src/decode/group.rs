//! A place in the content: arrays are taken out of it by name, type and shape.

use ppum::vec2::{Vec2, vec2};

use super::Read;
use crate::content::{Content, Element, Values, join};
use crate::error::ReadError;
use crate::names::{Words, value};

/// A place in the file to take arrays from. What is taken is gone: nothing is copied.
pub(super) struct Group<'a> {
    pub(super) path: String,
    pub(super) content: &'a mut Content,
}

impl Group<'_> {
    pub(super) fn group(&mut self, name: &str) -> Group<'_> {
        Group { path: self.path_of(name), content: self.content }
    }

    pub(super) fn path_of(&self, name: &str) -> String {
        join(&self.path, name)
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.content.contains_key(&self.path_of(name))
    }

    /// True if there is anything in the group.
    pub(super) fn exists(&self) -> bool {
        let path = self.path.as_str();
        let from_here = self.content.range(path.to_owned()..).map(|(key, _)| key);
        let mut rests = from_here.map_while(|key| key.strip_prefix(path));
        rests.any(|rest| rest.starts_with(['/', '@']))
    }

    pub(super) fn error(&self, name: &str, problem: impl Into<String>) -> ReadError {
        ReadError::object(&self.path_of(name), problem)
    }

    /// The values of an array of the given shape.
    pub(super) fn take<T: Element>(&mut self, key: &str, shape: &[Extent]) -> Read<Vec<T>> {
        let array = self.content.remove(key).ok_or_else(|| ReadError::object(key, "is missing"))?;
        let fits = array.shape.len() == shape.len()
            && array.shape.iter().zip(shape).all(|(n, extent)| extent.allows(*n));
        if !fits {
            let wanted: Vec<String> = shape.iter().map(Extent::to_string).collect();
            return Err(ReadError::object(
                key,
                format!("has shape {:?}, expected [{}]", array.shape, wanted.join(", ")),
            ));
        }
        T::unwrap(array.values).map_err(|other| {
            ReadError::object(key, format!("has type {}, expected {}", other.type_name(), T::NAME))
        })
    }

    /// True if the attribute is there and is a text.
    pub(super) fn has_text(&self, name: &str) -> bool {
        let array = self.content.get(&self.path_of(&format!("@{name}")));
        array.is_some_and(|array| matches!(array.values, Values::Text(_)))
    }

    pub(super) fn scalar<T: Element>(&mut self, name: &str) -> Read<T> {
        let key = self.path_of(name);
        self.one(&key)
    }

    pub(super) fn attribute<T: Element>(&mut self, name: &str) -> Read<T> {
        let key = self.path_of(&format!("@{name}"));
        self.one(&key)
    }

    pub(super) fn one<T: Element>(&mut self, key: &str) -> Read<T> {
        let value = self.take(key, &[])?.pop();
        value.ok_or_else(|| ReadError::object(key, "is empty"))
    }

    pub(super) fn attribute_point(&mut self, name: &str) -> Read<Vec2> {
        let key = self.path_of(&format!("@{name}"));
        let p = self.take::<f64>(&key, &[Extent::Is(2)])?;
        Ok(vec2(p[0], p[1]))
    }

    /// The values of an array of the given shape, row-major.
    pub(super) fn array<T: Element>(&mut self, name: &str, shape: &[Extent]) -> Read<Vec<T>> {
        self.take(&self.path_of(name), shape)
    }

    /// A vector of any length.
    pub(super) fn vector<T: Element>(&mut self, name: &str) -> Read<Vec<T>> {
        self.take(&self.path_of(name), &[Extent::Any])
    }

    /// A vector as long as another.
    pub(super) fn column<T: Element>(&mut self, name: &str, length: usize) -> Read<Vec<T>> {
        self.take(&self.path_of(name), &[Extent::Is(length as u64)])
    }

    /// A matrix of `N` columns.
    pub(super) fn rows<T: Element + Clone, const N: usize>(
        &mut self,
        name: &str,
    ) -> Read<Vec<[T; N]>> {
        let values = self.take::<T>(&self.path_of(name), &[Extent::Any, Extent::Is(N as u64)])?;
        Ok(values.as_chunks::<N>().0.to_vec())
    }

    pub(super) fn points(&mut self, name: &str) -> Read<Vec<Vec2>> {
        Ok(self.rows(name)?.into_iter().map(Vec2::from).collect())
    }

    /// The rows of a matrix with a given number of them.
    pub(super) fn matrix(&mut self, name: &str, rows: usize) -> Read<Vec<Vec<f64>>> {
        let key = self.path_of(name);
        let values = self.take::<f64>(&key, &[Extent::Is(rows as u64), Extent::Any])?;
        let columns = values.len().checked_div(rows).unwrap_or(0);
        Ok((0..rows).map(|k| values[k * columns..(k + 1) * columns].to_vec()).collect())
    }

    /// Compressed rows of `count` parts over `length` entries, as ranges.
    pub(super) fn offsets(
        &mut self,
        name: &str,
        count: usize,
        length: usize,
    ) -> Read<Vec<std::ops::Range<usize>>> {
        let ends = self.column::<u64>(name, count + 1)?;
        let rising = ends.windows(2).all(|w| w[0] <= w[1]);
        if ends[0] != 0 || !rising || ends[count] != length as u64 {
            return Err(
                self.error(name, format!("must rise from 0 to the {length} entries it divides"))
            );
        }
        Ok(ends.windows(2).map(|w| w[0] as usize..w[1] as usize).collect())
    }

    pub(super) fn word<T: Copy>(&self, words: &Words<T>, word: &str, name: &str) -> Read<T> {
        value(words, word).map_err(|problem| self.error(name, problem))
    }
}

/// What is allowed of one dimension of an array.
pub(super) enum Extent {
    Any,
    Is(u64),
}

impl Extent {
    fn allows(&self, n: u64) -> bool {
        match self {
            Self::Any => true,
            Self::Is(expected) => n == *expected,
        }
    }
}

impl std::fmt::Display for Extent {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Any => f.write_str("any"),
            Self::Is(n) => n.fmt(f),
        }
    }
}

/// The groups `0000`, `0001`, … of a group, as long as they go on.
pub(super) fn numbered<T>(
    parent: &mut Group,
    name: &str,
    mut item: impl FnMut(&mut Group) -> Read<T>,
) -> Read<Vec<T>> {
    let mut items = Vec::new();
    loop {
        let mut group = parent.group(&format!("{name}/{:04}", items.len()));
        if !group.exists() {
            return Ok(items);
        }
        items.push(item(&mut group)?);
    }
}

/// What a group holds, nothing if it is not there.
pub(super) fn optional<T>(
    parent: &mut Group,
    name: &str,
    items: impl Fn(&mut Group) -> Read<Vec<T>>,
) -> Read<Vec<T>> {
    let mut group = parent.group(name);
    if group.exists() { items(&mut group) } else { Ok(Vec::new()) }
}
