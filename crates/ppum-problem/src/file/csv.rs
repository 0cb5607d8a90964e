//! Lines of numbers, separated by commas.

use std::path::Path;

use crate::data::{Diagnostic, ProblemLocation};

/// A line that says something.
pub(crate) struct CsvLine<'t> {
    /// Its number, from 1.
    pub(crate) number: usize,
    pub(crate) words: Vec<Word<'t>>,
}

/// The text between two commas.
pub(crate) struct Word<'t> {
    /// Column of its first character, from 1.
    pub(crate) column: usize,
    pub(crate) text: &'t str,
}

/// The lines of a text without empty ones, and without what follows `#`.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = CsvLine<'_>> {
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
pub(crate) const MOST_ERRORS: usize = 100;

/// The errors of the lines of a file.
pub(crate) struct LineErrors<'f> {
    file: &'f str,
    found: Vec<Diagnostic>,
}

impl<'f> LineErrors<'f> {
    pub(crate) fn new(file: &'f str) -> Self {
        Self { file, found: Vec::new() }
    }

    /// Reports an error at a line and a column.
    pub(crate) fn at(&mut self, line: usize, column: usize, message: String) {
        let location = ProblemLocation::Text { file: self.file.to_owned(), line, column };
        self.found.extend((!self.is_full()).then_some(Diagnostic { location, message }));
    }

    /// True if no more errors need to be looked for.
    pub(crate) fn is_full(&self) -> bool {
        self.found.len() >= MOST_ERRORS
    }

    /// The number at a place of a line; a remedy follows the message that it is none.
    pub(crate) fn number(&mut self, line: &CsvLine<'_>, place: usize, remedy: &str) -> Option<f64> {
        let word = &line.words[place];
        let number = word.text.parse().ok().filter(|value: &f64| value.is_finite());
        if number.is_none() {
            let message = format!("`{}` is not a finite number{remedy}", word.text);
            self.at(line.number, word.column, message);
        }
        number
    }

    /// The data that were read, if there were no errors.
    pub(crate) fn or<T>(self, data: T) -> Result<T, Vec<Diagnostic>> {
        if self.found.is_empty() { Ok(data) } else { Err(self.found) }
    }
}

/// The text of a file, or what to say of it: `what` cannot be read.
pub(crate) fn read(path: &Path, what: &str) -> Result<String, Vec<Diagnostic>> {
    ppum_file::text(path, LONGEST)
        .map_err(|error| vec![of_file(path, format!("cannot read the {what}: {error}"))])
}

/// An error about a file as a whole.
pub(crate) fn of_file(path: &Path, message: String) -> Diagnostic {
    Diagnostic { location: ProblemLocation::File(path.display().to_string()), message }
}
