//! Content ↔ the bytes of an HDF5 file. Nothing outside this module knows the HDF5 library.
//!
//! The library (hdf5-pure, all of it safe Rust) checks what it parses, but not what a small file can make of
//! it: the same object under many names, one text referred to a million times, a few kilobytes that
//! inflate to gigabytes. So [`account`] limits the bytes that it may read and the memory that what it
//! returns may take, both in proportion to the length of the file.

mod account;
mod links;
mod read;
mod write;

pub(crate) use read::from_bytes;
pub(crate) use write::{check_texts, to_bytes, to_compressed_bytes};
