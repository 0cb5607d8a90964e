//! Tables, for terminals and for pages.

use std::fmt::Write as _;

/// A table: a title, the names of its columns, rows. The first columns are words, the
/// others numbers.
#[derive(Debug)]
pub struct ReportTable {
    /// The title.
    pub title: String,
    /// Columns of words.
    pub words: usize,
    /// The names of the columns.
    pub head: Vec<String>,
    /// The rows, a cell for each column.
    pub rows: Vec<Vec<String>>,
    /// A paragraph below.
    pub note: String,
}

impl ReportTable {
    /// Lines of columns that stand below each other; those that are empty are left out.
    pub fn text(&self) -> String {
        let kept: Vec<usize> = (0..self.head.len()).filter(|&column| self.has(column)).collect();
        let width = |column: usize| {
            let cells = self.rows.iter().map(|row| row[column].chars().count());
            cells.chain([self.head[column].chars().count()]).max().unwrap_or(0)
        };
        let line = |cells: &[String]| {
            let cell = |&column: &usize| {
                let (cell, width) = (&cells[column], width(column));
                if column < self.words {
                    format!("{cell:<width$}")
                } else {
                    format!("{cell:>width$}")
                }
            };
            kept.iter().map(cell).collect::<Vec<_>>().join("  ").trim_end().to_owned() + "\n"
        };
        let mut text = format!("\n{}\n{}", self.title, line(&self.head));
        self.rows.iter().for_each(|row| text += &line(row));
        if !self.note.is_empty() {
            let _ = writeln!(text, "{}", self.note);
        }
        text
    }

    /// Writes the table in Markdown.
    pub fn markdown(&self) -> String {
        let kept: Vec<usize> = (0..self.head.len()).filter(|&column| self.has(column)).collect();
        let line = |cells: &[String]| {
            let cells: Vec<&str> = kept.iter().map(|&column| cells[column].as_str()).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let rule = |&column: &usize| if column < self.words { " --- |" } else { " ---: |" };
        let rule: String = kept.iter().map(rule).collect();
        let mut text = format!("### {}\n\n{}|{rule}\n", self.title, line(&self.head));
        self.rows.iter().for_each(|row| text += &line(row));
        if !self.note.is_empty() {
            let _ = write!(text, "\n{}\n", filled(&self.note));
        }
        text
    }

    fn has(&self, column: usize) -> bool {
        self.rows.iter().any(|row| !row[column].is_empty())
    }
}

/// Columns of a line of a page.
const COLUMNS: usize = 120;

/// The words in lines of at most as many columns as pages have.
fn filled(words: &str) -> String {
    let (mut text, mut columns) = (String::new(), 0);
    for word in words.split(' ') {
        let width = word.chars().count();
        let fits = columns + 1 + width <= COLUMNS;
        if columns > 0 {
            text.push(if fits { ' ' } else { '\n' });
        }
        columns = if fits && columns > 0 { columns + 1 + width } else { width };
        text += word;
    }
    text
}
