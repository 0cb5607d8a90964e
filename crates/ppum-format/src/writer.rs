//! A place in the content that is written: arrays are put into it by name.

use crate::content::{Array, ElementType as _, ObjectTree, join};
use crate::error::WriteError;
use crate::stored::StoredValue;

pub(crate) type EncodeResult = Result<(), WriteError>;

/// Puts arrays into a group of the file.
pub(crate) struct GroupWriter<'a> {
    pub(crate) path: String,
    pub(crate) content: &'a mut ObjectTree,
}

impl GroupWriter<'_> {
    pub(crate) fn group(&mut self, name: &str) -> GroupWriter<'_> {
        GroupWriter { path: self.path_of(name), content: self.content }
    }

    pub(crate) fn path_of(&self, name: &str) -> String {
        join(&self.path, name)
    }

    pub(crate) fn array(&mut self, name: &str, array: Array) {
        self.content.insert(self.path_of(name), array);
    }

    pub(crate) fn attribute<T: StoredValue>(&mut self, name: &str, value: &T) -> EncodeResult {
        let mut elements = Vec::new();
        let name = format!("@{name}");
        value.store(&mut elements).ok_or_else(|| self.unknown(&name))?;
        self.array(&name, Array { shape: T::SHAPE.to_vec(), values: T::Element::wrap(elements) });
        Ok(())
    }

    /// Values, one in a row.
    pub(crate) fn values<'v, T: StoredValue + 'v>(
        &mut self,
        name: &str,
        values: impl IntoIterator<Item = &'v T>,
    ) -> EncodeResult {
        let mut elements = Vec::new();
        for value in values {
            value.store(&mut elements).ok_or_else(|| self.unknown(name))?;
        }
        let shape = [&[(elements.len() / T::width()) as u64], T::SHAPE].concat();
        self.array(name, Array { shape, values: T::Element::wrap(elements) });
        Ok(())
    }

    /// Compressed rows: where each part starts, and where the last one ends.
    pub(crate) fn put_offsets(&mut self, name: &str, lengths: impl Iterator<Item = usize>) {
        let ends = lengths.scan(0, |end, n| {
            *end += n as u64;
            Some(*end)
        });
        self.array(name, Array::vector(std::iter::once(0).chain(ends)));
    }

    /// Rows of one length.
    pub(crate) fn put_matrix<R: AsRef<[f64]>>(
        &mut self,
        name: &str,
        rows: impl Iterator<Item = R>,
    ) -> EncodeResult {
        let rows: Vec<R> = rows.collect();
        let columns = rows.first().map_or(0, |row| row.as_ref().len());
        self.array(name, Array::matrix(&rows, columns));
        Ok(())
    }

    pub(crate) fn unknown(&self, name: &str) -> WriteError {
        WriteError::object(&self.path_of(name), "this kind has no word in the file format")
    }
}
