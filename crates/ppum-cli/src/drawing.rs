//! What commands that draw have in common: the quantity that is drawn, and its colours.

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::formula::one_line;
use ppum::quantity::Quantity;
use ppum_figure::figure::Labels;
use ppum_render::colormap::{Colormap, LONGEST, NAMES};
use ppum_render::picture::Style;
use ppum_render::range::Range;
use ppum_render::scale::Scale;

use crate::dataset::{field, open, quantity};
use crate::given;
use crate::replacements::Replacements;
use crate::standard::{self, is_standard};

/// The subject of a picture: a quantity of a dataset.
#[derive(Debug, clap::Args)]
pub(crate) struct Subject {
    /// Dataset, - for standard input
    #[arg(value_name = "FILE.h5")]
    pub(crate) file: PathBuf,
    /// Quantity, see `ppum info`, or a formula of quantities, or @FILE with one [default: von-mises;
    /// for Poisson problems u]
    #[arg(short, long, value_name = "Q", allow_hyphen_values = true)]
    quantity: Option<String>,
    #[command(flatten)]
    pub(crate) replacements: Replacements,
    /// Step of the series, from 0 [default: the last]
    #[arg(long, value_name = "K")]
    step: Option<usize>,
}

impl Subject {
    /// The dataset, with what is replaced in it.
    pub(crate) fn open(&self) -> anyhow::Result<Dataset> {
        let mut dataset = open(&self.file)?;
        self.replacements.apply(&mut dataset, self.step)?;
        Ok(dataset)
    }

    pub(crate) fn field<'d>(&self, dataset: &'d Dataset) -> anyhow::Result<Field<'d>> {
        field(dataset, self.step)
    }

    /// The quantity, and its name in messages and in the picture's description.
    pub(crate) fn quantity(&self, field: &Field<'_>) -> anyhow::Result<(Quantity, String)> {
        let given = self.quantity.as_deref().unwrap_or(default_quantity(field));
        let quantity = quantity(field, given)?;
        let name = match &quantity {
            Quantity::Formula(formula) => formula.label(),
            _ => given.to_owned(),
        };
        Ok((quantity, name))
    }

    /// The files that are read.
    pub(crate) fn inputs(&self) -> impl Iterator<Item = &Path> {
        let formula = self.quantity.as_deref().and_then(given::file);
        [self.file.as_path()].into_iter().chain(formula).chain(self.replacements.files())
    }

    /// The name of the dataset in the picture.
    pub(crate) fn file_name(&self) -> String {
        match self.file.file_name() {
            Some(name) if !is_standard(&self.file) => name.to_string_lossy().into_owned(),
            _ => standard::name(&self.file),
        }
    }

    /// Notes in the picture: the formula of the quantity, what was replaced.
    pub(crate) fn notes(&self, quantity: &Quantity) -> impl Iterator<Item = (String, String)> {
        let formula = match quantity {
            Quantity::Formula(formula) => Some(one_line(formula.formula().text())),
            _ => None,
        };
        let formula = formula.map(|text| ("ppum:formula".to_owned(), text));
        formula.into_iter().chain(self.replacements.notes())
    }
}

fn default_quantity<'f>(field: &'f Field<'_>) -> &'f str {
    match field.equation.elastic() {
        Some(_) => "von-mises",
        None => &field.data.components[0],
    }
}

/// The words of a figure.
pub(crate) fn labels(title: String, field: &Field<'_>, quantity: &Quantity) -> Labels {
    Labels {
        title,
        quantity: quantity.symbol(&field.data.components),
        unit: quantity.unit(field).to_owned(),
        length_unit: String::new(),
    }
}

/// The way values become colours.
#[derive(Debug, clap::Args)]
pub(crate) struct Colours {
    #[arg(long, value_name = "NAME", default_value = "viridis", help = colormaps())]
    colormap: String,
    /// Values that the colours span; `auto` is robust against peaks at tips
    #[arg(long, value_name = "A,B|auto", default_value = "auto", allow_hyphen_values = true)]
    range: Range,
    /// How values spread over the colours: linear, log or symlog
    #[arg(long, default_value = "linear")]
    scale: Scale,
}

impl Colours {
    pub(crate) fn style(&self) -> anyhow::Result<Style> {
        Ok(Style { scale: self.scale, range: self.range, ..style(&self.colormap)? })
    }

    /// The file that may be read.
    pub(crate) fn input(&self) -> &Path {
        Path::new(&self.colormap)
    }
}

fn colormaps() -> String {
    format!(
        "Colour map: {}; reversed with _r; or a file, CSV or JSON, as ParaView, Plotly and others write it",
        NAMES.join(", ")
    )
}

/// The map of a file, or the built-in one of that name. What is neither, but there, is read as a file too,
/// to say why it cannot be.
fn style(name: &str) -> anyhow::Result<Style> {
    let path = Path::new(name);
    match Style::named(name) {
        Ok(style) if !path.is_file() => return Ok(style),
        Err(error) if !path.exists() => return Err(error.into()),
        _ => {}
    }
    let text = ppum_file::text(path, LONGEST).with_context(|| format!("cannot read {name}"))?;
    Ok(Style { colormap: Colormap::from_text(name, &text)?, ..Style::default() })
}
