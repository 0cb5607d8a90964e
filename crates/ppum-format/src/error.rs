//! Errors of reading and writing.

use std::path::{Path, PathBuf};

use ppum::check::CheckError;

use crate::limits::FORMAT_VERSION;

/// The reason why a dataset could not be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file system refused.
    #[error("cannot read {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: std::io::Error,
    },
    /// Not an HDF5 file, or a damaged one.
    #[error("not a readable HDF5 file: {message}")]
    Hdf5 {
        /// The error.
        message: String,
    },
    /// HDF5, but not a dataset of this format.
    #[error("an HDF5 file, but not a ppum dataset: the root attribute `format` is not \"ppum\"")]
    NotADataset,
    /// Written by a newer program.
    #[error(
        "the file has format version {major}.{minor}, this program reads versions up to {}.x; \
         use a newer ppum",
        FORMAT_VERSION.0
    )]
    TooNew {
        /// Major version of the file.
        major: u64,
        /// Minor version of the file.
        minor: u64,
    },
    /// Written by a newer program, with something that this one does not know.
    #[error(
        "{source}; the file has format version {}.{minor}, this program knows {}.{}: a newer ppum \
         may read it",
        FORMAT_VERSION.0, FORMAT_VERSION.0, FORMAT_VERSION.1
    )]
    Newer {
        /// Minor version of the file.
        minor: u32,
        /// The part that was not understood.
        source: Box<ReadError>,
    },
    /// An object of the file is missing or not what it should be.
    #[error("{object}: {message}")]
    Object {
        /// Path in the file; attributes are written `group@attribute`.
        object: String,
        /// The error.
        message: String,
    },
    /// The content is not what was written.
    #[error(
        "the content does not match its checksum (stored {stored}, computed {computed}): the file \
         is damaged or was edited; after an intended edit delete the attribute `{attribute}`"
    )]
    Checksum {
        /// Name of the attribute that holds it, as that of an object.
        attribute: String,
        /// Value of the attribute.
        stored: String,
        /// Checksum of the content as read.
        computed: String,
    },
    /// Readable, but without meaning.
    #[error("the file's content is inconsistent: {0}")]
    Invalid(#[from] CheckError),
}

impl ReadError {
    pub(crate) fn io(path: &Path, source: std::io::Error) -> Self {
        Self::Io { path: path.to_owned(), source }
    }

    /// An error of an object.
    pub(crate) fn object(object: &str, message: impl Into<String>) -> Self {
        Self::Object { object: shortened(object.to_owned()), message: shortened(message.into()) }
    }

    /// The object of the file that it is about, if it is about one.
    #[must_use]
    pub fn place(&self) -> Option<&str> {
        match self {
            Self::Object { object, .. } => Some(object),
            Self::Checksum { attribute, .. } => Some(attribute),
            Self::Invalid(CheckError { place, .. }) => Some(place),
            Self::Newer { source, .. } => source.place(),
            Self::Io { .. } | Self::Hdf5 { .. } | Self::NotADataset | Self::TooNew { .. } => None,
        }
    }
}

/// Longest text of an error, in characters: a formula's error with two lines of it fits.
const LONGEST: usize = 700;

/// A text of a file without the middle, if it is long: it may be of any length.
pub(crate) fn shortened(mut text: String) -> String {
    let place = |k: usize| text.char_indices().nth(k).map(|(at, _)| at);
    let last = text.chars().count().saturating_sub(LONGEST / 2);
    if let (Some(_), Some(from), Some(to)) = (place(LONGEST), place(LONGEST / 2), place(last)) {
        text.replace_range(from..to, " … ");
    }
    text
}

/// The reason why a dataset could not be written. The file that was at the path before
/// is unchanged.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The file system refused, or the target is nothing that may be replaced.
    #[error("cannot write {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: std::io::Error,
    },
    /// A dataset, but none that steps can be appended to.
    #[error("steps cannot be appended to {}: {reason}; begin a new series", path.display())]
    NoSeries {
        /// The file.
        path: PathBuf,
        /// The reason.
        reason: &'static str,
    },
    /// Steps cannot be appended to what cannot be read.
    #[error("steps cannot be appended to {}: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: Box<ReadError>,
    },
    /// Longer than what is read.
    #[error("the file would have {length} bytes, at most {most} are read")]
    TooLong {
        /// Length in bytes.
        length: u64,
        /// [`MAX_LENGTH`](crate::MAX_LENGTH), or [`MAX_SERIES_LENGTH`](crate::MAX_SERIES_LENGTH).
        most: u64,
    },
    /// The dataset has no meaning.
    #[error("the dataset is inconsistent: {0}")]
    Invalid(#[from] CheckError),
    /// The format cannot express something.
    #[error("{object}: {message}")]
    Object {
        /// Path it would have in the file.
        object: String,
        /// The error.
        message: String,
    },
    /// The HDF5 library refused.
    #[error("cannot make an HDF5 file of it: {message}")]
    Hdf5 {
        /// The message of the HDF5 library.
        message: String,
    },
}

impl WriteError {
    pub(crate) fn object(object: &str, message: impl Into<String>) -> Self {
        Self::Object { object: object.to_owned(), message: message.into() }
    }
}
