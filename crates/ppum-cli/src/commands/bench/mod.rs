//! `ppum bench`: what the solver and the renderers take on this machine.

mod frames;
mod growth;
mod guard;
mod machine;
mod paper;
mod region;
mod renderer;
mod solver;
mod synthetic;
mod table;
mod window;

use std::io::Write;
use std::num::NonZeroUsize;
use std::path::PathBuf;

use anyhow::{Context as _, ensure};
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
/// and on the CPU, and tells the milliseconds per frame. `ppum bench window` tells those of panning in the window,
/// `ppum bench paper` compares all that draws with table 1 of the 2011 paper, and `ppum bench guard` fails if kernels
/// have lost their vectors.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// What to measure [default: solver and renderer]
    #[arg(value_enum, value_name = "WHAT")]
    what: Option<What>,
    /// Dataset that `renderer` draws, in place of a crack on many covers
    #[arg(value_name = "FILE.h5")]
    file: Option<PathBuf>,
    /// Last level of the solver; 7 has 212,560 unknowns and takes about 10 s and 2 GB
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = clap::value_parser!(u32).range(FIRST..=10))]
    level: u32,
    /// Linear solver
    #[arg(long, value_enum, value_name = "KIND", default_value = "auto")]
    solver: Kind,
    /// Picture of the solver's times against the unknowns, or of `paper`: .svg, .pdf or .png
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    /// Page in Markdown whose tables `paper` or `guard` makes anew
    #[arg(long, value_name = "PAGE")]
    page: Option<PathBuf>,
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
  ppum bench renderer plate.h5
  ppum bench window --frames 100
  ppum bench paper --frames 20 -o frames.svg
  ppum bench paper --page docs/performance.md
  ppum bench guard
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
    /// Table 1 of the 2011 paper, and what else drawing depends on
    Paper,
    /// What wide vectors gain; fails if a kernel has lost them
    Guard,
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

#[derive(Debug, Default, Serialize)]
struct Report {
    threads: usize,
    solver: Vec<Run>,
    /// Of three levels or more.
    #[serde(skip_serializing_if = "Option::is_none")]
    fit: Option<Fits>,
    renderer: Option<renderer::Report>,
    #[serde(skip_serializing_if = "Option::is_none")]
    window: Option<window::Report>,
    #[serde(skip_serializing_if = "Option::is_none")]
    paper: Option<paper::Report>,
    #[serde(skip_serializing_if = "Option::is_none")]
    guard: Option<guard::Report>,
}

impl Args {
    pub(crate) fn run(&self, out: &mut Output) -> anyhow::Result<()> {
        self.check()?;
        let threads = threads::with(self.threads, rayon::current_num_threads)?;
        let mut report = Report { threads, ..Report::default() };
        match self.what {
            None => {
                self.solve(&mut report, out)?;
                self.draw(&mut report)?;
            }
            Some(What::Solver) => self.solve(&mut report, out)?,
            Some(What::Renderer) => self.draw(&mut report)?,
            Some(What::Window) => {
                report.window = Some(window::Report::new(self.quick, self.frames)?)
            }
            Some(What::Paper) => {
                report.paper = Some(paper::Report::new(self.quick, self.frames, threads)?);
            }
            Some(What::Guard) => report.guard = Some(guard::Report::new(self.quick)?),
        }
        self.show(&report, out)?;
        self.keep(&report, out)?;
        report.verdict()
    }

    /// Refuses what could not be written, before anything is measured.
    fn check(&self) -> anyhow::Result<()> {
        ensure!(
            self.file.is_none() || self.what == Some(What::Renderer),
            "a dataset is drawn by `ppum bench renderer`"
        );
        if let Some(path) = &self.output {
            target::check(path, target::Kind::Picture, [])?;
            ensure!(
                self.what == Some(What::Paper) || self.levels().count() > 1,
                "-o draws the solver's times over levels, or those of `paper`; measure two levels or more"
            );
        }
        let Some(page) = &self.page else { return Ok(()) };
        let name = self.part().context("--page takes the tables of `paper` and `guard`")?;
        region::check(page, name)
    }

    /// The part of a page that is made.
    fn part(&self) -> Option<&'static str> {
        match self.what? {
            What::Paper => Some("ppum bench paper"),
            What::Guard => Some("ppum bench guard"),
            _ => None,
        }
    }

    /// Measures the solver, and tells of each level when it is done.
    fn solve(&self, report: &mut Report, out: &mut Output) -> anyhow::Result<()> {
        for level in self.levels() {
            let run = threads::with(self.threads, || Run::new(level, self.solver.of_problem()))??;
            if !self.json {
                run.print(report.threads, out)?;
                out.flush()?;
            }
            report.solver.push(run);
        }
        report.fit = Fits::new(&report.solver);
        Ok(())
    }

    fn draw(&self, report: &mut Report) -> anyhow::Result<()> {
        let measure = || renderer::Report::new(self.quick, self.frames, self.file.as_deref());
        report.renderer = Some(threads::with(self.threads, measure)??);
        Ok(())
    }

    fn show(&self, report: &Report, out: &mut Output) -> anyhow::Result<()> {
        if self.json {
            return Ok(json(out, report)?);
        }
        growth::print(&report.solver, report.fit.as_ref(), out)?;
        report.renderer.iter().try_for_each(|renderer| renderer.print(report.threads, out))?;
        report.window.iter().try_for_each(|window| window.print(out))?;
        if let Some((words, tables)) = report.tables() {
            write!(out, "{words}")?;
            table::print(&tables, out)?;
        }
        Ok(())
    }

    /// Writes the picture and the page.
    fn keep(&self, report: &Report, out: &mut Output) -> anyhow::Result<()> {
        if let Some(path) = &self.output {
            match &report.paper {
                Some(paper) => paper.chart(path, self.json, out)?,
                None => {
                    growth::picture((&report.solver, report.fit.as_ref()), path, self.json, out)?
                }
            }
        }
        let Some(((page, name), (words, tables))) =
            self.page.as_ref().zip(self.part()).zip(report.tables())
        else {
            return Ok(());
        };
        let tables: Vec<String> = tables.iter().map(table::Table::markdown).collect();
        region::replace(page, name, &format!("```text\n{words}```\n\n{}", tables.join("\n")))
    }

    fn levels(&self) -> std::ops::Range<u32> {
        let first = FIRST as u32;
        let last = if self.quick { first } else { self.level };
        let is_solver = matches!(self.what, None | Some(What::Solver));
        let end = if is_solver { last + 1 } else { first };
        first..end
    }
}

impl Report {
    /// What `paper` or `guard` have to show.
    fn tables(&self) -> Option<(String, Vec<table::Table>)> {
        let paper = self.paper.as_ref().map(|paper| (paper.words(), paper.tables()));
        let guard = || self.guard.as_ref().map(|guard| (guard.words(), vec![guard.table()]));
        paper.or_else(guard)
    }

    fn verdict(&self) -> anyhow::Result<()> {
        self.paper.iter().try_for_each(paper::Report::verdict)?;
        self.guard.iter().try_for_each(guard::Report::verdict)
    }
}
