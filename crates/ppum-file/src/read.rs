//! Reading within limits.

use std::fs::{self, File, FileType, Metadata};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// Opens a regular file of at most `limit` bytes, as far as its length tells.
///
/// Anything else is refused before it is opened: a pipe would be waited for until somebody writes
/// to it.
///
/// # Errors
/// A folder, a device, a pipe or a socket; a longer file; whatever the system refuses.
pub fn open(path: &Path, limit: u64) -> io::Result<File> {
    must_be_regular(&fs::metadata(path)?)?;
    let file = File::open(path)?;
    let metadata = file.metadata()?;
    // it may be another one by now
    must_be_regular(&metadata)?;
    if metadata.len() > limit { Err(too_long(limit)) } else { Ok(file) }
}

/// The bytes of a regular file of at most `limit` bytes.
///
/// # Errors
/// As [`open`]; a file that turns out to be longer.
pub fn read(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    within(open(path, limit)?, limit)
}

/// The text of a regular file of at most `limit` bytes.
///
/// # Errors
/// As [`read()`]; bytes that are no UTF-8.
pub fn text(path: &Path, limit: u64) -> io::Result<String> {
    read(path, limit).and_then(utf8)
}

/// The bytes of `source` until its end, at most `limit` bytes: a file may say that it is empty, or
/// grow.
///
/// # Errors
/// More than `limit` bytes; whatever the source or the memory refuses.
pub fn within(source: impl Read, limit: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.take(limit.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit { Err(too_long(limit)) } else { Ok(bytes) }
}

/// As [`within`], of text.
///
/// # Errors
/// As [`within`]; bytes that are no UTF-8.
pub fn text_within(source: impl Read, limit: u64) -> io::Result<String> {
    within(source, limit).and_then(utf8)
}

fn utf8(bytes: Vec<u8>) -> io::Result<String> {
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to() + 1;
        let message = format!("it is no text in UTF-8, from byte {at} on");
        io::Error::new(ErrorKind::InvalidData, message)
    })
}

pub(crate) fn too_long(limit: u64) -> io::Error {
    let limit = match limit {
        l if l >= 1 << 30 && l.is_multiple_of(1 << 30) => format!("{} GiB", l >> 30),
        l if l >= 1 << 20 && l.is_multiple_of(1 << 20) => format!("{} MiB", l >> 20),
        l => format!("{l} bytes"),
    };
    let message = format!("it has more than {limit}, the most that are read");
    io::Error::new(ErrorKind::FileTooLarge, message)
}

fn must_be_regular(metadata: &Metadata) -> io::Result<()> {
    match metadata.file_type() {
        kind if kind.is_file() => Ok(()),
        kind if kind.is_dir() => Err(io::Error::new(ErrorKind::IsADirectory, "it is a folder")),
        kind => {
            let message = format!("it is {}, not a regular file", word(kind));
            Err(io::Error::new(ErrorKind::InvalidInput, message))
        }
    }
}

#[cfg(unix)]
fn word(kind: FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt as _;
    match () {
        () if kind.is_fifo() => "a pipe",
        () if kind.is_socket() => "a socket",
        () => "a device",
    }
}

#[cfg(not(unix))]
fn word(_: FileType) -> &'static str {
    "something else"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_within_their_limit() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.txt");
        fs::write(&path, "σ = 1").expect("written");
        assert_eq!(text(&path, 6).expect("short enough"), "σ = 1");
        for limit in [0, 1, 5] {
            assert_eq!(read(&path, limit).expect_err("too long").kind(), ErrorKind::FileTooLarge);
        }
        fs::write(&path, b"a\xff").expect("written");
        let error = text(&path, 10).expect_err("no text").to_string();
        assert_eq!(error, "it is no text in UTF-8, from byte 2 on");
        assert_eq!(read(&path, 10).expect("bytes"), b"a\xff");
    }

    /// A file with a hole, which takes no room and would take all memory.
    #[cfg(unix)]
    #[test]
    fn long_files_are_not_begun() {
        let path = tempfile::NamedTempFile::new().expect("a file").into_temp_path();
        File::create(&path).and_then(|file| file.set_len(1 << 40)).expect("a hole");
        assert!(open(&path, 1 << 40).is_ok());
        assert_eq!(read(&path, 1 << 39).expect_err("long").kind(), ErrorKind::FileTooLarge);
    }

    /// The limit holds whatever a source says of itself.
    #[test]
    fn sources_without_an_end() {
        assert_eq!(within(io::repeat(1).take(9), 9).expect("all"), [1; 9]);
        for limit in [0, 9, 1 << 20] {
            let error = text_within(io::repeat(b'a'), limit).expect_err("endless");
            assert_eq!(error.kind(), ErrorKind::FileTooLarge);
        }
        assert!(too_long(3 << 20).to_string().contains("3 MiB"));
        assert!(too_long(4 << 30).to_string().contains("4 GiB"));
    }

    #[test]
    fn folders_are_no_files() {
        let folder = tempfile::tempdir().expect("a folder");
        let error = read(folder.path(), 10).expect_err("a folder");
        assert_eq!(error.to_string(), "it is a folder");
        assert_eq!(
            open(&folder.path().join("b"), 10).expect_err("none").kind(),
            ErrorKind::NotFound
        );
    }

    #[cfg(unix)]
    #[test]
    fn devices_pipes_and_sockets_are_refused_at_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let [pipe, socket, link] = ["pipe", "socket", "link"].map(|name| folder.path().join(name));
        let made = std::process::Command::new("mkfifo").arg(&pipe).status().expect("it runs");
        assert!(made.success());
        let _socket = std::os::unix::net::UnixListener::bind(&socket).expect("a socket");
        std::os::unix::fs::symlink(&pipe, &link).expect("a link");
        let zero = Path::new("/dev/zero").to_owned();
        for (path, kind) in
            [(zero, "a device"), (pipe, "a pipe"), (socket, "a socket"), (link, "a pipe")]
        {
            let error = read(&path, 1 << 20).expect_err("no file").to_string();
            assert_eq!(error, format!("it is {kind}, not a regular file"));
        }
    }

    /// Files of the kernel say that they are empty.
    #[cfg(target_os = "linux")]
    #[test]
    fn files_that_lie_about_their_length() {
        let path = Path::new("/proc/self/status");
        assert_eq!(fs::metadata(path).expect("it is there").len(), 0);
        assert!(text(path, 1 << 20).expect("short").contains("Name:"));
        assert_eq!(read(path, 10).expect_err("longer").kind(), ErrorKind::FileTooLarge);
    }
}
