//! Fuzzes the reader for a while: damaged files, read and evaluated.
//!
//!     cargo run --release -p ppum-bench --example fuzz_files -- --seconds 60 --seed 1 FILE.h5 …
//!
//! The damaged files are tried in a process of their own, with limits of memory and of time for
//! each. One that crashes it, takes too long, or shows another dataset under a checksum that is
//! right is kept in `crates/ppum-format/tests/data/hostile`, where the tests find it, and the
//! search goes on. Without files it starts from those of `tests/data` and `tests/data/h5py` of that
//! crate.

#[path = "../../ppum-format/tests/damage/mod.rs"]
mod damage;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus};
use std::time::{Duration, Instant};

use ppum::crack::Side;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::vec2::Vec2;
use ppum_format::Series;
use ppum_testkit::random::Random;

use damage::{DamagedFile, damaged};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Longest time for one file.
const PATIENCE: Duration = Duration::from_secs(30);

/// Memory of the process that makes and tries the files, in KiB.
const MEMORY: usize = 1536 * 1024;

/// Damaged files are damaged again, so that damage adds up, this many times at most.
const ROUNDS: usize = 3;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (mut seconds, mut seed, mut worker, mut files) = (10, 1, None, Vec::new());
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        let mut value = || rest.next().ok_or(format!("{argument} needs a value"));
        match argument.as_str() {
            "--seconds" => seconds = value()?.parse()?,
            "--seed" => seed = value()?.parse()?,
            "--worker" => worker = Some(PathBuf::from(value()?)),
            file => files.push(PathBuf::from(file)),
        }
    }
    if files.is_empty() {
        files = kept(&data())?;
        files.extend(kept(&data().join("h5py"))?);
    }
    match worker {
        Some(current) => work(&current, &files, seconds, seed),
        None => watch(&files, Duration::from_secs(seconds), seed),
    }
}

fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../ppum-format/tests/data")
}

fn kept(folder: &Path) -> Result<Vec<PathBuf>> {
    let paths: Vec<PathBuf> =
        std::fs::read_dir(folder)?.map(|e| Ok(e?.path())).collect::<std::io::Result<_>>()?;
    let mut paths: Vec<_> =
        paths.into_iter().filter(|path| path.extension().is_some_and(|e| e == "h5")).collect();
    paths.sort();
    Ok(paths)
}

/// Starts workers until the time is up; keeps what they die of.
fn watch(files: &[PathBuf], time: Duration, seed: u64) -> Result<()> {
    let current = std::env::temp_dir().join(format!("ppum-fuzz-{}.h5", std::process::id()));
    let (start, mut found) = (Instant::now(), 0);
    while start.elapsed() < time {
        let left = (time - start.elapsed()).as_secs().max(1);
        let limited = format!("ulimit -v {MEMORY} 2>/dev/null; exec \"$0\" \"$@\"");
        let mut worker = Command::new("sh")
            .args(["-c", &limited])
            .arg(std::env::current_exe()?)
            .args(["--seconds", &left.to_string(), "--seed", &(seed + found).to_string()])
            .arg("--worker")
            .arg(&current)
            .args(files)
            .spawn()?;
        let status = wait(&mut worker, &current)?;
        if status.is_some_and(|status| status.success()) {
            break;
        }
        let hostile = data().join("hostile");
        std::fs::create_dir_all(&hostile)?;
        let kept = hostile.join(format!("found-{seed}-{found}.h5"));
        std::fs::copy(&current, &kept)?;
        let what = status.map_or("it takes too long".to_owned(), |status| status.to_string());
        println!("{what}: kept as {}", kept.display());
        found += 1;
    }
    std::fs::remove_file(&current)?;
    if found > 0 { Err(format!("{found} files found").into()) } else { Ok(()) }
}

