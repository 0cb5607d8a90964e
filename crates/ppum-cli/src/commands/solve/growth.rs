//! Series of growing cracks: each step is written and reported when it is complete.

use std::io::Write as _;
use std::panic::resume_unwind;
use std::path::Path;
use std::sync::mpsc::{Sender, channel};
use std::thread;
use std::time::Instant;

use anyhow::{Context as _, bail, ensure};
use ppum::dataset::{Dataset, Growth, Step, TipIncrement, TipIntensity};
use ppum::text::short;
use ppum_format::SeriesWriter;
use ppum_fracture::growth::{GrowthError, ResumePoint, grow, is_same_series};
use ppum_problem::{GrowthRule, Problem};
use ppum_scene::facts::{self, increment};
use serde::Serialize;

use super::{SolveArgs, SolveReport};
use crate::dataset::{named, series};
use crate::number::{JsonNumber, count, json};
use crate::output::StandardStream;
use crate::progress::ProgressLine;
use crate::standard::is_standard;
use crate::threads;
use crate::warnings::warn_of_steps;

/// The growth of the cracks, in JSON.
#[derive(Debug, Serialize)]
pub(super) struct Grown {
    /// The first step of this run; more than 0 if it resumed another run.
    first: usize,
    steps: Vec<GrowthStepRow>,
    /// Why the series ended; null if all increments were made.
    stop: Option<&'static str>,
}

#[derive(Debug, Serialize)]
struct GrowthStepRow {
    step: usize,
    load: f64,
    cycles: Option<f64>,
    tips: Vec<GrowthTipRow>,
}

#[derive(Debug, Serialize)]
struct GrowthTipRow {
    crack: u32,
    end: &'static str,
    tip: [f64; 2],
    k1: JsonNumber,
    k2: JsonNumber,
    strength: JsonNumber,
    /// Direction of the next increment, radians.
    direction: f64,
    /// Its length.
    length: f64,
    /// The fate of the tip, in words.
    fate: String,
    /// Length grown since the first step.
    extension: f64,
}

impl GrowthStepRow {
    fn new(number: usize, step: &Step, growth: &Growth) -> Self {
        let tips = growth.tips.iter().map(|row| GrowthTipRow::new(step, row)).collect();
        Self { step: number, load: step.load, cycles: growth.cycles, tips }
    }
}

impl GrowthTipRow {
    fn new(step: &Step, row: &TipIncrement) -> Self {
        let factors = factors(step, row);
        Self {
            crack: row.tip.crack,
            end: row.tip.end.name(),
            tip: step.cracks[row.tip.crack as usize].end_point(row.tip.end).into(),
            k1: JsonNumber(factors.map_or(f64::NAN, |factors| factors.k1)),
            k2: JsonNumber(factors.map_or(f64::NAN, |factors| factors.k2)),
            strength: JsonNumber(row.k_eq),
            direction: row.direction,
            length: row.length,
            fate: row.fate.words(),
            extension: row.extension,
        }
    }
}

fn factors<'s>(step: &'s Step, row: &TipIncrement) -> Option<&'s TipIntensity> {
    step.intensities.iter().find(|factors| factors.tip == row.tip)
}

/// Solves a problem with growing cracks and writes the series to a file, or resumes the series in
/// the file.
pub(super) fn run(
    args: &SolveArgs,
    problem: &Problem,
    rule: &GrowthRule,
    target: &Path,
    out: &mut StandardStream,
) -> anyhow::Result<()> {
    ensure!(
        !is_standard(target),
        "a series grows in its file, step by step, and cannot go to standard output; give a file with -o"
    );
    let there = (args.resume && target.exists()).then(|| there(problem, target)).transpose()?;
    let last = there.as_ref().and_then(|(number, steps)| {
        let (step, earlier) = steps.split_last()?;
        Some(ResumePoint { number: *number, step, earlier })
    });
    if let Some(stop) = last.and_then(|last| ends(rule, last.number, last.step)) {
        writeln!(out, "{}: nothing to do, {stop}", target.display())?;
        return Ok(());
    }
    let first = last.map_or(0, |last| last.number + 1);
    let writer = last.is_some().then(|| SeriesWriter::resume(target)).transpose()?;
    let (lines, told) = channel();
    let run =
        GrowthRun { rule, target, start: Instant::now(), bar: ProgressLine::new(), first, lines };
    let grown = Grown { first, steps: Vec::new(), stop: None };
    let mut state = GrowthState { writer, grown, last: None, warnings: Vec::new() };
    thread::scope(|scope| {
        let state = &mut state;
        let solved = scope.spawn(move || {
            let grow =
                || grow(problem, last, args.memory(), &run.bar, |step| run.keep(state, step));
            let ended = threads::with(args.threads, grow)?;
            ended.map_err(|error| run.failed(error, first + state.grown.steps.len()))
        });
        for line in told.iter().filter(|_| !args.json) {
            out.write_all(line.as_bytes())?;
            out.flush()?;
        }
        solved.join().unwrap_or_else(|panic| resume_unwind(panic))
    })?;
    report(args, target, state, out)
}

/// The number of the last step of the series in a file, and the steps that the next one follows
/// from, all but the last without their fields.
fn there(problem: &Problem, target: &Path) -> anyhow::Result<(usize, Vec<Step>)> {
    let series = series(target)?;
    let like = Problem::of_dataset(series.head()).ok().flatten();
    ensure!(
        like.is_some_and(|like| is_same_series(&like, problem)),
        "{}: holds another problem, or one with other settings; only the number of steps may differ",
        target.display()
    );
    let number = series.len() - 1;
    // the step is read as a whole: the next one follows from it, and its checksum covers all of it
    let step = named(target, series.dataset(number))?.steps.remove(0);
    if step.growth.is_none() {
        bail!("{}: its last step does not say how it goes on", target.display());
    }
    let has_law = problem.growth.as_ref().is_some_and(|rule| rule.law.is_some());
    let earlier = (0..number).filter(|_| has_law).map(|k| named(target, series.results(k)));
    Ok((number, earlier.chain([Ok(step)]).collect::<Result<_, _>>()?))
}

