//! A TOML text with places: typed access to its values that reports every mistake and goes on.

mod value;

use std::cell::RefCell;
use std::iter;
use std::path::PathBuf;

use toml::de::{DeTable, DeValue};

use super::error::{Location, Mistake};
pub(super) use ppum::text::nearest;
pub(super) use value::Value;

/// Collects mistakes; shared by all sections and values of a document.
pub(super) struct Report<'a> {
    file: &'a str,
    text: &'a str,
    /// Bytes at which the lines of the text begin: files may have as many mistakes as lines.
    lines: Vec<usize>,
    /// With the offset in the text, by which they are sorted in the end.
    mistakes: RefCell<Vec<(usize, Mistake)>>,
    /// Files that the text names, as far as they were asked for.
    files: RefCell<Vec<PathBuf>>,
}

impl<'a> Report<'a> {
    pub(super) fn new(file: &'a str, text: &'a str) -> Self {
        let starts = text.match_indices('\n').map(|(newline, _)| newline + 1);
        Self {
            file,
            text,
            lines: iter::once(0).chain(starts).collect(),
            mistakes: RefCell::default(),
            files: RefCell::default(),
        }
    }

    /// Reports a mistake at a byte of the text.
    pub(super) fn at(&self, offset: usize, message: impl Into<String>) {
        let (line, column) = self.position(offset);
        let location = Location::Text { file: self.file.to_owned(), line, column };
        self.add(offset, Mistake { location, message: message.into() });
    }

    /// Reports a mistake in another file, named at a byte of this text.
    pub(super) fn add(&self, offset: usize, mistake: Mistake) {
        self.mistakes.borrow_mut().push((offset, mistake));
    }

    /// Line and column in characters, from 1, of a byte of the text.
    pub(super) fn position(&self, offset: usize) -> (usize, usize) {
        let line = self.lines.partition_point(|start| *start <= offset);
        let before = self.text.get(self.lines[line - 1]..offset).unwrap_or_default();
        (line, before.chars().count() + 1)
    }

    /// The files that the text names, as far as they were asked for.
    pub(super) fn files(&self) -> Vec<PathBuf> {
        self.files.borrow().clone()
    }

    /// The mistakes in the order of the text.
    pub(super) fn into_findings(self) -> Vec<Mistake> {
        let mut mistakes = self.mistakes.into_inner();
        mistakes.sort_by_key(|(offset, _)| *offset);
        // of a curve each vertex has the place of all
        mistakes.dedup_by(|a, b| a.0 == b.0 && a.1.message == b.1.message);
        mistakes.into_iter().map(|(_, mistake)| mistake).collect()
    }
}

/// A table of the document.
pub(super) struct Section<'a> {
    report: &'a Report<'a>,
    /// As users write it, e.g. `[material]`.
    name: String,
    table: &'a DeTable<'a>,
    /// Place at which something is said to be missing.
    offset: usize,
    /// Keys that were meant by those that are not known.
    meant: Vec<&'static str>,
}

/// What to write for a key of another equation: the keys that do for this one what it does.
#[derive(Clone, Copy)]
pub(super) struct Instead(pub(super) &'static [&'static str]);

impl<'a> Section<'a> {
    /// The whole document.
    pub(super) fn root(report: &'a Report<'a>, table: &'a DeTable<'a>) -> Self {
        Self { report, name: "the problem file".to_owned(), table, offset: 0, meant: Vec::new() }
    }

    /// Reports that something is missing in or wrong with the section as a whole.
    pub(super) fn error(&self, message: impl Into<String>) {
        self.report.at(self.offset, message);
    }

    /// True if the key is there, or meant by one that is.
    pub(super) fn mentions(&self, key: &str) -> bool {
        self.table.contains_key(key) || self.meant.contains(&key)
    }

