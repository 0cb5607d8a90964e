//! The page in Markdown, and the folder of its images.

use crate::picture::draw;
use crate::studies::support::unknowns;
use anyhow::Context as _;
use ppum::dataset::Dataset;
use ppum::vec2::Rect;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// A page that grows.
pub(crate) struct Page {
    docs: PathBuf,
    text: String,
}

impl Page {
    /// A page in the folder `docs` with its first lines.
    pub(crate) fn new(docs: &Path, head: &str) -> Self {
        Self { docs: docs.into(), text: format!("{head}\n") }
    }

    /// The page as it is, up to a heading.
    pub(crate) fn before(docs: &Path, name: &str, heading: &str) -> anyhow::Result<Self> {
        let path = docs.join(name);
        let text = std::fs::read_to_string(&path)
            .with_context(|| format!("cannot read {}", path.display()))?;
        let text = text.split(&format!("\n{heading}\n")).next().unwrap_or_default().to_owned();
        Ok(Self { docs: docs.into(), text })
    }

    /// A paragraph, or a heading.
    pub(crate) fn add(&mut self, text: &str) {
        eprintln!("{}", text.lines().next().unwrap_or_default());
        let _ = write!(self.text, "\n{text}\n");
    }

    /// The head of a table.
    pub(crate) fn head(&mut self, columns: &[&str]) {
        let line = " --- |".repeat(columns.len());
        let _ = write!(self.text, "\n| {} |\n|{line}\n", columns.join(" | "));
    }

    /// One row of a table.
    pub(crate) fn row(&mut self, cells: &[String]) {
        let _ = writeln!(self.text, "| {} |", cells.join(" | "));
    }

    /// An image of a solution in a window.
    pub(crate) fn picture(
        &mut self,
        name: &str,
        dataset: &Dataset,
        window: Rect,
    ) -> anyhow::Result<()> {
        let file = format!("images/validation/{name}.png");
        let path = self.docs.join(&file);
        draw(&path, dataset, window).with_context(|| format!("cannot draw {}", path.display()))?;
        let count = unknowns(dataset);
        self.add(&format!("![{name}, {count} unknowns]({file})"));
        Ok(())
    }

    /// The path of an image.
    pub(crate) fn image(&self, name: &str) -> PathBuf {
        self.docs.join("images/validation").join(name)
    }

    /// Writes the page.
    pub(crate) fn save(self, name: &str) -> anyhow::Result<()> {
        let path = self.docs.join(name);
        std::fs::write(&path, self.text).with_context(|| format!("cannot write {}", path.display()))
    }
}

/// An error as a power of ten with two digits.
pub(crate) fn error(value: f64) -> String {
    format!("{value:.1e}")
}

/// The rate between an error and the one on cells twice as large, in parentheses.
fn rate(coarse: Option<f64>, fine: f64) -> String {
    coarse.map_or(String::new(), |coarse| format!(" ({:.2})", (coarse / fine).log2()))
}

/// Errors on covers each of half the cell size of the one before, with rates.
pub(crate) fn rated(errors: &[f64]) -> Vec<String> {
    let before = std::iter::once(None).chain(errors.iter().copied().map(Some));
    let cell = |(before, &e): (Option<f64>, &f64)| format!("{e:.2e}{}", rate(before, e));
    before.zip(errors).map(cell).collect()
}
