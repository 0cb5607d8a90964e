//! Locks that let one program at a time write a file: `.NAME.lock` beside the target NAME.
//!
//! The writer locks that file, not the target: other programs, such as h5py, lock the files that
//! they read, and could not read a locked target. A lock file that can be locked has no owner.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use crate::part::{existing_folder, is_at, live, remove_if_dead};

/// The exclusive right to write a target, until this is dropped or the program ends or is killed.
#[derive(Debug)]
pub(crate) struct TargetLock {
    path: PathBuf,
    file: File,
}

/// Most attempts: the last owner may remove the file between its opening and its locking.
const MOST_ATTEMPTS: u32 = 1000;

impl TargetLock {
    /// Acquires the lock of `target`, which must not be a link.
    ///
    /// # Errors
    /// Another program, or another part of this one, holds it; the folder takes no files.
    pub(crate) fn acquire(target: &Path) -> io::Result<Self> {
        let path = lock_path(target)?;
        existing_folder(target)?;
        let mut live = live();
        for _ in 0..MOST_ATTEMPTS {
            let file = OpenOptions::new().write(true).create(true).truncate(false).open(&path)?;
            if matches!(file.try_lock(), Err(TryLockError::WouldBlock)) {
                return Err(taken());
            }
            // without file locks on this system nobody else can hold this one
            if is_at(&file, &path) {
                live.insert(path.clone());
                return Ok(Self { path, file });
            }
        }
        Err(taken())
    }
}

impl Drop for TargetLock {
    fn drop(&mut self) {
        if live().remove(&self.path) && is_at(&self.file, &self.path) {
            // a file that cannot be removed may stay: without an owner it has no effect
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Refuses a target whose lock is held, and removes a lock file without an owner.
pub(crate) fn refuse_taken(target: &Path) -> io::Result<()> {
    if remove_if_dead(&lock_path(target)?) { Ok(()) } else { Err(taken()) }
}

fn lock_path(target: &Path) -> io::Result<PathBuf> {
    let mut hidden = OsString::from(".");
    hidden.push(target.file_name().ok_or(ErrorKind::InvalidFilename)?);
    hidden.push(".lock");
    Ok(target.with_file_name(hidden))
}

fn taken() -> io::Error {
    let message = "it is being written by another run; wait for its end, or stop it";
    io::Error::new(ErrorKind::ResourceBusy, message)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_at_a_time() {
        let folder = tempfile::tempdir().expect("a folder");
        let target = folder.path().join("a");
        let lock = TargetLock::acquire(&target).expect("nobody has it");
        for error in [TargetLock::acquire(&target).map(drop), refuse_taken(&target)] {
            assert_eq!(error.expect_err("it is taken").kind(), ErrorKind::ResourceBusy);
        }
        assert!(refuse_taken(&folder.path().join("b")).is_ok());
        drop(lock);
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0);
        assert!(TargetLock::acquire(&target).is_ok());
    }

    /// Its owner was killed.
    #[test]
    fn a_lock_of_nobody() {
        let folder = tempfile::tempdir().expect("a folder");
        let target = folder.path().join("a");
        let attempts: [fn(&Path) -> io::Result<()>; 2] =
            [refuse_taken, |target| TargetLock::acquire(target).map(drop)];
        for attempt in attempts {
            fs::write(folder.path().join(".a.lock"), "").expect("written");
            attempt(&target).expect("nobody has it");
            assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0);
        }
    }

    #[test]
    fn folders_that_are_not_there() {
        let error = TargetLock::acquire(Path::new("nowhere/a")).expect_err("no folder");
        assert!(error.to_string().contains("there is no folder nowhere"), "{error}");
    }
}
