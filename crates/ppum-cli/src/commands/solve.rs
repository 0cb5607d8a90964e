//! `ppum solve`: from a problem file to a dataset.

use std::io::Write;
use std::num::NonZeroUsize;
use std::path::PathBuf;

use ppum::dataset::{Dataset, Record, Step};
use ppum::formula::one_line;
use ppum::weight::WeightFunction;
use ppum_solve::problem::Problem;
use ppum_solve::solve::Plan;

use crate::arguments::positive;
use crate::families::{Family, blocks, families};
use crate::memory;
use crate::number::trimmed;
use crate::progress::Bar;
use crate::target;
use crate::threads;
use crate::tips::{Tip, table};
use crate::warnings::{rows, warn};

/// Solve a problem and write the dataset
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Problem file (TOML), see docs/problem-file.md
    #[arg(value_name = "PROBLEM.toml")]
    problem: PathBuf,
    /// Dataset to write [default: beside the problem file, with the extension .h5]
    #[arg(short, long, value_name = "FILE.h5")]
    output: Option<PathBuf>,
    /// Find everything that would be refused, tell what the solution takes, and stop there
    #[arg(long)]
    check: bool,
    /// Memory that may be used, in GiB [default: what is free]
    #[arg(long, value_name = "GIB", value_parser = positive)]
    memory: Option<f64>,
    /// Number of threads [default: all cores]; the result does not depend on it
    #[arg(long, value_name = "N", value_parser = threads::number)]
    threads: Option<NonZeroUsize>,
}

const EXAMPLES: &str = "\
Examples:
  ppum solve plate.toml                      writes plate.h5
  ppum solve plate.toml -o results/fine.h5
  ppum solve plate.toml --check              reports every mistake in the file";

impl Args {
    pub(crate) fn run(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        let problem = Problem::read(&self.problem)?;
        let target = self.output.clone().unwrap_or_else(|| self.problem.with_extension("h5"));
        let inputs = [&self.problem].into_iter().chain(&problem.files).map(PathBuf::as_path);
        target::check(&target, target::Kind::Dataset, inputs)?;
        if self.check {
            return self.tell(out, &problem);
        }
        let dataset = {
            let bar = Bar::new();
            let mut show = |progress| bar.show(progress);
            let memory = self.memory();
            let solve = || {
                let plan = Plan::new(&problem, memory, &mut show)?;
                ppum_format::check(plan.dataset())?;
                anyhow::Ok(plan.solve(&mut show)?)
            };
            threads::with(self.threads, solve)??
        };
        ppum_format::write(&dataset, &target)?;
        summary(out, &dataset)?;
        writeln!(out, "wrote {}", target.display())?;
        Ok(())
    }

    /// Does all but solving: what is refused is told now.
    fn tell(&self, out: &mut dyn Write, problem: &Problem) -> anyhow::Result<()> {
        let checked = || {
            let plan = Plan::new(problem, self.memory(), &mut |_| {})?;
            plan.check()?;
            ppum_format::check(plan.dataset())?;
            anyhow::Ok(*plan.estimate())
        };
        let estimate = threads::with(self.threads, checked)??;
        writeln!(out, "{}: nothing wrong", self.problem.display())?;
        writeln!(out, "{estimate}")?;
        Ok(())
    }

    /// The memory that the solution may take [bytes].
    fn memory(&self) -> Option<u64> {
        self.memory.map(|gibibytes| (gibibytes * f64::from(1 << 30)) as u64).or_else(memory::free)
    }
}

fn summary(out: &mut dyn Write, dataset: &Dataset) -> anyhow::Result<()> {
    writeln!(out, "{}", dataset.title)?;
    for (index, step) in dataset.steps.iter().enumerate() {
        functions(out, step)?;
        history(out, step)?;
        let tips: Vec<_> = step.intensities.iter().map(|t| Tip::new(index, step, t)).collect();
        if !tips.is_empty() {
            table(out, &tips)?;
        }
        warn(&rows(index, &step.warnings));
    }
    Ok(())
}

/// The functions beside 1 that multiply polynomials, and the weight if it is a formula.
fn functions(out: &mut dyn Write, step: &Step) -> anyhow::Result<()> {
    let Some(field) = step.fields.first() else { return Ok(()) };
    let families = families(&step.functions, &blocks(&step.functions, field));
    let enriched = families.iter().filter(|family| family.blocks > 0 && family.name != "one");
    let titles: Vec<_> = enriched.map(Family::title).collect();
    if !titles.is_empty() {
        writeln!(out, "functions {}", titles.join(", "))?;
    }
    if let WeightFunction::Formula(weight) = &step.partition.weight {
        writeln!(out, "weight {}", one_line(weight.text()))?;
    }
    Ok(())
}

/// The solver's report: its numbers on one line, its times on another.
fn history(out: &mut dyn Write, step: &Step) -> anyhow::Result<()> {
    let (times, numbers): (Vec<_>, Vec<_>) = step.history.iter().partition(|r| r.unit == "s");
    let line = |records: &[&Record]| {
        let part = |r: &&Record| match r.unit.as_str() {
            "s" => format!("{} {:.2} s", r.name, r.value),
            unit => format!("{} {} {unit}", r.name, trimmed(r.value)).trim_end().to_owned(),
        };
        records.iter().map(part).collect::<Vec<_>>().join(", ")
    };
    writeln!(out, "patches {}, {}", step.partition.len(), line(&numbers))?;
    writeln!(out, "{}", line(&times))?;
    Ok(())
}
