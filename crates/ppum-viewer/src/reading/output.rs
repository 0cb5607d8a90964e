//! Files that readings are written to.

use std::io;
use std::path::{Path, PathBuf};

use crate::replacing::{ASK, Replacing};

/// The name of the next file, and what became of the last one.
#[derive(Debug, Default)]
pub struct Output {
    /// The name without its end.
    pub path: String,
    /// What became of the last file: its name, or the reason why there is none.
    pub told: Option<Result<String, String>>,
    /// The file that was asked for last.
    replacing: Replacing,
}

/// A file that is not written.
#[derive(Debug, thiserror::Error)]
enum OutputError {
    #[error("write the file's name first")]
    NoName,
    #[error("{}: this is the dataset that is shown; choose another name", .0.display())]
    Input(PathBuf),
    #[error("{}: {}", .0.display(), ASK)]
    There(PathBuf),
    #[error("{}: {}", .0.display(), .1)]
    Write(PathBuf, #[source] io::Error),
}

impl Output {
    /// Writes bytes to the file of the name with an end of its own, in one step, and tells it;
    /// never over an input, over another file if that is asked for twice.
    pub fn save(&mut self, end: &str, bytes: &[u8], inputs: &[&Path]) {
        let saved = self.try_save(end, bytes, inputs);
        let told = saved.map(|path| path.display().to_string());
        self.told = Some(told.map_err(|error| error.to_string()));
    }

    fn try_save(
        &mut self,
        end: &str,
        bytes: &[u8],
        inputs: &[&Path],
    ) -> Result<PathBuf, OutputError> {
        let name = self.path.trim();
        if name.is_empty() {
            return Err(OutputError::NoName);
        }
        let has_end = Path::new(name).extension().is_some_and(|e| e.eq_ignore_ascii_case(end));
        let name = if has_end { name.to_owned() } else { format!("{name}.{end}") };
        let path = PathBuf::from(name);
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
