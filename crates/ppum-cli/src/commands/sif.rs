//! `ppum sif`: stress intensity factors of a stored field.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use ppum::dataset::{Dataset, Step, TipIntensity};
use ppum::field::Field;
use ppum::vec2::Vec2;
use ppum_solve::intensity::{Loads, intensities};
use ppum_solve::problem::{Expression, Problem};
use ppum_solve::space::Space;
use serde::Serialize;

use crate::dataset::open;
use crate::number::json;
use crate::tips::{Tip, table, warn};

/// Print the stress intensity factors of all crack tips
///
/// They are computed from the stored field, by the interaction integral at three radii; `spread` is
/// the largest relative difference of the three.
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
        let tips = tips(&dataset, &self.file)?;
        warn(&tips);
        if self.json {
            json(out, &Report { file, tips })?;
        } else if tips.is_empty() {
            writeln!(out, "{file}: no crack tips, so no stress intensity factors")?;
        } else {
            table(out, &tips)?;
        }
        Ok(())
    }
}

fn tips(dataset: &Dataset, path: &Path) -> anyhow::Result<Vec<Tip>> {
    let force = BodyForce::of(dataset, path);
    let mut tips = Vec::new();
    for (index, step) in dataset.steps.iter().enumerate() {
        let found = match &force {
            BodyForce::Known(force) => computed(dataset, index, force)?,
            // What the solver found while it knew the force.
            BodyForce::Unknown if is_complete(step) => step.intensities.clone(),
            BodyForce::Unknown => bail!(
                "{}: the stored problem cannot be read, so the body force is not known",
                path.display()
            ),
        };
        tips.extend(found.iter().map(|tip| Tip::new(index, step, tip)));
    }
    Ok(tips)
}

/// True if every tip has stored intensities.
fn is_complete(step: &Step) -> bool {
    step.intensities.len() == ppum::crack::tips(&step.cracks).count()
}

/// The interaction integrals over the field of a step.
fn computed(
    dataset: &Dataset,
    step: usize,
    force: &[Expression],
) -> anyhow::Result<Vec<TipIntensity>> {
    let field = Field::new(dataset, step)?;
    let space = Space::new(field.step, field.domain, field.equation, field.tables)
        .context("functions of the field")?;
    let at = |x: Vec2| {
        let mut values = [0.0; 2];
        values.iter_mut().zip(force).for_each(|(value, f)| *value = f.value(x));
        values
    };
    let loads = Loads { force: Some(&at), faces: None };
    let found = intensities(dataset, &field, &space, loads);
    Ok(found.into_iter().filter_map(|outcome| outcome.factors).collect())
}

/// The force inside the plate, which the interaction integral needs.
enum BodyForce {
    /// One expression a component; none for no force.
    Known(Vec<Expression>),
    /// The problem's text cannot be read any more, e.g. because it names a file of points.
    Unknown,
}

impl BodyForce {
    fn of(dataset: &Dataset, path: &Path) -> Self {
        let Some(text) = &dataset.problem else { return Self::Known(Vec::new()) };
        let folder = path.parent().unwrap_or(Path::new(""));
        match Problem::parse(text, "problem", folder) {
            Ok(problem) => Self::Known(problem.source),
            Err(_) => Self::Unknown,
        }
    }
}
