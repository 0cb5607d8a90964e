//! What is drawn: quantities, and how their values become colours.

use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use anyhow::Context as _;
use clap::ValueEnum;
use ppum::field::Field;
use ppum::formula::one_line;
use ppum::quantity::Quantity;
use ppum_figure::figure::Labels;
use ppum_render::colormap::{Colormap, LONGEST, NAMES};
use ppum_render::picture::Style;
use ppum_render::range::Range;
use ppum_render::scale::Scale;

use crate::dataset::quantity;

/// The options of colours.
#[derive(Debug, clap::Args)]
pub(super) struct Colors {
    #[arg(long, value_name = "NAME", help = colormaps())]
    pub(super) colormap: Option<String>,
    /// Values that the colours span; `auto` is robust against peaks at tips
    #[arg(long, value_name = "A,B|auto", default_value = "auto", allow_hyphen_values = true)]
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
    pub(super) fn style(&self, quantity: &Quantity) -> anyhow::Result<Style> {
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

    /// True if the range is found from the picture.
    pub(super) fn is_automatic(&self) -> bool {
        self.range == Range::Auto
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

/// A quantity as it was asked for.
pub(super) struct Subject {
    pub(super) quantity: Quantity,
    /// Its name in messages and in the picture's description.
    pub(super) name: String,
}

impl Subject {
    pub(super) fn new(field: &Field<'_>, given: &str) -> anyhow::Result<Self> {
        let quantity = quantity(field, given)?;
        let name = match &quantity {
            Quantity::Formula(formula) => formula.label(),
            _ => given.to_owned(),
        };
        Ok(Self { quantity, name })
    }

    /// The formula, as a note in the picture.
    pub(super) fn note(&self) -> Option<(String, String)> {
        let Quantity::Formula(formula) = &self.quantity else { return None };
        Some(("ppum:formula".to_owned(), one_line(formula.formula().text())))
    }

    /// The words of its figure.
    pub(super) fn labels(&self, title: String, field: &Field<'_>) -> Labels {
        Labels {
            title,
            quantity: self.quantity.symbol(&field.data.components),
            unit: self.quantity.unit(field).to_owned(),
            ..Labels::default()
        }
    }
}

/// The quantity without a word on it.
pub(super) fn default<'f>(field: &'f Field<'_>) -> &'f str {
    match field.equation.elastic() {
        Some(_) => "von-mises",
        None => &field.data.components[0],
    }
}

/// Quantities with commas between; commas within brackets are those of formulas.
pub(super) fn list(text: &str) -> Vec<&str> {
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
