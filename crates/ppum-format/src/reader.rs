//! A place in the content: arrays are taken out of it by name, type and shape.
//!
//! An object that is not what it should be goes into the list of errors, and something of the right
//! type and shape takes its place, so that reading goes on and finds all errors. Nobody sees what
//! was read if there are any.

use std::cell::RefCell;
use std::ops::Range;

use crate::content::{ArrayValues, ElementType, ObjectKind, ObjectTree, join, key};
use crate::error::ReadError;
use crate::scopes::Scopes;
use crate::stored::{StoredValue, WordTable, value};

/// Most errors that are kept.
const MOST_ERRORS: usize = 100;

/// Takes arrays from a group of the file.
pub(crate) struct GroupReader<'a> {
    pub(crate) path: String,
    pub(crate) content: &'a ObjectTree,
    /// The scopes of formulas, once they are known.
    pub(crate) scopes: Option<&'a Scopes>,
    errors: &'a RefCell<Vec<ReadError>>,
}

/// Returns the result of `read` for a content, or the first of its errors.
pub(crate) fn read<T>(
    content: &ObjectTree,
    read: impl FnOnce(&GroupReader) -> T,
) -> Result<T, ReadError> {
    let (found, errors) = attempt(content, read);
    errors.into_iter().next().map_or(Ok(found), Err)
}

/// Returns what `read` makes of a content, and all errors; where there are any, the first is not to
/// be used.
pub(crate) fn attempt<T>(
    content: &ObjectTree,
    read: impl FnOnce(&GroupReader) -> T,
) -> (T, Vec<ReadError>) {
    let errors = RefCell::default();
    let path = String::new();
    let found = read(&GroupReader { path, content, scopes: None, errors: &errors });
    (found, errors.into_inner())
}

impl<'a> GroupReader<'a> {
    fn at(&self, path: String) -> Self {
        Self { path, ..*self }
    }

    /// The group, whose formulas are read in these scopes.
    pub(crate) fn within<'s>(&'s self, scopes: Option<&'s Scopes>) -> GroupReader<'s> {
        GroupReader { scopes, path: self.path.clone(), ..*self }
    }

    /// True if nothing wrong has been found so far.
    pub(crate) fn is_fine(&self) -> bool {
        self.errors.borrow().is_empty()
    }

    /// True if something wrong has been found with a dataset of this group.
    pub(crate) fn is_wrong(&self, name: &str) -> bool {
        let path = self.path_of(name);
        self.errors.borrow().iter().any(|error| error.place() == Some(&path))
    }

    /// A group in this one.
    pub(crate) fn group(&self, name: &str) -> Self {
        if self.is_there(name, ObjectKind::Group) == Some(false) {
            self.error(name, "is missing");
        }
        self.at(self.path_of(name))
    }

    pub(crate) fn path_of(&self, name: &str) -> String {
        join(&self.path, name)
    }

    /// True if there is an object of this name and kind.
    pub(crate) fn holds(&self, name: &str, kind: ObjectKind) -> bool {
        self.is_there(name, kind) == Some(true)
    }

    /// As [`holds`](Self::holds); none, and an error, if there is one of another kind.
    fn is_there(&self, name: &str, kind: ObjectKind) -> Option<bool> {
        self.or_report(self.content.holds(&self.path, name, kind))
    }

    /// Refuses an object that belongs to another word than the one the group has.
    pub(crate) fn refuse(&self, name: &str, kind: ObjectKind, word: &str) {
        if self.holds(name, kind) {
            let key = key(&self.path, name, kind);
            let message = format!("does not belong to `{word}`; leave it out");
            self.report(ReadError::object(&key, message));
        }
    }

    /// Adds an error about an object of this group, `@name` an attribute.
    pub(crate) fn error(&self, name: &str, message: impl Into<String>) {
        self.report(ReadError::object(&self.path_of(name), message));
    }

    /// Adds an error, but not a second one about the same object: that often follows from
    /// the first.
    fn report(&self, error: ReadError) {
        let mut errors = self.errors.borrow_mut();
        let is_known = errors.iter().any(|known| known.place() == error.place());
        if !is_known && errors.len() < MOST_ERRORS {
            errors.push(error);
        }
    }

