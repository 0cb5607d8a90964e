//! A program that ends in the middle of writing. Alone in its process: it stops all writing there.

use std::io;
use std::sync::mpsc::channel;
use std::thread;
use std::time::Duration;

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
        ppum_file::Growing::begin(&other.path().join("b"), |out| out.write_all(b"head"));
    let _growing = begun.expect("begun");
    assert_eq!(locks(), 1);
    let (in_the_middle, started) = channel();
    let (go_on, waiting) = channel();
    let target = path.clone();
    let writer = thread::spawn(move || -> io::Result<()> {
        ppum_file::replace(&target, |out| {
            out.write_all(&[0; 100_000])?;
            in_the_middle.send(()).map_err(io::Error::other)?;
            waiting.recv().map_err(io::Error::other)
        })
    });
    started.recv().expect("it has begun");
    assert_eq!(count(), 2);

    let abandoned = ppum_file::abandon();
    assert_eq!((count(), locks()), (1, 0));
    go_on.send(()).expect("it waits");
    thread::sleep(Duration::from_millis(200));
    assert!(!writer.is_finished(), "it would report an error while the program ends");

    drop(abandoned);
    assert!(writer.join().expect("no panic").is_err());
    assert_eq!(std::fs::read(&path).expect("there"), b"precious");
    assert_eq!(count(), 1);
    ppum_file::replace(&path, |out| out.write_all(b"new")).expect("it can write again");
    assert_eq!(std::fs::read(&path).expect("there"), b"new");
}
