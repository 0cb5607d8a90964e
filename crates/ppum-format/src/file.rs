//! Datasets as files: reading, and writing that replaces a file completely or not at all.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use ppum::dataset::Dataset;

use crate::error::{ReadError, WriteError};

/// Reads a dataset from a file.
///
/// # Errors
///
/// [`ReadError`]; the dataset returned has passed [`Dataset::check`].
pub fn read(path: &Path) -> Result<Dataset, ReadError> {
    let bytes = bytes(path).map_err(|e| ReadError::io(path, e))?;
    crate::from_bytes(bytes)
}

/// Signature at the start of an HDF5 file, or after a block of 512, 1024 or 2048 bytes of the user's.
const SIGNATURE: &[u8] = b"\x89HDF\r\n\x1a\n";
const PLACES: [usize; 4] = [0, 512, 1024, 2048];

/// The bytes of a file; of one that is no HDF5 file, and may have no end, the first.
fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    let mut file = File::open(path)?;
    let mut bytes = Vec::new();
    let head = (PLACES[3] + SIGNATURE.len()) as u64;
    (&mut file).take(head).read_to_end(&mut bytes)?;
    let begins = |&at: &usize| bytes.get(at..).is_some_and(|rest| rest.starts_with(SIGNATURE));
    if PLACES.iter().any(begins) {
        file.read_to_end(&mut bytes)?;
    }
    Ok(bytes)
}

/// Writes a dataset to a file, completely or not at all.
///
/// The bytes go to a temporary file in the same folder, reach the disk, and then take the place of
/// `path` in one step; a reader sees the old file or the new one. An existing file keeps its
/// permissions, a symbolic link keeps pointing at the file that is replaced.
///
/// # Errors
///
/// [`WriteError`], and then whatever stood at `path` still stands there unchanged. A file without
/// write permission, a folder or a device is not replaced.
pub fn write(dataset: &Dataset, path: &Path) -> Result<(), WriteError> {
    let bytes = crate::to_bytes(dataset)?;
    let target = resolve(path)?;
    let permissions = replaceable(&target)?;
    let temporary = Temporary::create(&target).map_err(|e| WriteError::io(path, e))?;
    temporary.replace(&target, &bytes, permissions).map_err(|e| WriteError::io(path, e))
}

/// The file a symbolic link leads to, also where there is none yet; else the path itself.
fn resolve(path: &Path) -> Result<PathBuf, WriteError> {
    let mut target = path.to_owned();
    // as many links as Linux follows
    for _ in 0..40 {
        match fs::read_link(&target) {
            Ok(link) => target = target.parent().unwrap_or(Path::new("")).join(link),
            Err(_) => return Ok(target),
        }
    }
    Err(WriteError::Protected { path: path.to_owned(), reason: "is a ring of symbolic links" })
}

/// The permissions of the file at `target`, `None` if there is none yet.
fn replaceable(target: &Path) -> Result<Option<fs::Permissions>, WriteError> {
    let protected = |reason| Err(WriteError::Protected { path: target.to_owned(), reason });
    match fs::metadata(target) {
        Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(e) => Err(WriteError::io(target, e)),
        Ok(data) if data.is_dir() => protected("is a folder; give a file name"),
        Ok(data) if !data.is_file() => protected("is not a regular file"),
        Ok(data) if data.permissions().readonly() => protected("is write-protected"),
        Ok(data) => Ok(Some(data.permissions())),
    }
}

/// A file that disappears unless it has taken its target's place.
struct Temporary {
    path: PathBuf,
    file: File,
    done: bool,
}

impl Temporary {
    /// A new file next to `target`; never one that exists.
    fn create(target: &Path) -> io::Result<Self> {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let name = target.file_name().ok_or(io::ErrorKind::InvalidFilename)?;
        let mut hidden = std::ffi::OsString::from(".");
        hidden.push(name);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        hidden.push(format!(".{}-{count}.part", std::process::id()));
        let path = target.with_file_name(hidden);
        let file = OpenOptions::new().write(true).create_new(true).open(&path)?;
        Ok(Self { path, file, done: false })
    }

    fn replace(
        mut self,
        target: &Path,
        bytes: &[u8],
        permissions: Option<fs::Permissions>,
    ) -> io::Result<()> {
        self.file.write_all(bytes)?;
        if let Some(permissions) = permissions {
            self.file.set_permissions(permissions)?;
        }
        self.file.sync_all()?;
        fs::rename(&self.path, target)?;
        self.done = true;
        sync_folder(target);
        Ok(())
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if !self.done {
            // nothing better can be done about a file that cannot be removed
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Makes the new name last through a power failure, where the system can. The file is complete and
/// in place by now, so a folder that cannot be synchronised is no error.
fn sync_folder(target: &Path) {
    let folder = match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
}
