//! Named arrays: those of a dataset, by the names that files have for them, and of other formats.

use ppum::dataset::Dataset;

use crate::bytes::{all_errors, checked};
use crate::content::{Array, ArrayValues, ObjectTree};
use crate::error::{ReadError, WriteError};
use crate::limits::FORMAT_VERSION;
use crate::{checksum, encode, hdf5};

/// Named arrays and attributes, as `FORMAT.md` names them, or those of an HDF5 file of another
/// format.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arrays(ObjectTree);

impl Arrays {
    /// Those of a dataset, which need not obey the rules, without a checksum.
    ///
    /// # Errors
    /// [`WriteError::Object`]: something that the format cannot express.
    pub fn of(dataset: &Dataset) -> Result<Self, WriteError> {
        encode::content(dataset).map(Self)
    }

    /// Those in the bytes of an HDF5 file.
    ///
    /// # Errors
    /// [`ReadError::Hdf5`] or [`ReadError::Object`]: it cannot be read.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, ReadError> {
        hdf5::from_bytes(bytes).map(Self)
    }

    /// Adds an array (`steps/0000/partition/center`) or an attribute (`steps/0000@load`, `@title`),
    /// row-major, of shape `[]` if it is a scalar, and the groups that it is in. One of this path
    /// is replaced.
    pub fn insert(&mut self, path: &str, shape: impl Into<Vec<u64>>, values: ArrayValues) {
        self.0.insert(path.to_owned(), Array { shape: shape.into(), values });
    }

    /// All paths, shapes and values, in the order of paths.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &[u64], &ArrayValues)> {
        self.0.iter().map(|(path, array)| (path.as_str(), array.shape.as_slice(), &array.values))
    }

    /// Adds the checksums that a file of this program has, or makes them right: over all, or with
    /// several steps one for each and one for the rest.
    pub fn seal(&mut self) {
        let second = self.0.has_group("steps/0001");
        if second { checksum::seal_parts(&mut self.0) } else { checksum::seal(&mut self.0) }
    }

    /// The bytes of an HDF5 file. Long arrays that shrink are compressed.
    ///
    /// # Errors
    /// [`WriteError::Object`]: a text with NUL or U+FFFD, or a type that is not stored;
    /// [`WriteError::Hdf5`]: a name of more than 65,000 bytes.
    pub fn to_bytes(&self) -> Result<Vec<u8>, WriteError> {
        hdf5::to_compressed_bytes(&self.0)
    }

    /// The dataset, of this version of the format unless they name another one; it has passed
    /// [`Dataset::check`].
    ///
    /// # Errors
    ///
    /// All that is wrong, each with the path of the array at fault.
    pub fn dataset(mut self) -> Result<Dataset, Vec<ReadError>> {
        let version = Array::vector(<[u32; 2]>::from(FORMAT_VERSION));
        let format = ("@format", Array::scalar("ppum".to_owned()));
        for (name, array) in [format, ("@format_version", version)] {
            self.0.entry(name.to_owned()).or_insert(array);
        }
        checked(&self.0).map_err(|_| all_errors(Ok(self.0)))
    }
}

#[cfg(test)]
mod tests {
    use ppum::dataset::Equation;

    use super::*;
    use crate::everything;

    /// The arrays of a dataset without an equation, whose field has any name and any components.
    fn arrays() -> (Dataset, Arrays) {
        let mut data = everything::dataset(2);
        data.equation = Equation::None;
        data.steps.truncate(1);
        data.steps[0].reactions.clear();
        data.steps[0].fields[0].name = "velocity".into();
        let arrays = Arrays::of(&data).expect("valid");
        (data, arrays)
    }

    #[test]
    fn the_arrays_of_a_dataset_make_it() {
        let (data, arrays) = arrays();
        // bytes: a dataset with a number that is none does not equal itself
        let bytes = crate::to_bytes(&data).expect("valid");
        let made = arrays.dataset().expect("the same arrays");
        assert!(crate::to_bytes(&made).expect("valid") == bytes, "of arrays");
        let read = crate::from_bytes(bytes.clone()).expect("what was written");
        assert!(crate::to_bytes(&read).expect("valid") == bytes, "of a file");
    }

    #[test]
    fn all_errors_have_paths() {
        let (_, mut arrays) = arrays();
        arrays.insert("steps/0000/partition/level", vec![1], ArrayValues::U8(vec![0]));
        arrays.insert("steps/0000/fields/0000/block_degree", vec![1], ArrayValues::I64(vec![0]));
        arrays.insert("equation@young", vec![], ArrayValues::F64(vec![1.0]));
        let errors = arrays.dataset().expect_err("three errors");
        let places: Vec<_> = errors.iter().filter_map(ReadError::place).collect();
        for path in ["equation@young", "partition/level", "block_degree"] {
            assert!(places.iter().any(|place| place.ends_with(path)), "{path}: {errors:?}");
        }
    }

    /// Formulas may name arrays, however long they are.
    #[test]
    fn names_of_any_length_are_read_again() {
        for length in [1, 255, 256, 300, 60_000] {
            let mut file = Arrays::default();
            for name in ["x".repeat(length), "ü".repeat(length / 2 + 1)] {
                file.insert(&format!("group/{name}"), vec![2], ArrayValues::F64(vec![1.0, 2.0]));
            }
            let bytes = file.to_bytes().expect("a file");
            assert_eq!(Arrays::from_bytes(&bytes).expect("readable"), file, "{length}");
        }
        let mut file = Arrays::default();
        file.insert(&"x".repeat(66_000), vec![1], ArrayValues::U8(vec![1]));
        assert!(matches!(file.to_bytes(), Err(WriteError::Hdf5 { .. })));
    }
}
