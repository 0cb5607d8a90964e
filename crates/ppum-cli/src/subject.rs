//! Options common to commands that draw: the quantities that are drawn.

use std::path::{Path, PathBuf};

use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_scene::drawing::DisplayedQuantity;
use ppum_scene::scene::default_quantity;
use ppum_scene::shot::QuantityRequest;

use crate::dataset::{field, open_step, quantity};
use crate::formula_text::{self, FormulaText, parts};
use crate::replacements::ReplacementArgs;
use crate::standard::{self, is_standard};

/// The subject of an image: a quantity of a dataset.
#[derive(Debug, clap::Args)]
pub(crate) struct QuantityArgs {
    /// Dataset, - for standard input
    #[arg(value_name = "FILE.h5")]
    pub(crate) file: PathBuf,
    /// Quantity or value of cells, see `ppum info`, or a formula of quantities, or @FILE with one;
    /// of `render` several with commas between, in panels [default: von-mises; for Poisson problems
    /// u]
    #[arg(short, long, value_name = "Q", allow_hyphen_values = true)]
    quantity: Option<String>,
    #[command(flatten)]
    pub(crate) replacements: ReplacementArgs,
    /// Step of the series, from 0 [default: the last]
    #[arg(long, value_name = "K")]
    pub(crate) step: Option<usize>,
}

impl QuantityArgs {
    /// The dataset with the step that is asked for, and what is replaced in it.
    pub(crate) fn open(&self) -> anyhow::Result<Dataset> {
        let mut dataset = open_step(&self.file, self.step)?;
        self.replacements.apply(&mut dataset, self.step)?;
        Ok(dataset)
    }

    /// The dataset for each part that is asked for, with what is replaced in it.
    pub(crate) fn open_parts(&self) -> anyhow::Result<Vec<Dataset>> {
        self.replacements.each(open_step(&self.file, self.step)?, self.step)
    }

    pub(crate) fn field<'d>(&self, dataset: &'d Dataset) -> anyhow::Result<Field<'d>> {
        field(dataset, self.step)
    }

    /// The quantity, none but that.
    pub(crate) fn quantity(
        &self,
        field: &Field<'_>,
    ) -> anyhow::Result<(Quantity, QuantityRequest)> {
        let quantity = quantity(field, self.given(field))?;
        let shown = DisplayedQuantity::Quantity(quantity.clone());
        Ok((quantity, QuantityRequest { name: shown.name(self.given(field)), shown }))
    }

    /// Returns the texts of the quantities as given: quantities and values of cells, of a list with
    /// commas between; nothing if that is left to the program.
    pub(crate) fn listed(&self) -> Vec<String> {
        self.quantity.iter().flat_map(|list| parts(list)).map(str::to_owned).collect()
    }

    /// Returns the texts of the quantities, with the content of files.
    pub(crate) fn texts(&self) -> anyhow::Result<Vec<FormulaText>> {
        self.listed().iter().map(|text| FormulaText::read(text)).collect()
    }

    /// True if several parts are asked for.
    pub(crate) fn has_parts(&self) -> bool {
        !self.replacements.captions().is_empty()
    }

    fn given<'a>(&'a self, field: &'a Field<'_>) -> &'a str {
        self.quantity.as_deref().unwrap_or(default_quantity(field))
    }

    /// The files that are read.
    pub(crate) fn inputs(&self) -> impl Iterator<Item = &Path> {
        let formulas =
            self.quantity.iter().flat_map(|list| parts(list)).filter_map(formula_text::file);
        [self.file.as_path()].into_iter().chain(formulas).chain(self.replacements.files())
    }

    /// The name of the dataset in the image.
    pub(crate) fn file_name(&self) -> String {
        match self.file.file_name() {
            Some(name) if !is_standard(&self.file) => name.to_string_lossy().into_owned(),
            _ => standard::name(&self.file),
        }
    }
}
