//! `ppum sif`: stress intensity factors of a stored field.

use std::io::Write;
use std::path::PathBuf;

use anyhow::{bail, ensure};
use ppum::crack::{TipId, tips};
use ppum::dataset::{Dataset, TipIntensity, Warning, WarningKind};
use ppum::text::LocationText;
use ppum_fracture::diagnostics::recompute;
use ppum_fracture::intensity::TipResult;
use ppum_problem::Problem;
use ppum_scene::facts::{self, Tip, all_tips};
use ppum_scene::range::places;
use serde::Serialize;

use crate::dataset::{named, open_results, series};
use crate::number::json;
use crate::progress::ProgressLine;
use crate::standard;
use crate::tips::table;
use crate::warnings::{warn, warn_of_steps};

/// Print the stress intensity factors of all crack tips, T, the energy release rate and the angle
/// of growth
///
/// The factors are those that the solver stored. `error` is the estimated error of K: quote it with
/// K. `spread`, the largest relative difference of K on three discs, and `J/G-1` are checks of the
/// integrals, not estimates of the error.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct SifArgs {
    /// Dataset of a problem of elasticity, - for standard input
    #[arg(value_name = "FILE.h5")]
    file: PathBuf,
    /// Recompute K, T, J and the warnings from the stored field
    #[arg(long)]
    recompute: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "\
Examples:
  ppum sif plate.h5
  ppum sif plate.h5 --recompute
  ppum sif plate.h5 --json | jq '.tips[] | [.k1, .k2]'";

#[derive(Debug, Serialize)]
struct SifReport {
    file: String,
    tips: Vec<Tip>,
    warnings: Vec<facts::WarningFacts>,
}

impl SifArgs {
    pub(crate) fn run(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        let name = standard::name(&self.file);
        let (tips, warnings, places) =
            if self.recompute { self.recomputed(&name)? } else { self.stored(&name)? };
        let report = SifReport { file: self.file.display().to_string(), tips, warnings };
        match report.tips.iter().any(|tip| tip.step > 0) {
            true => warn_of_steps(&report.warnings),
            false => warn(&report.warnings),
        }
        if self.json {
            json(out, &report)?;
        } else if report.tips.is_empty() {
            writeln!(out, "{name}: no crack tips, so no stress intensity factors")?;
        } else {
            table(out, &report.tips, &places)?;
        }
        Ok(())
    }

    /// The factors that the solver stored, of all steps.
    fn stored(&self, name: &str) -> anyhow::Result<TipsAndWarnings> {
        let dataset = open_results(&self.file)?;
        refuse_poisson(name, &dataset)?;
        let (tips, warnings) = stored(name, &dataset)?;
        Ok((tips, warnings, places(&dataset)))
    }

    /// The factors of the fields, one step after the other.
    fn recomputed(&self, name: &str) -> anyhow::Result<TipsAndWarnings> {
        let series = series(&self.file)?;
        refuse_poisson(name, series.head())?;
        let (mut tips, mut warnings, mut all) = (Vec::new(), Vec::new(), series.head().clone());
        for index in 0..series.len() {
            let dataset = named(&self.file, series.dataset(index))?;
            let (mut found, remarks) = recomputed(name, &dataset)?;
            found.iter_mut().for_each(|tip| tip.step = index);
            tips.extend(found);
            warnings.extend(facts::warnings(index, &remarks));
            all.steps.push(named(&self.file, series.results(index))?);
        }
        Ok((tips, warnings, places(&all)))
    }
}

/// The tips of all steps, the warnings, and the writer of places.
type TipsAndWarnings = (Vec<Tip>, Vec<facts::WarningFacts>, LocationText);

fn refuse_poisson(name: &str, dataset: &Dataset) -> anyhow::Result<()> {
    if dataset.equation.elastic().is_none() {
        bail!("{name}: only displacements of elasticity have stress intensity factors");
    }
    Ok(())
}

/// The factors that the solver stored.
fn stored(name: &str, dataset: &Dataset) -> anyhow::Result<(Vec<Tip>, Vec<facts::WarningFacts>)> {
    let (mut all, mut warnings) = (Vec::new(), Vec::new());
    for (index, step) in dataset.steps.iter().enumerate() {
        let is_told = step.warnings.iter().any(|warning| warning.kind == WarningKind::NoRoom);
        let is_stored = !step.intensities.is_empty() || is_told || tips(&step.cracks).count() == 0;
        ensure!(
            is_stored,
            "{name}: holds no stress intensity factors; --recompute finds them from the field"
        );
        all.extend(all_tips(dataset, index));
        warnings.extend(facts::warnings(index, &step.warnings));
    }
    Ok((all, warnings))
}

/// The factors of the field of the only step at hand; those that the solver stored where the loads
/// near the tips are not known.
fn recomputed(name: &str, dataset: &Dataset) -> anyhow::Result<(Vec<Tip>, Vec<Warning>)> {
    match Problem::of_step(dataset, 0) {
        // Uses the results that the solver found while it knew the loads.
        Err(_) => known(name, dataset, 0),
        Ok(problem) => computed(dataset, 0, problem.as_ref()),
    }
}

/// The interaction integrals over the field of a step.
fn computed(
    dataset: &Dataset,
    index: usize,
    problem: Option<&Problem>,
) -> anyhow::Result<(Vec<Tip>, Vec<Warning>)> {
    let (outcomes, warnings) = recompute(dataset, index, problem, &ProgressLine::new())?;
    // the error is that of the stored field, which only its solver can estimate
    let stored = &dataset.steps[index].intensities;
    let error = |tip: TipId| stored.iter().find(|known| known.tip == tip)?.error;
    let tip = |outcome: &TipResult| match &outcome.factors {
        Some(factors) => {
            let factors = TipIntensity { error: error(outcome.tip), ..factors.clone() };
            Tip::new(dataset, index, &factors)
        }
        None => Tip::without_factors(dataset, index, outcome.tip),
    };
    Ok((outcomes.iter().map(tip).collect(), warnings))
}

/// The factors that the solver stored in a step whose loads are not known.
fn known(file: &str, dataset: &Dataset, index: usize) -> anyhow::Result<(Vec<Tip>, Vec<Warning>)> {
    let (step, tips) = (&dataset.steps[index], all_tips(dataset, index));
    let reason = "the stored problem cannot be read, so the loads near the tips are not known";
    if step.intensities.is_empty() && !tips.is_empty() {
        bail!("{file}: {reason}, and no factors are stored; solve the problem again");
    }
    let message = format!("{file}: {reason}; these are the factors that the solver stored");
    let kind = WarningKind::LoadsUnknown;
    let told = Warning { kind, at: None, value: 0.0, limit: 0.0, message };
    Ok((tips, step.warnings.iter().cloned().chain([told]).collect()))
}
