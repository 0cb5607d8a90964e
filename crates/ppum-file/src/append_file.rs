//! Files that grow: bytes are appended, then published by a small change of existing bytes.
//!
//! A file of this kind records its length in a few bytes at its start (in HDF5 the superblock).
//! Bytes beyond that length have no meaning; a killed program may leave some. An addition is
//! written beyond the recorded end and reaches the disk before the record changes, so a reader
//! sees all of it or nothing.

use std::fs::OpenOptions;
use std::io::{self, ErrorKind, Seek as _, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::lock::TargetLock;
use crate::part::{is_at, live};
use crate::ranged::RangedFile;
use crate::write::{replace_locked, replaceable, resolve};

/// A file that only this program may write while this value exists. Others may read it at any time.
#[derive(Debug)]
pub struct AppendFile {
    file: RangedFile,
    target: PathBuf,
    _lock: TargetLock,
}

impl AppendFile {
    /// Begins a file as [`replace`](crate::replace) does.
    ///
    /// # Errors
    /// As those of [`replace`](crate::replace); another run is writing the file.
    pub fn begin<E: From<io::Error>>(
        path: &Path,
        write: impl FnOnce(&mut dyn Write) -> Result<(), E>,
    ) -> Result<Self, E> {
        let target = resolve(path)?;
        let lock = TargetLock::acquire(&target)?;
        replace_locked(&target, write)?;
        Ok(Self::locked(target, lock)?)
    }

    /// Opens a file that was begun before.
    ///
    /// # Errors
    /// The file does not exist, is not a regular file or has no write permission; another run is
    /// writing it.
    pub fn open(path: &Path) -> io::Result<Self> {
        let target = resolve(path)?;
        if replaceable(&target)?.is_none() {
            return Err(ErrorKind::NotFound.into());
        }
        let lock = TargetLock::acquire(&target)?;
        Self::locked(target, lock)
    }

    fn locked(target: PathBuf, lock: TargetLock) -> io::Result<Self> {
        let file = OpenOptions::new().read(true).write(true).open(&target)?;
        Ok(Self { file: RangedFile::of(file), target, _lock: lock })
    }

    /// The file, to read from.
    #[must_use]
    pub fn file(&self) -> &RangedFile {
        &self.file
    }

    /// Truncates the file to `end` bytes, appends `addition` and flushes both to the disk.
    ///
    /// # Errors
    /// The disk is full, or another error of the system; the file is then truncated to `end` if the
    /// system allows. The file is shorter than `end`, or another file has replaced it.
    pub fn append(&mut self, end: u64, addition: &[u8]) -> io::Result<()> {
        // a terminating program releases its lock and must not write after that
        let _live = live();
        if !is_at(self.file.file(), &self.target) || self.file.length(u64::MAX)? < end {
            let message =
                "since this run began it was removed or cut, or another file took its place";
            return Err(io::Error::other(message));
        }
        let written = self.try_append(end, addition);
        if written.is_err() {
            // bytes beyond the end have no meaning, they only take space
            let _ = self.file.file().set_len(end);
        }
        written
    }

    fn try_append(&mut self, end: u64, addition: &[u8]) -> io::Result<()> {
        let mut file = self.file.file();
        file.set_len(end)?;
        file.seek(SeekFrom::Start(end))?;
        file.write_all(addition)?;
        file.sync_all()
    }

    /// Overwrites the few bytes at `at` that publish an addition, and flushes them to the disk.
    /// They must not cross a multiple of 512 bytes: a disk writes such a block atomically.
    ///
    /// # Errors
    /// Errors of the system. Both the old and the new bytes describe a valid file.
    pub fn publish(&mut self, at: u64, bytes: &[u8]) -> io::Result<()> {
        let _live = live();
        let mut file = self.file.file();
        file.seek(SeekFrom::Start(at))?;
        file.write_all(bytes)?;
        file.sync_data()
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::{check, replace};

    fn begun(path: &Path) -> AppendFile {
        let begun: io::Result<AppendFile> = AppendFile::begin(path, |out| out.write_all(b"4:head"));
        begun.expect("begun")
    }

    #[test]
    fn additions_stand_behind_the_end() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a");
        let mut file = begun(&path);
        file.append(6, b"one").expect("appended");
        file.append(6, b"two.").expect("what was not published is gone");
        file.publish(0, b"8").expect("published");
        assert_eq!(fs::read(&path).expect("there"), b"8:headtwo.");
        drop(file);
        let mut file = AppendFile::open(&path).expect("opened");
        file.append(10, b"!").expect("appended");
        let mut all = [0; 11];
        file.file().read(0, &mut all).expect("there");
        assert_eq!(&all, b"8:headtwo.!");
        drop(file);
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1);
    }

    /// Nobody else appends, begins it again or replaces it.
    #[test]
    fn one_writer_at_a_time() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a");
        let file = begun(&path);
        let replaced = || replace(&path, |out| out.write_all(b"x"));
        let again = || AppendFile::begin::<io::Error>(&path, |out| out.write_all(b"x")).map(drop);
        let refused = [check(&path), replaced(), again(), AppendFile::open(&path).map(drop)];
        for error in refused.map(|result| result.expect_err("it is taken")) {
            assert!(error.to_string().contains("another run"), "{error}");
        }
        drop(file);
        check(&path).expect("nobody has it");
        assert_eq!(fs::read(&path).expect("there"), b"4:head");
    }

    #[cfg(unix)]
    #[test]
    fn another_file_at_its_place() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        let mut file = begun(&at("a"));
        fs::write(at("b"), "precious").expect("written");
        fs::rename(at("b"), at("a")).expect("renamed");
        let error = file.append(6, b"one").expect_err("another file").to_string();
        assert!(error.contains("took its place"), "{error}");
        assert_eq!(fs::read(at("a")).expect("there"), b"precious");
    }

    #[test]
    fn files_that_cannot_be_continued() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        let kind = |path: &Path| AppendFile::open(path).expect_err("refused").kind();
        assert_eq!(kind(&at("none")), ErrorKind::NotFound);
        assert_eq!(kind(folder.path()), ErrorKind::InvalidInput);
        fs::write(at("protected"), "precious").expect("written");
        let mut permissions = fs::metadata(at("protected")).expect("there").permissions();
        permissions.set_readonly(true);
        fs::set_permissions(at("protected"), permissions).expect("protected");
        assert_eq!(kind(&at("protected")), ErrorKind::InvalidInput);
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1, "no lock is left");
    }

    /// By a link the file itself is meant, and has one lock.
    #[cfg(unix)]
    #[test]
    fn links_lead_to_one_lock() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        std::os::unix::fs::symlink("a", at("link")).expect("a link");
        let mut file = begun(&at("link"));
        assert_eq!(AppendFile::open(&at("a")).expect_err("taken").kind(), ErrorKind::ResourceBusy);
        file.append(6, b"one").expect("appended");
        assert_eq!(fs::read(at("a")).expect("there"), b"4:headone");
    }
}
