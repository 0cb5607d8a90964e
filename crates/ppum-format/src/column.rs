//! Arrays of a group, each with how it is written and read: the one place of its name.

use crate::content::ObjectKind;
use crate::reader::{GroupReader, most};
use crate::writer::{EncodeResult, GroupWriter};

/// An array of what a group holds, `S`: a slice of rows, or a struct of vectors.
#[derive(Clone, Copy)]
pub(crate) struct ArrayColumn<S: ?Sized> {
    pub(crate) names: ColumnNames,
    /// Where it says nothing it is not written.
    pub(crate) is_optional: bool,
    /// True if its length is the number of rows.
    pub(crate) counts: bool,
    pub(crate) is_used: fn(&S) -> bool,
    pub(crate) put: fn(&S, &mut GroupWriter, &str) -> EncodeResult,
    pub(crate) take: fn(&mut S, &GroupReader, &str, usize),
}

/// The names of an array.
#[derive(Clone, Copy)]
pub(crate) struct ColumnNames {
    /// Its name in the file.
    pub(crate) array: &'static str,
    /// Its name in the data model, with those of the structs that it is in.
    pub(crate) field: &'static str,
    /// The array with the offsets of each row's part of it.
    pub(crate) offsets: Option<&'static str>,
}

/// The arrays of a group.
pub(crate) type TableColumns<R> = [ArrayColumn<[R]>];

impl<S: ?Sized> ArrayColumn<S> {
    /// An array that is always written, by functions of its own.
    pub(crate) const fn new(
        array: &'static str,
        put: fn(&S, &mut GroupWriter, &str) -> EncodeResult,
        take: fn(&mut S, &GroupReader, &str, usize),
    ) -> Self {
        let names = ColumnNames { array, field: array, offsets: None };
        Self { names, is_optional: false, counts: false, is_used: |_| true, put, take }
    }

    /// The array, not written where it says nothing.
    pub(crate) const fn optional(self) -> Self {
        Self { is_optional: true, ..self }
    }
}

impl GroupReader<'_> {
    /// The number of rows that most of these arrays say that there are.
    pub(crate) fn count<S: ?Sized>(&self, columns: &[ArrayColumn<S>]) -> usize {
        let count = |column: &ArrayColumn<S>| match column.names.offsets {
            Some(offsets) => self.row_count(offsets)?.checked_sub(1),
            None => self.row_count(column.names.array).filter(|_| column.counts),
        };
        most(columns.iter().filter(|column| !column.is_optional).filter_map(count).collect())
    }

    /// The rows of a table.
    pub(crate) fn table<R: Clone + Default>(&self, columns: &TableColumns<R>) -> Vec<R> {
        let mut rows = vec![R::default(); self.count(columns)];
        self.take(columns, rows.len(), rows.as_mut_slice());
        rows
    }

    /// Puts arrays for so many rows into a value.
    pub(crate) fn take<S: ?Sized>(&self, columns: &[ArrayColumn<S>], rows: usize, value: &mut S) {
        for column in columns {
            let ColumnNames { array, offsets, .. } = column.names;
            let mut names = [Some(array), offsets].into_iter().flatten();
            if !column.is_optional || names.any(|name| self.holds(name, ObjectKind::Dataset)) {
                (column.take)(value, self, array, rows);
            }
        }
    }
}

impl GroupWriter<'_> {
    /// The arrays of a value.
    pub(crate) fn columns<S: ?Sized>(
        &mut self,
        columns: &[ArrayColumn<S>],
        value: &S,
    ) -> EncodeResult {
        let mut used =
            columns.iter().filter(|column| !column.is_optional || (column.is_used)(value));
        used.try_for_each(|column| (column.put)(value, self, column.names.array))
    }

    /// Nothing where there are no rows.
    pub(crate) fn table_of_some<R>(
        &mut self,
        columns: &[ArrayColumn<[R]>],
        rows: &[R],
    ) -> EncodeResult {
        if rows.is_empty() { Ok(()) } else { self.columns(columns, rows) }
    }
}

/// The columns of a table: `cell`, `list`, `matrix` or `custom` for each.
macro_rules! table {
    ($row:ty: $($kind:ident($($arguments:tt)*)$(.$optional:ident())?),* $(,)?) => {
        &[$($crate::column::$kind!($row, $($arguments)*)$(.$optional())?),*]
    };
}

macro_rules! custom {
    ($row:ty, $column:ident) => {
        $column
    };
}

/// An entry for each row.
macro_rules! cell {
    ($row:ty, $name:literal, $($field:ident).+) => {
        $crate::column::ArrayColumn::<[$row]> {
            names: $crate::column::ColumnNames {
                array: $name,
                field: stringify!($($field).+),
                offsets: None,
            },
            counts: true,
            is_used: |rows| {
                let none = <$row>::default();
                rows.iter().any(|row| row.$($field).+ != none.$($field).+)
            },
            ..$crate::column::ArrayColumn::new(
                $name,
                |rows, group, name| group.put(name, rows.iter().map(|row| &row.$($field).+)),
                |rows, group, name, n| {
                    let values = rows.iter_mut().zip(group.rows(name, n));
                    values.for_each(|(row, value)| row.$($field).+ = value);
                },
            )
        }
    };
}

/// A list for each row, a part of an array.
macro_rules! list {
    ($row:ty, $name:literal, $offsets:literal, $($field:ident).+) => {
        $crate::column::ArrayColumn::<[$row]> {
            names: $crate::column::ColumnNames {
                array: $name,
                field: stringify!($($field).+),
                offsets: Some($offsets),
            },
            is_used: |rows| rows.iter().any(|row| !row.$($field).+.is_empty()),
            ..$crate::column::ArrayColumn::new(
                $name,
                |rows, group, name| {
                    group.put_offsets($offsets, rows.iter().map(|row| row.$($field).+.len()));
                    group.put(name, rows.iter().flat_map(|row| &row.$($field).+))
                },
                |rows, group, name, n| {
                    let parts = group.parts($offsets, n, (name, &group.list(name)));
                    rows.iter_mut().zip(parts).for_each(|(row, part)| row.$($field).+ = part);
                },
            )
        }
    };
}

/// Numbers for each row, a row of a matrix.
macro_rules! matrix {
    ($row:ty, $name:literal, $field:ident) => {
        $crate::column::ArrayColumn::<[$row]> {
            counts: true,
            ..$crate::column::ArrayColumn::new(
                $name,
                |rows, group, name| group.put_matrix(name, rows.iter().map(|row| &row.$field)),
                |rows, group, name, n| {
                    let values = rows.iter_mut().zip(group.matrix(name, n));
                    values.for_each(|(row, value)| row.$field = value);
                },
            )
        }
    };
}

/// A vector of a struct, with as many entries as there are rows.
macro_rules! vector {
    ($struct:ty, $field:ident) => {
        $crate::column::ArrayColumn::<$struct> {
            counts: true,
            is_used: |data| !data.$field.is_empty(),
            ..$crate::column::ArrayColumn::new(
                stringify!($field),
                |data, group, name| group.put(name, &data.$field),
                |data, group, name, n| data.$field = group.rows(name, n),
            )
        }
    };
}

/// A vector of a struct, of any length.
macro_rules! any_vector {
    ($struct:ty, $field:ident) => {
        $crate::column::ArrayColumn::<$struct>::new(
            stringify!($field),
            |data, group, name| group.put(name, &data.$field),
            |data, group, name, _| data.$field = group.list(name),
        )
    };
}

pub(crate) use {any_vector, cell, custom, list, matrix, table, vector};
