//! What commands that draw have in common: the quantities that are drawn, and their colours.

use std::f64::consts::FRAC_PI_2;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use clap::ValueEnum;
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
    /// Quantity, see `ppum info`, or a formula of quantities, or @FILE with one; with --layout several, with commas
    /// between [default: von-mises; for Poisson problems u]
    #[arg(short, long, value_name = "Q", allow_hyphen_values = true)]
    quantity: Option<String>,
    #[command(flatten)]
    pub(crate) replacements: Replacements,
    /// Step of the series, from 0 [default: the last]
    #[arg(long, value_name = "K")]
    pub(crate) step: Option<usize>,
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

    /// The quantity.
    pub(crate) fn quantity(&self, field: &Field<'_>) -> anyhow::Result<Asked> {
        Asked::new(field, self.given(field))
    }

    /// The quantities of a list with commas between.
    pub(crate) fn quantities(&self, field: &Field<'_>) -> anyhow::Result<Vec<Asked>> {
        list(self.given(field)).into_iter().map(|text| Asked::new(field, text)).collect()
    }

    fn given<'a>(&'a self, field: &'a Field<'_>) -> &'a str {
        self.quantity.as_deref().unwrap_or(default_quantity(field))
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
}

/// A quantity as it was asked for.
pub(crate) struct Asked {
    pub(crate) quantity: Quantity,
    /// Its name in messages and in the picture's description.
    pub(crate) name: String,
}

impl Asked {
    pub(crate) fn new(field: &Field<'_>, given: &str) -> anyhow::Result<Self> {
        let quantity = quantity(field, given)?;
        let name = match &quantity {
            Quantity::Formula(formula) => formula.label(),
            _ => given.to_owned(),
        };
        Ok(Self { quantity, name })
    }

    /// The formula, as a note in the picture.
    pub(crate) fn note(&self) -> Option<(String, String)> {
        let Quantity::Formula(formula) = &self.quantity else { return None };
        Some(("ppum:formula".to_owned(), one_line(formula.formula().text())))
    }

    /// The words of its figure.
    pub(crate) fn labels(&self, title: String, field: &Field<'_>) -> Labels {
        Labels {
            title,
            quantity: self.quantity.symbol(&field.data.components),
            unit: self.quantity.unit(field).to_owned(),
            ..Labels::default()
        }
    }
}

/// The quantity without a word on it.
fn default_quantity<'f>(field: &'f Field<'_>) -> &'f str {
    match field.equation.elastic() {
        Some(_) => "von-mises",
        None => &field.data.components[0],
    }
}

/// The options of colours.
#[derive(Debug, clap::Args)]
pub(crate) struct Colors {
    #[arg(long, value_name = "NAME", help = colormaps())]
    colormap: Option<String>,
    /// Values that the colours span: auto for all, but robust against peaks that are infinite; full; two values; two percentiles, or
    /// one for both ends
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

impl Colors {
    /// The way a quantity's values become colours.
    pub(crate) fn style(&self, quantity: &Quantity) -> anyhow::Result<Style> {
        let period = period(quantity);
        let default = if period.is_some() { "twilight" } else { "viridis" };
        let mut colormap = colormap(self.colormap.as_deref().unwrap_or(default))?;
        let range = match (self.range, period) {
            (Range::Auto, Some([from, to])) if colormap.cyclic => Range::Fixed(from, to),
            (range, _) => range,
        };
        if self.extremes == Extremes::Contrast {
            colormap = colormap.contrasting();
        }
        if let Some(count) = self.bands {
            colormap = colormap.banded(count);
        }
        Ok(Style { colormap, range, scale: self.scale, ..Style::default() })
    }

    /// The file of the colour map, if it is one.
    pub(crate) fn input(&self) -> Option<&Path> {
        self.colormap.as_deref().map(Path::new)
    }
}

/// The values that an angle goes round through.
fn period(quantity: &Quantity) -> Option<[f64; 2]> {
    // π/2 rounded to single precision, as graphics cards have it, lies above π/2
    let quarter = f64::from(FRAC_PI_2 as f32);
    matches!(quantity, Quantity::PrincipalDirection).then_some([-quarter, quarter])
}

/// The map of a file, or the built-in one of that name. What is neither, but there, is read as a file too,
/// to say why it cannot be.
fn colormap(name: &str) -> anyhow::Result<Colormap> {
    let path = Path::new(name);
    match Colormap::named(name) {
        Ok(map) if !path.is_file() => return Ok(map),
        Err(error) if !path.exists() => return Err(error.into()),
        _ => {}
    }
    let text = ppum_file::text(path, LONGEST).with_context(|| format!("cannot read {name}"))?;
    Ok(Colormap::from_text(name, &text)?)
}

/// Quantities with commas between; commas within brackets are those of formulas.
fn list(text: &str) -> Vec<&str> {
    let (mut depth, mut from, mut all) = (0i32, 0, Vec::new());
    for (at, c) in text.char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            ',' if depth == 0 => {
                all.push(text[from..at].trim());
                from = at + 1;
            }
            _ => {}
        }
    }
    all.push(text[from..].trim());
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_keep_their_commas() {
        assert_eq!(list("von-mises, hypot(ux, uy),syy"), ["von-mises", "hypot(ux, uy)", "syy"]);
        assert_eq!(list("u"), ["u"]);
        assert_eq!(list("u,"), ["u", ""]);
    }
}
