//! `ppum solve`: from a problem file to a dataset.

mod growth;

use std::io::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, ensure};
use ppum::dataset::{Dataset, Record, Step};
use ppum_fracture::solve::Plan;
use ppum_problem::Problem;
use ppum_scene::facts::{self, Tip, all_tips};
use ppum_scene::range::places;
use ppum_solve::report::{LinearKind, SolverReport};
use serde::Serialize;

use crate::memory;
use crate::number::{JsonNumber, count, json};
use crate::output::StandardStream;
use crate::progress::ProgressLine;
use crate::standard::{self, is_standard};
use crate::target;
use crate::threads;
use crate::tips::table;
use crate::warnings::warn;
use ppum_scene::arguments::positive;

/// Solve a problem and write the dataset
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct SolveArgs {
    /// Problem file (TOML), such as `ppum init` writes; - for standard input
    #[arg(value_name = "PROBLEM.toml")]
    problem: PathBuf,
    /// Dataset to write, - for standard output [default: beside the problem file, with the
    /// extension .h5]
    #[arg(short, long, value_name = "FILE.h5")]
    output: Option<PathBuf>,
    /// Validate the problem and estimate the memory that it needs; do not solve it
    #[arg(long)]
    check: bool,
    /// Continue an interrupted series in the output file
    #[arg(long, conflicts_with = "check")]
    resume: bool,
    /// Memory limit in GiB; larger problems are refused [default: the free memory]
    #[arg(long, value_name = "GIB", value_parser = positive)]
    memory: Option<f64>,
    /// Print JSON
    #[arg(long, conflicts_with = "check")]
    json: bool,
    /// Number of threads [default: all cores]; the result does not depend on it
    #[arg(long, value_name = "N", value_parser = threads::number)]
    threads: Option<NonZeroUsize>,
}

const EXAMPLES: &str = "\
Examples:
  ppum solve plate.toml                      writes plate.h5
  ppum solve plate.toml -o results/fine.h5
  ppum solve plate.toml --check              reports every mistake in the file
  ppum solve plate.toml --json | jq '.tips[] | [.k1, .k2]'
  sed 's/level = 4/level = 5/' plate.toml | ppum solve - -o fine.h5";

