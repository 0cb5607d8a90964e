//! What commands that draw have in common: the quantities that are drawn, and their colours.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_render::colormap::NAMES;
use ppum_render::range::Range;
use ppum_render::scale::Scale;
use ppum_scene::colors;
use ppum_scene::drawing::Shown;
use ppum_scene::scene::default_quantity;
use ppum_scene::shot::Asked;

use crate::dataset::{field, open_step, quantity};
use crate::given::{self, Given, parts};
use crate::replacements::Replacements;
use crate::standard::{self, is_standard};

/// The subject of a picture: a quantity of a dataset.
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
    pub(crate) replacements: Replacements,
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
    pub(crate) fn quantity(&self, field: &Field<'_>) -> anyhow::Result<(Quantity, Asked)> {
        let quantity = quantity(field, self.given(field))?;
        let shown = Shown::Quantity(quantity.clone());
        Ok((quantity, Asked { name: shown.name(self.given(field)), shown }))
    }

    /// What is shown: quantities and values of cells, of a list with commas between; nothing if
    /// that is left to the program.
    pub(crate) fn texts(&self) -> anyhow::Result<Option<Vec<Given>>> {
        let read = |list| parts(list).into_iter().map(Given::read).collect();
        self.quantity.as_deref().map(read).transpose()
    }

    /// True if several parts are asked for.
    pub(crate) fn has_parts(&self) -> bool {
        !self.replacements.captions().is_empty()
    }

    /// The number of pictures that are asked for: one for each quantity and part.
    pub(crate) fn count(&self) -> usize {
        let quantities = self.quantity.as_deref().map_or(1, |list| parts(list).len());
        quantities * self.replacements.captions().len().max(1)
    }

    fn given<'a>(&'a self, field: &'a Field<'_>) -> &'a str {
        self.quantity.as_deref().unwrap_or(default_quantity(field))
    }

    /// The files that are read.
    pub(crate) fn inputs(&self) -> impl Iterator<Item = &Path> {
        let formulas = self.quantity.iter().flat_map(|list| parts(list)).filter_map(given::file);
        [self.file.as_path()].into_iter().chain(formulas).chain(self.replacements.files())
    }

    /// The name of the dataset in the picture.
    pub(crate) fn file_name(&self) -> String {
        match self.file.file_name() {
            Some(name) if !is_standard(&self.file) => name.to_string_lossy().into_owned(),
            _ => standard::name(&self.file),
        }
    }
}

/// The options of colours.
#[derive(Debug, clap::Args)]
pub(crate) struct ColorArgs {
    #[arg(long, value_name = "NAME", help = colormaps())]
    colormap: Option<String>,
    /// Values that the colours span: auto for all, but robust against peaks that are infinite;
    /// full; two values; two percentiles, or one for both ends
    #[arg(
        long,
        value_name = "auto|full|A,B|P%,Q%|P%",
        default_value = "auto",
        allow_hyphen_values = true
    )]
    range: Range,
    /// How values spread over the colours: linear, log or symlog
    #[arg(long, default_value = "linear")]
    scale: Scale,
    /// Colours of values below and above the range
    #[arg(long, value_enum, default_value = "end")]
    extremes: Extremes,
    /// Show values in so many bands of one colour each
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000))]
    bands: Option<u16>,
    /// Put zero in the middle of a range that is found and holds it, as diverging maps always do
    #[arg(long)]
    symmetric: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Extremes {
    /// Those of the map's ends
    End,
    /// Colours that do not occur in the map
    Contrast,
}

fn colormaps() -> String {
    format!(
        "Colour map: {}; reversed with _r; or a file, CSV or JSON, as ParaView, Plotly and others write it \
         [default: viridis; of directions twilight]",
        NAMES.join(", ")
    )
}

impl ColorArgs {
    /// The way values become colours.
    pub(crate) fn chosen(&self) -> colors::Colors {
        colors::Colors {
            colormap: self.colormap.clone(),
            range: self.range,
            scale: self.scale,
            contrast: self.extremes == Extremes::Contrast,
            bands: self.bands,
            symmetric: self.symmetric,
        }
    }

    /// The file of the colour map, if it is one.
    pub(crate) fn input(&self) -> Option<&Path> {
        self.colormap.as_deref().map(Path::new)
    }
}
