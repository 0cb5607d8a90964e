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
    /// [`WriteError::Object`]: a text with NUL or U+FFFD, or a type that is not stored;
    /// [`WriteError::Hdf5`]: a name of more than 65,000 bytes.
    pub fn to_bytes(&self) -> Result<Vec<u8>, WriteError> {
        hdf5::to_compressed_bytes(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Formulas may name arrays, however long they are.
    #[test]
    fn names_of_any_length_are_read_again() {
        for length in [1, 255, 256, 300, 60_000] {
            let mut file = Hdf5File::default();
            for name in ["x".repeat(length), "ü".repeat(length / 2 + 1)] {
                file.insert(&format!("group/{name}"), &[2], ArrayValues::F64(vec![1.0, 2.0]));
            }
            let bytes = file.to_bytes().expect("a file");
            assert_eq!(hdf5::from_bytes(&bytes).expect("readable"), file.0, "{length}");
        }
        let mut file = Hdf5File::default();
        file.insert(&"x".repeat(66_000), &[1], ArrayValues::U8(vec![1]));
        assert!(matches!(file.to_bytes(), Err(WriteError::Hdf5 { .. })));
    }
}
