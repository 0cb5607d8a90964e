//! Damaged files: the program says what is wrong with a file, or shows what it holds, within bounds
//! of time and memory. It never crashes and never shows a changed field under a checksum that
//! is right.

use std::ops::Range;
use std::path::Path;
use std::process::Command;
use std::sync::Mutex;

#[path = "../../../ppum-format/tests/damage/mod.rs"]
mod damages;

use damages::{DamagedFile, damaged};
use ppum_testkit::random::Random;

use crate::{CRACKED, LINEAR, Lab, with_formulas};

/// Longest time of the processor for a command in seconds, far above what any takes.
const PATIENCE: u32 = 60;

/// The bound on memory that FORMAT.md states, and 64 MiB for the program itself, in KiB.
fn memory(length: usize) -> usize {
    16 * length / 1024 + (512 + 64) * 1024
}

/// The outcome of a damage.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Outcome {
    /// A clear error.
    Found,
    /// Nothing that the program reads was damaged.
    Same,
    /// Another dataset, with a checksum that is right or none.
    Other,
}

/// A file and what the program says of it.
struct Original {
    name: &'static str,
    bytes: Vec<u8>,
    told: String,
}

#[test]
fn damaged_files_are_errors_or_what_they_hold() {
    survive_damages(0..147);
}

#[test]
#[ignore = "slow: hundreds of runs of the program"]
fn many_damaged_files_are_errors_or_what_they_hold() {
    survive_damages(147..700);
}

/// Damages as many files as there are seeds.
fn survive_damages(seeds: Range<u64>) {
    let lab = Lab::new();
    let originals = originals(&lab);
    let outcomes = Mutex::new(Vec::new());
    let workers = std::thread::available_parallelism().map_or(2, usize::from);
    std::thread::scope(|scope| {
        for worker in 0..workers {
            let (lab, originals, outcomes) = (&lab, &originals, &outcomes);
            let own = seeds.clone().skip(worker).step_by(workers);
            scope.spawn(move || {
                for seed in own {
                    let outcome = survive(lab, &originals[seed as usize % originals.len()], seed);
                    outcomes.lock().unwrap().push(outcome);
                }
            });
        }
    });
    let outcomes = outcomes.into_inner().unwrap();
    let failures: Vec<_> = outcomes.iter().filter_map(|outcome| outcome.as_ref().err()).collect();
    assert!(failures.is_empty(), "{} failures: {failures:#?}", failures.len());
    let count = |wanted| outcomes.iter().flatten().filter(|&&outcome| outcome == wanted).count();
    let [found, same, other] = [Outcome::Found, Outcome::Same, Outcome::Other].map(count);
    println!("{found} found, {same} without effect, {other} with another meaning");
    let few = outcomes.len() / 100;
    assert!(found > outcomes.len() / 2 && same > few && other > few, "{found} {same} {other}");
}

/// Files of this program and of h5py, of several versions.
fn originals(lab: &Lab) -> Vec<Original> {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../ppum-format/tests/data");
    let kept = |name| std::fs::read(data.join(name)).unwrap();
    let solved = |problem: &str| std::fs::read(Lab::solved(problem).path("plate.h5")).unwrap();
    let files = [
        ("cracked plate", solved(CRACKED)),
        ("h5py, first layout", kept("h5py-earliest.h5")),
        ("plate with formulas", solved(&with_formulas())),
        ("h5py, later layout", kept("h5py-v110.h5")),
        ("plate with holes", with_holes(lab)),
        ("Poisson", solved(LINEAR)),
        ("version 1.0", kept("version-1.0.h5")),
    ];
    let original = |(name, bytes): (&'static str, Vec<u8>)| {
        std::fs::write(lab.path("original.h5"), &bytes).unwrap();
        let told =
            told(lab, "original.h5", bytes.len()).unwrap_or_else(|e| panic!("{name}: {e:?}"));
        Original { name, bytes, told }
    };
    files.into_iter().map(original).collect()
}

/// The cracked plate with a round hole and a polygonal one, both apart from the crack.
fn with_holes(lab: &Lab) -> Vec<u8> {
    let holes = "[[hole]]\ncenter = [0.0, 0.65]\nradius = 0.2\n\
                 [[hole]]\npoints = [[-0.5, -0.75], [0.25, -0.75], [0.0, -0.5]]\n";
    let coarse = CRACKED.replace("level = 3", "level = 3\nrefine = false");
    lab.write("plate.toml", &coarse.replace("[[crack]]", &format!("{holes}[[crack]]")));
    // coarse cells at holes are warned of
    lab.warned("solve plate.toml");
    std::fs::read(lab.path("plate.h5")).unwrap()
}

/// The outcome of a damage, or the promise that is broken.
fn survive(lab: &Lab, original: &Original, seed: u64) -> Result<Outcome, String> {
    let mut random = Random(seed);
    let DamagedFile { bytes, what, is_sealed } =
        damaged(&original.bytes, &mut |below| random.below(below));
    let file = format!("{seed}.h5");
    std::fs::write(lab.path(&file), &bytes).unwrap();
    let told = told(lab, &file, bytes.len());
    std::fs::remove_file(lab.path(&file)).unwrap();
    let failed = |why: &str| Err(format!("{}, seed {seed}, {what}: {why}", original.name));
    match told {
        Err(Failure::Crash(why)) => failed(&why),
        Err(Failure::Complaint(text)) if is_clear(&text, &file) => Ok(Outcome::Found),
        Err(Failure::Complaint(text)) => failed(&text),
        Ok(told) if told.replace(&file, "original.h5") == original.told => Ok(Outcome::Same),
        Ok(_) if is_sealed => Ok(Outcome::Other),
        Ok(_) => failed("another dataset is shown"),
    }
}

/// An error that names the file and says something, not too much.
fn is_clear(complaint: &str, file: &str) -> bool {
    let start = format!("error: {file}: ");
    let length = complaint.len();
    complaint.starts_with(&start) && (start.len() + 10..2000).contains(&length)
}

/// The reason why a command fails.
#[derive(Debug)]
enum Failure {
    /// Its error.
    Complaint(String),
    /// It crashed, took too long, or complained and went on.
    Crash(String),
}

/// The words of `ppum info` and `ppum probe` on a file within the bounds.
fn told(lab: &Lab, file: &str, length: usize) -> Result<String, Failure> {
    let info = run(lab, &["info", file, "--json"], length)?;
    let points = ["--at", "0.25,0.125", "--at", "0,0", "--at", "0.5,0.25", "--at", "-0.3,0.7"];
    let probe = run(lab, &[&["probe", file, "--json"], &points[..]].concat(), length)?;
    Ok(info + &probe)
}

fn run(lab: &Lab, arguments: &[&str], length: usize) -> Result<String, Failure> {
    let limits = format!("ulimit -t {PATIENCE}; ulimit -v {} 2>/dev/null", memory(length));
    let limited = format!("{limits}; exec \"$0\" \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &limited, env!("CARGO_BIN_EXE_ppum")]).args(arguments);
    let output = command
        .current_dir(lab.folder.path())
        // the 1 GiB of addresses that mimalloc reserves when it starts is more than the bound
        .env("MIMALLOC_ARENA_RESERVE", "0")
        .output()
        .unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
    match output.status.code() {
        Some(0) if complaint.is_empty() => Ok(String::from_utf8(output.stdout).unwrap()),
        Some(1) => Err(Failure::Complaint(complaint)),
        _ => Err(Failure::Crash(format!("{arguments:?}: {} {complaint}", output.status))),
    }
}
