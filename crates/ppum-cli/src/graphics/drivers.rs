//! Words of graphics drivers on standard error while they are opened.
//!
//! Drivers of Mesa complain of what does no harm: a missing display, say, although nothing is shown on one. Such
//! lines are dropped; others become a note, as the program's own. Where that cannot be done, and on systems
//! other than Linux, drivers write what they like.

/// Lines with these words are known to mean nothing.
const HARMLESS: [&str; 2] = ["XDG_RUNTIME_DIR", "not a conformant vulkan implementation"];

/// Most characters of a note.
const LONGEST: usize = 1000;

/// Opens drivers, and tells afterwards what they had to say.
pub(crate) fn opening<T>(open: impl FnOnce() -> T) -> T {
    #[cfg(target_os = "linux")]
    let _told = capture::Told(capture::Capture::new());
    open()
}

/// The note made of the words of drivers: one line, or nothing.
#[cfg_attr(not(target_os = "linux"), allow(dead_code, reason = "drivers are heard on Linux only"))]
fn note(words: &str) -> Option<String> {
    let matters = |line: &&str| !line.is_empty() && !HARMLESS.iter().any(|h| line.contains(h));
    let lines: Vec<_> = words.lines().map(str::trim).filter(matters).collect();
    let plain = |c: char| if c.is_control() { ' ' } else { c };
    let shown: String = lines.join("; ").chars().map(plain).take(LONGEST).collect();
    (!shown.is_empty()).then(|| format!("note: the graphics driver says: {shown}"))
}

#[cfg(target_os = "linux")]
mod capture {
    use std::fs::File;
    use std::io::{self, Read as _, Seek as _, Write as _};
    use std::os::fd::OwnedFd;

    use rustix::fs::{MemfdFlags, memfd_create};
    use rustix::io::fcntl_dupfd_cloexec;
    use rustix::stdio::{dup2_stderr, stderr};

    /// Standard error, led into memory until this ends.
    pub(super) struct Capture {
        own: OwnedFd,
        words: File,
    }

    impl Capture {
        /// None where standard error is closed, or the system does not allow it.
        pub(super) fn new() -> Option<Self> {
            let own = fcntl_dupfd_cloexec(stderr(), 3).ok()?;
            let words = File::from(memfd_create("drivers", MemfdFlags::CLOEXEC).ok()?);
            dup2_stderr(&words).ok()?;
            Some(Self { own, words })
        }

        /// Gives standard error back; what has been written to it.
        pub(super) fn end(mut self) -> String {
            let mut bytes = Vec::new();
            // of what cannot be given back nothing can be told either
            let read = dup2_stderr(&self.own).is_ok()
                && self.words.rewind().is_ok()
                && self.words.read_to_end(&mut bytes).is_ok();
            if read { String::from_utf8_lossy(&bytes).into_owned() } else { String::new() }
        }
    }

    /// Tells in the end; of a panic, whose message is among the words, all of it.
    pub(super) struct Told(pub(super) Option<Capture>);

    impl Drop for Told {
        fn drop(&mut self) {
            let Some(words) = self.0.take().map(Capture::end) else { return };
            let told = if std::thread::panicking() {
                words
            } else {
                super::note(&words).map_or(String::new(), |note| format!("{note}\n"))
            };
            // if standard error is closed nobody can be told
            let _ = io::stderr().write_all(told.as_bytes());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn harmless_words_are_dropped_and_others_become_a_line() {
        let complaint = "error: XDG_RUNTIME_DIR is invalid or not set in the environment.\n";
        assert_eq!(note(&complaint.repeat(4)), None);
        assert_eq!(note(""), None);
        let words = format!("{complaint}MESA: \u{1b}[31mout of memory\n\n  at 3\n");
        let told = note(&words).expect("a note");
        assert_eq!(told, "note: the graphics driver says: MESA:  [31mout of memory; at 3");
        assert!(note(&"x".repeat(9999)).is_some_and(|told| told.len() < 1100));
    }

    /// Standard error is one for the whole process, so all of it is one test.
    #[cfg(target_os = "linux")]
    #[test]
    fn standard_error_comes_back() {
        use super::capture::Capture;

        let say = |words: &str| {
            rustix::io::write(rustix::stdio::stderr(), words.as_bytes()).expect("written");
        };
        let heard = |work: &dyn Fn()| {
            let all = Capture::new().expect("memory");
            work();
            all.end()
        };
        let quiet = heard(&|| {
            assert_eq!(opening(|| [say("XDG_RUNTIME_DIR\n"), ()].len()), 2);
            say("after\n");
        });
        assert_eq!(quiet, "after\n");
        let told = heard(&|| opening(|| say("broken\n")));
        // the harness takes what goes through the standard library
        assert!(told.is_empty() || told == "note: the graphics driver says: broken\n", "{told}");
        let panicked = heard(&|| {
            let result = std::panic::catch_unwind(|| opening(|| panic!("lost")));
            assert!(result.is_err());
            say("still there\n");
        });
        assert!(panicked.ends_with("still there\n"), "{panicked}");
    }
}