    /// Reports every key that is not known.
    pub(super) fn only(
        mut self,
        known: &[&'static str],
        remedies: &[(&'static str, Instead)],
    ) -> Self {
        for key in self.table.keys().filter(|key| !known.contains(&key.get_ref().as_ref())) {
            let name = key.get_ref().as_ref();
            let remedy = remedies.iter().find(|(word, _)| *word == name);
            let (message, meant) = match remedy {
                Some((_, remedy)) => (misplaced(name, &self.name, *remedy), remedy.0.to_vec()),
                None => {
                    let near = nearest(name, known.iter().copied());
                    (unknown(name, &self.name, near, known), near.into_iter().collect())
                }
            };
            self.report.at(key.span().start, message);
            self.meant.extend(meant);
        }
        self
    }

    /// The value of a key that may be absent.
    pub(super) fn get(&self, key: &str) -> Option<Value<'a>> {
        let item = self.table.get(key)?;
        let name = format!("`{key}` in {}", self.name);
        Some(Value { report: self.report, name, item })
    }

    /// The value of a key that must be there; `example` shows it.
    pub(super) fn require(&self, key: &str, example: &str) -> Option<Value<'a>> {
        let value = self.get(key);
        if !self.mentions(key) {
            self.error(format!("`{key}` is missing in {}; add e.g. `{example}`", self.name));
        }
        value
    }

    /// All keys with their values.
    pub(super) fn entries(&self) -> impl Iterator<Item = (&'a str, Value<'a>)> {
        self.table.iter().map(|(key, item)| {
            let key = key.get_ref().as_ref();
            (key, Value { report: self.report, name: format!("`{key}` in {}", self.name), item })
        })
    }

    /// A table `[key]` that may be absent.
    pub(super) fn section(&self, key: &str) -> Option<Section<'a>> {
        let item = self.table.get(key)?;
        let name = format!("[{key}]");
        match item.get_ref() {
            DeValue::Table(table) => {
                let (report, offset) = (self.report, item.span().start);
                Some(Section { report, name, table, offset, meant: Vec::new() })
            }
            _ => {
                let message = format!("`{key}` must be one table; write [{key}] once");
                self.report.at(item.span().start, message);
                None
            }
        }
    }

    /// The tables `[[key]]`; none, and a mistake, if there are more than a dataset can hold.
    pub(super) fn sections_at_most(&self, most: usize, key: &str) -> Vec<Section<'a>> {
        let sections = self.sections(key);
        let Some(first) = sections.get(most) else { return sections };
        first.error(format!("there are {} [[{key}]], but at most {most} may be", sections.len()));
        Vec::new()
    }

    /// The tables `[[key]]`; none if absent.
    pub(super) fn sections(&self, key: &str) -> Vec<Section<'a>> {
        let Some(item) = self.table.get(key) else { return Vec::new() };
        let tables: Option<Vec<_>> = match item.get_ref() {
            DeValue::Array(array) => array
                .iter()
                .map(|item| Some((item.span().start, item.get_ref().as_table()?)))
                .collect(),
            _ => None,
        };
        if tables.is_none() {
            let message = format!("`{key}` must be a list of tables; write [[{key}]] for each");
            self.report.at(item.span().start, message);
        }
        let section = |(offset, table)| {
            let name = format!("[[{key}]]");
            Section { report: self.report, name, table, offset, meant: Vec::new() }
        };
        tables.unwrap_or_default().into_iter().map(section).collect()
    }
}

fn misplaced(name: &str, section: &str, Instead(keys): Instead) -> String {
    let remedy = match keys {
        [] => "does not fit the equation; remove it".to_owned(),
        keys => {
            let keys: Vec<_> = keys.iter().map(|key| format!("`{key}`")).collect();
            format!("does not fit the equation; write {} instead", keys.join(", "))
        }
    };
    format!("`{name}` in {section} {remedy}")
}

fn unknown(name: &str, section: &str, near: Option<&str>, known: &[&str]) -> String {
    let suggestion = match near {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("known are {}", known.join(", ")),
    };
    format!("unknown key `{name}` in {section}; {suggestion}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_characters_and_lines_from_one() {
        let text = "ä = 1\r\nβγ = 2\n";
        let report = Report::new("plate.toml", text);
        assert_eq!(report.position(0), (1, 1));
        assert_eq!(report.position(text.find('=').expect("there")), (1, 3));
        assert_eq!(report.position(text.find('2').expect("there")), (2, 6));
        assert_eq!(report.position(text.len()), (3, 1));
    }
}
