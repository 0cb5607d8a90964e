//! The machine that is measured.

use ppum::real::{Scalar, instructions};
use serde::Serialize;
use sysinfo::{CpuRefreshKind, RefreshKind, System};

use super::frames::Adapter;
use crate::graphics::Cards;

/// What there is, and what of it is used.
#[derive(Debug, Serialize)]
pub(super) struct Machine {
    processor: String,
    /// Instruction set of the vectors, and how many numbers they hold.
    instructions: &'static str,
    lanes: Lanes,
    pub(super) threads: usize,
    /// Programs that wanted to run in the last minute, where the system tells: more than the cores, and times are long.
    load: Option<f64>,
    adapter: Option<Adapter>,
    /// The reason why there is none.
    missing: Option<String>,
}

#[derive(Debug, Serialize)]
struct Lanes {
    f64: usize,
    f32: usize,
}

impl Machine {
    pub(super) fn new(threads: usize, cards: Result<&Cards, &String>) -> Self {
        let refreshed = RefreshKind::nothing().with_cpu(CpuRefreshKind::nothing());
        let system = System::new_with_specifics(refreshed);
        let processor = system.cpus().first().map_or("", |cpu| cpu.brand().trim());
        let load = System::load_average().one;
        Self {
            processor: if processor.is_empty() { std::env::consts::ARCH } else { processor }.into(),
            instructions: instructions(),
            lanes: Lanes { f64: f64::VECTOR, f32: f32::VECTOR },
            threads,
            load: (load > 0.0).then_some(load),
            adapter: cards.ok().map(Adapter::of),
            missing: cards.err().cloned(),
        }
    }

    /// Sentences.
    pub(super) fn words(&self) -> String {
        let Self { processor, instructions, lanes, threads, load, adapter, missing } = self;
        let load = load.map_or(String::new(), |load| format!(", load {load:.1} before"));
        let devices = match (adapter, missing) {
            (Some(Adapter { name, kind }), _) => format!("splat and gather by {name}, {kind}"),
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
