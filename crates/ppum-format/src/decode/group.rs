//! A place in the content: arrays are taken out of it by name, type and shape.

use ppum::vec2::{Vec2, vec2};

use super::Read;
use crate::content::{Content, Element, Form, Values, join, key};
use crate::error::ReadError;
use crate::names::{Words, value};

/// A place in the file to take arrays from.
pub(super) struct Group<'a> {
    pub(super) path: String,
    pub(super) content: &'a Content,
}

impl<'a> Group<'a> {
    /// A group in this one.
    pub(super) fn group(&self, name: &str) -> Read<Group<'a>> {
        if self.holds(name, Form::Group)? {
            Ok(Group { path: self.path_of(name), content: self.content })
        } else {
            Err(self.error(name, "is missing"))
        }
    }

    pub(super) fn path_of(&self, name: &str) -> String {
        join(&self.path, name)
    }

    /// True if there is an object of this name; an error if it is of another form.
    pub(super) fn holds(&self, name: &str, form: Form) -> Read<bool> {
        self.content.holds(&self.path, name, form)
    }

    /// Refuses an object that belongs to another word than the one the group has.
    pub(super) fn refuse(&self, name: &str, form: Form, word: &str) -> Read<()> {
        if !self.holds(name, form)? {
            return Ok(());
        }
        let key = key(&self.path, name, form);
        Err(ReadError::object(&key, format!("does not belong to `{word}`; leave it out")))
    }

    pub(super) fn error(&self, name: &str, mistake: impl Into<String>) -> ReadError {
        ReadError::object(&self.path_of(name), mistake)
    }

    /// The values of an array or attribute of the given shape.
    fn look<T: Element>(&self, name: &str, form: Form, shape: &[Extent]) -> Read<&'a [T]> {
        let key = key(&self.path, name, form);
        self.holds(name, form)?;
        let array = self.content.get(&key).ok_or_else(|| ReadError::object(&key, "is missing"))?;
        let fits = array.shape.len() == shape.len()
            && array.shape.iter().zip(shape).all(|(n, extent)| extent.allows(*n));
        if !fits {
            let wanted: Vec<String> = shape.iter().map(Extent::to_string).collect();
            return Err(ReadError::object(
                &key,
                format!("has shape {:?}, expected [{}]", array.shape, wanted.join(", ")),
            ));
        }
        T::of(&array.values).ok_or_else(|| {
            let found = array.values.type_name();
            ReadError::object(&key, format!("has type {found}, expected {}", T::NAME))
        })
    }

    /// True if the attribute is there and is a text.
    pub(super) fn has_text(&self, name: &str) -> bool {
        let array = self.content.get(&key(&self.path, name, Form::Attribute));
        array.is_some_and(|array| matches!(array.values, Values::Text(_)))
    }

    pub(super) fn scalar<T: Element>(&self, name: &str) -> Read<T> {
        self.one(name, Form::Dataset)
    }

    pub(super) fn attribute<T: Element>(&self, name: &str) -> Read<T> {
        self.one(name, Form::Attribute)
    }

    fn one<T: Element>(&self, name: &str, form: Form) -> Read<T> {
        let value = self.look::<T>(name, form, &[])?.first();
        value.cloned().ok_or_else(|| ReadError::object(&key(&self.path, name, form), "is empty"))
    }

    pub(super) fn attribute_point(&self, name: &str) -> Read<Vec2> {
        let p = self.look::<f64>(name, Form::Attribute, &[Extent::Is(2)])?;
        Ok(vec2(p[0], p[1]))
    }

    /// The values of an array of the given shape, row-major.
    pub(super) fn array<T: Element>(&self, name: &str, shape: &[Extent]) -> Read<Vec<T>> {
        self.look(name, Form::Dataset, shape).map(<[T]>::to_vec)
    }

    /// A vector of any length.
    pub(super) fn vector<T: Element>(&self, name: &str) -> Read<Vec<T>> {
        self.array(name, &[Extent::Any])
    }

    /// A vector as long as another.
    pub(super) fn column<T: Element>(&self, name: &str, length: usize) -> Read<Vec<T>> {
        self.array(name, &[Extent::Is(length as u64)])
    }

    /// A matrix of `N` columns.
    pub(super) fn rows<T: Element, const N: usize>(&self, name: &str) -> Read<&'a [[T; N]]> {
        let values = self.look(name, Form::Dataset, &[Extent::Any, Extent::Is(N as u64)])?;
        Ok(values.as_chunks().0)
    }

    pub(super) fn points(&self, name: &str) -> Read<Vec<Vec2>> {
        Ok(self.rows(name)?.iter().map(|&p: &[f64; 2]| p.into()).collect())
    }

    /// The rows of a matrix with a given number of them.
    pub(super) fn matrix(&self, name: &str, rows: usize) -> Read<Vec<Vec<f64>>> {
        let shape = [Extent::Is(rows as u64), Extent::Any];
        let values = self.look::<f64>(name, Form::Dataset, &shape)?;
        let columns = values.len().checked_div(rows).unwrap_or(0);
        Ok((0..rows).map(|k| values[k * columns..(k + 1) * columns].to_vec()).collect())
    }

    /// Compressed rows of `count` parts over `length` entries, as ranges.
    pub(super) fn offsets(
        &self,
        name: &str,
        count: usize,
        length: usize,
    ) -> Read<Vec<std::ops::Range<usize>>> {
        let shape = [Extent::Is(count as u64 + 1)];
        let ends = self.look::<u64>(name, Form::Dataset, &shape)?;
        let rising = ends.windows(2).all(|w| w[0] <= w[1]);
        if ends[0] != 0 || !rising || ends[count] != length as u64 {
            return Err(
                self.error(name, format!("must rise from 0 to the {length} entries it divides"))
            );
        }
        Ok(ends.windows(2).map(|w| w[0] as usize..w[1] as usize).collect())
    }

    pub(super) fn word<T: Copy>(&self, words: &Words<T>, word: &str, name: &str) -> Read<T> {
        value(words, word).map_err(|mistake| self.error(name, mistake))
    }
}

/// The lengths allowed of one dimension of an array.
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

/// The groups `0000`, `0001`, … of a group. Members that are no numbers are of no concern.
pub(super) fn numbered<T>(
    parent: &Group,
    name: &str,
    mut item: impl FnMut(&Group) -> Read<T>,
) -> Read<Vec<T>> {
    if !parent.holds(name, Form::Group)? {
        return Ok(Vec::new());
    }
    let list = parent.group(name)?;
    let is_number = |name: &&str| name.bytes().all(|b| b.is_ascii_digit());
    let count = list.content.members(&list.path).filter(is_number).count();
    let mut items = Vec::new();
    for number in 0..count {
        let number = format!("{number:04}");
        if !list.holds(&number, Form::Group)? {
            return Err(missing(&list.path_of(&number), count));
        }
        items.push(item(&list.group(&number)?)?);
    }
    Ok(items)
}

/// The error that one of so many numbered groups is missing.
pub(crate) fn missing(path: &str, count: usize) -> ReadError {
    let mistake = format!(
        "is missing: the {count} numbered groups here must be 0000, 0001, …, of four digits \
         at least and without gaps"
    );
    ReadError::object(path, mistake)
}

/// The content of a group, nothing if it is not there.
pub(super) fn optional<T>(
    parent: &Group,
    name: &str,
    items: impl Fn(&Group) -> Read<Vec<T>>,
) -> Read<Vec<T>> {
    if parent.holds(name, Form::Group)? { items(&parent.group(name)?) } else { Ok(Vec::new()) }
}
