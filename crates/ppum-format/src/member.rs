//! Members of groups: attributes, arrays and groups, each with how it is written and read. This is
//! the one place of its name.

use crate::content::ObjectKind;
use crate::reader::{GroupReader, most};
use crate::writer::{EncodeResult, GroupWriter};

/// A member of the group that holds an `S`: a struct, or the slice of a table's rows.
#[derive(Clone, Copy)]
pub(crate) struct Member<S: ?Sized> {
    pub(crate) names: MemberNames,
    /// It may be missing; where it says nothing it is not written.
    pub(crate) is_optional: bool,
    /// True if its length is the number of rows.
    pub(crate) counts: bool,
    pub(crate) is_used: fn(&S) -> bool,
    pub(crate) put: MemberEncoder<S>,
    pub(crate) take: MemberDecoder<S>,
}

/// Writes a member of a value under its name.
type MemberEncoder<S> = fn(&S, &mut GroupWriter, &str) -> EncodeResult;

/// Reads a member of this name into a value that has so many rows.
type MemberDecoder<S> = fn(&mut S, &GroupReader, &str, usize);

/// The names of a member, and of what is in it.
#[derive(Clone, Copy)]
pub(crate) struct MemberNames {
    /// Its name in the file.
    pub(crate) stored: &'static str,
    pub(crate) kind: ObjectKind,
    /// Its name in the data model, with those of the structs that it is in.
    pub(crate) field: &'static str,
    /// The array with the offsets of each row's part of it.
    pub(crate) offsets: Option<&'static str>,
    /// The members of a group.
    pub(crate) members: fn() -> Vec<MemberNames>,
    pub(crate) shape: GroupShape,
}

/// The contents of a group.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum GroupShape {
    /// Members.
    Single,
    /// Groups with these members, `0000`, `0001`, …
    Numbered,
    /// Arrays with an entry for each row.
    Table,
}

/// The members of a table.
pub(crate) type TableMembers<R> = [Member<[R]>];

/// The names of all members of a group.
pub(crate) fn names_of<S: ?Sized>(members: &[Member<S>]) -> Vec<MemberNames> {
    members.iter().map(|member| member.names).collect()
}

impl MemberNames {
    /// A member that has one name in the file and in the data model.
    pub(crate) const fn new(name: &'static str, kind: ObjectKind) -> Self {
        let (members, shape): (fn() -> _, _) = (Vec::new, GroupShape::Single);
        Self { stored: name, kind, field: name, offsets: None, members, shape }
    }
}

impl<S: ?Sized> Member<S> {
    const fn new(names: MemberNames, put: MemberEncoder<S>, take: MemberDecoder<S>) -> Self {
        Self { names, is_optional: false, counts: false, is_used: |_| true, put, take }
    }

    /// An array that is always written, by functions of its own.
    pub(crate) const fn array(
        name: &'static str,
        put: MemberEncoder<S>,
        take: MemberDecoder<S>,
    ) -> Self {
        Self::new(MemberNames::new(name, ObjectKind::Dataset), put, take)
    }

    /// An attribute, as [`array`](Self::array).
    pub(crate) const fn attribute(
        name: &'static str,
        put: MemberEncoder<S>,
        take: MemberDecoder<S>,
    ) -> Self {
        Self::new(MemberNames::new(name, ObjectKind::Attribute), put, take)
    }

    /// A group that holds these members, as [`array`](Self::array).
    pub(crate) const fn group(
        name: &'static str,
        (shape, members): (GroupShape, fn() -> Vec<MemberNames>),
        put: MemberEncoder<S>,
        take: MemberDecoder<S>,
    ) -> Self {
        let names = MemberNames::new(name, ObjectKind::Group);
        Self::new(MemberNames { members, shape, ..names }, put, take)
    }

    /// The member, not written where it says nothing.
    pub(crate) const fn optional(self) -> Self {
        Self { is_optional: true, ..self }
    }

