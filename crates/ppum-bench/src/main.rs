//! The program `ppum-bench`: what the solver, the renderers and the window take on this machine.

use std::io::Write as _;
use std::num::NonZeroUsize;
use std::path::PathBuf;

use anyhow::ensure;
use clap::{Parser, Subcommand};
use ppum_bench::paper::{SceneGroup, Single};
use ppum_bench::solver::{SolverChoice, Study};
use ppum_bench::{Report, guard, page, paper, window};

/// The memory of the window's program, as its frames are measured.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Measures the solver, the renderers and the window on this machine.
#[derive(Debug, Parser)]
#[command(name = "ppum-bench", max_term_width = 100)]
struct BenchCli {
    #[command(subcommand)]
    what: BenchCommand,
    /// Frames that are drawn of each kind
    #[arg(long, global = true, value_name = "N", default_value_t = 9)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=1000))]
    frames: u32,
    /// Small problems and images only, to see whether everything works
    #[arg(long, global = true)]
    quick: bool,
    /// Print JSON
    #[arg(long, global = true)]
    json: bool,
    /// Number of threads [default: all cores]
    #[arg(long, global = true, value_name = "N")]
    threads: Option<NonZeroUsize>,
}

#[derive(Debug, Subcommand)]
enum BenchCommand {
    /// The gain of wide vectors, kernel by kernel; fails if a kernel has lost them
    Guard {
        /// Page in Markdown whose part of this name is written again
        #[arg(long)]
        page: Option<PathBuf>,
    },
    /// Table 1 of the 2011 paper, and what else drawing depends on; fails if an image is wrong
    Paper {
        /// Groups of scenes alone, separated by commas
        #[arg(long, value_enum, value_delimiter = ',')]
        scenes: Vec<SceneGroup>,
        /// Page in Markdown whose part of this name is written again
        #[arg(long, conflicts_with = "scenes")]
        page: Option<PathBuf>,
        /// Chart of the times against the patches: .svg, .pdf or .png
        #[arg(short, long)]
        output: Option<PathBuf>,
    },
    /// Frames of a dataset's last step
    Frames {
        /// Dataset
        #[arg(value_name = "FILE.h5")]
        file: PathBuf,
    },
    /// Phases of the solver on uniform covers of growing levels
    Solver {
        /// Problem, by default the centre crack at order 2
        #[arg(value_name = "PROBLEM.toml")]
        problem: Option<PathBuf>,
        /// First level: 4^level cells
        #[arg(long, value_name = "N", default_value_t = 4)]
        first: u32,
        /// Last level; 7 has 212,560 unknowns of the centre crack
        #[arg(long, value_name = "N", default_value_t = 7)]
        level: u32,
        /// Order of the polynomials [default: that of the problem]
        #[arg(long, value_name = "P")]
        order: Option<usize>,
        /// Linear solver
        #[arg(long, value_enum, default_value = "auto")]
        solver: SolverChoice,
        /// Chart of the times against the unknowns: .svg, .pdf or .png
        #[arg(short, long)]
        output: Option<PathBuf>,
    },
    /// Milliseconds of panning in the window, without a display
    Window,
}

fn main() -> anyhow::Result<()> {
    let cli = BenchCli::parse();
    if let Some(threads) = cli.threads {
        rayon::ThreadPoolBuilder::new().num_threads(threads.get()).build_global()?;
    }
    let (quick, frames) = (cli.quick, cli.frames);
    match &cli.what {
        BenchCommand::Guard { page } => {
            cli.on_page(page.as_ref(), "ppum-bench guard", || guard::GuardReport::new(quick))
        }
        BenchCommand::Paper { scenes, page, output } => {
            check(output.as_ref())?;
            cli.on_page(page.as_ref(), "ppum-bench paper", || {
                let report = paper::PaperReport::new(quick, frames, scenes)?;
                output.as_ref().map_or(Ok(()), |path| report.chart(path))?;
                Ok(report)
            })
        }
        BenchCommand::Frames { file } => cli.tell(&Single::new(file, quick, frames)?),
        BenchCommand::Solver { problem, first, level, order, solver, output } => {
            check(output.as_ref())?;
            let last = if quick { *first } else { *level };
            ensure!(output.is_none() || first < &last, "-o draws times over two levels or more");
            let problem = (problem.as_deref(), *order, *solver);
            let study = Study::new(problem, *first..=last)?;
            output.as_ref().map_or(Ok(()), |path| study.chart(path))?;
            cli.tell(&study)
        }
        BenchCommand::Window => cli.tell(&window::WindowReport::new(quick, frames)?),
    }
}

/// Refuses a file that could not be written, before anything is measured.
fn check(output: Option<&PathBuf>) -> anyhow::Result<()> {
    Ok(output.map_or(Ok(()), |path| ppum_file::check(path))?)
}

impl BenchCli {
    /// Measures, and writes the tables to a page too if there is one.
    fn on_page<R: Report>(
        &self,
        path: Option<&PathBuf>,
        name: &str,
        measure: impl FnOnce() -> anyhow::Result<R>,
    ) -> anyhow::Result<()> {
        path.map_or(Ok(()), |path| page::check(path, name))?;
        let report = measure()?;
        path.map_or(Ok(()), |path| page::replace(path, name, &report))?;
        self.tell(&report)
    }

    /// Prints a report, and fails if it says so.
    fn tell(&self, report: &impl Report) -> anyhow::Result<()> {
        let mut out = std::io::stdout().lock();
        if self.json {
            serde_json::to_writer_pretty(&mut out, report)?;
            writeln!(out)?;
        } else {
            write!(out, "{}", report.words())?;
            report.tables().iter().try_for_each(|table| write!(out, "{}", table.text()))?;
        }
        report.verdict()
    }
}