/// The end of the worker; `None` if it had to be stopped because one file took too long.
fn wait(worker: &mut Child, current: &Path) -> Result<Option<ExitStatus>> {
    let start = Instant::now();
    loop {
        if let Some(status) = worker.try_wait()? {
            return Ok(Some(status));
        }
        let written = std::fs::metadata(current).and_then(|file| file.modified());
        let age = written.ok().and_then(|written| written.elapsed().ok()).unwrap_or_default();
        if age > PATIENCE && start.elapsed() > PATIENCE {
            worker.kill()?;
            worker.wait()?;
            return Ok(None);
        }
        std::thread::sleep(Duration::from_millis(50));
    }
}

/// Tries damaged files, each written to a file before.
fn work(current: &Path, files: &[PathBuf], seconds: u64, seed: u64) -> Result<()> {
    let originals: Vec<Vec<u8>> =
        files.iter().map(std::fs::read).collect::<std::io::Result<_>>()?;
    let told: Vec<Option<String>> = originals
        .iter()
        .map(|bytes| ppum_format::from_bytes(bytes.clone()).ok().map(text))
        .collect();
    let steps: Vec<Vec<String>> = files.iter().map(|file| by_steps(file)).collect();
    let (mut random, start) = (Random(seed), Instant::now());
    let mut fates = [0_u64; 3];
    while start.elapsed() < Duration::from_secs(seconds) {
        let k = random.below(originals.len());
        let (mut bytes, mut is_sealed) = (originals[k].clone(), false);
        for _ in 0..=random.below(ROUNDS) {
            let next = damaged(&bytes, &mut |below| random.below(below));
            is_sealed |= next.is_sealed;
            DamagedFile { bytes, .. } = next;
        }
        std::fs::write(current, &bytes)?;
        let is_other = |(number, step): (usize, &String)| {
            !step.is_empty() && steps[k].get(number) != Some(step)
        };
        if !is_sealed && by_steps(current).iter().enumerate().any(is_other) {
            return Err("another step under a checksum that is right".into());
        }
        let fate = match ppum_format::from_bytes(bytes) {
            Err(_) => 0,
            Ok(dataset) => {
                evaluate(&dataset, &mut random);
                let is_same = told[k] == Some(text(dataset));
                if !is_same && !is_sealed {
                    return Err("another dataset under a checksum that is right".into());
                }
                if is_same { 1 } else { 2 }
            }
        };
        fates[fate] += 1;
    }
    let [refused, same, other] = fates;
    println!(
        "{refused} refused, {same} without effect, {other} with another meaning; {}",
        memory()
    );
    Ok(())
}

/// The dataset with each of its steps, read one by one; nothing for what cannot be read.
fn by_steps(file: &Path) -> Vec<String> {
    let Ok(series) = Series::open(file) else { return Vec::new() };
    let step = |number| {
        // whatever it holds, it must not take the program down
        let _ = series.results(number);
        series.dataset(number).map_or_else(|_| String::new(), text)
    };
    (0..series.len().min(MOST_STEPS)).map(step).collect()
}

/// Steps of a file that are read one by one: a damaged one may have many.
const MOST_STEPS: usize = 8;

/// Debug output tells every double apart, and a NaN is equal to a NaN.
fn text(dataset: Dataset) -> String {
    format!("{dataset:?}")
}

/// All fields at some points, on both sides, with all derivatives.
fn evaluate(dataset: &Dataset, random: &mut Random) {
    for step in 0..dataset.steps.len() {
        for data in &dataset.steps[step].fields {
            let Ok(field) = Field::named(dataset, step, &data.name) else { continue };
            let mut jets = vec![Jet::constant(0.0); field.components()];
            for side in [Side::Above, Side::Below] {
                let mut local = field.at(random.point(&dataset.domain.bounds));
                local.evaluate::<2>(Vec2::ZERO, side, &mut jets);
                local.evaluate_into::<1>(&[Vec2::ZERO], side, &mut jets);
            }
        }
    }
}

/// The most memory this process has had, where the system tells.
fn memory() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    peak.map_or("memory not known".to_owned(), |peak| format!("at most {} of memory", peak.trim()))
}
