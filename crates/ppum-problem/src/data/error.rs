//! Diagnostics of a problem and their locations.

use std::fmt;

/// Everything found wrong with a problem, in the order of the file.
///
/// Renders one error per line, the first hundred of them, e.g.
/// ``plate.toml:12:1: unknown key `yong` in [material]; did you mean `young`?``
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", lines(.mistakes))]
pub struct ProblemError {
    mistakes: Vec<Diagnostic>,
}

/// One thing that is wrong, with its remedy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Its location.
    pub location: ProblemLocation,
    /// The error and its remedy, lower-case, without the location.
    pub message: String,
}

/// The location of a [`Diagnostic`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ProblemLocation {
    /// A file as a whole, e.g. one that cannot be read.
    File(String),
    /// A position in a file's text.
    Text {
        /// The file's name as it was given.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
    },
    /// A key, for problems that were built in code, e.g. `crack[0].points[1]`.
    Key(String),
}

impl ProblemError {
    /// An error made of diagnostics, of which there is at least one.
    pub(crate) fn new(mistakes: Vec<Diagnostic>) -> Self {
        debug_assert!(!mistakes.is_empty(), "an error without a mistake");
        Self { mistakes }
    }

    /// The diagnostics, at least one.
    #[must_use]
    pub fn mistakes(&self) -> &[Diagnostic] {
        &self.mistakes
    }
}

impl From<Diagnostic> for ProblemError {
    fn from(mistake: Diagnostic) -> Self {
        Self::new(vec![mistake])
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.location, self.message)
    }
}

impl fmt::Display for ProblemLocation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(file) => write!(f, "{file}"),
            Self::Text { file, line, column } => write!(f, "{file}:{line}:{column}"),
            Self::Key(key) => write!(f, "{key}"),
        }
    }
}

/// Findings that are shown; nobody reads more of them at a time.
const SHOWN: usize = 100;

fn lines(mistakes: &[Diagnostic]) -> String {
    let mut lines: Vec<_> = mistakes.iter().take(SHOWN).map(Diagnostic::to_string).collect();
    match mistakes.len().saturating_sub(SHOWN) {
        0 => {}
        1 => lines.push("… and one mistake more".to_owned()),
        more => lines.push(format!("… and {more} mistakes more")),
    }
    lines.join("\n")
}
