//! Lines of numbers, separated by commas.

use std::path::Path;

use super::error::{Diagnostic, ProblemLocation};

/// A line that says something.
pub(super) struct CsvLine<'t> {
    /// Its number, from 1.
    pub(super) number: usize,
    pub(super) words: Vec<Word<'t>>,
}

/// The text between two commas.
pub(super) struct Word<'t> {
    /// Column of its first character, from 1.
    pub(super) column: usize,
    pub(super) text: &'t str,
}

impl Word<'_> {
    /// The number, if it is a finite one.
    pub(super) fn number(&self) -> Option<f64> {
        self.text.parse().ok().filter(|value: &f64| value.is_finite())
    }
}

/// The lines of a text without empty ones, and without what follows `#`.
pub(super) fn lines(text: &str) -> impl Iterator<Item = CsvLine<'_>> {
    let numbered = (1..).zip(text.trim_start_matches('\u{feff}').lines());
    let contents = numbered.map(|(number, line)| (number, line.split('#').next().unwrap_or("")));
    contents
        .filter(|(_, content)| !content.trim().is_empty())
        .map(|(number, content)| CsvLine { number, words: words(content) })
}

/// Most words of a line that are looked at: as many values as a dataset holds in tables.
const MOST_WORDS: usize = 1 << 20;

fn words(content: &str) -> Vec<Word<'_>> {
    let mut next = 1;
    let word = |text| {
        let column = next + str::chars(text).take_while(|c| c.is_whitespace()).count();
        next += text.chars().count() + 1;
        Word { column, text: text.trim() }
    };
    content.split(',').take(MOST_WORDS).map(word).collect()
}

/// Longest file, in bytes: a million lines, most points that cells can be made of and most values
/// that a dataset holds in tables, take some ten MiB.
const LONGEST: u64 = 64 << 20;

/// Most errors of one file that are reported: a file of another kind has one on every line.
pub(super) const MOST_FINDINGS: usize = 100;

/// The text of a file, or what to say of it: `what` cannot be read.
pub(super) fn read(path: &Path, what: &str) -> Result<String, Diagnostic> {
    ppum_file::text(path, LONGEST)
        .map_err(|error| of_file(path, format!("cannot read the {what}: {error}")))
}

/// True if no more errors need to be looked for.
pub(super) fn is_enough(mistakes: &[Diagnostic]) -> bool {
    mistakes.len() >= MOST_FINDINGS
}

/// An error about a file as a whole.
pub(super) fn of_file(path: &Path, message: String) -> Diagnostic {
    Diagnostic { location: ProblemLocation::File(path.display().to_string()), message }
}

/// An error at a position in a file.
pub(super) fn mistake(file: &str, line: usize, column: usize, message: String) -> Diagnostic {
    Diagnostic { location: ProblemLocation::Text { file: file.to_owned(), line, column }, message }
}
