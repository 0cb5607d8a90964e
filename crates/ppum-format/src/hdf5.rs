//! Content ↔ the bytes of an HDF5 file. Nothing outside this module knows HDF5.
//!
//! Files are written by a library (hdf5-pure, all of it safe Rust), steps are appended and files
//! read by the code here: what other programs write has more forms than the library reads
//! (docs/decisions/0007-hdf5.md), and it appends no more links to a group than a header holds
//! (docs/decisions/0021-series.md). A small file can also ask for much: the same object under many
//! names, one text referred to a million times, a few kilobytes that inflate to gigabytes. So
//! [`account`] limits the bytes that may be read and expanded and the memory that what is read may
//! take, each in proportion to the length of the file, and [`read`] pays before it acts.

mod account;
mod append;
mod lookup3;
mod messages;
mod objects;
mod read;
mod values;
mod write;

pub(crate) use append::{AppendedStep, Trunk};
#[cfg(feature = "damage")]
pub(crate) use lookup3::lookup3;
pub(crate) use read::{Outline, Ranges, from_bytes, from_file};
#[cfg(feature = "damage")]
pub(crate) use write::to_compressed_bytes;
pub(crate) use write::{check_texts, to_bytes};