    pub(crate) fn or_report<T>(&self, read: Result<T, ReadError>) -> Option<T> {
        read.map_err(|error| self.report(error)).ok()
    }

    /// The values of an array or attribute of the given shape.
    fn look<T: ElementType>(
        &self,
        name: &str,
        kind: ObjectKind,
        shape: &[Extent],
    ) -> Option<&'a [T]> {
        let is_there = self.is_there(name, kind)?;
        let key = key(&self.path, name, kind);
        let Some(array) = self.content.get(&key).filter(|_| is_there) else {
            // a group that is missing is one error
            if self.path.is_empty() || self.content.has_group(&self.path) {
                self.report(ReadError::object(&key, "is missing"));
            }
            return None;
        };
        let fits = array.shape.len() == shape.len()
            && array.shape.iter().zip(shape).all(|(n, extent)| extent.allows(*n));
        let wanted = || shape.iter().map(Extent::to_string).collect::<Vec<_>>().join(", ");
        let (found, values) = (array.values.type_name(), T::of(&array.values));
        let message = match (values, fits) {
            (Some(values), true) => return Some(values),
            (Some(_), false) => format!("has shape {:?}, expected [{}]", array.shape, wanted()),
            (None, true) => format!("has type {found}, expected {}", T::NAME),
            (None, false) => format!(
                "has type {found} and shape {:?}, expected {} [{}]",
                array.shape,
                T::NAME,
                wanted()
            ),
        };
        self.report(ReadError::object(&key, message));
        None
    }

    /// True if the attribute is there and is a text.
    pub(crate) fn has_text(&self, name: &str) -> bool {
        let array = self.content.get(&key(&self.path, name, ObjectKind::Attribute));
        array.is_some_and(|array| matches!(array.values, ArrayValues::Text(_)))
    }

    pub(crate) fn scalar<T: StoredValue>(&self, name: &str) -> T {
        self.one(name, ObjectKind::Dataset).unwrap_or_else(T::blank)
    }

    pub(crate) fn attribute<T: StoredValue>(&self, name: &str) -> T {
        self.known_attribute(name).unwrap_or_else(T::blank)
    }

    /// The attribute. None, and an error, if it is not there or not what it should be.
    pub(crate) fn known_attribute<T: StoredValue>(&self, name: &str) -> Option<T> {
        self.one(name, ObjectKind::Attribute)
    }

    /// One value; of a scalar other writers make an array of one element.
    fn one<T: StoredValue>(&self, name: &str, kind: ObjectKind) -> Option<T> {
        let key = key(&self.path, name, kind);
        let is_single = self.content.get(&key).is_some_and(|array| array.shape == [1]);
        let shape = if is_single && T::SHAPE.is_empty() { &[1] } else { T::SHAPE };
        let shape: Vec<_> = shape.iter().copied().map(Extent::Is).collect();
        let elements = self.look::<T::Element>(name, kind, &shape)?;
        if elements.len() < T::width() {
            self.report(ReadError::object(&key, "is empty"));
            return None;
        }
        let mut is_fine = true;
        let value = T::restore(0, elements, &mut |message| {
            is_fine = false;
            self.report(ReadError::object(&key, message));
        });
        is_fine.then_some(value)
    }

    /// The number of rows of an array whose values were read.
    pub(crate) fn row_count(&self, name: &str) -> Option<usize> {
        let array = self.content.get(&key(&self.path, name, ObjectKind::Dataset))?;
        let is_read = !matches!(array.values, ArrayValues::Other(_));
        array.shape.first().filter(|_| is_read).map(|&n| n as usize)
    }

    /// The number of rows that most of these arrays have.
    pub(crate) fn rows_of<'n>(&self, names: impl IntoIterator<Item = &'n str>) -> usize {
        most(names.into_iter().filter_map(|name| self.row_count(name)).collect())
    }

    /// The values of an array of the given shape, row-major, if it is of that.
    pub(crate) fn array<T: ElementType>(&self, name: &str, shape: &[Extent]) -> Option<Vec<T>> {
        self.look(name, ObjectKind::Dataset, shape).map(<[T]>::to_vec)
    }

    /// Values, as many as there are.
    pub(crate) fn list<T: StoredValue>(&self, name: &str) -> Vec<T> {
        self.values(name, Extent::Any, self.row_count(name).unwrap_or_default())
    }

    /// A value in each of so many rows.
    pub(crate) fn rows<T: StoredValue>(&self, name: &str, rows: usize) -> Vec<T> {
        self.values(name, Extent::Is(rows as u64), rows)
    }

    fn values<T: StoredValue>(&self, name: &str, extent: Extent, rows: usize) -> Vec<T> {
        let columns = T::SHAPE.iter().copied().map(Extent::Is);
        let shape: Vec<_> = [extent].into_iter().chain(columns).collect();
        let Some(elements) = self.look::<T::Element>(name, ObjectKind::Dataset, &shape) else {
            return vec![T::blank(); rows];
        };
        let rows = elements.chunks_exact(T::width()).enumerate();
        rows.map(|(k, row)| T::restore(k, row, &mut |message| self.error(name, message))).collect()
    }

    /// The rows of a matrix with a given number of them.
    pub(crate) fn matrix(&self, name: &str, rows: usize) -> Vec<Vec<f64>> {
        let shape = [Extent::Is(rows as u64), Extent::Any];
        let values = self.look::<f64>(name, ObjectKind::Dataset, &shape).unwrap_or_default();
        let columns = values.len().checked_div(rows).unwrap_or(0);
        (0..rows).map(|k| values[k * columns..(k + 1) * columns].to_vec()).collect()
    }

    /// Compressed rows of `count` parts over the entries of a list, as those of each part. Where
    /// the offsets are wrong or there is no list, all parts are empty.
    pub(crate) fn parts<T: Clone>(
        &self,
        name: &str,
        count: usize,
        (of, list): (&str, &[T]),
    ) -> Vec<Vec<T>> {
        let shape = [Extent::Is(count as u64 + 1)];
        let Some(ends) = self.look::<u64>(name, ObjectKind::Dataset, &shape) else {
            return vec![Vec::new(); count];
        };
        let rising = ends.is_sorted();
        if ends[0] != 0 || !rising || ends[count] != list.len() as u64 {
            if !self.is_wrong(of) {
                let length = list.len();
                self.error(name, format!("must rise from 0 to the {length} entries of `{of}`"));
            }
            return vec![Vec::new(); count];
        }
        let part = |w: &[u64]| -> Range<usize> { w[0] as usize..w[1] as usize };
        ends.windows(2).map(|w| list[part(w)].to_vec()).collect()
    }

    pub(crate) fn word<T: Clone>(&self, words: &WordTable<T>, word: &str, name: &str) -> Option<T> {
        value(words, word).map_err(|message| self.error(name, message)).ok()
    }
}

