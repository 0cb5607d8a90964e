//! Writing that replaces a file completely or not at all.

use std::fs::{self, File, Permissions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use crate::lock::refuse_taken;
use crate::part::{PartFile, folder};

/// Writes a file by `write`, completely or not at all.
///
/// The bytes go to a part file in the same folder, reach the disk, and then take the place of
/// `path` in one step; a reader sees the old file or the new one. An existing file keeps its
/// permissions, a symbolic link keeps pointing at the file that is replaced, and what else is a
/// hard link to that file keeps the old bytes. Part files of the same target that dead programs
/// have left are removed.
///
/// # Errors
/// Those of `write`, and of the system; a folder, a device, a file without write permission, one
/// that [grows](crate::AppendFile) just now. Whatever stood at `path` then still stands there
/// unchanged, and no part file is left.
pub fn replace<E: From<io::Error>>(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> Result<(), E>,
) -> Result<(), E> {
    let target = resolve(path)?;
    refuse_taken(&target)?;
    replace_locked(&target, write)
}

/// Replaces a target that is no link, and that no other process may write.
pub(crate) fn replace_locked<E: From<io::Error>>(
    target: &Path,
    write: impl FnOnce(&mut dyn Write) -> Result<(), E>,
) -> Result<(), E> {
    let permissions = replaceable(target)?;
    let part = PartFile::create(target)?;
    let mut out = BufWriter::with_capacity(1 << 16, part.file());
    write(&mut out)?;
    out.flush()?;
    drop(out);
    finish(part, target, permissions)?;
    Ok(())
}

/// Says whether [`replace`] could write to `path`, by making a part file there and removing it
/// again.
///
/// # Errors
/// As those of [`replace`].
pub fn check(path: &Path) -> io::Result<()> {
    let target = resolve(path)?;
    refuse_taken(&target)?;
    replaceable(&target)?;
    PartFile::create(&target).map(drop)
}

fn finish(part: PartFile, target: &Path, permissions: Option<Permissions>) -> io::Result<()> {
    if let Some(permissions) = permissions {
        part.file().set_permissions(permissions)?;
    }
    part.file().sync_all()?;
    part.rename(target)?;
    sync_folder(target);
    Ok(())
}

/// The file a symbolic link leads to, also where there is none yet; else the path itself.
pub(crate) fn resolve(path: &Path) -> io::Result<PathBuf> {
    let mut target = path.to_owned();
    // as many links as Linux follows
    for _ in 0..40 {
        match fs::read_link(&target) {
            Ok(link) => target = target.parent().unwrap_or(Path::new("")).join(link),
            Err(_) => return Ok(target),
        }
    }
    Err(refused("it is a ring of symbolic links"))
}

/// The permissions of the file at `target`, `None` if there is none yet.
pub(crate) fn replaceable(target: &Path) -> io::Result<Option<Permissions>> {
    match fs::metadata(target) {
        Err(e) if e.kind() == ErrorKind::NotFound => Ok(None),
        Err(e) => Err(e),
        Ok(data) if data.is_dir() => Err(refused("it is a folder; give a file name")),
        Ok(data) if !data.is_file() => Err(refused("it is not a regular file")),
        Ok(data) if data.permissions().readonly() => Err(refused("it is write-protected")),
        Ok(data) => Ok(Some(data.permissions())),
    }
}

fn refused(reason: &str) -> io::Error {
    io::Error::new(ErrorKind::InvalidInput, reason)
}

/// Makes the new name last through a power failure, where the system can. The file is complete and
/// in place by now, so a folder that cannot be synchronised is no error.
fn sync_folder(target: &Path) {
    if let Ok(folder) = File::open(folder(target)) {
        let _ = folder.sync_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write(path: &Path, text: &str) -> io::Result<()> {
        replace(path, |out| out.write_all(text.as_bytes()))
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).expect("a folder");
        let mut names: Vec<_> = entries
            .map(|e| e.expect("an entry").file_name().into_string().expect("text"))
            .collect();
        names.sort();
        names
    }

    #[test]
    fn files_appear_whole_and_alone() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a");
        for text in ["one", "a longer one", ""] {
            check(&path).expect("it can be written");
            write(&path, text).expect("written");
            assert_eq!(fs::read_to_string(&path).expect("there"), text);
        }
        assert_eq!(names(folder.path()), ["a"]);
    }

    /// Until it is complete the old one is seen, and after a failure it is still there.
    #[test]
    fn an_existing_file_survives_a_failure() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a");
        fs::write(&path, "precious").expect("written");
        let failed: io::Result<()> = replace(&path, |out| {
            out.write_all(&[0; 200_000])?;
            out.flush()?;
            assert_eq!(fs::read_to_string(&path)?, "precious");
            assert_eq!(names(folder.path()).len(), 2);
            Err(io::Error::other("enough"))
        });
        assert_eq!(failed.expect_err("it fails").to_string(), "enough");
        assert_eq!(names(folder.path()), ["a"]);
        assert_eq!(fs::read_to_string(&path).expect("there"), "precious");
    }

    #[test]
    fn what_cannot_be_written_is_found_before() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        fs::write(at("protected"), "precious").expect("written");
        let mut permissions = fs::metadata(at("protected")).expect("there").permissions();
        permissions.set_readonly(true);
        fs::set_permissions(at("protected"), permissions).expect("protected");
        let refused = |path: &Path, reason: &str| {
            for error in [check(path), write(path, "x")].map(|r| r.expect_err(reason).to_string()) {
                assert!(error.contains(reason), "{}: {error}", path.display());
            }
        };
        refused(&at("protected"), "write-protected");
        refused(folder.path(), "is a folder");
        refused(&at("nowhere/a"), "there is no folder");
        refused(&at("protected/a"), "");
        refused(&at(&"n".repeat(300)), "");
        assert_eq!(names(folder.path()), ["protected"]);
        assert_eq!(fs::read_to_string(at("protected")).expect("there"), "precious");
    }

    #[cfg(unix)]
    #[test]
    fn links_and_permissions_are_kept() {
        use std::os::unix::fs::{PermissionsExt as _, symlink};
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        fs::write(at("a"), "old").expect("written");
        fs::set_permissions(at("a"), Permissions::from_mode(0o640)).expect("set");
        for (link, to) in [("soft", "a"), ("softer", "soft"), ("new", "b"), ("ring", "ring")] {
            symlink(to, at(link)).expect("a link");
        }
        fs::hard_link(at("a"), at("hard")).expect("a link");
        write(&at("softer"), "new").expect("written");
        write(&at("new"), "newer").expect("written");
        let text = |name: &str| fs::read_to_string(at(name)).expect("there");
        assert_eq!(["a", "b", "hard"].map(text), ["new", "newer", "old"]);
        assert_eq!(fs::metadata(at("a")).expect("there").permissions().mode() & 0o777, 0o640);
        for link in ["soft", "softer", "new"] {
            assert!(fs::symlink_metadata(at(link)).expect("there").is_symlink(), "{link}");
        }
        for (path, reason) in [(at("ring"), "ring of"), ("/dev/null".into(), "not a regular")] {
            assert!(check(&path).expect_err(reason).to_string().contains(reason));
        }
    }

    /// Nothing can be made in the folders of the kernel, not even by the superuser.
    #[cfg(target_os = "linux")]
    #[test]
    fn folders_that_take_no_files() {
        assert!(check(Path::new("/proc/a")).is_err());
    }
}
