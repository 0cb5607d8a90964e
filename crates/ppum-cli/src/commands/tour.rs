//! Command lines that the program runs one after the other, on problem files of its own.

use std::ffi::OsString;
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail, ensure};

use crate::output::Output;
use crate::target;

/// Files that a tour writes, and commands that work on them. In command lines `@` stands for the folder.
pub(crate) struct Tour<'a> {
    /// Where everything is written.
    pub(crate) folder: &'a Path,
    /// Names and texts of files: problems, and the points they name.
    pub(crate) files: &'a [(&'a str, &'a str)],
    /// The command lines.
    pub(crate) lines: Vec<&'a str>,
}

/// Runs a command line, given word by word.
pub(crate) type Run<'a> = &'a dyn Fn(Vec<OsString>, &mut Output) -> anyhow::Result<()>;

impl Tour<'_> {
    /// Makes the folder; refuses before any work what could not be written, and files that are the user's.
    pub(crate) fn check(&self) -> anyhow::Result<()> {
        for (name, text) in self.files {
            check_file(&self.folder.join(name), text)?;
        }
        target::make_folder(self.folder)?;
        let problems: Vec<PathBuf> =
            self.files.iter().map(|(name, _)| self.folder.join(name)).collect();
        for name in self.pictures() {
            let inputs = problems.iter().map(PathBuf::as_path);
            target::check(&self.folder.join(name), target::Kind::Picture, inputs)?;
        }
        Ok(())
    }

    /// Writes the files.
    pub(crate) fn write_files(&self, out: &mut Output) -> anyhow::Result<()> {
        for (name, text) in self.files {
            let path = self.folder.join(name);
            target::save(&path, |out| out.write_all(text.as_bytes()))?;
            writeln!(out, "wrote {}", path.display())?;
        }
        Ok(())
    }

    /// Runs the commands, each told before.
    pub(crate) fn run(&self, out: &mut Output, run: Run<'_>) -> anyhow::Result<()> {
        for line in &self.lines {
            writeln!(out, "\n$ {}", self.shown(line))?;
            out.flush()?;
            run(self.words(line), out)?;
        }
        Ok(())
    }

    /// The pictures that the commands write.
    fn pictures(&self) -> impl Iterator<Item = &str> {
        let words = self.lines.iter().flat_map(|line| line.split(' '));
        words.filter_map(|word| word.strip_prefix("@/")).filter(|word| word.ends_with(".png"))
    }

    /// A command line, word by word.
    fn words(&self, line: &str) -> Vec<OsString> {
        let word = |word: &str| match word.strip_prefix("@/") {
            Some(name) => self.folder.join(name).into_os_string(),
            None => word.into(),
        };
        ["ppum"].into_iter().chain(line.split(' ')).map(word).collect()
    }

    /// A command line as one would type it, with the program as this one was called.
    pub(crate) fn shown(&self, line: &str) -> String {
        let program = std::env::args_os().next().unwrap_or_else(|| "ppum".into());
        let quoted = |word: &OsString| {
            let text = word.to_string_lossy();
            if text.contains(' ') { format!("'{text}'") } else { text.into_owned() }
        };
        let words = self.words(line);
        [&program].into_iter().chain(&words[1..]).map(quoted).collect::<Vec<_>>().join(" ")
    }
}

/// Refuses a file that is not the tour's own.
fn check_file(path: &Path, text: &str) -> anyhow::Result<()> {
    let own = "give another folder with -o, or remove it";
    match ppum_file::text(path, text.len() as u64) {
        Ok(found) => ensure!(found == text, "{}: was edited; {own}", path.display()),
        Err(e) if matches!(e.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => {}
        Err(e) if matches!(e.kind(), ErrorKind::FileTooLarge | ErrorKind::InvalidData) => {
            bail!("{}: is another file; {own}", path.display())
        }
        Err(e) => return Err(e).with_context(|| format!("cannot read {}", path.display())),
    }
    Ok(())
}
