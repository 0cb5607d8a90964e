//! Datasets as files.

use std::fs::File;
use std::io::{self, Read as _, Seek as _};
use std::path::Path;

use ppum::dataset::Dataset;

use crate::bytes::{from_bytes, to_bytes};
use crate::error::{ReadError, WriteError};
use crate::limits::MAX_LENGTH;

/// Reads a dataset from a regular file of at most [`MAX_LENGTH`] bytes.
///
/// # Errors
///
/// [`ReadError`]; the dataset returned has passed [`Dataset::check`].
pub fn read(path: &Path) -> Result<Dataset, ReadError> {
    from_bytes(bytes(path).map_err(|e| ReadError::io(path, e))?)
}

/// Signature at the start of an HDF5 file, or after a block of 512, 1024 or 2048 bytes of the user's.
const SIGNATURE: &[u8] = b"\x89HDF\r\n\x1a\n";
const PLACES: [usize; 4] = [0, 512, 1024, 2048];

/// The bytes of a file; of one that is no HDF5 file, the first.
fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    let mut file = ppum_file::open(path, MAX_LENGTH)?;
    let head = head(&file)?;
    let begins = |&at: &usize| head.get(at..).is_some_and(|rest| rest.starts_with(SIGNATURE));
    if !PLACES.iter().any(begins) {
        return Ok(head);
    }
    file.rewind()?;
    ppum_file::within(file, MAX_LENGTH)
}

/// As many bytes from the beginning as may hold the signature.
fn head(file: &File) -> io::Result<Vec<u8>> {
    let mut head = Vec::new();
    file.take((PLACES[3] + SIGNATURE.len()) as u64).read_to_end(&mut head)?;
    Ok(head)
}

/// Writes a dataset to a file, completely or not at all, as [`ppum_file::replace`] does.
///
/// # Errors
///
/// [`WriteError`], and then whatever stood at `path` still stands there unchanged. A file without
/// write permission, a folder or a device is not replaced, and no file is longer than [`MAX_LENGTH`].
pub fn write(dataset: &Dataset, path: &Path) -> Result<(), WriteError> {
    let bytes = to_bytes(dataset)?;
    if bytes.len() as u64 > MAX_LENGTH {
        return Err(WriteError::TooLong { length: bytes.len() as u64, most: MAX_LENGTH });
    }
    let written: io::Result<()> = ppum_file::replace(path, |out| out.write_all(&bytes));
    written.map_err(|source| WriteError::Io { path: path.to_owned(), source })
}
