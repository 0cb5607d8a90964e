//! Why a part of a file cannot be read.

use std::borrow::Cow;

/// The reason why a part of a file cannot be read.
#[derive(Debug)]
pub(super) struct Hdf5Error(pub(super) Cow<'static, str>);

pub(super) type ReadResult<T> = Result<T, Hdf5Error>;

impl From<&'static str> for Hdf5Error {
    fn from(text: &'static str) -> Self {
        Self(text.into())
    }
}

impl From<String> for Hdf5Error {
    fn from(text: String) -> Self {
        Self(text.into())
    }
}

pub(super) fn fail<T>(mistake: impl Into<Hdf5Error>) -> ReadResult<T> {
    Err(mistake.into())
}
