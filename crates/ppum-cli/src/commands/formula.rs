//! `ppum formula`: what a formula means, its derivatives, where it is not smooth.

mod library;
mod point;
mod report;
mod subject;
mod text;

use std::io::Write;
use std::path::Path;
use std::sync::Arc;

use anyhow::Context as _;
use ppum::formula::Table;
use ppum_problem::read_table;

use crate::formula_text::FormulaText;
use crate::number::json;
use ppum_scene::arguments::{assignment, value};
use report::FormulaReport;
use subject::{FormulaQuestion, Of};

/// Show what a formula means, its derivatives, and where it is not smooth
///
/// A name of the library in place of a formula shows what is behind it; --list lists all.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct FormulaArgs {
    /// Formula, or @FILE with one, or a name of the library
    #[arg(required_unless_present = "list", conflicts_with = "list", allow_hyphen_values = true)]
    formula: Option<String>,
    /// List the built-in functions
    #[arg(long)]
    list: bool,
    /// Variables that the formula may use: `plane` (x, y, r, theta), `weight` (t), quantities of
    /// `elasticity` or `poisson`, or those of a dataset FILE.h5 [default: what the formula's names
    /// fit]
    #[arg(long, value_name = "WHAT")]
    of: Option<Of>,
    /// Print values at a point; r and theta follow from x and y
    #[arg(long, value_name = "NAME=VALUE,…", value_delimiter = ',', value_parser = value)]
    #[arg(allow_hyphen_values = true)]
    at: Vec<(String, f64)>,
    /// A named constant of the formula; may be given more than once
    #[arg(long, value_name = "NAME=VALUE", value_parser = value)]
    parameter: Vec<(String, f64)>,
    /// A table for table(NAME, x); may be given more than once
    #[arg(long, value_name = "NAME=FILE.csv", value_parser = assignment)]
    table: Vec<(String, String)>,
    /// Print a module of WGSL, the shading language of WebGPU, with the value and its derivatives
    #[arg(long)]
    wgsl: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "\
Examples:
  ppum formula --list
  ppum formula westergaard
  ppum formula 'sqrt(r)*sin(theta/2)' --at x=-0.5,y=0.1
  ppum formula 'r^lambda*cos(lambda*theta)' --parameter lambda=0.5445
  ppum formula '(1 - t)^2*(1 + 2*t)' --at t=0.25
  ppum formula 'max(s1, 0)' --of plate.h5
  ppum formula westergaard --wgsl > westergaard.wgsl";

impl FormulaArgs {
    pub(crate) fn run(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        if self.list {
            return library::list(out, self.json);
        }
        let question = FormulaQuestion {
            given: FormulaText::read(self.formula.as_deref().unwrap_or_default())?,
            parameters: &self.parameter,
            tables: self.tables()?,
        };
        let subjects = question.subjects(self.of.as_ref())?;
        let report = FormulaReport::new(&subjects, &self.at, self.wgsl)?;
        match (self.json, self.wgsl) {
            (true, _) => json(out, &report)?,
            (false, true) => text::write_wgsl(out, &report)?,
            (false, false) => text::write(out, &report)?,
        }
        Ok(())
    }

    fn tables(&self) -> anyhow::Result<Vec<Arc<Table>>> {
        let table = |(name, file): &(String, String)| {
            read_table(name, Path::new(file)).map(Arc::new).context("--table")
        };
        self.table.iter().map(table).collect()
    }
}
