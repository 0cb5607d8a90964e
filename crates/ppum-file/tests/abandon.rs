//! A program that ends in the middle of writing. Alone in its process: it stops all writing there.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::mpsc::channel;
use std::thread;

#[test]
fn writing_stops_and_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a");
    let count = || std::fs::read_dir(folder.path()).expect("a folder").count();
    std::fs::write(&path, "precious").expect("written");
    // one that grows, whose lock is a file beside it
    let other = tempfile::tempdir().expect("a folder");
    let locks = || std::fs::read_dir(other.path()).expect("a folder").count() - 1;
    let begun: io::Result<_> =
        ppum_file::AppendFile::begin(&other.path().join("b"), |out| out.write_all(b"head"));
    let _growing = begun.expect("begun");
    assert_eq!(locks(), 1);
    let (in_the_middle, started) = channel();
    let (go_on, waiting) = channel();
    let (has_gone_on, resumed) = channel();
    let target = path.clone();
    let writer = thread::spawn(move || -> io::Result<()> {
        ppum_file::replace(&target, |out| {
            out.write_all(&[0; 100_000])?;
            in_the_middle.send(thread_folder()).map_err(io::Error::other)?;
            waiting.recv().map_err(io::Error::other)?;
            has_gone_on.send(()).map_err(io::Error::other)
        })
    });
    let thread = started.recv().expect("it has begun");
    assert_eq!(count(), 2);

    let abandoned = ppum_file::abandon();
    assert_eq!((count(), locks()), (1, 0));
    go_on.send(()).expect("it waits");
    resumed.recv().expect("it goes on");
    while !writer.is_finished() && !is_asleep(&thread) {
        thread::yield_now();
    }
    assert!(!writer.is_finished(), "it would report an error while the program ends");

    drop(abandoned);
    assert!(writer.join().expect("no panic").is_err());
    assert_eq!(std::fs::read(&path).expect("there"), b"precious");
    assert_eq!(count(), 1);
    ppum_file::replace(&path, |out| out.write_all(b"new")).expect("it can write again");
    assert_eq!(std::fs::read(&path).expect("there"), b"new");
}

/// The folder in which Linux reports the state of the calling thread.
fn thread_folder() -> PathBuf {
    Path::new("/proc").join(std::fs::read_link("/proc/thread-self").unwrap_or_default())
}

/// True if a thread waits for something, or the system does not report its state.
fn is_asleep(thread: &Path) -> bool {
    let Ok(state) = std::fs::read_to_string(thread.join("stat")) else { return true };
    // the state follows the name, which is in parentheses
    state.rsplit(')').next().is_some_and(|rest| rest.trim_start().starts_with('S'))
}
