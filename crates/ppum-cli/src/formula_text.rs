//! Formulas on the command line.

use std::path::Path;

use anyhow::Context as _;
use ppum_scene::list::parts;

use crate::standard::{self, is_standard};

/// Longest file, in bytes: far above the longest formula.
const LONGEST: u64 = 1 << 20;

/// A formula as it was given: itself, or the content of the file named after `@`; `@-` is standard
/// input.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FormulaText {
    pub(crate) text: String,
    file: Option<String>,
}

impl FormulaText {
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

/// The files of the formulas of lists.
pub(crate) fn files<'a>(
    lists: impl IntoIterator<Item = &'a String>,
) -> impl Iterator<Item = &'a Path> {
    lists.into_iter().flat_map(|list| parts(list)).filter_map(file)
}
