//! `ppum info`: what is inside a dataset, or what graphics adapters there are.

mod adapters;
mod formulas;
pub(super) mod reactions;
pub(super) mod report;
mod text;

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::ArgGroup;

use crate::dataset::open;
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
    /// Print JSON, see docs/cli.md
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "\
Examples:
  ppum info plate.h5
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
        let report = report::Report::new(file.display().to_string(), &dataset)?;
        if self.json {
            json(out, &report)?;
        } else {
            text::write(out, &report)?;
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
