//! Datasets as the bytes of an HDF5 file.

use ppum::dataset::Dataset;

use crate::content::Content;
use crate::error::{ReadError, WriteError};
use crate::limits::FORMAT_VERSION;
use crate::{checksum, decode, encode, hdf5};

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

pub(crate) fn checked(content: Content) -> Result<Dataset, ReadError> {
    let dataset = decode::dataset(content)?;
    dataset.check()?;
    Ok(dataset)
}
