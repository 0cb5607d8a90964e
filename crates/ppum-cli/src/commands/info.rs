//! `ppum info`: what is inside a dataset, or what graphics adapters there are.

mod adapters;
mod extrema;
mod formulas;
pub(super) mod reactions;
pub(super) mod report;
mod text;

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::ArgGroup;

use ppum::dataset::Dataset;
use ppum_scene::range::places;

use crate::dataset::{field, open, quantity};
use crate::number::json;

/// Show what is inside a dataset, or what graphics adapters there are
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
#[command(group(ArgGroup::new("subject").required(true).args(["file", "gpu"])))]
pub(crate) struct Args {
    /// Dataset, - for standard input
    #[arg(value_name = "FILE.h5")]
    file: Option<PathBuf>,
    /// List the graphics adapters of this machine
    #[arg(long)]
    gpu: bool,
    /// Find the smallest and the largest value of a quantity in the plate, with their places, not just over pixels
    #[arg(long, value_name = "Q", requires = "file", allow_hyphen_values = true)]
    extrema: Option<String>,
    /// Step of the series for --extrema, from 0 [default: the last]
    #[arg(long, value_name = "K", requires = "extrema")]
    step: Option<usize>,
    /// Print JSON, see docs/cli.md
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "\
Examples:
  ppum info plate.h5
  ppum info plate.h5 --extrema syy
  ppum info --gpu
  ppum info plate.h5 --json | jq -r '.steps[0].quantities[]'";

impl Args {
    pub(crate) fn run(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        match &self.file {
            Some(file) => self.dataset(file, out),
            None => self.adapters(out),
        }
    }

    fn dataset(&self, file: &Path, out: &mut dyn Write) -> anyhow::Result<()> {
        let dataset = open(file)?;
        if let Some(given) = &self.extrema {
            return self.extrema(&dataset, given, out);
        }
        let report = report::Report::new(file.display().to_string(), &dataset)?;
        if self.json {
            json(out, &report)?;
        } else {
            text::write(out, &report)?;
        }
        Ok(())
    }

    fn extrema(&self, dataset: &Dataset, given: &str, out: &mut dyn Write) -> anyhow::Result<()> {
        let field = field(dataset, self.step)?;
        let report = extrema::Report::new(&field, given, &quantity(&field, given)?)?;
        if self.json {
            json(out, &report)?;
        } else {
            report.write(&places(dataset), out)?;
        }
        Ok(())
    }

    fn adapters(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        let report = adapters::Report::new();
        if self.json {
            json(out, &report)?;
        } else {
            report.write(out)?;
        }
        Ok(())
    }
}
