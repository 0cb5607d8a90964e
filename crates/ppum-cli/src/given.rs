//! Formulas on the command line.

use std::path::Path;

use anyhow::Context as _;

use crate::standard::{self, is_standard};

/// Longest file, in bytes: far above the longest formula.
const LONGEST: u64 = 1 << 20;

/// A formula as it was given: itself, or the content of the file named after `@`; `@-` is standard input.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Given {
    pub(crate) text: String,
    file: Option<String>,
}

impl Given {
    /// Reads the file, if one is named.
    pub(crate) fn read(given: &str) -> anyhow::Result<Self> {
        let Some(path) = file(given) else {
            return Ok(Self { text: given.to_owned(), file: None });
        };
        if is_standard(path) {
            let text = standard::text("a formula")?;
            return Ok(Self { text, file: Some("standard input".into()) });
        }
        let file = path.display().to_string();
        let text = ppum_file::text(path, LONGEST).with_context(|| format!("cannot read {file}"))?;
        Ok(Self { text, file: Some(file) })
    }

    /// The name the text may be, if it stands on the command line itself.
    pub(crate) fn name(&self) -> Option<&str> {
        self.file.is_none().then_some(self.text.trim())
    }

    /// The result, an error with the name of the file in front.
    pub(crate) fn explain<T, E>(&self, result: Result<T, E>) -> anyhow::Result<T>
    where
        E: Into<anyhow::Error>,
    {
        let result = result.map_err(E::into);
        match &self.file {
            Some(file) => result.with_context(|| file.clone()),
            None => result,
        }
    }
}

/// The file of a formula that is given as `@FILE`.
pub(crate) fn file(given: &str) -> Option<&Path> {
    given.trim().strip_prefix('@').map(Path::new)
}

/// The parts of a list: what commas separate that stand in no parentheses and no comment.
pub(crate) fn parts(list: &str) -> Vec<&str> {
    let (mut depth, mut comment, mut start) = (0usize, false, 0);
    let mut parts = Vec::new();
    for (at, c) in list.char_indices() {
        match c {
            '\n' => comment = false,
            _ if comment => {}
            '#' => comment = true,
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                parts.push(list[start..at].trim());
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(list[start..].trim());
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_part_what_is_outside_of_parentheses() {
        assert_eq!(parts("ux, uy"), ["ux", "uy"]);
        assert_eq!(parts("max(ux, hypot(uy, 1)),@q.txt"), ["max(ux, hypot(uy, 1))", "@q.txt"]);
        assert_eq!(parts("ux # a, b (\n + uy, 1"), ["ux # a, b (\n + uy", "1"]);
        assert_eq!(parts("a), (b, c"), ["a)", "(b, c"]);
        assert_eq!(parts(""), [""]);
    }
}
