//! Datasets as files.

use std::io;
use std::path::Path;

use ppum::dataset::Dataset;
use ppum_file::RangedFile;

use crate::bytes::{all_errors, checked, to_bytes};
use crate::content::ObjectTree;
use crate::error::{ReadError, WriteError};
use crate::hdf5;
use crate::limits::MAX_LENGTH;

/// Reads a dataset from a regular file of at most [`MAX_LENGTH`] bytes.
///
/// # Errors
///
/// [`ReadError`]; the dataset returned has passed [`Dataset::check`].
pub fn read(path: &Path) -> Result<Dataset, ReadError> {
    content(path).and_then(|content| checked(&content))
}

/// All arrays and attributes of a file.
fn content(path: &Path) -> Result<ObjectTree, ReadError> {
    let io = |error| ReadError::io(path, error);
    let file = RangedFile::open(path, MAX_LENGTH).map_err(io)?;
    hdf5::from_file(&file, file.length(MAX_LENGTH).map_err(io)?)
}

/// All that is wrong with the dataset in a file, nothing if [`read`] would return it.
#[must_use]
pub fn diagnose(path: &Path) -> Vec<ReadError> {
    all_errors(content(path))
}

/// Writes a dataset to a file, completely or not at all, as [`ppum_file::replace`] does.
///
/// # Errors
///
/// [`WriteError`], and then whatever stood at `path` still stands there unchanged. A file without
/// write permission, a folder or a device is not replaced, and no file is longer
/// than [`MAX_LENGTH`].
pub fn write(dataset: &Dataset, path: &Path) -> Result<(), WriteError> {
    let bytes = to_bytes(dataset)?;
    if bytes.len() as u64 > MAX_LENGTH {
        return Err(WriteError::TooLong { length: bytes.len() as u64, most: MAX_LENGTH });
    }
    let written: io::Result<()> = ppum_file::replace(path, |out| out.write_all(&bytes));
    written.map_err(|source| WriteError::Io { path: path.to_owned(), source })
}
