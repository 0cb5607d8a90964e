//! Datasets as the bytes of an HDF5 file.

use std::collections::BTreeSet;

use ppum::check::CheckError;
use ppum::dataset::{Dataset, Step};

use crate::content::{ObjectTree, join, step_of, step_path};
use crate::error::{ReadError, WriteError, shortened};
use crate::hdf5::{AppendState, Ranges};
use crate::limits::FORMAT_VERSION;
use crate::place::in_file;
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

/// Returns the bytes that appending the steps one by one after the first would give.
fn series(dataset: &Dataset) -> Result<Vec<u8>, WriteError> {
    let mut bytes = begun(dataset)?;
    let mut state = AppendState::read(&bytes.as_slice()).expect("this program made it");
    for (number, step) in dataset.steps.iter().enumerate().skip(1) {
        let (step, grown) = appended(&state, number, step)?;
        bytes.extend(step.bytes);
        bytes[..step.start.len()].copy_from_slice(&step.start);
        state = grown;
    }
    Ok(bytes)
}

/// Returns the objects that make a step part of a file, and the state of the file that has it.
pub(crate) fn appended(
    state: &AppendState,
    number: usize,
    step: &Step,
) -> Result<(hdf5::AppendedStep, AppendState), WriteError> {
    let mut content = encode::one_step(number, step)?;
    hdf5::check_texts(&content)?;
    let path = step_path(number);
    checksum::seal_step(&mut content, &path);
    state.step(&content, &path)
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
    let content = hdf5::from_bytes(&bytes)?;
    drop(bytes);
    checked(&content)
}

/// All that is wrong with the dataset in the bytes of an HDF5 file, nothing if it is one.
#[must_use]
pub fn diagnose_bytes(bytes: &[u8]) -> Vec<ReadError> {
    all_errors(hdf5::from_bytes(bytes))
}

pub(crate) fn all_errors(content: Result<ObjectTree, ReadError>) -> Vec<ReadError> {
    content.map_or_else(|error| vec![error], |content| diagnose(&content))
}

/// The dataset in a file of so many bytes.
pub(crate) fn from_file(file: &dyn Ranges, length: u64) -> Result<Dataset, ReadError> {
    hdf5::from_file(file, length).and_then(|content| checked(&content))
}

/// The dataset of a content. Its checksums are compared while it is made.
pub(crate) fn checked(content: &ObjectTree) -> Result<Dataset, ReadError> {
    let minor = decode::check_version(content)?;
    let dataset = || {
        let dataset = decode::dataset(content)?;
        dataset.check().map_err(|error| invalid(error, content))?;
        Ok(dataset)
    };
    let (verified, dataset) = rayon::join(|| checksum::verify(content), dataset);
    verified?;
    dataset.map_err(|error| newer(error, minor))
}

/// An error of the dataset as one of its file.
pub(crate) fn invalid(mut error: CheckError, content: &ObjectTree) -> ReadError {
    error.place = shortened(in_file(&error.place, content));
    error.message = shortened(error.message);
    ReadError::Invalid(error)
}

/// Objects whose meaning depends on that of others in the same step, or outside of steps.
const NEEDS: &[(&str, &[&str])] = &[
    ("equation", &["domain", "tables"]),
    ("quantities", &["tables", "equation", "fields"]),
    ("partition", &["domain", "tables"]),
    ("functions", &["cracks", "tables"]),
    ("fields", &["equation", "tables"]),
    ("intensities", &["cracks"]),
    ("growth", &["cracks"]),
    ("reactions", &["fields", "equation"]),
];

/// All that is wrong with a content: nothing if it is a dataset. Returns one error for each object,
/// and none that may follow from another.
pub(crate) fn diagnose(content: &ObjectTree) -> Vec<ReadError> {
    let minor = match decode::check_version(content) {
        Ok(minor) => minor,
        Err(error) => return vec![error],
    };
    let (dataset, mut errors) = decode::diagnose(content);
    let broken: BTreeSet<String> =
        errors.iter().filter_map(|error| error.place().map(str::to_owned)).collect();
    let follows = |error: &ReadError| {
        let (step, name) = error.place().map(part).unwrap_or_default();
        let needs = NEEDS.iter().find(|(of, _)| *of == name).map_or(&[][..], |(_, needs)| *needs);
        broken.iter().any(|place| {
            let (at, broken) = part(place);
            // where a group is missing as a whole nothing can be said of others
            let is_whole = place.len() == join(at, broken).len();
            (at == step || at.is_empty() || step.is_empty())
                && (broken == name || needs.contains(&broken) || is_whole)
        })
    };
    let invalid = dataset.diagnose().into_iter().map(|error| invalid(error, content));
    errors.extend(invalid.filter(|error| !follows(error)));
    errors.extend(checksum::verify(content).err());
    errors.into_iter().map(|error| newer(error, minor)).collect()
}

/// The step that an object belongs to, empty if to none, and the group there that it is in.
fn part(object: &str) -> (&str, &str) {
    let step = step_of(object).unwrap_or_default();
    let rest = object[step.len()..].trim_start_matches('/');
    (step, rest.split(['/', '@', '[', ' ']).next().unwrap_or_default())
}

/// Returns the error with the version of the file, if that is later than this program.
pub(crate) fn newer(error: ReadError, minor: u32) -> ReadError {
    let source = Box::new(error);
    if minor > FORMAT_VERSION.1 { ReadError::Newer { minor, source } } else { *source }
}
