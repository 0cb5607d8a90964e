//! Fuzzes formulas for a while: random texts through parser, derivatives and all back ends.
//!
//!     cargo run --release -p ppum-bench --example fuzz_formulas -- --seconds 60 --seed 1
//!
//! The texts are tried in a process of their own. One that crashes it, breaks a promise or takes
//! too long is written into `tests/corpus/hostile`, where the tests find it, and the search goes
//! on.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus};
use std::time::{Duration, Instant};

use ppum_testkit::corpus::folder;
use ppum_testkit::corpus::hostile::{Arena, STACK, mutant, seeds, survive, valid_seeds};
use ppum_testkit::random::Random;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Longest time for one text.
const PATIENCE: Duration = Duration::from_secs(20);

/// Seeds longer than this are left to the test of kept texts: they cost thousands of short ones.
const LONGEST_SEED: usize = 20_000;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |name: &str, default: u64| -> Result<u64> {
        match arguments.iter().position(|argument| argument == name) {
            Some(k) => Ok(arguments.get(k + 1).ok_or(format!("{name} needs a number"))?.parse()?),
            None => Ok(default),
        }
    };
    let (seconds, seed) = (number("--seconds", 10)?, number("--seed", 1)?);
    match arguments.iter().position(|argument| argument == "--worker") {
        Some(k) => work(Path::new(&arguments[k + 1]), seconds, seed),
        None => watch(Duration::from_secs(seconds), seed),
    }
}

/// Starts workers until the time is up; keeps what they die of.
fn watch(time: Duration, seed: u64) -> Result<()> {
    let current = std::env::temp_dir().join(format!("ppum-fuzz-{}.txt", std::process::id()));
    let (start, mut found) = (Instant::now(), 0);
    while start.elapsed() < time {
        let left = (time - start.elapsed()).as_secs().max(1);
        let mut worker = Command::new(std::env::current_exe()?)
            .args([
                "--seconds",
                &left.to_string(),
                "--seed",
                &(seed + found).to_string(),
                "--worker",
            ])
            .arg(&current)
            .spawn()?;
        let status = wait(&mut worker, &current)?;
        if status.is_some_and(|status| status.success()) {
            break;
        }
        let kept = folder().join(format!("hostile/found-{seed}-{found}.txt"));
        std::fs::copy(&current, &kept)?;
        let what = status.map_or("it takes too long".to_owned(), |status| status.to_string());
        println!("{what}: kept as {}", kept.display());
        found += 1;
    }
    std::fs::remove_file(&current)?;
    if found > 0 { Err(format!("{found} texts found").into()) } else { Ok(()) }
}

/// The end of the worker; `None` if it had to be stopped because one text took too long.
fn wait(worker: &mut Child, current: &PathBuf) -> Result<Option<ExitStatus>> {
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

/// Tries texts on a small stack, each written to a file before.
fn work(current: &Path, seconds: u64, seed: u64) -> Result<()> {
    let (current, time) = (current.to_owned(), Duration::from_secs(seconds));
    let fuzz = move || -> std::result::Result<(), String> {
        let (arena, mut random) = (Arena::new(), Random(seed));
        let mut from = seeds();
        from.retain(|seed| seed.text.len() < LONGEST_SEED);
        from.extend(valid_seeds());
        let (start, mut fates) = (Instant::now(), [0_u64; 3]);
        while start.elapsed() < time {
            let text = mutant(&from, &mut random);
            std::fs::write(&current, &text).map_err(|error| error.to_string())?;
            fates[survive(&text, &arena, &mut random)? as usize] += 1;
        }
        let [refused, large, evaluated] = fates;
        println!("{refused} refused, {large} too large, {evaluated} evaluated; {}", memory());
        Ok(())
    };
    let thread = std::thread::Builder::new().stack_size(STACK).spawn(fuzz)?;
    thread.join().map_err(|_| "panicked")??;
    Ok(())
}

/// The most memory this process has had, where the system tells.
fn memory() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    peak.map_or("memory not known".to_owned(), |peak| format!("at most {} of memory", peak.trim()))
}
