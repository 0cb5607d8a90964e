//! Parts of a page that the program writes.
//!
//! ```text
//! <!-- begin NAME -->
//! what is replaced
//! <!-- end NAME -->
//! ```

use std::path::Path;

use anyhow::{Context as _, ensure};

use crate::target;

/// Longest page that is read.
const MOST: u64 = 1 << 24;

/// Marks of a part.
fn marks(name: &str) -> [String; 2] {
    ["begin", "end"].map(|word| format!("<!-- {word} {name} -->"))
}

/// Refuses a page that has no such part, before any work is done.
pub(super) fn check(path: &Path, name: &str) -> anyhow::Result<()> {
    replaced(&read(path)?, name, "").map(|_| ()).with_context(|| path.display().to_string())
}

/// Puts a text between the marks.
pub(super) fn replace(path: &Path, name: &str, text: &str) -> anyhow::Result<()> {
    let page = replaced(&read(path)?, name, text)?;
    target::save(path, |out| out.write_all(page.as_bytes()))
}

fn read(path: &Path) -> anyhow::Result<String> {
    ppum_file::text(path, MOST).with_context(|| format!("cannot read {}", path.display()))
}

fn replaced(page: &str, name: &str, text: &str) -> anyhow::Result<String> {
    let [begin, end] = marks(name);
    let parts = page
        .split_once(&begin)
        .and_then(|(before, rest)| rest.split_once(&end).map(|(_, after)| (before, after)));
    ensure!(parts.is_some(), "put the lines `{begin}` and `{end}` where the tables are to be");
    let (before, after) = parts.unwrap_or_default();
    Ok(format!("{before}{begin}\n\n{}\n\n{end}{after}", text.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_replaced() {
        let page =
            "# Page\n<!-- begin a -->\nold\n<!-- end a -->\nrest\n<!-- begin b --><!-- end b -->\n";
        let new = replaced(page, "a", "new\n").unwrap();
        assert_eq!(
            new,
            "# Page\n<!-- begin a -->\n\nnew\n\n<!-- end a -->\nrest\n<!-- begin b --><!-- end b -->\n"
        );
        assert_eq!(replaced(&new, "a", "new").unwrap(), new);
        let error = replaced(page, "c", "").unwrap_err().to_string();
        assert!(error.contains("<!-- begin c -->") && error.contains("<!-- end c -->"), "{error}");
    }
}