    /// The member, always written, though it is missing in some files.
    pub(crate) const fn optional_to_read(self) -> Self {
        Self { is_optional: true, is_used: |_| true, ..self }
    }

    /// The list, of whose parts for each row this array has the offsets.
    pub(crate) const fn with_offsets(self, offsets: &'static str) -> Self {
        Self { names: MemberNames { offsets: Some(offsets), ..self.names }, ..self }
    }

    /// The member, whose name in the data model is another one.
    pub(crate) const fn of_field(self, field: &'static str) -> Self {
        Self { names: MemberNames { field, ..self.names }, ..self }
    }
}

impl GroupReader<'_> {
    /// The number of rows that most of these arrays say that there are.
    fn count<S: ?Sized>(&self, members: &[Member<S>]) -> usize {
        let count = |member: &Member<S>| match member.names.offsets {
            Some(offsets) => self.row_count(offsets)?.checked_sub(1),
            None => self.row_count(member.names.stored).filter(|_| member.counts),
        };
        most(members.iter().filter(|member| !member.is_optional).filter_map(count).collect())
    }

    /// The rows of a table.
    pub(crate) fn table<R: Clone + Default>(&self, members: &TableMembers<R>) -> Vec<R> {
        let mut rows = vec![R::default(); self.count(members)];
        self.take(members, rows.as_mut_slice());
        rows
    }

    /// Puts the members of this group into a value.
    pub(crate) fn take<S: ?Sized>(&self, members: &[Member<S>], value: &mut S) {
        let rows = self.count(members);
        members.iter().for_each(|member| self.take_one(member, rows, value));
    }

    /// A value with the members of this group.
    pub(crate) fn taken<S>(&self, members: &[Member<S>], mut value: S) -> S {
        self.take(members, &mut value);
        value
    }

    /// Puts a member into a value, one with so many rows if it is a table.
    pub(crate) fn take_one<S: ?Sized>(&self, member: &Member<S>, rows: usize, value: &mut S) {
        let MemberNames { stored, kind, offsets, .. } = member.names;
        let mut names = [Some(stored), offsets].into_iter().flatten();
        if !member.is_optional || names.any(|name| self.holds(name, kind)) {
            (member.take)(value, self, stored, rows);
        }
    }
}

impl GroupWriter<'_> {
    /// The members of a value.
    pub(crate) fn put<S: ?Sized>(&mut self, members: &[Member<S>], value: &S) -> EncodeResult {
        let mut used =
            members.iter().filter(|member| !member.is_optional || (member.is_used)(value));
        used.try_for_each(|member| (member.put)(value, self, member.names.stored))
    }
}

/// The members of a group of a type: `attribute`, `vector`, `cell`, … for each.
macro_rules! members {
    ($owner:ty: $($kind:ident($($arguments:tt)*)$(.$method:ident())*),* $(,)?) => {
        &[$($crate::member::$kind!($owner, $($arguments)*)$(.$method())*),*]
    };
}

macro_rules! custom {
    ($owner:ty, $member:expr) => {
        $member
    };
}

/// An attribute.
macro_rules! attribute {
    ($owner:ty, $name:literal, $($field:ident).+) => {
        $crate::member::Member::<$owner>::attribute(
            $name,
            |data, group, name| group.attribute(name, &data.$($field).+),
            |data, group, name, _| data.$($field).+ = group.attribute(name),
        )
    };
}

/// An attribute of what has a value, or none.
macro_rules! some_attribute {
    ($owner:ty, $name:literal, $field:ident) => {
        $crate::member::Member::<$owner> {
            is_optional: true,
            is_used: |data| data.$field.is_some(),
            ..$crate::member::Member::attribute(
                $name,
                |data, group, name| {
                    data.$field.iter().try_for_each(|value| group.attribute(name, value))
                },
                |data, group, name, _| data.$field = group.known_attribute(name),
            )
        }
    };
}

