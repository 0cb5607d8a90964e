//! The name of a file that is to be written, and what became of the last one.

use std::io;
use std::path::{Path, PathBuf};

use egui::Ui;

/// The name of a file that is to be written, and what became of the last one.
#[derive(Clone, Debug, Default)]
pub struct SaveTarget {
    /// The name, as it is written.
    pub name: String,
    /// The result of the last file, in words, or the reason why there is none.
    pub result: Option<Result<String, String>>,
    /// The file that was asked for, or written, last.
    asked: Option<PathBuf>,
}

/// The warning about a file that exists already.
const ASK: &str = "this file exists; save again to replace it";

impl SaveTarget {
    /// A name that is proposed.
    #[must_use]
    pub fn new(name: String) -> Self {
        Self { name, ..Self::default() }
    }

    /// Returns the reason why no file of this name is written: it has none of these extensions, or
    /// is the file of the dataset.
    pub(crate) fn refusal(path: &Path, ends: &[&str], dataset: Option<&Path>) -> Option<String> {
        if path.as_os_str().is_empty() {
            return Some("Write the name of a file.".into());
        }
        if !has_extension(path, ends) {
            return Some(format!("The name must end in .{}.", ends.join(", .")));
        }
        let is_input = dataset.is_some_and(|dataset| ppum_file::is_same(dataset, path));
        is_input.then(|| "This file is the dataset itself; choose another name.".into())
    }

    /// Returns the reason why a file is not written now. One that exists is replaced only if it
    /// was written before, or is asked for the second time.
    pub fn refuses(
        &mut self,
        path: &Path,
        ends: &[&str],
        dataset: Option<&Path>,
    ) -> Option<String> {
        Self::refusal(path, ends, dataset).or_else(|| {
            let before = self.asked.replace(path.to_owned());
            (before.as_deref() != Some(path) && path.exists()).then(|| ASK.to_owned())
        })
    }

    /// True if the user is asked whether a file is to be replaced.
    pub(crate) fn is_asking(&self) -> bool {
        self.result.as_ref().is_some_and(|result| result.as_ref().is_err_and(|e| e == ASK))
    }

    /// Forgets the last file: the name is another one.
    pub fn forget(&mut self) {
        (self.asked, self.result) = (None, None);
    }

    /// Shows the result of the last file.
    pub fn show_result(&self, ui: &mut Ui) {
        match &self.result {
            Some(Ok(text)) => drop(ui.label(text)),
            Some(Err(reason)) => drop(ui.colored_label(ui.visuals().error_fg_color, reason)),
            None => {}
        }
    }
}

/// True if the name of a file ends so.
pub(crate) fn has_extension(path: &Path, known: &[&str]) -> bool {
    let extension = path.extension().and_then(|end| end.to_str()).unwrap_or_default();
    known.iter().any(|end| end.eq_ignore_ascii_case(extension))
}

/// Writes a file, completely or not at all.
///
/// # Errors
/// Those of the system.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    ppum_file::replace(path, |out| out.write_all(bytes))
}
