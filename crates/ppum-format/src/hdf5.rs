//! Content ↔ the bytes of an HDF5 file. Nothing outside this module knows HDF5.
//!
//! All of it is code of our own: why is told in docs/decisions/0007-hdf5.md. A whole file is a
//! superblock and the group of the root, a step that is appended one more group.
//!
//! A small file can ask for much: the same object under many names, one text referred to a million
//! times, a few kilobytes that inflate to gigabytes. So [`budget`] limits the bytes that may be
//! read and expanded and the memory that what is read may take, each in proportion to the length of
//! the file, and [`read`] charges it before it acts.

mod append;
mod budget;
mod layout;
mod messages;
mod objects;
mod read;
mod values;
mod write;

pub(crate) use append::{AppendState, AppendedStep};
pub(crate) use read::{Outline, Ranges, from_bytes, from_file};
pub(crate) use write::{check_texts, to_bytes, to_compressed_bytes};
