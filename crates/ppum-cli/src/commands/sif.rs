//! `ppum sif`: stress intensity factors of a stored field.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::PathBuf;

use anyhow::bail;
use ppum::crack::{TipId, tips};
use ppum::dataset::{Dataset, Step, Warning};
use ppum_solve::effort::{EffortError, check_effort};
use ppum_solve::intensity::Outcome;
use ppum_solve::problem::Problem;
use ppum_solve::warnings::judge;
use serde::Serialize;

use crate::dataset::open;
use crate::number::json;
use crate::tips::{Tip, table};
use crate::warnings::{WarningRow, rows, warn};

/// Print the stress intensity factors of all crack tips
///
/// They are computed from the stored field, by the interaction integral at three radii; `spread` is
/// the largest relative difference of the three: a check that they agree, no estimate of the error.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Dataset of a problem of elasticity
    #[arg(value_name = "FILE.h5")]
    file: PathBuf,
    /// Print JSON, see docs/cli.md
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "\
Examples:
  ppum sif plate.h5
  ppum sif plate.h5 --json | jq '.tips[] | [.k1, .k2]'";

#[derive(Debug, Serialize)]
struct Report {
    file: String,
    tips: Vec<Tip>,
    warnings: Vec<WarningRow>,
}

impl Args {
    pub(crate) fn run(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        let dataset = open(&self.file)?;
        let file = self.file.display().to_string();
        if dataset.equation.elastic().is_none() {
            bail!(
                "{file}: a Poisson problem has no stress intensity factors; solve one of elasticity"
            );
        }
        let report = Report::new(file, &dataset)?;
        warn(&report.warnings);
        if self.json {
            json(out, &report)?;
        } else if report.tips.is_empty() {
            writeln!(out, "{}: no crack tips, so no stress intensity factors", report.file)?;
        } else {
            table(out, &report.tips)?;
        }
        Ok(())
    }
}

impl Report {
    fn new(file: String, dataset: &Dataset) -> anyhow::Result<Self> {
        let problem = Problem::of_dataset(dataset);
        let (mut tips, mut warnings) = (Vec::new(), Vec::new());
        for (index, step) in dataset.steps.iter().enumerate() {
            let of_step = |problem: &&Option<Problem>| {
                problem.as_ref().is_none_or(|problem| problem.cracks == step.cracks)
            };
            let (found, remarks) = match problem.as_ref().ok().filter(of_step) {
                // What the solver found while it knew the loads.
                None => stored(&file, index, step, UNKNOWN)?,
                Some(problem) => match check_effort(dataset, index, problem.as_ref()) {
                    Err(error @ EffortError::TooMuch { .. }) => {
                        stored(&file, index, step, ("too-costly", &error.to_string()))?
                    }
                    effort => {
                        effort?;
                        computed(dataset, index, problem.as_ref())?
                    }
                },
            };
            tips.extend(found);
            warnings.extend(rows(index, &remarks));
        }
        Ok(Self { file, tips, warnings })
    }
}

/// The interaction integrals over the field of a step.
fn computed(
    dataset: &Dataset,
    index: usize,
    problem: Option<&Problem>,
) -> anyhow::Result<(Vec<Tip>, Vec<Warning>)> {
    let (outcomes, warnings) = judge(dataset, index, problem)?;
    let step = &dataset.steps[index];
    let tip = |outcome: &Outcome| match &outcome.factors {
        Some(factors) => Tip::new(index, step, factors),
        None => Tip::without_factors(index, step, outcome.tip),
    };
    Ok((outcomes.iter().map(tip).collect(), warnings))
}

/// Why factors cannot be found again: a word for the kind of the warning, and what to say.
type Reason<'a> = (&'a str, &'a str);

const UNKNOWN: Reason<'static> = (
    "loads-unknown",
    "the stored problem cannot be read, so the loads near the tips are not known",
);

/// What the solver stored in a step.
fn stored(
    file: &str,
    index: usize,
    step: &Step,
    (kind, reason): Reason<'_>,
) -> anyhow::Result<(Vec<Tip>, Vec<Warning>)> {
    let known: BTreeMap<TipId, _> =
        step.intensities.iter().map(|known| (known.tip, known)).collect();
    let tip = |tip: TipId| match known.get(&tip) {
        Some(factors) => Tip::new(index, step, factors),
        None => Tip::without_factors(index, step, tip),
    };
    let tips: Vec<Tip> = tips(&step.cracks).map(tip).collect();
    if step.intensities.is_empty() && !tips.is_empty() {
        bail!("{file}: {reason}, and no factors are stored; solve the problem again");
    }
    let message = format!("{file}: {reason}; these are the factors that the solver stored");
    let told = Warning { kind: kind.into(), at: None, value: 0.0, limit: 0.0, message };
    Ok((tips, step.warnings.iter().cloned().chain([told]).collect()))
}
