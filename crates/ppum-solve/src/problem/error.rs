//! Mistakes of a problem and their places.

use std::fmt;

/// Everything found wrong with a problem, in the order of the file.
///
/// Renders one finding per line, the first hundred of them, e.g.
/// ``plate.toml:12:1: unknown key `yong` in [material]; did you mean `young`?``
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", lines(.findings))]
pub struct ProblemError {
    findings: Vec<Finding>,
}

/// One thing that is wrong, with its remedy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Its place.
    pub place: Place,
    /// The mistake and its remedy, lower-case, without the place.
    pub message: String,
}

/// The place of a [`Finding`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// A file as a whole, e.g. one that cannot be read.
    File(String),
    /// A place in a file's text.
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
    /// An error of the given findings, of which there is at least one.
    pub(super) fn new(findings: Vec<Finding>) -> Self {
        debug_assert!(!findings.is_empty(), "an error without a finding");
        Self { findings }
    }

    /// The findings, at least one.
    #[must_use]
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }
}

impl From<Finding> for ProblemError {
    fn from(finding: Finding) -> Self {
        Self::new(vec![finding])
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.message)
    }
}

impl fmt::Display for Place {
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

fn lines(findings: &[Finding]) -> String {
    let mut lines: Vec<_> = findings.iter().take(SHOWN).map(Finding::to_string).collect();
    match findings.len().saturating_sub(SHOWN) {
        0 => {}
        1 => lines.push("… and one mistake more".to_owned()),
        more => lines.push(format!("… and {more} mistakes more")),
    }
    lines.join("\n")
}
