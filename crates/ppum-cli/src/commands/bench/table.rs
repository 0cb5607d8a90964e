//! Tables, for terminals and for pages.

use std::fmt::Write as _;

use crate::output::Output;

/// A table: a title, the names of its columns, rows. The first columns are words, the others numbers.
#[derive(Debug)]
pub(super) struct Table {
    pub(super) title: String,
    /// Columns of words.
    pub(super) words: usize,
    pub(super) head: Vec<String>,
    pub(super) rows: Vec<Vec<String>>,
    /// A paragraph below.
    pub(super) note: String,
}

impl Table {
    /// Lines of columns that stand below each other; those that are empty are left out.
    pub(super) fn text(&self) -> String {
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

    /// The same in Markdown.
    pub(super) fn markdown(&self) -> String {
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
            let _ = write!(text, "\n{}\n", self.note);
        }
        text
    }

    fn has(&self, column: usize) -> bool {
        self.rows.iter().any(|row| !row[column].is_empty())
    }
}

/// Writes tables for people.
pub(super) fn print(tables: &[Table], out: &mut Output) -> std::io::Result<()> {
    use std::io::Write as _;
    tables.iter().try_for_each(|table| write!(out, "{}", table.text()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_stand_below_each_other() {
        let words = |row: [&str; 3]| row.map(str::to_owned).to_vec();
        let table = Table {
            title: "Title".into(),
            words: 1,
            head: words(["cover", "patches", "none"]),
            rows: vec![words(["a", "16", ""]), words(["graded", "4", ""])],
            note: "A note.".into(),
        };
        let text = "\nTitle\ncover   patches\na            16\ngraded        4\nA note.\n";
        assert_eq!(table.text(), text);
        let page = "### Title\n\n| cover | patches |\n| --- | ---: |\n| a | 16 |\n| graded | 4 |\n\nA note.\n";
        assert_eq!(table.markdown(), page);
    }
}
