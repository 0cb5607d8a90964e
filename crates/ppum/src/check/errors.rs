//! The errors of a check, and the rules for numbers, lists and names that others are made of.

use std::collections::BTreeSet;

use crate::vec2::{Rect, Vec2};

/// Most errors that are kept.
const MOST_ERRORS: usize = 100;

/// A thing that is wrong in a dataset.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {message}")]
#[non_exhaustive]
pub struct CheckError {
    /// The place, as a path through the dataset's fields, e.g. `steps[0].partition.half[17]`.
    pub place: String,
    /// A description of the error, with the expected value.
    pub message: String,
}

pub(super) type CheckResult = Result<(), CheckError>;

/// A list of errors, all seen from the same object of the dataset.
#[derive(Debug, Default)]
pub(super) struct Errors(Vec<CheckError>);

impl Errors {
    /// Keeps the error, if there is one. True if there is none.
    pub(super) fn add(&mut self, checked: CheckResult) -> bool {
        let is_fine = checked.is_ok();
        self.0.extend(checked.err().filter(|_| self.0.len() < MOST_ERRORS));
        is_fine
    }

    /// Checks a part of the object. True if nothing is wrong there.
    pub(super) fn within(&mut self, part: &str, check: impl FnOnce(&mut Self)) -> bool {
        let mut inner = Self::default();
        check(&mut inner);
        let is_fine = inner.is_empty();
        for error in inner.0 {
            self.add(Err(error.inside(part)));
        }
        is_fine
    }

    /// Checks the entries of a list of parts one by one. True if nothing is wrong with them.
    pub(super) fn each<T>(
        &mut self,
        list: &str,
        parts: &[T],
        check: impl Fn(usize, &T) -> CheckResult,
    ) -> bool {
        let errors = parts.iter().enumerate().filter_map(|(k, part)| {
            let error = check(k, part).err()?;
            Some(error.inside(&format!("{list}[{k}]")))
        });
        errors.fold(true, |_, error| self.add(Err(error)))
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn into_list(self) -> Vec<CheckError> {
        self.0
    }
}

impl CheckError {
    /// Prefixes the place with the object that holds it.
    fn inside(self, outer: &str) -> Self {
        let separator = if self.place.is_empty() { "" } else { "." };
        Self { place: format!("{outer}{separator}{}", self.place), ..self }
    }
}

pub(super) fn fail(place: &str, message: String) -> CheckResult {
    Err(CheckError { place: place.to_owned(), message })
}

pub(super) fn require(
    condition: bool,
    place: &str,
    message: impl FnOnce() -> String,
) -> CheckResult {
    if condition { Ok(()) } else { fail(place, message()) }
}

/// Checks every entry of an array; the place names the first that fails.
pub(super) fn check_all<T>(
    name: &str,
    values: &[T],
    good: impl Fn(&T) -> bool,
    message: impl Fn(&T) -> String,
) -> CheckResult {
    check_each(name, values.len(), |k| good(&values[k]), |k| message(&values[k]))
}

/// Checks each of so many entries, and reports the first bad one.
pub(super) fn check_each(
    name: &str,
    count: usize,
    good: impl Fn(usize) -> bool,
    message: impl Fn(usize) -> String,
) -> CheckResult {
    match (0..count).find(|&k| !good(k)) {
        None => Ok(()),
        Some(k) => fail(&format!("{name}[{k}]"), message(k)),
    }
}

pub(super) fn check_number(place: &str, value: f64) -> CheckResult {
    require(value.is_finite(), place, || format!("{value} is not a finite number"))
}

pub(super) fn check_numbers(name: &str, values: &[f64]) -> CheckResult {
    check_all(name, values, |v| v.is_finite(), |v| format!("{v} is not a finite number"))
}

pub(super) fn check_points(name: &str, points: &[Vec2]) -> CheckResult {
    check_all(
        name,
        points,
        |p| p.is_finite(),
        |p| format!("({}, {}) is not a finite point", p.x, p.y),
    )
}

pub(super) fn check_extents(name: &str, extents: &[Vec2]) -> CheckResult {
    check_all(
        name,
        extents,
        |e| e.is_finite() && e.x > 0.0 && e.y > 0.0,
        |e| format!("({}, {}) must be finite and positive", e.x, e.y),
    )
}

pub(super) fn is_box(b: &Rect) -> bool {
    let size = b.size();
    b.min.is_finite() && b.max.is_finite() && size.is_finite() && size.x > 0.0 && size.y > 0.0
}

pub(super) fn check_box(place: &str, b: &Rect) -> CheckResult {
    require(is_box(b), place, || no_box(b))
}

/// The message about a rectangle that is not one.
pub(super) fn no_box(Rect { min, max }: &Rect) -> String {
    format!("({}, {}) to ({}, {}) is not a box", min.x, min.y, max.x, max.y)
}

pub(super) fn check_length(place: &str, length: usize, expected: usize, of: &str) -> CheckResult {
    require(length == expected, place, || {
        format!("has {length} entries, expected {expected} ({of})")
    })
}

pub(super) fn check_index(place: &str, index: usize, count: usize, of: &str) -> CheckResult {
    require(index < count, place, || format!("index {index}, but there are {count} {of}"))
}

/// Compressed rows of so many parts: they start at zero, never fall, and end at the number of
/// entries.
pub(super) fn check_rising<T: Copy + Into<u64>>(
    place: &str,
    offsets: &[T],
    (parts, of_parts): (usize, &str),
    (entries, of_entries): (usize, &str),
) -> CheckResult {
    check_length(place, offsets.len(), parts + 1, &format!("one more than {of_parts}"))?;
    let at = |k: usize| -> u64 { offsets[k].into() };
    require(at(0) == 0, &format!("{place}[0]"), || format!("is {}, expected 0", at(0)))?;
    if let Some(k) = (1..=parts).find(|&k| at(k) < at(k - 1)) {
        let message = format!("{} falls below {}; offsets must not fall", at(k), at(k - 1));
        return fail(&format!("{place}[{k}]"), message);
    }
    require(at(parts) == entries as u64, &format!("{place}[{parts}]"), || {
        format!("is {}, but there are {entries} {of_entries}", at(parts))
    })
}

pub(super) fn check_names<'a>(place: &str, names: impl Iterator<Item = &'a String>) -> CheckResult {
    let mut seen = BTreeSet::new();
    for name in names {
        require(!name.trim().is_empty(), place, || "a name is empty".into())?;
        require(seen.insert(name), place, || format!("the name `{name}` occurs twice"))?;
    }
    Ok(())
}
