//! The errors found so far.

use super::{CheckError, Checked};

/// Most errors that are kept.
const MOST_ERRORS: usize = 100;

/// A list of errors, all seen from the same object of the dataset.
#[derive(Debug, Default)]
pub(super) struct Errors(Vec<CheckError>);

impl Errors {
    /// Keeps the error, if there is one. True if there is none.
    pub(super) fn add(&mut self, checked: Checked) -> bool {
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
        check: impl Fn(usize, &T) -> Checked,
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
