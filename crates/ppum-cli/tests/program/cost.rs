//! The cost of commands: small files that ask for much are read within the bounds that
//! docs/commands/cost.md states.
//!
//! The system holds the bounds: a command that passes one is killed, or has no memory.

use std::process::Command;
use std::sync::Mutex;

use ppum_testkit::costly;

use crate::Lab;
use crate::errors::unchecked;

/// Largest of the files, in bytes.
const SMALL: usize = 250_000;

/// A command, the seconds of the processor it may take, and the memory in MiB beside that of
/// reading the file: the bounds of docs/commands/cost.md for two threads, 2,000 points and
/// 3,072 pixels.
struct Bound {
    command: &'static str,
    seconds: u32,
    memory: usize,
}

const BOUNDS: [Bound; 3] = [
    Bound { command: "info FILE --json", seconds: 10, memory: 64 },
    Bound { command: "sample FILE --grid 50x40 -o FILE.csv", seconds: 15, memory: 64 },
    Bound {
        command: "render FILE -o FILE.png --backend cpu --size 64x48 --threads 2",
        seconds: 15,
        memory: 512,
    },
];

/// Files of which commands take more than half a second.
const SLOW: [&str; 7] = [
    "formula-long",
    "functions",
    "holes",
    "patches-piled",
    "quantities",
    "table-of-two",
    "tips-in-cells",
];

#[test]
fn small_costly_files_stay_within_the_bounds() {
    stay_within(|name| !SLOW.contains(&name));
}

#[test]
#[ignore = "slow: commands on costly files take up to ten seconds each"]
fn the_costliest_files_stay_within_the_bounds() {
    stay_within(|name| SLOW.contains(&name));
}

/// Runs commands on the chosen files, each within its bound.
fn stay_within(is_chosen: impl Fn(&str) -> bool + Send) {
    let (lab, failures) = (Lab::new(), Mutex::new(Vec::new()));
    let files = Mutex::new(costly::all().filter(move |(name, _)| is_chosen(name)));
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(|| {
                loop {
                    // the lock is held for this line alone
                    let Some((name, dataset)) = files.lock().unwrap().next() else { break };
                    let bytes = unchecked(&dataset);
                    assert!(bytes.len() < SMALL, "{name}: {} bytes are not small", bytes.len());
                    let file = format!("{name}.h5");
                    std::fs::write(lab.path(&file), &bytes).unwrap();
                    let found = BOUNDS.iter().filter_map(|b| failure(&lab, &file, bytes.len(), b));
                    failures.lock().unwrap().extend(found);
                }
            });
        }
    });
    let failures = failures.into_inner().unwrap();
    assert!(failures.is_empty(), "{} failures: {failures:#?}", failures.len());
}

fn failure(lab: &Lab, file: &str, length: usize, bound: &Bound) -> Option<String> {
    // what FORMAT.md lets reading take, and 64 MiB for the program itself
    let memory = 16 * length / 1024 + (512 + 64 + bound.memory) * 1024;
    let limits = format!("ulimit -t {}; ulimit -v {memory} 2>/dev/null", bound.seconds);
    let arguments = bound.command.replace("FILE", file);
    let mut command = Command::new("sh");
    command
        .args(["-c", &format!("{limits}; exec \"$0\" \"$@\""), env!("CARGO_BIN_EXE_ppum")])
        .args(arguments.split(' '))
        .current_dir(lab.folder.path())
        // memory is counted where it is reserved: each thread would reserve some, and mimalloc, the
        // allocator of the program with a window, 1 GiB when it starts
        .env("MALLOC_ARENA_MAX", "2")
        .env("MIMALLOC_ARENA_RESERVE", "0")
        .env("RAYON_NUM_THREADS", "2");
    let output = command.output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr);
    let is_right = output.status.code() == Some(0);
    (!is_right).then(|| format!("ppum {arguments}: {} {message:.500}", output.status))
}
