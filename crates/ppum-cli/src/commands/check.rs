//! `ppum check`: all that is wrong with a dataset.

use std::io::Write;
use std::path::PathBuf;

use anyhow::bail;
use ppum_format::{FORMAT_VERSION, ReadError};
use serde::Serialize;

use crate::number::json;
use crate::standard;

/// List all errors of a dataset, for those who write such files
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct CheckArgs {
    /// Dataset, - for standard input
    #[arg(value_name = "FILE.h5")]
    file: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "\
Examples:
  ppum check plate.h5
  ppum check plate.h5 --json | jq -r '.errors[].object'";

#[derive(Debug, Serialize)]
struct CheckReport {
    file: String,
    errors: Vec<ErrorRow>,
}

#[derive(Debug, Serialize)]
struct ErrorRow {
    object: Option<String>,
    message: String,
}

impl CheckArgs {
    pub(crate) fn run(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        let name = standard::name(&self.file);
        let errors = if standard::is_standard(&self.file) {
            ppum_format::diagnose_bytes(&standard::bytes(standard::THE_DATASET, standard::DATASET)?)
        } else {
            ppum_format::diagnose(&self.file)
        };
        let row = |error: &ReadError| ErrorRow {
            object: error.place().map(str::to_owned),
            message: error.to_string(),
        };
        let rows: Vec<ErrorRow> = errors.iter().map(row).collect();
        if self.json {
            json(out, &CheckReport { file: self.file.display().to_string(), errors: rows })?;
        } else {
            rows.iter().try_for_each(|row| writeln!(out, "{}", row.message))?;
        }
        match errors.len() {
            0 if self.json => {}
            0 => {
                let (major, minor) = FORMAT_VERSION;
                writeln!(out, "{name}: no errors, by the rules of format {major}.{minor}")?;
            }
            1 => bail!("{name}: 1 error"),
            n => bail!("{name}: {n} errors"),
        }
        Ok(())
    }
}
