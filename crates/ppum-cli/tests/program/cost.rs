//! The cost of commands: small files that ask for much are read within the bounds that docs/cli.md
//! states, or refused with their reason.
//!
//! The system holds the bounds: a command that passes one is killed, or has no memory.

use std::process::Command;
use std::sync::Mutex;

use ppum_format::damage::unchecked;
use ppum_testkit::costly::{self, Costly};

use crate::Lab;

/// Largest of the files, in bytes.
const SMALL: usize = 250_000;

/// A command, the seconds of the processor it may take, and the memory in MiB beside that of
/// reading the file.
struct Bound {
    command: &'static str,
    seconds: u32,
    memory: usize,
}

const INFO: Bound = Bound { command: "info FILE", seconds: 10, memory: 0 };
const INFO_AS_JSON: Bound = Bound { command: "info FILE --json", seconds: 10, memory: 64 };
const PROBE: Bound =
    Bound { command: "probe FILE --at 0.3,0.3 --at 0.5,0.4375", seconds: 10, memory: 0 };
const FORMULA: Bound = Bound { command: "formula x --of FILE", seconds: 10, memory: 0 };

/// The bounds of docs/cli.md for two threads, 2,000 points and 3,072 pixels.
const SAMPLE: Bound =
    Bound { command: "sample FILE --grid 50x40 -o FILE.csv", seconds: 15, memory: 64 };
const RENDER: Bound = Bound {
    command: "render FILE -o FILE.png --backend cpu --size 64x48 --threads 2",
    seconds: 15,
    memory: 512,
};

/// The bound of docs/cli.md for 320 points of files that are opened in less than half a second.
const FEW_POINTS: Bound =
    Bound { command: "sample FILE --grid 20x16 -o FILE.csv", seconds: 2, memory: 64 };

/// The bound of factors that are found again.
const RECOMPUTED: Bound = Bound { command: "sif FILE --recompute", seconds: 300, memory: 2048 };

/// Files of which commands take more than half a second.
const SLOW: [&str; 18] = [
    "cracks-crossing",
    "formula-in-frames",
    "formula-long",
    "formula-of-products",
    "functions",
    "functions-and-table",
    "functions-of-table",
    "holes",
    "intensities",
    "kinks",
    "material",
    "parameters",
    "polygon",
    "quantities",
    "quantities-long",
    "table-of-two",
    "tables",
    "tips-in-cells",
];

#[test]
fn files_that_ask_for_too_much_are_refused() {
    stay_within(&[INFO], |_, refused| refused.is_some());
}

#[test]
fn small_costly_files_stay_within_the_bounds() {
    stay_within(&[INFO_AS_JSON, SAMPLE, RENDER], |name, refused| {
        refused.is_none() && !SLOW.contains(&name)
    });
}

/// Files whose fields take much time at each point.
#[test]
fn points_of_costly_files_stay_within_the_bound() {
    let files = ["formula-in-frames", "holes", "polygon"];
    stay_within(&[PROBE, FEW_POINTS, FORMULA], |name, _| files.contains(&name));
}

#[test]
fn factors_of_costly_files_stay_within_the_bound() {
    stay_within(&[RECOMPUTED], |name, _| name == "material-noise");
}

#[test]
#[ignore = "slow: commands on costly files take up to ten seconds each"]
fn the_costliest_files_stay_within_the_bounds() {
    let is_of_quantities = |name: &str| name.starts_with("quantities");
    stay_within(&[SAMPLE, RENDER], |name, _| SLOW.contains(&name) && !is_of_quantities(name));
    // formulas of quantities are read again and again, whatever the command; numbers of tables are
    // most of what JSON takes
    stay_within(&[INFO], |name, _| is_of_quantities(name));
    stay_within(&[INFO_AS_JSON], |name, _| name == "tables");
    let files = ["cracks", "cracks-crossing", "formula-in-frames"];
    stay_within(&[RECOMPUTED], |name, _| files.contains(&name));
}

#[test]
#[ignore = "slow: factors of some files take minutes"]
fn by_hand_all_commands_on_costly_files_stay_within_the_bounds() {
    let bounds = [INFO, INFO_AS_JSON, PROBE, SAMPLE, RENDER, FORMULA, RECOMPUTED];
    stay_within(&bounds, |_, _| true);
}

/// Runs commands on the chosen files, each within its bound.
fn stay_within(bounds: &[Bound], is_chosen: impl Fn(&str, Option<&str>) -> bool) {
    let (lab, failures) = (Lab::new(), Mutex::new(Vec::new()));
    let files = costly::chosen(is_chosen);
    assert!(!files.is_empty(), "files of these names");
    let files = Mutex::new(files.into_iter());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(|| {
                loop {
                    // the lock is held for this line alone
                    let Some(file) = files.lock().unwrap().next() else { break };
                    failures.lock().unwrap().extend(failures_of(&lab, &file, bounds));
                }
            });
        }
    });
    let failures = failures.into_inner().unwrap();
    assert!(failures.is_empty(), "{} failures: {failures:#?}", failures.len());
}

/// The failures of the commands on a file.
fn failures_of(lab: &Lab, file: &Costly, bounds: &[Bound]) -> Vec<String> {
    let bytes = unchecked(&file.dataset).unwrap();
    assert!(bytes.len() < SMALL, "{}: {} bytes are not small", file.name, bytes.len());
    let name = format!("{}.h5", file.name);
    std::fs::write(lab.path(&name), &bytes).unwrap();
    let failure = |bound: &Bound| failure(lab, &name, bytes.len(), bound, file.refused);
    bounds.iter().filter_map(failure).collect()
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
        // memory is counted where it is reserved: each thread would reserve some, and mimalloc, the
        // allocator of the program with a window, 1 GiB when it starts
        .env("MALLOC_ARENA_MAX", "2")
        .env("MIMALLOC_ARENA_RESERVE", "0")
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
