//! One file under several names.

use std::path::Path;

/// True if both names lead to one file that exists: by other ways through folders, by symbolic or
/// by hard links.
#[must_use]
pub fn is_same(a: &Path, b: &Path) -> bool {
    let key = |path| identity(path).ok();
    key(a).is_some_and(|a| key(b) == Some(a))
}

#[cfg(unix)]
fn identity(path: &Path) -> std::io::Result<(u64, u64)> {
    use std::os::unix::fs::MetadataExt as _;
    std::fs::metadata(path).map(|data| (data.dev(), data.ino()))
}

#[cfg(not(unix))]
fn identity(path: &Path) -> std::io::Result<std::path::PathBuf> {
    std::fs::canonicalize(path)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn names_of_one_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        for name in ["a", "b"] {
            fs::write(at(name), "alike").expect("written");
        }
        fs::create_dir(at("c")).expect("a folder");
        for name in ["a", "./a", "c/../a"] {
            assert!(is_same(&at("a"), &at(name)), "{name}");
        }
        for (a, b) in [("a", "b"), ("a", "none"), ("none", "a"), ("none", "none")] {
            assert!(!is_same(&at(a), &at(b)), "{a} {b}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn links() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        fs::write(at("a"), "").expect("written");
        fs::hard_link(at("a"), at("hard")).expect("a link");
        std::os::unix::fs::symlink("a", at("soft")).expect("a link");
        std::os::unix::fs::symlink("soft", at("softer")).expect("a link");
        std::os::unix::fs::symlink("none", at("broken")).expect("a link");
        assert!(["hard", "soft", "softer"].iter().all(|name| is_same(&at("a"), &at(name))));
        assert!(!is_same(&at("a"), &at("broken")));
    }
}
