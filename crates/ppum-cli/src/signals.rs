//! Signals that end the program: what is half written is removed first.

/// From here on part files are removed when a signal ends the program.
#[cfg(not(unix))]
pub(crate) fn watch() {}

#[cfg(unix)]
pub(crate) use unix::watch;

#[cfg(unix)]
mod unix {
    use std::path::Path;
    use std::sync::mpsc::{Sender, channel};
    use std::thread;

    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    /// From here on part files are removed when a signal ends the program. Where no thread can be
    /// had it ends as if nobody watched.
    pub(crate) fn watch() {
        let (ready, is_ready) = channel();
        if thread::Builder::new().spawn(move || wait(&ready)).is_ok() {
            // an error says that nobody watches
            let _ = is_ready.recv();
        }
    }

    fn wait(ready: &Sender<()>) {
        let ignored = ignored().unwrap_or(bit(SIGHUP));
        let watched = [SIGTERM, SIGINT, SIGHUP].into_iter().filter(|&s| ignored & bit(s) == 0);
        let Ok(mut signals) = Signals::new(watched) else { return };
        // nobody may wait any more
        let _ = ready.send(());
        if let Some(signal) = signals.forever().next() {
            let _abandoned = ppum_file::abandon();
            // ends the program by the signal, as whoever sent it expects
            let _ = emulate_default_handler(signal);
            std::process::exit(128 + signal);
        }
    }

    pub(super) fn bit(signal: i32) -> u64 {
        1 << (signal - 1)
    }

    /// The signals that the program was started to survive, as by `nohup`, where the system tells.
    pub(super) fn ignored() -> Option<u64> {
        ignored_by("self")
    }

    /// The signals that a process ignores, given by its number or as `self`, where the system
    /// tells.
    pub(super) fn ignored_by(process: &str) -> Option<u64> {
        let status = Path::new("/proc").join(process).join("status");
        let status = ppum_file::text(&status, 1 << 16).ok()?;
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"))?;
        u64::from_str_radix(mask.trim(), 16).ok()
    }
}

#[cfg(unix)]
#[cfg(test)]
mod tests {
    use std::io::{BufRead as _, BufReader, Write as _};
    use std::os::unix::process::ExitStatusExt as _;
    use std::path::Path;
    use std::process::{Child, ChildStdout, Command, Stdio};
    use std::time::Duration;
    use std::{env, fs, io, thread};

    use super::unix::{bit, ignored};
    use super::watch;

    /// Says that this is a child, and where it writes.
    const TARGET: &str = "PPUM_TEST_TARGET";

    /// No test of its own: the program that the others start. It is for ever in the middle of
    /// writing a file.
    #[test]
    fn child() {
        let Some(target) = env::var_os(TARGET) else { return };
        watch();
        let written: io::Result<()> = ppum_file::replace(Path::new(&target), |out| {
            out.write_all(&[0; 200_000])?;
            writeln!(io::stdout(), "\nin the middle")?;
            loop {
                thread::sleep(Duration::from_secs(60));
            }
        });
        written.expect("it never ends");
    }

    /// A child in the middle of writing, with signals ignored if `trap` says so.
    fn writing(target: &Path, trap: &str) -> (Child, BufReader<ChildStdout>) {
        let program = env::current_exe().expect("this program");
        let script = format!("{trap} exec \"$0\" --exact signals::tests::child --nocapture");
        let mut command = Command::new("sh");
        command.arg("-c").arg(script).arg(program).env(TARGET, target).stdout(Stdio::piped());
        let mut child = command.spawn().expect("it runs");
        let mut out = BufReader::new(child.stdout.take().expect("it is piped"));
        let mut line = String::new();
        while line.trim() != "in the middle" {
            line.clear();
            assert!(out.read_line(&mut line).expect("text") > 0, "it ended before");
        }
        (child, out)
    }

    fn kill(child: &Child, signal: &str) {
        let id = child.id().to_string();
        assert!(Command::new("kill").args([signal, &id]).status().expect("it runs").success());
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).expect("a folder");
        let name = |entry: io::Result<fs::DirEntry>| entry.expect("an entry").file_name();
        let mut names: Vec<_> = entries.map(|e| name(e).into_string().expect("text")).collect();
        names.sort();
        names
    }

    #[test]
    fn signals_leave_nothing_half_written() {
        // those that this test was started to survive a child survives too
        let ignored = ignored().unwrap_or(bit(1));
        for (signal, number) in [("-TERM", 15), ("-INT", 2), ("-HUP", 1)] {
            if ignored & bit(number) != 0 {
                continue;
            }
            let folder = tempfile::tempdir().expect("a folder");
            let target = folder.path().join("a.csv");
            fs::write(&target, "precious").expect("written");
            let (mut child, _out) = writing(&target, "");
            assert_eq!(names(folder.path()).len(), 2);
            kill(&child, signal);
            assert_eq!(child.wait().expect("it ends").signal(), Some(number));
            assert_eq!(names(folder.path()), ["a.csv"]);
            assert_eq!(fs::read(&target).expect("there"), b"precious");
        }
    }

    /// As `nohup` asks.
    #[cfg(target_os = "linux")]
    #[test]
    fn signals_that_are_ignored_stay_so() {
        let folder = tempfile::tempdir().expect("a folder");
        let (mut child, _out) = writing(&folder.path().join("a.csv"), "trap '' HUP;");
        // the system discards a signal that is ignored
        let ignored = super::unix::ignored_by(&child.id().to_string()).expect("Linux tells it");
        assert_eq!(ignored & bit(1), bit(1), "it goes on");
        kill(&child, "-HUP");
        kill(&child, "-TERM");
        assert_eq!(child.wait().expect("it ends").signal(), Some(15));
    }

    /// Nobody can do anything at the time, but whoever writes the file next.
    #[test]
    fn what_a_killed_program_leaves_is_removed_later() {
        let folder = tempfile::tempdir().expect("a folder");
        let target = folder.path().join("a.csv");
        let (mut child, _out) = writing(&target, "");
        ppum_file::check(&target).expect("it can be written");
        assert_eq!(names(folder.path()).len(), 1, "it belongs to a living program");
        kill(&child, "-KILL");
        assert_eq!(child.wait().expect("it ends").signal(), Some(9));
        assert_eq!(names(folder.path()).len(), 1);
        ppum_file::check(&target).expect("it can be written");
        assert!(names(folder.path()).is_empty());
    }
}
