//! `ppum solve`: from a problem file to a dataset.

use std::io::{self, Write};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use anyhow::{bail, ensure};
use ppum::dataset::{Dataset, Record};
use ppum_solve::problem::Problem;
use ppum_solve::solve::solve;
use serde::Serialize;

use super::info::reactions::{self, ReactionRow};
use super::info::report::{HistoryRow, history_row};
use crate::number::{Number, count, json, places};
use crate::progress::Bar;
use crate::standard::{self, is_standard};
use crate::threads;
use crate::tips::{Tip, all_tips, table};
use crate::warnings::{WarningRow, rows, warn};

/// Solve a problem and write the dataset
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Problem file (TOML), see docs/problem-file.md; - for standard input
    #[arg(value_name = "PROBLEM.toml")]
    problem: PathBuf,
    /// Dataset to write, - for standard output [default: beside the problem file, with the extension
    /// .h5]
    #[arg(short, long, value_name = "FILE.h5")]
    output: Option<PathBuf>,
    /// Read and check the problem file, and stop there
    #[arg(long)]
    check: bool,
    /// Print JSON, see docs/cli.md
    #[arg(long, conflicts_with = "check")]
    json: bool,
    /// Number of threads [default: all cores]; the result does not depend on it
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
}

const EXAMPLES: &str = "\
Examples:
  ppum solve plate.toml                      writes plate.h5
  ppum solve plate.toml -o results/fine.h5
  ppum solve plate.toml --check              reports every mistake in the file
  ppum solve plate.toml --json | jq '.tips[] | [.k1, .k2]'
  sed 's/level = 4/level = 5/' plate.toml | ppum solve - -o fine.h5";

impl Args {
    pub(crate) fn run(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        let problem = self.problem()?;
        if self.check {
            writeln!(out, "{}: nothing wrong", standard::name(&self.problem))?;
            return Ok(());
        }
        let target = self.target()?;
        let dataset = {
            let bar = Bar::new();
            threads::with(self.threads, || solve(&problem, &mut |progress| bar.show(progress)))??
        };
        let report = Report::new(target.display().to_string(), &dataset);
        if is_standard(&target) {
            out.write_all(&ppum_format::to_bytes(&dataset)?)?;
            return report.write(&mut io::stderr(), &dataset);
        }
        ppum_format::write(&dataset, &target)?;
        if self.json {
            warn(&report.warnings);
            return Ok(json(out, &report)?);
        }
        report.write(out, &dataset)
    }

    /// The problem; files that standard input names are looked for in the working directory.
    fn problem(&self) -> anyhow::Result<Problem> {
        if !is_standard(&self.problem) {
            return Ok(Problem::read(&self.problem)?);
        }
        let text = standard::text("the problem")?;
        Ok(Problem::parse(&text, "standard input", Path::new(""))?)
    }

    /// Where the dataset is written to.
    fn target(&self) -> anyhow::Result<PathBuf> {
        let target = match &self.output {
            Some(output) => output.clone(),
            None if is_standard(&self.problem) => {
                bail!(
                    "a problem from standard input has no place for its dataset: give a file with -o"
                )
            }
            None => self.problem.with_extension("h5"),
        };
        if is_standard(&target) {
            ensure!(
                !self.json,
                "--json and `-o -` would both write to standard output; give a file with -o"
            );
            standard::check_output("a dataset")?;
        } else {
            self.check_target(&target)?;
        }
        Ok(target)
    }

    /// Refuses now what could not be written after minutes of work.
    fn check_target(&self, target: &Path) -> anyhow::Result<()> {
        ensure!(
            target != self.problem,
            "{}: the dataset would replace the problem file; give another file with -o",
            target.display()
        );
        if target.is_dir() {
            bail!("{}: is a folder; give a file with -o", target.display());
        }
        let folder = target.parent().filter(|f| !f.as_os_str().is_empty());
        match folder {
            Some(folder) if !folder.is_dir() => {
                bail!("cannot write {}: there is no folder {}", target.display(), folder.display())
            }
            _ => Ok(()),
        }
    }
}

/// What is told of a solution; more of it is in `ppum info`.
#[derive(Debug, Serialize)]
struct Report {
    file: String,
    title: String,
    patches: usize,
    unknowns: usize,
    energy: Option<Number>,
    /// Of all phases.
    seconds: f64,
    phases: Vec<PhaseRow>,
    history: Vec<HistoryRow>,
    tips: Vec<Tip>,
    reactions: Vec<ReactionRow>,
    warnings: Vec<WarningRow>,
}

#[derive(Debug, Serialize)]
struct PhaseRow {
    name: String,
    seconds: f64,
}

impl Report {
    /// The solver makes one step with one field.
    fn new(file: String, dataset: &Dataset) -> Self {
        let step = &dataset.steps[0];
        let (times, numbers): (Vec<_>, Vec<_>) = step.history.iter().partition(|r| r.unit == "s");
        let phase = |r: &&Record| PhaseRow { name: r.name.clone(), seconds: r.value };
        let is_elastic = dataset.equation.elastic().is_some();
        let energy = numbers.iter().find(|r| r.name == "energy");
        Self {
            file,
            title: dataset.title.clone(),
            patches: step.partition.len(),
            unknowns: step.fields[0].coefficients.iter().map(Vec::len).sum(),
            energy: energy.map(|r| Number(r.value)),
            seconds: times.iter().map(|r| r.value).sum(),
            phases: times.iter().map(phase).collect(),
            history: numbers.into_iter().map(history_row).collect(),
            tips: if is_elastic { all_tips(0, step) } else { Vec::new() },
            reactions: reactions::rows(dataset, step),
            warnings: rows(0, &step.warnings),
        }
    }

    /// The same for people, warnings on standard error.
    fn write(&self, out: &mut dyn Write, dataset: &Dataset) -> anyhow::Result<()> {
        let Self { title, patches, unknowns, seconds, .. } = self;
        let patches = count(*patches, "patch", "patches");
        writeln!(out, "{title}")?;
        writeln!(out, "{patches}, {unknowns} unknowns, solved in {seconds:.1} s")?;
        if !self.tips.is_empty() {
            table(out, &self.tips, &places(dataset))?;
        }
        out.flush()?;
        warn(&self.warnings);
        let target = Path::new(&self.file);
        let name = if is_standard(target) { "standard output" } else { &self.file };
        writeln!(out, "wrote {name}")?;
        Ok(())
    }
}
