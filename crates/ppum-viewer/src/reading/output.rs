//! Files that readings are written to.

use std::io;
use std::path::{Path, PathBuf};

use crate::replaced_file::{ASK, ReplacedFile};

/// The name of the next file, and what became of the last one.
#[derive(Debug, Default)]
pub struct TableExport {
    /// The name without its end; that of the proposal where it is empty, and beside it where it
    /// names no folder.
    pub path: String,
    /// Where the file goes if nothing else is said.
    proposal: PathBuf,
    /// The proposal for the last file.
    told_of: PathBuf,
    /// The result of the last file: its name, or the reason why there is none.
    pub told: Option<Result<String, String>>,
    /// The file that was asked for last.
    replacing: ReplacedFile,
}

/// A file that is not written.
#[derive(Debug, thiserror::Error)]
enum OutputError {
    #[error("{}: this is the dataset that is shown; choose another name", .0.display())]
    Input(PathBuf),
    #[error("{}: {}", .0.display(), ASK)]
    There(PathBuf),
    #[error("{}: {}", .0.display(), .1)]
    Write(PathBuf, #[source] io::Error),
}

impl TableExport {
    /// Proposes a file.
    pub fn propose(&mut self, proposal: PathBuf) {
        self.proposal = proposal;
    }

    /// Returns the result of the last file, if this one was proposed for it: there are several
    /// lists that are written.
    #[must_use]
    pub fn told(&self) -> Option<&Result<String, String>> {
        self.told.as_ref().filter(|_| self.told_of == self.proposal)
    }

    /// The file without its end.
    #[must_use]
    pub fn file(&self) -> PathBuf {
        match self.path.trim() {
            "" => self.proposal.clone(),
            name => self.proposal.with_file_name(name),
        }
    }

    /// Writes bytes to the file of the name with an end of its own, in one step, and tells it;
    /// never over an input, over another file if that is asked for twice.
    pub fn save(&mut self, end: &str, bytes: &[u8], inputs: &[&Path]) {
        let saved = self.try_save(end, bytes, inputs);
        let told = saved.map(|path| path.display().to_string());
        self.told = Some(told.map_err(|error| error.to_string()));
        self.told_of.clone_from(&self.proposal);
    }

    fn try_save(
        &mut self,
        end: &str,
        bytes: &[u8],
        inputs: &[&Path],
    ) -> Result<PathBuf, OutputError> {
        let name = self.file();
        let has_end = name.extension().is_some_and(|e| e.eq_ignore_ascii_case(end));
        let mut path = name.into_os_string();
        if !has_end {
            path.push(format!(".{end}"));
        }
        let path = PathBuf::from(path);
        if inputs.iter().any(|input| ppum_file::is_same(input, &path)) {
            return Err(OutputError::Input(path));
        }
        if !self.replacing.allows(&path) {
            return Err(OutputError::There(path));
        }
        ppum_file::replace(&path, |out| out.write_all(bytes))
            .map_err(|error| OutputError::Write(path.clone(), error))?;
        Ok(path)
    }
}