/// The number that most of these are, the first of several.
pub(crate) fn most(all: Vec<usize>) -> usize {
    let votes = |n: usize| all.iter().filter(|&&other| other == n).count();
    all.iter().copied().rev().max_by_key(|&n| votes(n)).unwrap_or(0)
}

/// The lengths allowed of one dimension of an array.
pub(crate) enum Extent {
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
pub(crate) fn numbered<T>(
    parent: &GroupReader,
    name: &str,
    mut item: impl FnMut(&GroupReader) -> T,
) -> Vec<T> {
    if !parent.holds(name, ObjectKind::Group) {
        return Vec::new();
    }
    let list = parent.group(name);
    let is_number = |name: &&str| name.bytes().all(|b| b.is_ascii_digit());
    let count = list.content.members(&list.path).filter(is_number).count();
    let names = (0..count).map(|number| format!("{number:04}"));
    let present = names.filter(|number| match list.is_there(number, ObjectKind::Group) {
        Some(false) => {
            list.report(missing(&list.path_of(number), count));
            false
        }
        found => found.is_some(),
    });
    present.map(|number| item(&list.group(&number))).collect()
}

/// The error that one of so many numbered groups is missing.
pub(crate) fn missing(path: &str, count: usize) -> ReadError {
    let message = format!(
        "is missing: the {count} numbered groups here must be 0000, 0001, …, of four digits \
         at least and without gaps"
    );
    ReadError::object(path, message)
}
