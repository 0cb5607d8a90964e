//! Changed texts of problems that have made place for others: the window keeps them for the next
//! time, beside those that another window has put aside meanwhile.

use std::path::Path;

use super::window_state::read_kept;
use crate::save_target::replace;
use crate::session::ProblemDraft;

const FILE: &str = "texts.json";

/// The texts that a window has put aside.
#[derive(Debug, Default)]
pub(super) struct StoredTexts {
    /// All of them, the newest last.
    pub(super) all: Vec<ProblemDraft>,
    /// Those that the file had from this window.
    written: Vec<ProblemDraft>,
}

/// The texts that are to be in the file from now on.
pub(super) struct TextsUpdate {
    all: Vec<ProblemDraft>,
    before: Vec<ProblemDraft>,
}

impl StoredTexts {
    /// The texts that are kept in a folder.
    ///
    /// # Errors
    /// A file that cannot be read, and where it is now.
    pub(super) fn read(folder: &Path) -> Result<Self, String> {
        let parse = |text: &str| serde_json::from_str(text).map_err(|error| error.to_string());
        let read: Result<Option<Vec<ProblemDraft>>, String> = read_kept(folder, FILE, parse);
        let told = |error| format!("changed texts of the last time cannot be read: {error}");
        let all = read.map_err(told)?.unwrap_or_default();
        Ok(Self { written: all.clone(), all })
    }

    /// Returns the texts to be written.
    pub(super) fn update(&mut self) -> TextsUpdate {
        let before = std::mem::replace(&mut self.written, self.all.clone());
        TextsUpdate { all: self.all.clone(), before }
    }
}

impl TextsUpdate {
    /// Writes the texts into a folder. Those that another window has put there stay.
    pub(super) fn write(self, folder: &Path) -> std::io::Result<()> {
        let there = StoredTexts::read(folder).unwrap_or_default().all;
        let foreign = there.into_iter().filter(|text| !self.before.contains(text));
        let mut all: Vec<_> = foreign.filter(|text| !self.all.contains(text)).collect();
        all.extend(self.all);
        let text = serde_json::to_string_pretty(&all).map_err(std::io::Error::other)?;
        replace(&folder.join(FILE), text.as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two windows at once: none takes away what the other one has put there.
    #[test]
    fn windows_keep_each_others_texts() {
        let folder = tempfile::tempdir().expect("a folder");
        let draft = |text: &str| ProblemDraft { text: text.into(), ..ProblemDraft::default() };
        let read = || StoredTexts::read(folder.path()).expect("readable");
        let write = |texts: &mut StoredTexts| texts.update().write(folder.path()).expect("written");
        let [mut one, mut other] = [read(), read()];
        one.all.push(draft("one"));
        write(&mut one);
        other.all.push(draft("other"));
        write(&mut other);
        write(&mut one);
        assert_eq!(read().all, [draft("other"), draft("one")]);
        one.all.clear();
        write(&mut one);
        write(&mut other);
        assert_eq!(read().all, [draft("other")]);
    }
}
