//! The cost of commands: small files that ask for much are read within the bounds that docs/cli.md states, or
//! refused with their reason.
//!
//! The system holds the bounds: a command that passes one is killed, or has no memory.

use std::process::Command;
use std::sync::Mutex;

use ppum_format::damage::unchecked;
use ppum_testkit::costly::{self, Costly};

use crate::Lab;

/// Largest of the files, in bytes.
const SMALL: usize = 250_000;

/// A command, the seconds of the processor it may take, and the memory in MiB beside that of reading the file.
struct Bound {
    command: &'static str,
    seconds: u32,
    memory: usize,
}

/// The bounds of docs/cli.md for two threads, 12,288 pixels and 8,000 points.
const BOUNDS: [Bound; 7] = [
    Bound { command: "info FILE", seconds: 10, memory: 0 },
    Bound { command: "info FILE --json", seconds: 10, memory: 64 },
    Bound { command: "probe FILE --at 0.3,0.3 --at 0.5,0.4375", seconds: 10, memory: 0 },
    Bound { command: "sample FILE --grid 100x80 -o FILE.csv", seconds: 60, memory: 64 },
    Bound {
        command: "render FILE -o FILE.png --backend cpu --size 128x96 --threads 2",
        seconds: 60,
        memory: 512,
    },
    Bound { command: "formula x --of FILE", seconds: 10, memory: 0 },
    Bound { command: "sif FILE --recompute", seconds: 300, memory: 2048 },
];

#[test]
fn small_costly_files_stay_within_the_bounds() {
    let (lab, failures) = (Lab::new(), Mutex::new(Vec::new()));
    let files = Mutex::new(costly::all().into_iter());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(|| {
                loop {
                    // the lock is held for this line alone
                    let Some(file) = files.lock().unwrap().next() else { break };
                    failures.lock().unwrap().extend(failures_of(&lab, &file));
                }
            });
        }
    });
    let failures = failures.into_inner().unwrap();
    assert!(failures.is_empty(), "{} failures: {failures:#?}", failures.len());
}

/// The failures of the commands on a file.
fn failures_of(lab: &Lab, file: &Costly) -> Vec<String> {
    let bytes = unchecked(&file.dataset).unwrap();
    assert!(bytes.len() < SMALL, "{}: {} bytes are not small", file.name, bytes.len());
    let name = format!("{}.h5", file.name);
    std::fs::write(lab.path(&name), &bytes).unwrap();
    let failure = |bound: &Bound| failure(lab, &name, bytes.len(), bound, file.refused);
    BOUNDS.iter().filter_map(failure).collect()
}

fn failure(
    lab: &Lab,
    file: &str,
    length: usize,
    bound: &Bound,
    refused: Option<&str>,
) -> Option<String> {
    // what FORMAT.md lets reading take, and 64 MiB for the program itself
    let memory = 16 * length / 1024 + (512 + 64 + bound.memory) * 1024;
    let limits = format!("ulimit -t {}; ulimit -v {memory} 2>/dev/null", bound.seconds);
    let arguments = bound.command.replace("FILE", file);
    let mut command = Command::new("sh");
    command
        .args(["-c", &format!("{limits}; exec \"$0\" \"$@\""), env!("CARGO_BIN_EXE_ppum")])
        .args(arguments.split(' '))
        .current_dir(lab.folder.path())
        // memory is counted where it is reserved, and each thread would reserve some
        .env("MALLOC_ARENA_MAX", "2")
        .env("RAYON_NUM_THREADS", "2");
    let output = command.output().unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr);
    let code = output.status.code();
    let is_right = match refused {
        Some(words) => code == Some(1) && complaint.contains(words) && output.stdout.is_empty(),
        // factors that would take too much are not found again
        None if bound.command.starts_with("sif") => {
            code == Some(0) || code == Some(1) && complaint.contains("no factors are stored")
        }
        None => code == Some(0),
    };
    (!is_right).then(|| format!("ppum {arguments}: {} {complaint:.500}", output.status))
}
