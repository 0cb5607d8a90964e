//! Files that are there already are replaced only for those who ask for it twice.

use std::path::{Path, PathBuf};

/// The file that was asked for, or written, last.
#[derive(Clone, Debug, Default)]
pub struct ReplacedFile(Option<PathBuf>);

/// The warning about a file that exists already.
pub const ASK: &str = "this file exists; save again to replace it";

impl ReplacedFile {
    /// True if a file may be written: it is not there yet, was written before, or is asked for the
    /// second time.
    pub fn allows(&mut self, path: &Path) -> bool {
        let is_known = self.is(path);
        self.0 = Some(path.to_owned());
        is_known || !path.exists()
    }

    /// True if this is the file that was asked for, or written, last.
    #[must_use]
    pub fn is(&self, path: &Path) -> bool {
        self.0.as_deref() == Some(path)
    }

    /// Forgets what was asked for.
    pub fn forget(&mut self) {
        self.0 = None;
    }
}
