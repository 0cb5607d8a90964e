//! Numbers in results, and tables of them.

use std::io::{self, Write};

pub(crate) use ppum_scene::facts::JsonNumber;
use serde::Serialize;

/// Prints a result as JSON.
pub(crate) fn json(out: &mut dyn Write, result: &impl Serialize) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, result)?;
    writeln!(out)
}

/// `1 tip`, `2 tips`.
pub(crate) fn count(n: usize, one: &str, more: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { more })
}

/// Lines of texts with a name before the first of each.
pub(crate) struct NamedLines<'a>(pub(crate) &'a mut dyn Write);

impl NamedLines<'_> {
    /// Width of the column of names.
    pub(crate) const NAME: usize = 12;

    pub(crate) fn line(&mut self, name: &str, text: &str) -> io::Result<()> {
        writeln!(self.0, "{name:0$} {text}", Self::NAME)
    }

    /// The first line carries the name; nothing is written without lines.
    pub(crate) fn lines(
        &mut self,
        name: &str,
        lines: impl IntoIterator<Item = String>,
    ) -> io::Result<()> {
        for (k, text) in lines.into_iter().enumerate() {
            self.line(if k == 0 { name } else { "" }, &text)?;
        }
        Ok(())
    }
}

/// Lines of words in columns, to the right; the last column to the left if it `ends_in_words`.
pub(crate) fn columns(
    out: &mut dyn Write,
    lines: &[Vec<String>],
    ends_in_words: bool,
) -> io::Result<()> {
    let count = lines.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        let words = lines.iter().filter_map(|line| line.get(column));
        words.map(|word| word.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<_> = (0..count).map(width).collect();
    for line in lines {
        let words = line.iter().zip(&widths).enumerate().map(|(k, (word, &width))| {
            let is_left = ends_in_words && k + 1 == count;
            if is_left { word.clone() } else { format!("{word:>width$}") }
        });
        writeln!(out, "{}", words.collect::<Vec<_>>().join("  ").trim_end())?;
    }
    Ok(())
}
