//! Files on their way to their place: `.NAME.PROCESS-COUNT.part` beside a target of that name.
//!
//! The writer holds a lock on its part file for as long as it lives, whatever becomes of it. So a
//! part file whose lock can be had belongs to nobody any more, and who writes the same target
//! removes it.

use std::collections::BTreeSet;
use std::ffi::{OsStr, OsString};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The part files and locks of this program. Whoever makes, moves or removes one holds it.
static LIVE: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

pub(crate) fn live() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    // the set is right after any panic: it changes in one step
    LIVE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all part files and locks of this program, which is about to end: none is made, and none
/// takes its place, as long as the result is kept.
#[must_use = "files can be written again once it is dropped"]
pub fn abandon() -> WriteLock {
    let mut live = live();
    for path in std::mem::take(&mut *live) {
        // nothing better can be done about a file that cannot be removed
        let _ = fs::remove_file(path);
    }
    WriteLock(live)
}

/// All writing of this program stands still.
#[derive(Debug)]
pub struct WriteLock(
    #[expect(dead_code, reason = "it is held")] MutexGuard<'static, BTreeSet<PathBuf>>,
);

/// A file that disappears unless it has taken its target's place.
#[derive(Debug)]
pub(crate) struct PartFile {
    path: PathBuf,
    file: File,
}

/// Most names that are tried: others may have taken some.
const MOST_NAMES: u32 = 1000;

impl PartFile {
    /// A new file next to `target`, never one that exists. Those of dead programs are removed.
    pub(crate) fn create(target: &Path) -> io::Result<Self> {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let name = target.file_name().ok_or(ErrorKind::InvalidFilename)?;
        let folder = existing_folder(target)?;
        let mut live = live();
        remove_dead(folder, name);
        for _ in 0..MOST_NAMES {
            let number = COUNT.fetch_add(1, Ordering::Relaxed);
            let path = target.with_file_name(part_name(name, number));
            if let Some(file) = created(&path)? {
                live.insert(path.clone());
                return Ok(Self { path, file });
            }
        }
        Err(io::Error::new(ErrorKind::AlreadyExists, "other programs write it all the time"))
    }

    pub(crate) fn file(&self) -> &File {
        &self.file
    }

    /// Takes the place of `target`.
    pub(crate) fn rename(self, target: &Path) -> io::Result<()> {
        let mut live = live();
        fs::rename(&self.path, target)?;
        live.remove(&self.path);
        Ok(())
    }
}

impl Drop for PartFile {
    fn drop(&mut self) {
        if live().remove(&self.path) {
            // nothing better can be done about a file that cannot be removed
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// The folder that a file lies in.
pub(crate) fn folder(target: &Path) -> &Path {
    target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Returns the folder if it exists.
pub(crate) fn existing_folder(target: &Path) -> io::Result<&Path> {
    let folder = folder(target);
    if folder.is_dir() {
        return Ok(folder);
    }
    let message = format!("there is no folder {}", folder.display());
    Err(io::Error::new(ErrorKind::NotFound, message))
}

fn part_name(name: &OsStr, number: u32) -> OsString {
    let mut hidden = OsString::from(".");
    hidden.push(name);
    hidden.push(format!(".{}-{number}.part", std::process::id()));
    hidden
}

/// True if a part file of a target called `name` may have this name.
fn is_part_of(found: &OsStr, name: &OsStr) -> bool {
    let middle = || {
        let rest = found.as_encoded_bytes().strip_prefix(b".")?;
        rest.strip_prefix(name.as_encoded_bytes())?.strip_prefix(b".")?.strip_suffix(b".part")
    };
    let is_number = |text: &[u8]| !text.is_empty() && text.iter().all(u8::is_ascii_digit);
    middle().is_some_and(|middle| {
        let mut numbers = middle.split(|&byte| byte == b'-');
        numbers.clone().count() == 2 && numbers.all(is_number)
    })
}

/// A new file with its lock; none if somebody else has the name, or took it for dead before it
/// was locked.
fn created(path: &Path) -> io::Result<Option<File>> {
    let file = match OpenOptions::new().write(true).create_new(true).open(path) {
        Err(e) if e.kind() == ErrorKind::AlreadyExists => return Ok(None),
        opened => opened?,
    };
    // where the system has no locks nobody can have this one, and so nobody removes the file
    let is_taken = matches!(file.try_lock(), Err(TryLockError::WouldBlock));
    Ok((!is_taken && is_at(&file, path)).then_some(file))
}

/// Removes the part files that no program is writing of a target called `name`.
fn remove_dead(folder: &Path, name: &OsStr) {
    // a folder that cannot be listed is told where a file is made in it
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        if is_part_of(&entry.file_name(), name) {
            remove_if_dead(&entry.path());
        }
    }
}

/// Removes a regular file whose lock can be had; false if somebody holds the lock.
pub(crate) fn remove_if_dead(path: &Path) -> bool {
    let is_file = fs::symlink_metadata(path).is_ok_and(|data| data.is_file());
    let Some(file) = is_file.then(|| File::open(path).ok()).flatten() else { return true };
    let locked = file.try_lock();
    if locked.is_ok() && is_at(&file, path) {
        // nothing better can be done about a file that cannot be removed
        let _ = fs::remove_file(path);
    }
    !matches!(locked, Err(TryLockError::WouldBlock))
}

/// True if `path` itself, and no link there, is the open file.
#[cfg(unix)]
pub(crate) fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let key = |data: fs::Metadata| (data.dev(), data.ino());
    let [open, there] = [file.metadata(), fs::symlink_metadata(path)].map(|data| data.map(key));
    open.is_ok_and(|open| there.is_ok_and(|there| there == open))
}

#[cfg(not(unix))]
pub(crate) fn is_at(_: &File, path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|data| data.is_file())
}

#[cfg(test)]
mod tests;
