//! Opening datasets and choosing among what is in them.

use std::path::Path;

use anyhow::{Context as _, anyhow, ensure};
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_format::{ReadError, Series};
use ppum_render::cells;
use ppum_scene::list::parts;
use ppum_scene::quantity::OF_PATCHES;

use crate::formula_text::FormulaText;
use crate::standard::{self, is_standard};

/// Reads a dataset with all its steps, `-` from standard input; an error names the file.
pub(crate) fn open(path: &Path) -> anyhow::Result<Dataset> {
    if is_standard(path) {
        return standard_input();
    }
    named(path, ppum_format::read(path))
}

/// Reads a dataset of which one step is asked for, by default the last one. All steps have their
/// numbers, but the others may be empty.
pub(crate) fn open_step(path: &Path, step: Option<usize>) -> anyhow::Result<Dataset> {
    let series = series(path)?;
    let step = step.unwrap_or(series.len() - 1);
    named(path, series.into_dataset(step))
}

/// Reads of all steps the cracks and what the solver tells of them. The steps may have no fields.
pub(crate) fn open_results(path: &Path) -> anyhow::Result<Dataset> {
    named(path, series(path)?.into_results())
}

/// Opens a dataset whose steps are read one by one.
pub(crate) fn series(path: &Path) -> anyhow::Result<Series> {
    if is_standard(path) {
        return standard_input().map(Series::of);
    }
    named(path, Series::open(path))
}

fn standard_input() -> anyhow::Result<Dataset> {
    let bytes = standard::bytes(standard::THE_DATASET, standard::DATASET)?;
    ppum_format::from_bytes(bytes).context("standard input")
}

/// Returns the data read from a file, or an error that names it, and the command that finds others.
pub(crate) fn named<T>(path: &Path, read: Result<T, ReadError>) -> anyhow::Result<T> {
    let path = path.display();
    match read {
        Err(error @ ReadError::Io { .. }) => Err(error.into()),
        Err(error) if error.place().is_some() => {
            Err(anyhow!("{path}: {error}; `ppum check {path}` lists all errors"))
        }
        other => other.with_context(|| path.to_string()),
    }
}

/// The first field of a step, by default of the last one.
pub(crate) fn field(dataset: &Dataset, step: Option<usize>) -> anyhow::Result<Field<'_>> {
    let last = dataset.steps.len().saturating_sub(1);
    Ok(Field::new(dataset, step.unwrap_or(last))?)
}

/// A quantity by its name or formula, or by `@` and a file with one, if the field has what it
/// needs.
pub(crate) fn quantity(field: &Field<'_>, given: &str) -> anyhow::Result<Quantity> {
    let given = FormulaText::read(given)?;
    let found = Quantity::parse(&given.text, field);
    if found.is_err() {
        refuse_cells(field, given.text.trim())?;
    }
    let quantity = given.explain(found)?;
    quantity.check_at_points(field)?;
    Ok(quantity)
}

/// Refuses the name of a value of cells in place of a quantity.
fn refuse_cells(field: &Field<'_>, text: &str) -> anyhow::Result<()> {
    let name = text.strip_prefix(OF_PATCHES).unwrap_or(text);
    ensure!(
        cells::values(field, name).is_none(),
        "`{text}` belongs to the cells of the cover, not to points; `ppum render -q {text}` draws it"
    );
    Ok(())
}

/// Stresses that are told if nothing is asked for.
const STRESSES: [&str; 4] = ["sxx", "syy", "sxy", "von-mises"];

/// Quantities under the names and formulas of lists as they were given; by default the components,
/// and of elasticity the stresses.
pub(crate) fn quantities(
    field: &Field<'_>,
    given: &[String],
) -> anyhow::Result<Vec<(String, Quantity)>> {
    let stresses = field
        .equation
        .elastic()
        .is_some()
        .then_some(STRESSES)
        .into_iter()
        .flatten()
        .map(str::to_owned);
    let names: Vec<_> = match given {
        [] => field.data.components.iter().cloned().chain(stresses).collect(),
        given => given.iter().flat_map(|list| parts(list)).map(str::to_owned).collect(),
    };
    names.into_iter().map(|name| Ok((name.clone(), quantity(field, &name)?))).collect()
}
