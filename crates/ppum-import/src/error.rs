//! Why a file is no drawing of one body.

use ppum::vec2::Vec2;

use crate::source::SourceLine;

/// Why a file cannot be read, or why its curves are no outline with holes and cracks: a sentence
/// with the place and the remedy.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct ImportError(pub(crate) String);

impl ImportError {
    /// The error that a file has more things than are read.
    pub(crate) fn too_many(what: &str, most: usize) -> Self {
        Self(format!(
            "the file has more than {most} {what}; leave out what is no border of the body"
        ))
    }
}

impl SourceLine {
    /// The error that something here does not obey the format.
    pub(crate) fn error(self, message: impl std::fmt::Display) -> ImportError {
        ImportError(format!("{self}: {message}"))
    }
}

/// A point in messages.
pub(crate) fn shown(at: Vec2) -> String {
    format!("[{:.6}, {:.6}]", at.x, at.y)
}
