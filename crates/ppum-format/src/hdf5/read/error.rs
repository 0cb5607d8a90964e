//! Why a part of a file cannot be read.

use std::borrow::Cow;

/// The reason why a part of a file cannot be read.
pub(super) type Hdf5Error = Cow<'static, str>;

pub(super) type ReadResult<T> = Result<T, Hdf5Error>;

pub(super) fn fail<T>(message: impl Into<Hdf5Error>) -> ReadResult<T> {
    Err(message.into())
}
