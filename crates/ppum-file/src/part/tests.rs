//! Tests: whose part files are removed, and whose are not.

use std::thread;

use super::*;
use crate::replace;

fn is_part(found: &str, name: &str) -> bool {
    is_part_of(OsStr::new(found), OsStr::new(name))
}

#[test]
fn names_of_parts() {
    let own = part_name(OsStr::new("a.h5"), 7);
    assert!(is_part_of(&own, OsStr::new("a.h5")) && !is_part_of(&own, OsStr::new("b.h5")));
    assert!(is_part(".a.h5.12-0.part", "a.h5"));
    for found in [
        "a.h5.12-0.part",
        ".a.h5.12-0.par",
        ".a.h5.12-0.part2",
        ".a.h5.12.part",
        ".a.h5.-0.part",
        ".a.h5.12-.part",
        ".a.h5.1x-0.part",
        ".a.h5.1-2-3.part",
        ".a.h5.b.1-2.part",
        ".a.h5.part",
        ".a.h5",
        "a.h5",
    ] {
        assert!(!is_part(found, "a.h5"), "{found}");
    }
}

/// Only what is a part file of this target, of nobody, and a regular file.
#[test]
fn parts_of_dead_programs_are_removed() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let dead = [".a.1-0.part", ".a.99999-12.part"];
    let kept = [".b.1-0.part", ".a.part", ".a.1-0.part.bak", ".a.x-0.part", "a", "precious"];
    for name in dead.iter().chain(&kept) {
        fs::write(at(name), "old").expect("written");
    }
    fs::create_dir(at(".a.2-0.part")).expect("a folder");
    #[cfg(unix)]
    std::os::unix::fs::symlink("precious", at(".a.3-0.part")).expect("a link");
    let locked = File::create(at(".a.4-0.part")).expect("written");
    locked.try_lock().expect("nobody has it");

    replace(&at("a"), |out| out.write_all(b"new")).expect("written");
    assert!(dead.iter().all(|name| !at(name).exists()));
    assert!(kept.iter().chain(&[".a.2-0.part", ".a.4-0.part"]).all(|name| at(name).exists()));
    #[cfg(unix)]
    assert!(fs::symlink_metadata(at(".a.3-0.part")).is_ok());
    assert_eq!(fs::read(at("precious")).expect("there"), b"old");

    locked.unlock().expect("it is ours");
    crate::check(&at("a")).expect("it can be written");
    assert!(!at(".a.4-0.part").exists(), "its owner is gone");
}

/// Two that write one file at the same time do not take each other's parts for dead.
#[test]
fn parts_of_the_living_stay() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a");
    let others = || -> io::Result<()> {
        for k in 0..20 {
            replace(&path, |out| write!(out, "{k}"))?;
        }
        Ok(())
    };
    replace(&path, |out| {
        thread::scope(|scope| {
            let all: Vec<_> = (0..4).map(|_| scope.spawn(others)).collect();
            all.into_iter().try_for_each(|one| one.join().expect("no panic"))
        })?;
        out.write_all(b"last")
    })
    .expect("all are written");
    assert_eq!(fs::read(&path).expect("there"), b"last");
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1);
}
