//! HDF5 files of other formats.

use crate::content::{Array, ArrayValues, Content};
use crate::error::WriteError;
use crate::hdf5;

/// Named arrays and attributes that are written as an HDF5 file, for formats of other programs.
#[derive(Clone, Debug, Default)]
pub struct Hdf5File(Content);

impl Hdf5File {
    /// Adds an array, row-major, and the groups that it is in: `group/name`, and with `@` before
    /// the last name an attribute of a group, `group@name`. One of this name is replaced.
    pub fn insert(&mut self, name: &str, shape: &[u64], values: ArrayValues) {
        self.0.insert(name.to_owned(), Array { shape: shape.to_vec(), values });
    }

    /// The bytes of the file. Long arrays that shrink are compressed.
    ///
    /// # Errors
    /// [`WriteError::Object`]: a text with NUL or U+FFFD, or a type that is not stored.
    pub fn to_bytes(&self) -> Result<Vec<u8>, WriteError> {
        hdf5::to_compressed_bytes(&self.0)
    }
}
