//! Datasets from arrays in memory, by the names that files have for them.

use ppum::dataset::Dataset;

use crate::bytes::{all_errors, checked};
use crate::content::{Array, ArrayValues, Content};
use crate::error::ReadError;
use crate::limits::FORMAT_VERSION;

/// Arrays and attributes by their paths, as `FORMAT.md` names them.
#[derive(Debug)]
pub struct Arrays(Content);

impl Default for Arrays {
    fn default() -> Self {
        let (major, minor) = FORMAT_VERSION;
        let mut content = Content::new();
        content.insert("@format".into(), Array::scalar("ppum".to_owned()));
        content.insert("@format_version".into(), Array::vector([major, minor]));
        Self(content)
    }
}

impl Arrays {
    /// Adds an array (`steps/0000/partition/center`) or an attribute (`steps/0000@load`, `@title`),
    /// row-major, of shape `[]` if it is a scalar.
    pub fn insert(&mut self, path: &str, shape: Vec<u64>, values: ArrayValues) {
        self.0.insert(path.to_owned(), Array { shape, values });
    }

    /// The dataset; it has passed [`Dataset::check`].
    ///
    /// # Errors
    ///
    /// All that is wrong, each with the path of the array at fault.
    pub fn dataset(self) -> Result<Dataset, Vec<ReadError>> {
        checked(&self.0).map_err(|_| all_errors(Ok(self.0)))
    }
}

#[cfg(test)]
mod tests {
    use ppum::dataset::Equation;

    use super::*;
    use crate::{encode, everything};

    /// The arrays of a dataset without an equation, whose field has any name and any components.
    fn arrays() -> (Dataset, Arrays) {
        let mut data = everything::dataset(2);
        data.equation = Equation::None;
        data.steps.truncate(1);
        data.steps[0].reactions.clear();
        data.steps[0].fields[0].name = "velocity".into();
        let mut arrays = Arrays::default();
        for (path, array) in encode::content(&data).expect("valid").iter() {
            arrays.insert(path, array.shape.clone(), array.values.clone());
        }
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
}