/// A group with a table.
macro_rules! rows {
    ($owner:ty, $name:literal, $field:ident, $members:expr) => {
        $crate::member::Member::<$owner> {
            is_used: |data| !data.$field.is_empty(),
            ..$crate::member::Member::group(
                $name,
                ($crate::member::GroupShape::Table, || $crate::member::names_of($members)),
                |data, group, name| group.group(name).put($members, &data.$field),
                |data, group, name, _| data.$field = group.group(name).table($members),
            )
        }
    };
}

/// An entry for each row.
macro_rules! cell {
    ($row:ty, $name:literal, $($field:ident).+) => {
        $crate::member::Member::<[$row]> {
            counts: true,
            is_used: |rows| {
                let none = <$row>::default();
                rows.iter().any(|row| row.$($field).+ != none.$($field).+)
            },
            ..$crate::member::Member::array(
                $name,
                |rows, group, name| group.values(name, rows.iter().map(|row| &row.$($field).+)),
                |rows, group, name, n| {
                    let values = rows.iter_mut().zip(group.rows(name, n));
                    values.for_each(|(row, value)| row.$($field).+ = value);
                },
            )
        }
        .of_field(stringify!($($field).+))
    };
}

/// A list for each row, a part of an array.
macro_rules! list {
    ($row:ty, $name:literal, $offsets:literal, $($field:ident).+) => {
        $crate::member::Member::<[$row]> {
            is_used: |rows| rows.iter().any(|row| !row.$($field).+.is_empty()),
            ..$crate::member::Member::array(
                $name,
                |rows, group, name| {
                    group.put_offsets($offsets, rows.iter().map(|row| row.$($field).+.len()));
                    group.values(name, rows.iter().flat_map(|row| &row.$($field).+))
                },
                |rows, group, name, n| {
                    let parts = group.parts($offsets, n, (name, &group.list(name)));
                    rows.iter_mut().zip(parts).for_each(|(row, part)| row.$($field).+ = part);
                },
            )
        }
        .of_field(stringify!($($field).+))
        .with_offsets($offsets)
    };
}

/// The bulges of the edges behind the points of each row, which are there if words of the rows say
/// that there are arcs.
macro_rules! bulges {
    ($row:ty, $words:literal) => {{
        const LIST: Member<[$row]> = $crate::member::list!($row, "bulges", "offsets", bulges);
        $crate::member::Member::<[$row]> {
            is_used: |rows| rows.iter().any(<$row>::is_curved),
            take: |rows, group, name, n| {
                if rows.iter().any(<$row>::is_curved) {
                    (LIST.take)(rows, group, name, n);
                } else if !group.is_wrong($words) {
                    let kind = $crate::content::ObjectKind::Dataset;
                    group.refuse(name, kind, concat!($words, "` without `curved-"));
                }
            },
            ..LIST
        }
        .optional()
    }};
}

/// Numbers for each row, a row of a matrix.
macro_rules! matrix {
    ($row:ty, $name:literal, $field:ident) => {
        $crate::member::Member::<[$row]> {
            counts: true,
            ..$crate::member::Member::array(
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
        $crate::member::Member::<$struct> {
            counts: true,
            take: |data, group, name, n| data.$field = group.rows(name, n),
            ..$crate::member::any_vector!($struct, $field)
        }
    };
}

/// A vector of a struct, of any length.
macro_rules! any_vector {
    ($struct:ty, $field:ident) => {
        $crate::member::Member::<$struct> {
            is_used: |data| !data.$field.is_empty(),
            ..$crate::member::Member::array(
                stringify!($field),
                |data, group, name| group.values(name, &data.$field),
                |data, group, name, _| data.$field = group.list(name),
            )
        }
    };
}

pub(crate) use {
    any_vector, attribute, bulges, cell, custom, list, matrix, members, rows, some_attribute,
    vector,
};
