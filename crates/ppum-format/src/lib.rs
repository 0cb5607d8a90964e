//! [`Dataset`] ↔ HDF5, as `FORMAT.md` describes it.
//!
//! [`write()`] and [`read`] work on files, [`to_bytes`] and [`from_bytes`] in memory (also where there
//! is no file system). Between a dataset and HDF5 stands the content: a sorted map from the names of
//! arrays and attributes to their values. Names and shapes meet the data model in `encode` and
//! `decode`, HDF5 is known to `hdf5` alone, and the checksum is taken over the content, so it does
//! not depend on how HDF5 lays out its bytes.
//!
//! Files are not trusted: whatever their bytes are, reading ends in a checked [`Dataset`] or in a
//! [`ReadError`] that names the object at fault, and what is allocated is bounded by the file's size.
//!
//! ```
//! use ppum::prelude::*;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let domain = Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0));
//! let partition = Cover::uniform(domain, 1)?.partition(1.3, WeightFunction::Linear)?;
//! let mut potential = FieldData::new("potential", &["u"]);
//! (0..partition.len()).for_each(|_| potential.push_patch(&[(0, 2)]));
//! let step = Step::new(partition).with_function("one", FunctionKind::One).with_field(potential);
//! let dataset = Dataset::new(domain, Equation::poisson(1.0)).with_step(step);
//!
//! let bytes = ppum_format::to_bytes(&dataset)?;
//! assert_eq!(ppum_format::from_bytes(bytes.clone())?, dataset);
//!
//! let half = bytes[..bytes.len() / 2].to_vec();
//! let error = ppum_format::from_bytes(half).unwrap_err();
//! assert!(matches!(error, ppum_format::ReadError::Hdf5 { .. }));
//! # Ok(())
//! # }
//! ```

mod checksum;
mod content;
#[cfg(feature = "damage")]
pub mod damage;
mod decode;
mod encode;
mod error;
#[cfg(test)]
#[path = "../examples/fixture/everything.rs"]
mod everything;
mod file;
mod hdf5;
mod names;

use ppum::dataset::Dataset;

pub use error::{ReadError, WriteError};
pub use file::{MAX_LENGTH, read, write};

/// Version of the format as (major, minor). A reader takes every minor version of its own major
/// version; what it does not know is optional.
pub const FORMAT_VERSION: (u32, u32) = (1, 2);

/// Most values that the tables of a file may have together. In memory a value of a table takes 16
/// numbers more, those of its spline, so a small file could ask for more than there is.
const MAX_TABLE_VALUES: usize = 1 << 20;

/// The dataset as the bytes of an HDF5 file.
///
/// # Errors
///
/// [`WriteError::Invalid`] if the dataset fails [`Dataset::check`], [`WriteError::Object`] if it
/// holds something the format cannot express.
pub fn to_bytes(dataset: &Dataset) -> Result<Vec<u8>, WriteError> {
    dataset.check()?;
    let mut content = encode::content(dataset)?;
    checksum::seal(&mut content);
    hdf5::to_bytes(&content)
}

/// Makes sure that a dataset can be written and read again, before it is.
///
/// # Errors
///
/// As [`to_bytes`].
pub fn check(dataset: &Dataset) -> Result<(), WriteError> {
    dataset.check()?;
    hdf5::check_texts(&encode::content(dataset)?)
}

/// The dataset in the bytes of an HDF5 file.
///
/// # Errors
///
/// [`ReadError`]; the dataset returned has passed [`Dataset::check`].
pub fn from_bytes(bytes: Vec<u8>) -> Result<Dataset, ReadError> {
    decoded(bytes).map_err(ReadError::shortened)
}

fn decoded(bytes: Vec<u8>) -> Result<Dataset, ReadError> {
    let mut content = hdf5::from_bytes(&bytes)?;
    let minor = decode::check_version(&content)?;
    checksum::verify(&mut content)?;
    checked(content).map_err(|error| {
        let source = Box::new(error);
        if minor > FORMAT_VERSION.1 { ReadError::Newer { minor, source } } else { *source }
    })
}

fn checked(content: content::Content) -> Result<Dataset, ReadError> {
    let dataset = decode::dataset(content)?;
    dataset.check()?;
    Ok(dataset)
}
