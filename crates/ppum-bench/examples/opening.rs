//! Times of opening datasets, of reading steps and of appending them, on files in the system's memory: the least and the
//! median of each, as they pass, and of the processor.
//!
//! `cargo run --release -p ppum-bench --example opening [FOLDER [LEVEL]]`: of 4^LEVEL patches alone.

use std::path::Path;
use std::time::Instant;

use cpu_time::ProcessTime;
use ppum::crack::{CrackEnd, End, TipId};
use ppum::function::{Frame, WESTERGAARD};
use ppum::prelude::*;
use ppum_format::{Series, SeriesWriter};

const DOMAIN: Rect = Rect { min: vec2(-0.65, -0.48), max: vec2(0.68, 0.52) };
const TIPS: [Vec2; 2] = [vec2(-0.2, 0.0), vec2(0.2, 0.0)];

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
        ppum_format::write(&dataset(level)?, path)?;
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
    let dataset = dataset(4)?;
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

/// A uniform cover of 4^level cells of a plate with a crack; a quarter of the patches has tip functions.
fn dataset(level: u8) -> Result<Dataset, Box<dyn std::error::Error>> {
    let partition = Cover::uniform(DOMAIN, level)?.partition(1.3, WeightFunction::Linear)?;
    let mut field = FieldData::new("displacement", &["ux", "uy"]);
    for patch in 0..partition.len() {
        let (p, s) = (partition.center[patch], partition.scale[patch]);
        let tip = usize::from(p.x > 0.0);
        if (p - TIPS[tip]).length() < 0.23 {
            let first = 1 + 4 * tip as u32;
            field.push_patch(&[(0, 2), (first, 0), (first + 1, 0), (first + 2, 0), (first + 3, 0)]);
        } else {
            field.push_patch(&[(0, 2)]);
        }
        for (k, values) in field.coefficients.iter_mut().enumerate() {
            let from = field.block_offset[field.patch_blocks[patch] as usize] as usize;
            let phase = 3.0 * p.x - 2.0 * p.y + k as f64;
            let (sin, cos) = phase.sin_cos();
            let taylor = [
                sin,
                3.0 * s.x * cos,
                -2.0 * s.y * cos,
                -4.5 * s.x * s.x * sin,
                6.0 * s.x * s.y * sin,
                -2.0 * s.y * s.y * sin,
            ];
            values[from..from + 6].copy_from_slice(&taylor);
            values[from + 6..].fill(0.3);
        }
    }
    let mut step = Step::new(partition).with_function("one", FunctionKind::One);
    step.cracks.push(Crack { points: TIPS.to_vec(), ends: [CrackEnd::Tip; 2] });
    for end in [End::Start, End::Last] {
        let frame = Frame::Tip(TipId { crack: 0, end });
        for text in WESTERGAARD {
            step = step.with_function(text, FunctionKind::formula(text, frame));
        }
    }
    let material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
    Ok(Dataset::new(DOMAIN, Equation::elasticity(material)).with_step(step.with_field(field)))
}