impl SolveArgs {
    pub(crate) fn run(&self, out: &mut StandardStream) -> anyhow::Result<()> {
        let problem = self.problem()?;
        let target = self.target();
        if let Some(target) = &target {
            self.check_target(target, &problem)?;
        }
        if self.check {
            return self.tell(out, &problem);
        }
        let target = target.context(
            "a problem from standard input has no place for its dataset: give a file with -o",
        )?;
        if let Some(rule) = &problem.growth {
            return growth::run(self, &problem, rule, &target, out);
        }
        ensure!(!self.resume, "--resume goes on with a series; the problem has no [growth]");
        let dataset = {
            let bar = ProgressLine::new();
            let memory = self.memory();
            let solve = || {
                let plan = Plan::new(&problem, memory, &bar)?;
                ppum_format::check(plan.dataset())?;
                anyhow::Ok(plan.solve(&bar)?)
            };
            threads::with(self.threads, solve)??
        };
        let report = SolveReport::new(target.display().to_string(), &dataset);
        if is_standard(&target) {
            out.exact().write_all(&ppum_format::to_bytes(&dataset)?)?;
            return report.write(&mut StandardStream::stderr(), &dataset);
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

    /// The place of the dataset; none if nobody gives one.
    fn target(&self) -> Option<PathBuf> {
        let beside = || self.problem.with_extension("h5");
        self.output.clone().or_else(|| (!is_standard(&self.problem)).then(beside))
    }

    /// Refuses now what could not be written after minutes of work.
    fn check_target(&self, target: &Path, problem: &Problem) -> anyhow::Result<()> {
        ensure!(
            !(self.json && is_standard(target)),
            "--json and `-o -` would both write to standard output; give a file with -o"
        );
        let inputs = [&self.problem].into_iter().chain(&problem.files).map(PathBuf::as_path);
        target::check(target, target::FileKind::Dataset, inputs)
    }

    /// Does all but solving: what is refused is told now.
    fn tell(&self, out: &mut dyn Write, problem: &Problem) -> anyhow::Result<()> {
        let checked = || {
            let bar = ProgressLine::new();
            let plan = Plan::new(problem, self.memory(), &bar)?;
            plan.check(&bar)?;
            ppum_format::check(plan.dataset())?;
            anyhow::Ok(*plan.estimate())
        };
        let estimate = threads::with(self.threads, checked)??;
        writeln!(out, "{}: nothing wrong", standard::name(&self.problem))?;
        let of_what = if problem.adaptivity.is_some() { "the first step: " } else { "" };
        writeln!(out, "{of_what}{estimate}")?;
        let arcs = problem.arcs();
        if arcs > 0 {
            writeln!(out, "curves of {arcs} arc{}", if arcs == 1 { "" } else { "s" })?;
        }
        problem.notes.iter().try_for_each(|note| writeln!(out, "note: {note}"))?;
        Ok(())
    }

    /// The memory that the solution may take \[bytes\].
    fn memory(&self) -> Option<u64> {
        self.memory.map(|gibibytes| (gibibytes * f64::from(1 << 30)) as u64).or_else(memory::free)
    }
}

/// The report of a solution; more of it is in `ppum info`.
#[derive(Debug, Serialize)]
struct SolveReport {
    file: String,
    title: String,
    patches: usize,
    unknowns: usize,
    energy: Option<JsonNumber>,
    /// In the energy norm, as a part of that of the solution.
    estimated_error: Option<JsonNumber>,
    /// The results of adaptation; null without.
    adaptation: Option<Adaptation>,
    /// The growth of the cracks; null without growth.
    growth: Option<growth::Grown>,
    /// The linear solver.
    solver: Option<&'static str>,
    /// Total time of all phases.
    seconds: f64,
    phases: Vec<SolvePhaseRow>,
    history: Vec<facts::RecordFacts>,
    tips: Vec<Tip>,
    reactions: Vec<facts::ReactionFacts>,
    warnings: Vec<facts::WarningFacts>,
}

/// The course of an adaptation.
#[derive(Debug, Serialize)]
struct Adaptation {
    /// The reason of the end.
    stop: &'static str,
    /// The steps that are kept.
    steps: Vec<SolveStepRow>,
}

#[derive(Debug, Serialize)]
struct SolveStepRow {
    patches: usize,
    unknowns: usize,
    energy: Option<JsonNumber>,
    estimated_error: Option<JsonNumber>,
}

impl Adaptation {
    /// None of a dataset that was solved once.
    fn new(dataset: &Dataset) -> Option<Self> {
        let last = SolverReport::of(&dataset.steps.last()?.history);
        let stop = last.stop?.word();
        Some(Self { stop, steps: dataset.steps.iter().map(SolveStepRow::new).collect() })
    }

    /// A line for each step if there are several, and one for the end.
    fn write(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        if self.steps.len() > 1 {
            writeln!(out, "step  patches  unknowns  estimated error")?;
        }
        for (k, step) in self.steps.iter().enumerate().filter(|_| self.steps.len() > 1) {
            let error = step.estimated_error.as_ref().map_or(f64::NAN, |error| error.0);
            writeln!(out, "{k:4}  {:7}  {:8}  {error:15.1e}", step.patches, step.unknowns)?;
        }
        Ok(writeln!(out, "adaptation ended: {}", self.stop)?)
    }
}

impl SolveStepRow {
    fn new(step: &Step) -> Self {
        let report = SolverReport::of(&step.history);
        Self {
            patches: step.partition.len(),
            unknowns: step.unknowns(),
            energy: report.energy.map(JsonNumber),
            estimated_error: report.estimated_error.map(JsonNumber),
        }
    }
}

#[derive(Debug, Serialize)]
struct SolvePhaseRow {
    name: String,
    seconds: f64,
}

impl SolveReport {
    /// The solver makes steps with one field each, of which the last one counts.
    fn new(file: String, dataset: &Dataset) -> Self {
        let last = dataset.steps.len() - 1;
        let step = &dataset.steps[last];
        let (times, numbers): (Vec<_>, Vec<_>) = step.history.iter().partition(|r| r.unit == "s");
        let phase = |r: &&Record| SolvePhaseRow { name: r.name.clone(), seconds: r.value };
        let is_elastic = dataset.equation.elastic().is_some();
        let report = SolverReport::of(&step.history);
        Self {
            file,
            title: dataset.title.clone(),
            patches: step.partition.len(),
            unknowns: step.unknowns(),
            energy: report.energy.map(JsonNumber),
            estimated_error: report.estimated_error.map(JsonNumber),
            adaptation: Adaptation::new(dataset),
            growth: None,
            solver: report.solver.map(LinearKind::word),
            seconds: times.iter().map(|r| r.value).sum(),
            phases: times.iter().map(phase).collect(),
            history: numbers.into_iter().map(facts::RecordFacts::new).collect(),
            tips: if is_elastic { all_tips(dataset, last) } else { Vec::new() },
            reactions: facts::reactions(dataset, step),
            warnings: facts::warnings(last, &step.warnings),
        }
    }

    /// Writes text for people, warnings on standard error.
    fn write(&self, out: &mut dyn Write, dataset: &Dataset) -> anyhow::Result<()> {
        let Self { title, patches, unknowns, seconds, .. } = self;
        let patches = count(*patches, "patch", "patches");
        writeln!(out, "{title}")?;
        let estimated =
            |error: &JsonNumber| format!("; estimated error {:.1e} in the energy norm", error.0);
        let error = self.estimated_error.as_ref().map_or(String::new(), estimated);
        writeln!(out, "{patches}, {unknowns} unknowns, solved in {seconds:.1} s{error}")?;
        if let Some(adaptation) = &self.adaptation {
            adaptation.write(out)?;
        }
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
