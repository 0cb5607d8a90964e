//! Places in files.

use std::fmt;

/// A place in a file.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SourceLine {
    /// The line, from 1.
    pub line: usize,
    /// The handle of an entity of a DXF file; 0 if it has none.
    pub handle: u64,
}

impl SourceLine {
    pub(crate) fn new(line: usize) -> Self {
        Self { line, handle: 0 }
    }
}

impl fmt::Display for SourceLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.handle {
            0 => write!(f, "line {}", self.line),
            handle => write!(f, "line {}, handle {handle:X}", self.line),
        }
    }
}
