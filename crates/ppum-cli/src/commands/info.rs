//! `ppum info`: what is inside a dataset.

mod formulas;
mod reactions;
mod report;
mod text;

use std::io::Write;
use std::path::PathBuf;

use crate::dataset::open;
use crate::number::json;

/// Show what is inside a dataset
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Dataset
    #[arg(value_name = "FILE.h5")]
    file: PathBuf,
    /// Print JSON, see docs/cli.md
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "\
Examples:
  ppum info plate.h5
  ppum info plate.h5 --json | jq -r '.steps[0].quantities[]'";

impl Args {
    pub(crate) fn run(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        let dataset = open(&self.file)?;
        let report = report::Report::new(self.file.display().to_string(), &dataset)?;
        if self.json {
            json(out, &report)?;
        } else {
            text::write(out, &report)?;
        }
        Ok(())
    }
}
