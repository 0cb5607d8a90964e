//! `ppum info`: what is inside a dataset, or what graphics adapters there are.

mod adapters;
mod extrema;
mod formulas;
mod report;
mod series;
mod text;

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::ArgGroup;

use anyhow::ensure;
use ppum::dataset::Dataset;
use ppum_format::Series;
use ppum_scene::range::places;

use crate::dataset::{field, named, quantity};
use crate::number::json;

/// Show what is inside a dataset, or what graphics adapters there are
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
#[command(group(ArgGroup::new("subject").required(true).args(["file", "gpu"])))]
pub(crate) struct InfoArgs {
    /// Dataset, - for standard input
    #[arg(value_name = "FILE.h5")]
    file: Option<PathBuf>,
    /// List the graphics adapters of this machine
    #[arg(long)]
    gpu: bool,
    /// Minimum and maximum of a quantity in the body, with their locations, not only over pixels
    #[arg(long, value_name = "Q", requires = "file", allow_hyphen_values = true)]
    extrema: Option<String>,
    /// Step of the series, from 0 [default: the last]
    #[arg(long, value_name = "K", requires = "file")]
    step: Option<usize>,
    /// List the steps of a series: load, unknowns, crack length, stress intensity factors; for
    /// growing cracks, also each tip's next increment and why the series ended
    #[arg(long, requires = "file", conflicts_with = "extrema")]
    steps: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "\
Examples:
  ppum info plate.h5
  ppum info plate.h5 --extrema syy
  ppum info growth.h5 --steps
  ppum info --gpu
  ppum info plate.h5 --json | jq -r '.steps[0].quantities[]'";

impl InfoArgs {
    pub(crate) fn run(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        match &self.file {
            Some(file) => self.dataset(file, out),
            None => self.adapters(out),
        }
    }

    fn dataset(&self, file: &Path, out: &mut dyn Write) -> anyhow::Result<()> {
        let all = crate::dataset::series(file)?;
        let step = self.step.unwrap_or(all.len() - 1);
        let rows = if self.steps { Some(rows(file, &all)?) } else { None };
        let dataset = named(file, all.into_dataset(step))?;
        if let Some(given) = &self.extrema {
            return self.extrema(&dataset, given, out);
        }
        let mut report = report::InfoReport::new(file.display().to_string(), &dataset, step)?;
        report.series = rows;
        if self.json {
            json(out, &report)?;
        } else {
            text::write(out, &report)?;
        }
        Ok(())
    }

    fn extrema(&self, dataset: &Dataset, given: &str, out: &mut dyn Write) -> anyhow::Result<()> {
        let field = field(dataset, self.step)?;
        let report = extrema::ExtremaReport::new(&field, given, &quantity(&field, given)?)?;
        if self.json {
            json(out, &report)?;
        } else {
            report.write(&places(dataset), out)?;
        }
        Ok(())
    }

    fn adapters(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        let report = adapters::AdaptersReport::new();
        if self.json {
            json(out, &report)?;
        } else {
            report.write(out)?;
        }
        Ok(())
    }
}

/// A line for each step.
fn rows(file: &Path, all: &Series) -> anyhow::Result<Vec<series::SeriesStepRow>> {
    ensure!(
        all.len() > 1,
        "{}: --steps lists the steps of a series, but there is one alone",
        file.display()
    );
    let row = |number| Ok(series::SeriesStepRow::new(number, &named(file, all.results(number))?));
    (0..all.len()).map(row).collect()
}