/// Why a series has no further steps.
fn ends(rule: &GrowthRule, number: usize, step: &Step) -> Option<String> {
    let stop = step.growth.as_ref().and_then(|growth| growth.stop);
    let all = || format!("it has all {}", count(rule.steps, "increment", "increments"));
    stop.map(|stop| stop.words().to_owned()).or_else(|| (number >= rule.steps).then(all))
}

/// One run of the program.
struct GrowthRun<'a> {
    rule: &'a GrowthRule,
    target: &'a Path,
    start: Instant,
    bar: ProgressLine,
    /// Number of its first step.
    first: usize,
    /// Receives lines of text for the terminal.
    lines: Sender<String>,
}

/// The results of a run so far.
struct GrowthState {
    writer: Option<SeriesWriter>,
    grown: Grown,
    last: Option<Dataset>,
    /// Warnings of all steps.
    warnings: Vec<facts::WarningFacts>,
}

impl GrowthRun<'_> {
    /// Writes a step to the file and reports it.
    fn keep(&self, state: &mut GrowthState, dataset: Dataset) -> anyhow::Result<()> {
        match &mut state.writer {
            None => state.writer = Some(SeriesWriter::begin(self.target, &dataset)?),
            Some(writer) => writer.append(&dataset.steps[0])?,
        }
        let number = self.first + state.grown.steps.len();
        let step = &dataset.steps[0];
        let growth = step.growth.as_ref().context("a step of a series without its growth")?;
        state.grown.steps.push(GrowthStepRow::new(number, step, growth));
        state.grown.stop = growth.stop.map(|stop| stop.words());
        self.bar.clear();
        state.warnings.extend(facts::warnings(number, &step.warnings));
        // the receiver may be gone
        let _ = self.lines.send(self.lines_of(number, step, growth));
        self.bar.in_series(self.rule.steps, self.left(number));
        state.last = Some(dataset);
        Ok(())
    }

    /// Lines of a step, one for each tip.
    fn lines_of(&self, number: usize, step: &Step, growth: &Growth) -> String {
        let load = short(step.load);
        let mut lines = if number == self.first { format!("{HEADS}\n") } else { String::new() };
        for row in &growth.tips {
            lines += &format!("{number:4} {load:>8}  {}\n", line(step, row));
        }
        if growth.tips.is_empty() {
            let why = growth.stop.map_or("no tips", |stop| stop.words());
            lines += &format!("{number:4} {load:>8}  {why}\n");
        }
        lines
    }

    /// The remaining seconds, if the next steps take as long as the previous ones.
    fn left(&self, number: usize) -> f64 {
        let done = (number + 1 - self.first) as f64;
        let rest = self.rule.steps.saturating_sub(number) as f64;
        self.start.elapsed().as_secs_f64() / done * rest
    }

    /// The error, with the steps that the file contains in spite of it.
    fn failed(&self, error: GrowthError<anyhow::Error>, steps: usize) -> anyhow::Error {
        let error = match error {
            GrowthError::Solve(error) => anyhow::Error::from(error),
            GrowthError::Kept(error) => error,
            other => anyhow::anyhow!(other.to_string()),
        };
        match steps {
            0 => error,
            n => error.context(format!(
                "{} holds {}; `ppum solve --resume` goes on from there",
                self.target.display(),
                count(n, "step", "steps")
            )),
        }
    }
}

const HEADS: &str = "step     load  crack                   tip        K_I        K_II  increment, and what ends it";

/// A tip in a line.
fn line(step: &Step, row: &TipIncrement) -> String {
    let unknown = || ["–", "–"].map(String::from);
    let [k1, k2] = factors(step, row).map_or_else(unknown, |k| [short(k.k1), short(k.k2)]);
    let at = step.cracks[row.tip.crack as usize].end_point(row.tip.end);
    // enough digits to see the tip move
    let digits = (2.0 - row.length.log10().floor()).clamp(5.0, 16.0) as usize;
    let digits = if row.length > 0.0 { digits } else { 5 };
    let at = format!("({:.digits$}, {:.digits$})", at.x + 0.0, at.y + 0.0);
    let (crack, end) = (row.tip.crack, row.tip.end.name());
    format!("{crack:>3} {end:<5} {at:>20} {k1:>10} {k2:>11}  {}", increment(row))
}

/// The report of a series.
fn report(
    args: &SolveArgs,
    target: &Path,
    GrowthState { grown, last, warnings, .. }: GrowthState,
    out: &mut StandardStream,
) -> anyhow::Result<()> {
    let last = last.context("a series without a step")?;
    let number = grown.first + grown.steps.len() - 1;
    let mut report = SolveReport::new(target.display().to_string(), &last);
    report.tips.clear();
    report.warnings.clear();
    warn_of_steps(&warnings);
    if args.json {
        report.warnings = warnings;
        report.growth = Some(grown);
        return Ok(json(out, &report)?);
    }
    let stop = grown.stop.map_or_else(|| "all increments are made".to_owned(), str::to_owned);
    writeln!(out, "growth ended with step {number}: {stop}")?;
    report.write(out, &last)
}
