//! Options common to commands that evaluate a field: the step of a dataset, and quantities.

use std::path::{Path, PathBuf};

use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_scene::list::parts;
use ppum_scene::quantity::{DisplayError, DisplayedQuantity, default_quantity};
use ppum_scene::subject::ImageSubject;

use crate::dataset::{field, open_step, quantity};
use crate::formula_text::{FormulaText, files};
use crate::replacements::ReplacementArgs;
use crate::standard::{self, is_standard};

/// A step of a dataset, and what is replaced in it.
#[derive(Debug, clap::Args)]
pub(crate) struct StepArgs {
    /// Dataset, - for standard input
    #[arg(value_name = "FILE.h5")]
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) replacements: ReplacementArgs,
    /// Step of the series, from 0 [default: the last]
    #[arg(long, value_name = "K")]
    pub(crate) step: Option<usize>,
}

impl StepArgs {
    /// The dataset with the step that is asked for, and what is replaced in it.
    pub(crate) fn open(&self) -> anyhow::Result<Dataset> {
        let mut dataset = open_step(&self.file, self.step)?;
        self.replacements.apply(&mut dataset, self.step)?;
        Ok(dataset)
    }

    pub(crate) fn field<'d>(&self, dataset: &'d Dataset) -> anyhow::Result<Field<'d>> {
        field(dataset, self.step)
    }

    /// The files that are read.
    pub(crate) fn inputs(&self) -> impl Iterator<Item = &Path> {
        [self.file.as_path()].into_iter().chain(self.replacements.files())
    }
}

/// The subject of an image: a quantity of a dataset.
#[derive(Debug, clap::Args)]
pub(crate) struct QuantityArgs {
    /// Quantity to draw: von-mises, s1, sxx, ux or another of `ppum info`, a value of cells, a
    /// formula of quantities, or @FILE with one; for `render` several, separated by commas, in
    /// panels [default: von-mises; for Poisson problems u]
    #[arg(short, long, value_name = "Q", allow_hyphen_values = true)]
    quantity: Option<String>,
    #[command(flatten)]
    pub(crate) step: StepArgs,
}

impl QuantityArgs {
    /// The dataset for each part that is asked for, with what is replaced in it.
    pub(crate) fn open_parts(&self) -> anyhow::Result<Vec<Dataset>> {
        let StepArgs { file, replacements, step } = &self.step;
        replacements.each(open_step(file, *step)?, *step)
    }

    /// The quantity, none but that, and its name.
    pub(crate) fn quantity(&self, field: &Field<'_>) -> anyhow::Result<(Quantity, String)> {
        let given = self.quantity.as_deref().unwrap_or(default_quantity(field));
        let quantity = quantity(field, given)?;
        let name = DisplayedQuantity::Quantity(quantity.clone()).name(given);
        Ok((quantity, name))
    }

    /// Returns the texts of the quantities, of a list with commas between, with the content of
    /// files; nothing if they are left to the program.
    pub(crate) fn texts(&self) -> anyhow::Result<Vec<FormulaText>> {
        standard::keep_for_dataset(&self.step.file);
        self.quantity.iter().flat_map(|list| parts(list)).map(FormulaText::read).collect()
    }

    /// The files that are read.
    pub(crate) fn inputs(&self) -> impl Iterator<Item = &Path> {
        self.step.inputs().chain(files(&self.quantity))
    }

    /// The name of the dataset in the image.
    pub(crate) fn file_name(&self) -> String {
        let file = &self.step.file;
        match file.file_name() {
            Some(name) if !is_standard(file) => name.to_string_lossy().into_owned(),
            _ => standard::name(file),
        }
    }
}

/// The subject of an image of a field; a quantity that the field does not have is refused in the
/// words of the command line.
pub(crate) fn image_subject<'a>(
    dataset: &'a Dataset,
    field: &'a Field<'a>,
    given: Option<&FormulaText>,
) -> anyhow::Result<ImageSubject<'a>> {
    let subject = ImageSubject::new(dataset, field, given.map(|given| given.text.as_str()));
    match (subject, given) {
        (Err(DisplayError::Quantity(error)), Some(given)) => given.explain(Err(error)),
        (subject, _) => Ok(subject?),
    }
}
