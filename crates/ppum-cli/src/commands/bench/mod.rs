//! `ppum bench`: what the solver and the renderers take on this machine.

mod renderer;
mod solver;
mod synthetic;
mod window;

use std::io::Write;
use std::num::NonZeroUsize;

use clap::ValueEnum;
use serde::Serialize;

use crate::number::json;
use crate::threads;
use solver::Run;

/// Measure the solver and the renderers on this machine
///
/// Solves the centre crack at order 2 on covers of growing levels and tells the seconds and unknowns
/// per second of each phase. Draws a centre crack on covers of 16 to 1,048,576 patches by splatting, by gathering
/// and on the CPU, and tells the milliseconds per frame. `ppum bench window` tells those of panning in the window.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// What to measure [default: solver and renderer]
    #[arg(value_enum, value_name = "WHAT")]
    what: Option<What>,
    /// Last level of the solver; 7 has 212,560 unknowns and takes about 10 s and 2 GB
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = clap::value_parser!(u32).range(FIRST..=10))]
    level: u32,
    /// Frames that are drawn of each kind
    #[arg(long, value_name = "N", default_value_t = 9, value_parser = clap::value_parser!(u32).range(1..=1000))]
    frames: u32,
    /// Small problems only, to see whether everything works: --level 4, pictures of 256x192 of at most 256 patches
    #[arg(long)]
    quick: bool,
    /// Print JSON, see docs/cli.md
    #[arg(long)]
    json: bool,
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = threads::number)]
    threads: Option<NonZeroUsize>,
}

const EXAMPLES: &str = "\
Examples:
  ppum bench
  ppum bench solver --level 5 --threads 1
  ppum bench renderer --frames 30
  ppum bench window --frames 100
  ppum bench solver --json | jq '.solver[-1].seconds'";

/// First level.
const FIRST: i64 = 4;

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum What {
    /// Phases of the solver
    Solver,
    /// Milliseconds a frame
    Renderer,
    /// Milliseconds a frame of panning in the window, without a display
    Window,
}

#[derive(Debug, Serialize)]
struct Report {
    threads: usize,
    solver: Vec<Run>,
    renderer: Option<renderer::Report>,
    #[serde(skip_serializing_if = "Option::is_none")]
    window: Option<window::Report>,
}

impl Args {
    pub(crate) fn run(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        let threads = threads::with(self.threads, rayon::current_num_threads)?;
        let mut solver = Vec::new();
        for level in self.levels() {
            let run = threads::with(self.threads, || Run::new(level))??;
            if !self.json {
                run.print(threads, out)?;
                out.flush()?;
            }
            solver.push(run);
        }
        let measure = || renderer::Report::new(self.quick, self.frames);
        let wanted = !matches!(self.what, Some(What::Solver | What::Window));
        let renderer =
            wanted.then(|| threads::with(self.threads, measure)).transpose()?.transpose()?;
        let window = (self.what == Some(What::Window))
            .then(|| window::Report::new(self.quick, self.frames))
            .transpose()?;
        if self.json {
            return Ok(json(out, &Report { threads, solver, renderer, window })?);
        }
        renderer.iter().try_for_each(|renderer| renderer.print(threads, out))?;
        window.iter().try_for_each(|window| window.print(out))?;
        Ok(())
    }

    fn levels(&self) -> std::ops::Range<u32> {
        let first = FIRST as u32;
        let last = if self.quick { first } else { self.level };
        let is_solver = matches!(self.what, None | Some(What::Solver));
        let end = if is_solver { last + 1 } else { first };
        first..end
    }
}
