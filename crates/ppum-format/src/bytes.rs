//! Datasets as the bytes of an HDF5 file.

use ppum::dataset::{Dataset, Step};

use crate::content::{Content, step_path};
use crate::error::{ReadError, WriteError};
use crate::hdf5::{Ranges, Trunk};
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
    if dataset.steps.len() > 1 {
        return series(dataset);
    }
    let mut content = encode::content(dataset)?;
    checksum::seal(&mut content);
    hdf5::to_bytes(&content)
}

/// A series with the first step of a dataset, to which the others can be appended.
pub(crate) fn begun(dataset: &Dataset) -> Result<Vec<u8>, WriteError> {
    let mut content = encode::beginning(dataset, 1)?;
    checksum::seal_parts(&mut content);
    hdf5::to_bytes(&content)
}

/// The same bytes as if the steps after the first one had been appended one by one.
fn series(dataset: &Dataset) -> Result<Vec<u8>, WriteError> {
    let mut bytes = begun(dataset)?;
    let mut trunk = Trunk::read(&bytes).expect("this program made it");
    for (number, step) in dataset.steps.iter().enumerate().skip(1) {
        let (step, grown) = appended(&trunk, number, step)?;
        bytes.extend(step.bytes);
        bytes[..step.start.len()].copy_from_slice(&step.start);
        trunk = grown;
    }
    Ok(bytes)
}

/// What makes a step part of a file, and the trunk of the file that has it.
pub(crate) fn appended(
    trunk: &Trunk,
    number: usize,
    step: &Step,
) -> Result<(hdf5::Step, Trunk), WriteError> {
    let mut content = encode::one_step(number, step)?;
    hdf5::check_texts(&content)?;
    let path = step_path(number);
    checksum::seal_step(&mut content, &path);
    trunk.step(&content, &path)
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
    let content = hdf5::from_bytes(&bytes)?;
    drop(bytes);
    checked(&content)
}

/// The dataset in a file of so many bytes.
pub(crate) fn from_file(file: &dyn Ranges, length: u64) -> Result<Dataset, ReadError> {
    let read = hdf5::from_file(file, length).and_then(|content| checked(&content));
    read.map_err(ReadError::shortened)
}

/// The dataset of a content. Its checksums are compared while it is made.
pub(crate) fn checked(content: &Content) -> Result<Dataset, ReadError> {
    let minor = decode::check_version(content)?;
    let dataset = || {
        let dataset = decode::dataset(content)?;
        dataset.check()?;
        Ok(dataset)
    };
    let (verified, dataset) = rayon::join(|| checksum::verify(content), dataset);
    verified?;
    dataset.map_err(|error| newer(error, minor))
}

/// The same error with the version of the file, if that is later than this program.
pub(crate) fn newer(error: ReadError, minor: u32) -> ReadError {
    let source = Box::new(error);
    if minor > FORMAT_VERSION.1 { ReadError::Newer { minor, source } } else { *source }
}
