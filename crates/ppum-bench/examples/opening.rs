//! Times of opening datasets, of reading steps and of appending them, on files in the system's
//! memory: the least and the median of each, as they pass, and of the processor.
//!
//! `cargo run --release -p ppum-bench --example opening [FOLDER [LEVEL]]`: of 4^LEVEL patches
//! alone.

use std::path::Path;
use std::time::Instant;

use cpu_time::ProcessTime;
use ppum::dataset::{Dataset, Step};
use ppum_bench::synthetic::CrackRecipe;
use ppum_format::{Series, SeriesWriter};

/// Repetitions of a measurement.
const TIMES: usize = 9;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let [given, level] = [1, 2].map(|k| std::env::args().nth(k));
    let own = tempfile::tempdir()?;
    let folder = given.as_ref().map_or(own.path(), Path::new);
    let levels = match &level {
        Some(level) => vec![level.parse()?],
        None => vec![2, 7, 10],
    };
    for level in levels {
        opening(&folder.join(format!("patches-{level}.h5")), level)?;
    }
    let series = if level.is_none() { [1, 100, 1000].as_slice() } else { &[] };
    for &steps in series {
        appending(&folder.join(format!("series-{steps}.h5")), steps)?;
    }
    Ok(())
}

/// A file of 4^level patches, which stays if it is there already.
fn opening(path: &Path, level: u8) -> Result<(), Box<dyn std::error::Error>> {
    if !path.exists() {
        let start = Instant::now();
        ppum_format::write(&CrackRecipe::new(level, level).dataset()?, path)?;
        println!("writing {}: {:.0} ms", path.display(), milliseconds(start));
    }
    let dataset = ppum_format::read(path)?;
    let bytes = std::fs::read(path)?;
    let (file, memory) = (bytes.len() as f64, size(&dataset) as f64);
    println!(
        "{} patches: file {:.1} MB, values {:.1} MB",
        1_u64 << (2 * level),
        file / 1e6,
        memory / 1e6
    );
    println!("              least   median     core  MB/s of the file, of values");
    let told = |what: &str, times: Times| {
        let rate = |bytes: f64| bytes / 1e3 / times.least;
        println!("{} {:9.0} {:9.0}", times.line(what), rate(file), rate(memory));
    };
    told("read bytes", measured(|| std::fs::read(path).map(drop))?);
    told("check", measured(|| dataset.check())?);
    told("from bytes", measured(|| ppum_format::from_bytes(bytes.clone()).map(drop))?);
    told("open", measured(|| ppum_format::read(path).map(drop))?);
    Ok(())
}

/// A series of steps of 256 patches.
fn appending(path: &Path, steps: usize) -> Result<(), Box<dyn std::error::Error>> {
    let dataset = CrackRecipe::new(4, 4).dataset()?;
    let step = &dataset.steps[0];
    let mut writer = SeriesWriter::begin(path, &dataset)?;
    for _ in 1..steps {
        writer.append(step)?;
    }
    println!("a series of {steps} steps, {:.1} MB", std::fs::metadata(path)?.len() as f64 / 1e6);
    let told = |what: &str, times: Times| println!("{}", times.line(what));
    told("append", measured(|| writer.append(step))?);
    drop(writer);
    told("resume", measured(|| SeriesWriter::resume(path).map(drop))?);
    told("open", measured(|| Series::open(path).map(drop))?);
    let series = Series::open(path)?;
    told("a step", measured(|| series.dataset(steps - 1).map(drop))?);
    told("all steps", measured(|| ppum_format::read(path).map(drop))?);
    Ok(())
}

/// Times of a call in milliseconds.
struct Times {
    least: f64,
    median: f64,
    /// The least time of all processors together.
    core: f64,
}

impl Times {
    fn line(&self, what: &str) -> String {
        let Self { least, median, core } = self;
        format!("  {what:10} {least:8.2} {median:8.2} {core:8.2}")
    }
}

fn measured<E>(mut run: impl FnMut() -> Result<(), E>) -> Result<Times, E> {
    let (mut times, mut core) = ([0.0; TIMES], f64::INFINITY);
    for time in &mut times {
        let (start, busy) = (Instant::now(), ProcessTime::now());
        run()?;
        *time = milliseconds(start);
        core = core.min(busy.elapsed().as_secs_f64() * 1e3);
    }
    times.sort_by(f64::total_cmp);
    Ok(Times { least: times[0], median: times[TIMES / 2], core })
}

fn milliseconds(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}

/// Bytes of the large arrays.
fn size(dataset: &Dataset) -> usize {
    let Step { partition, fields, .. } = &dataset.steps[0];
    let field = &fields[0];
    let coefficients: usize = field.coefficients.iter().map(Vec::len).sum();
    105 * partition.len() + 13 * field.block_degree.len() + 8 * coefficients
}
