//! `ppum bench`: what the solver and the renderers take on this machine.

mod growth;
mod renderer;
mod solver;
mod synthetic;
mod window;

use std::io::Write;
use std::num::NonZeroUsize;
use std::path::PathBuf;

use anyhow::ensure;
use clap::ValueEnum;
use ppum_solve::problem::SolverKind;
use serde::Serialize;

use crate::number::json;
use crate::output::Output;
use crate::target;
use crate::threads;
use growth::Fits;
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
    /// Linear solver
    #[arg(long, value_enum, value_name = "KIND", default_value = "auto")]
    solver: Kind,
    /// Picture of the solver's times against the unknowns: .svg, .pdf or .png
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
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
  ppum bench solver --level 8 --solver multilevel -o times.svg
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

/// The linear solver of the problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// What is predicted to be faster
    Auto,
    /// Cholesky factorisation
    Direct,
    /// Conjugate gradients with coarser levels
    Multilevel,
}

impl Kind {
    fn of_problem(self) -> SolverKind {
        match self {
            Self::Auto => SolverKind::Auto,
            Self::Direct => SolverKind::Direct,
            Self::Multilevel => SolverKind::Multilevel,
        }
    }
}

#[derive(Debug, Serialize)]
struct Report {
    threads: usize,
    solver: Vec<Run>,
    /// Of three levels or more.
    #[serde(skip_serializing_if = "Option::is_none")]
    fit: Option<Fits>,
    renderer: Option<renderer::Report>,
    #[serde(skip_serializing_if = "Option::is_none")]
    window: Option<window::Report>,
}

impl Args {
    pub(crate) fn run(&self, out: &mut Output) -> anyhow::Result<()> {
        if let Some(path) = &self.output {
            target::check(path, target::Kind::Picture, [])?;
            ensure!(
                self.levels().count() > 1,
                "-o draws the solver's times over levels; measure two levels or more"
            );
        }
        let threads = threads::with(self.threads, rayon::current_num_threads)?;
        let mut solver = Vec::new();
        for level in self.levels() {
            let run = threads::with(self.threads, || Run::new(level, self.solver.of_problem()))??;
            if !self.json {
                run.print(threads, out)?;
                out.flush()?;
            }
            solver.push(run);
        }
        let fit = Fits::new(&solver);
        if !self.json {
            growth::print(&solver, fit.as_ref(), out)?;
        }
        let measure = || renderer::Report::new(self.quick, self.frames);
        let wanted = !matches!(self.what, Some(What::Solver | What::Window));
        let renderer =
            wanted.then(|| threads::with(self.threads, measure)).transpose()?.transpose()?;
        let window = (self.what == Some(What::Window))
            .then(|| window::Report::new(self.quick, self.frames))
            .transpose()?;
        if let Some(path) = &self.output {
            growth::picture((&solver, fit.as_ref()), path, self.json, out)?;
        }
        if self.json {
            return Ok(json(out, &Report { threads, solver, fit, renderer, window })?);
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
