//! Reading parts of a file.

use std::fs::File;
use std::io;
use std::path::Path;

use crate::read::{open, too_long};

/// A file that is read in parts. It remains the opened file even if another file replaces it.
#[derive(Debug)]
pub struct RangedFile {
    file: File,
}

impl RangedFile {
    /// Opens a regular file of at most `limit` bytes.
    ///
    /// # Errors
    /// As [`open`].
    pub fn open(path: &Path, limit: u64) -> io::Result<Self> {
        open(path, limit).map(Self::of)
    }

    pub(crate) fn of(file: File) -> Self {
        Self { file }
    }

    pub(crate) fn file(&self) -> &File {
        &self.file
    }

    /// The present length of the file in bytes; it may grow.
    ///
    /// # Errors
    /// The file is longer than `limit`; errors of the system.
    pub fn length(&self, limit: u64) -> io::Result<u64> {
        let length = self.file.metadata()?.len();
        if length > limit { Err(too_long(limit)) } else { Ok(length) }
    }

    /// Fills `buffer` with the bytes from `at` on.
    ///
    /// # Errors
    /// The file ends before the buffer is full; errors of the system.
    pub fn read(&self, at: u64, buffer: &mut [u8]) -> io::Result<()> {
        read_at(&self.file, at, buffer)
    }
}

#[cfg(unix)]
fn read_at(file: &File, at: u64, buffer: &mut [u8]) -> io::Result<()> {
    std::os::unix::fs::FileExt::read_exact_at(file, buffer, at)
}

#[cfg(windows)]
fn read_at(file: &File, mut at: u64, mut buffer: &mut [u8]) -> io::Result<()> {
    use std::os::windows::fs::FileExt as _;
    while !buffer.is_empty() {
        match file.seek_read(buffer, at)? {
            0 => return Err(io::ErrorKind::UnexpectedEof.into()),
            count => {
                at += count as u64;
                buffer = &mut buffer[count..];
            }
        }
    }
    Ok(())
}

/// Systems without positioned reads have no threads either, so seeking is safe.
#[cfg(not(any(unix, windows)))]
fn read_at(mut file: &File, at: u64, buffer: &mut [u8]) -> io::Result<()> {
    use std::io::{Read as _, Seek as _};
    file.seek(io::SeekFrom::Start(at))?;
    file.read_exact(buffer)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a");
        std::fs::write(&path, "0123456789").expect("written");
        assert!(RangedFile::open(&path, 9).is_err());
        let file = RangedFile::open(&path, 10).expect("short enough");
        let mut part = [0; 3];
        for (at, expected) in [(0, b"012"), (7, b"789"), (2, b"234")] {
            file.read(at, &mut part).expect("there");
            assert_eq!(&part, expected);
        }
        assert_eq!(
            file.read(8, &mut part).expect_err("short").kind(),
            io::ErrorKind::UnexpectedEof
        );
        crate::replace(&path, |out| out.write_all(b"ab")).expect("written");
        assert_eq!(file.length(10).expect("known"), 10);
        assert!(file.length(9).is_err());
        file.read(4, &mut part).expect("the old file is still open");
        assert_eq!(&part, b"456");
    }
}
