//! `ppum weight`: weight functions of tips, and factors of loads by them.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, ensure};
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum_fracture::weight::{FIELDS, factor, polynomials, weight_functions};
use ppum_problem::Problem;
use serde::Serialize;

use crate::dataset::open_step;
use crate::memory;
use crate::number::{JsonNumber, columns, json};
use crate::progress::ProgressLine;
use crate::standard::is_standard;
use crate::target::{self, FileFormat, FileKind};
use ppum_scene::arguments::positive;

/// Compute weight functions of crack tips: they give K of any load on the body by an integral
///
/// A dataset of weight functions has a step for each tip and mode, which `render`, `probe` and all
/// other commands take: `ux` and `uy` are K of a unit force at a point, `sxx` and `syy` that of a
/// strain there.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct WeightArgs {
    /// Problem file, a dataset of a solved problem, or one of weight functions
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Number of the tip, as `ppum sif` counts them [default: all]
    #[arg(long, value_name = "N")]
    tip: Option<usize>,
    /// Dataset to write
    #[arg(short, long, value_name = "FILE.h5")]
    output: Option<PathBuf>,
    /// K of the loads of other problem files on the same body [default: of its own]
    #[arg(long, value_name = "PROBLEM.toml")]
    loads: Vec<PathBuf>,
    /// Influence coefficients of so many powers of pressures on the crack
    #[arg(long, value_name = "N")]
    polynomials: Option<usize>,
    /// Memory that may be used, in GiB [default: what is free]
    #[arg(long, value_name = "GIB", value_parser = positive)]
    memory: Option<f64>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "\
Examples:
  ppum weight plate.toml --tip 1 -o weights.h5
  ppum weight weights.h5 --loads residual.toml    K of other loads, without solving again
  ppum weight plate.toml --polynomials 5          influence coefficients, K = √(πa) Σ σ_j G_j
  ppum render weights.h5 --step 0 -q 'sxx + syy' -o heat.png    where heat opens the crack";

/// The numbers of one weight function.
#[derive(Debug, Serialize)]
struct WeightRow {
    step: usize,
    /// `weight-I of tip 0`
    name: String,
    /// K of each file of loads.
    factors: Vec<JsonNumber>,
    /// G_0, G_1, …
    polynomials: Vec<JsonNumber>,
}

#[derive(Debug, Serialize)]
struct WeightReport {
    file: String,
    loads: Vec<String>,
    weights: Vec<WeightRow>,
}

impl WeightArgs {
    pub(crate) fn run(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        if let Some(target) = &self.output {
            ensure!(!is_standard(target), "weight functions are written to a file, not to `-`");
            target::check(target, FileKind::Dataset, [self.file.as_path()])?;
        }
        let weights = self.weights()?;
        if let Some(target) = &self.output {
            ppum_format::write(&weights, target)?;
        }
        let report = self.report(&weights)?;
        if self.json { Ok(json(out, &report)?) } else { report.write(out) }
    }

    /// The weight functions, of a file or computed.
    fn weights(&self) -> anyhow::Result<Dataset> {
        let problem = if FileFormat::of(&self.file) == Some(FileFormat::Hdf5) {
            let whole = crate::dataset::open(&self.file)?;
            let name = whole.steps.last().and_then(|step| step.fields.first());
            let is_weight = |name: &str| FIELDS.iter().any(|field| name.starts_with(field));
            if name.is_some_and(|field| is_weight(&field.name)) {
                ensure!(self.tip.is_none(), "--tip: the file holds weight functions already");
                return Ok(whole);
            }
            let dataset = open_step(&self.file, None)?;
            let last = dataset.steps.len() - 1;
            let of_step = Problem::of_step(&dataset, last)?;
            of_step.with_context(|| format!("{}: holds no problem", self.file.display()))?
        } else {
            Problem::read(&self.file)?
        };
        let memory = self.memory.map(|gibibytes| (gibibytes * f64::from(1 << 30)) as u64);
        let memory = memory.or_else(memory::free);
        Ok(weight_functions(&problem, self.tip, memory, &ProgressLine::new())?)
    }

    fn report(&self, weights: &Dataset) -> anyhow::Result<WeightReport> {
        let read = |path: &PathBuf| Ok((path.display().to_string(), Problem::read(path)?));
        let mut loads = self.loads.iter().map(read).collect::<anyhow::Result<Vec<_>>>()?;
        if loads.is_empty() && self.polynomials.is_none() {
            let own = Problem::of_step(weights, 0)?.context("the file holds no problem")?;
            loads.push((name_of(&self.file), own));
        }
        let row = |step: usize| {
            let factors = loads.iter().map(|(_, loads)| {
                Ok(JsonNumber(factor(weights, step, loads, &ProgressLine::new())?))
            });
            let polynomials = match self.polynomials {
                Some(count) => polynomials(weights, step, count)?,
                None => Vec::new(),
            };
            Ok(WeightRow {
                step,
                name: Field::new(weights, step)?.data.name.clone(),
                factors: factors.collect::<anyhow::Result<_>>()?,
                polynomials: polynomials.into_iter().map(JsonNumber).collect(),
            })
        };
        Ok(WeightReport {
            file: self.file.display().to_string(),
            weights: (0..weights.steps.len()).map(row).collect::<anyhow::Result<_>>()?,
            loads: loads.into_iter().map(|(name, _)| name).collect(),
        })
    }
}

fn name_of(path: &Path) -> String {
    path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

impl WeightReport {
    /// A table with a line for each weight function.
    fn write(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        let loads = self.loads.iter().map(|name| format!("K of {name}"));
        let count = self.weights.first().map_or(0, |row| row.polynomials.len());
        let heads = ["step".to_owned(), "field".to_owned()].into_iter().chain(loads);
        let heads = heads.chain((0..count).map(|j| format!("G_{j}"))).collect();
        let row = |row: &WeightRow| {
            let numbers = row.factors.iter().chain(&row.polynomials);
            let words = [row.step.to_string(), row.name.clone()].into_iter();
            words.chain(numbers.map(|number| format!("{:.10}", number.0))).collect()
        };
        let lines: Vec<Vec<String>> =
            [heads].into_iter().chain(self.weights.iter().map(row)).collect();
        Ok(columns(out, &lines, false)?)
    }
}
