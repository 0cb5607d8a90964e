//! The machine that is measured.

use std::path::Path;

use ppum::real::{LaneNumber, instructions};
use serde::Serialize;

use crate::cards::{BenchAdapter, BenchDevice};

/// The machine's resources, and those that are used.
#[derive(Debug, Serialize)]
pub(crate) struct Machine {
    processor: String,
    /// Instruction set of the vectors, and how many numbers they hold.
    instructions: &'static str,
    lanes: LaneCounts,
    pub(crate) threads: usize,
    /// Programs that wanted to run in the last minute, on Linux: more than the cores, and times
    /// are long.
    load: Option<f64>,
    adapter: Option<BenchAdapter>,
    /// The reason why there is none.
    missing: Option<String>,
}

#[derive(Debug, Serialize)]
struct LaneCounts {
    f64: usize,
    f32: usize,
}

impl Machine {
    pub(crate) fn new(threads: usize, cards: Result<&BenchDevice, &String>) -> Self {
        let processor = line("/proc/cpuinfo", "model name").unwrap_or_default();
        let processor = processor.trim_start_matches([' ', '\t', ':']).trim();
        let load = line("/proc/loadavg", "").unwrap_or_default();
        Self {
            processor: if processor.is_empty() { std::env::consts::ARCH } else { processor }.into(),
            instructions: instructions(),
            lanes: LaneCounts { f64: f64::VECTOR, f32: f32::VECTOR },
            threads,
            load: load.split(' ').next().and_then(|load| load.parse().ok()),
            adapter: cards.ok().map(BenchDevice::adapter),
            missing: cards.err().cloned(),
        }
    }

    /// Sentences.
    pub(crate) fn words(&self) -> String {
        let Self { processor, instructions, lanes, threads, load, adapter, missing } = self;
        let load = load.map_or(String::new(), |load| format!(", load {load:.1} before"));
        let devices = match (adapter, missing) {
            (Some(BenchAdapter { name, kind }), _) => format!("splat and gather by {name}, {kind}"),
            (None, missing) => {
                format!("splat and gather are missing: {}", missing.as_deref().unwrap_or_default())
            }
        };
        format!(
            "{processor}; {instructions}, {} numbers f64 or {} f32 at once; {threads} threads{load}\n{devices}",
            lanes.f64, lanes.f32
        )
    }
}

/// Linux: the rest of the first line of a file that begins so.
pub(crate) fn line(path: &str, start: &str) -> Option<String> {
    let text = ppum_file::text(Path::new(path), 1 << 24).ok()?;
    text.lines().find_map(|line| line.strip_prefix(start)).map(str::to_owned)
}
