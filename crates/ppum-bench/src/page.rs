//! Parts of a page that the program writes.
//!
//! ```text
//! <!-- begin NAME -->
//! what is replaced
//! <!-- end NAME -->
//! ```

use std::path::Path;

use anyhow::{Context as _, ensure};

use crate::Report;
use crate::table::ReportTable;

/// Longest page that is read.
const MOST: u64 = 1 << 24;

/// Refuses a page that has no such part, before any work is done.
///
/// # Errors
/// A page that cannot be read, or that lacks the part.
pub fn check(path: &Path, name: &str) -> anyhow::Result<()> {
    replaced(&read(path)?, name, "").map(|_| ()).with_context(|| path.display().to_string())
}

/// Puts the words and tables of a report between the marks.
///
/// # Errors
/// As [`check`], and if the page cannot be written.
pub fn replace(path: &Path, name: &str, report: &impl Report) -> anyhow::Result<()> {
    let tables: Vec<String> = report.tables().iter().map(ReportTable::markdown).collect();
    let text = format!("```text\n{}```\n\n{}", report.words(), tables.join("\n"));
    let page = replaced(&read(path)?, name, &text)?;
    ppum_file::replace(path, |out| out.write_all(page.as_bytes()))
        .with_context(|| format!("cannot write {}", path.display()))
}

fn read(path: &Path) -> anyhow::Result<String> {
    ppum_file::text(path, MOST).with_context(|| format!("cannot read {}", path.display()))
}

/// The page with a text between the marks.
///
/// # Errors
/// A page that lacks the marks.
pub fn replaced(page: &str, name: &str, text: &str) -> anyhow::Result<String> {
    let [begin, end] = ["begin", "end"].map(|word| format!("<!-- {word} {name} -->"));
    let parts = page
        .split_once(&begin)
        .and_then(|(before, rest)| rest.split_once(&end).map(|(_, after)| (before, after)));
    ensure!(parts.is_some(), "put the lines `{begin}` and `{end}` where the tables are to be");
    let (before, after) = parts.unwrap_or_default();
    Ok(format!("{before}{begin}\n\n{}\n\n{end}{after}", text.trim()))
}
