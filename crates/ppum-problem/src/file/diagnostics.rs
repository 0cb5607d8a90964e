//! The errors in a text, with their places.

use std::cell::RefCell;
use std::iter;

use crate::data::{Diagnostic, ProblemLocation};

/// Collects errors; shared by all sections and values of a document.
pub(crate) struct DiagnosticList<'a> {
    pub(crate) file: &'a str,
    pub(crate) text: &'a str,
    /// Bytes at which the lines of the text begin: files may have as many errors as lines.
    lines: Vec<usize>,
    /// Line and column of the file at which the text begins, from 1.
    start: (usize, usize),
    /// With the offset in the text, by which they are sorted in the end.
    errors: RefCell<Vec<(usize, Diagnostic)>>,
    /// Remarks that are no errors, in the order in which they were made.
    notes: RefCell<Vec<Diagnostic>>,
}

impl<'a> DiagnosticList<'a> {
    pub(crate) fn new(file: &'a str, text: &'a str) -> Self {
        let starts = text.match_indices('\n').map(|(newline, _)| newline + 1);
        let lines = iter::once(0).chain(starts).collect();
        Self {
            file,
            text,
            lines,
            start: (1, 1),
            errors: RefCell::default(),
            notes: RefCell::default(),
        }
    }

    /// Takes the text for a part of the file, which begins at a line and column.
    pub(crate) fn begins_at(&mut self, line: usize, column: usize) {
        self.start = (line, column);
    }

    /// Reports an error at a byte of the text.
    pub(crate) fn at(&self, offset: usize, message: impl Into<String>) {
        self.add(offset, self.diagnostic(offset, message));
    }

    /// Remarks something that is no error at a byte of the text.
    pub(crate) fn note(&self, offset: usize, message: impl Into<String>) {
        self.notes.borrow_mut().push(self.diagnostic(offset, message));
    }

    /// The remarks so far.
    pub(crate) fn notes(&self) -> Vec<Diagnostic> {
        self.notes.borrow().clone()
    }

    fn diagnostic(&self, offset: usize, message: impl Into<String>) -> Diagnostic {
        let (line, column) = self.position(offset);
        let location = ProblemLocation::Text { file: self.file.to_owned(), line, column };
        Diagnostic { location, message: message.into() }
    }

    /// Reports an error in another file, named at a byte of this text.
    pub(crate) fn add(&self, offset: usize, mistake: Diagnostic) {
        self.errors.borrow_mut().push((offset, mistake));
    }

    /// Line and column in characters, from 1, of a byte of the text in the file.
    pub(crate) fn position(&self, offset: usize) -> (usize, usize) {
        let line = self.lines.partition_point(|start| *start <= offset);
        let before = self.text.get(self.lines[line - 1]..offset).unwrap_or_default();
        let column = before.chars().count() + 1;
        let (first, indent) = self.start;
        (first + line - 1, if line == 1 { indent + column - 1 } else { column })
    }

    /// The errors in the order of the text.
    pub(crate) fn into_errors(self) -> Vec<Diagnostic> {
        let mut errors = self.errors.into_inner();
        errors.sort_by_key(|(offset, _)| *offset);
        // of a curve each vertex has the place of all
        errors.dedup();
        errors.into_iter().map(|(_, mistake)| mistake).collect()
    }
}

/// Length of what opens a text: quotes, and the line break that follows three of them.
pub(crate) fn quotes(raw: &str) -> Option<usize> {
    if let Some(rest) = raw.strip_prefix("\"\"\"").or_else(|| raw.strip_prefix("'''")) {
        let breaks = ["\r\n", "\n"].iter().find(|text| rest.starts_with(**text));
        return Some(3 + breaks.map_or(0, |text| text.len()));
    }
    raw.starts_with(['"', '\'']).then_some(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_characters_and_lines_from_one() {
        let text = "ä = 1\r\nβγ = 2\n";
        let report = DiagnosticList::new("plate.toml", text);
        assert_eq!(report.position(0), (1, 1));
        assert_eq!(report.position(text.find('=').expect("there")), (1, 3));
        assert_eq!(report.position(text.find('2').expect("there")), (2, 6));
        assert_eq!(report.position(text.len()), (3, 1));
    }
}
