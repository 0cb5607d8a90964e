//! The way values become colours, as data.

use std::f64::consts::FRAC_PI_2;
use std::io;
use std::path::Path;

use ppum::quantity::Quantity;
use ppum_render::colormap::{Colormap, ColormapError, LONGEST, Rgb};
use ppum_render::picture::Style;
use ppum_render::range::RangeChoice;
use ppum_render::scale::Scale;
use serde::{Deserialize, Serialize};

use crate::image::quantity::{DisplayedQuantity, classes};
use crate::image::values::RasterValues;
use crate::request::written;

/// The way values become colours, except for the map itself.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[serde(default)]
pub struct ColorOptions {
    /// Name of the map, or of a file with one; by default that of the quantity.
    #[cfg_attr(feature = "clap", arg(long, value_name = "NAME", help = maps()))]
    pub colormap: Option<String>,
    /// Range of the colours: auto, all values, but robust against infinite peaks; full, all finite
    /// values; two values; or two percentiles, such as 2% and 98%
    #[cfg_attr(
        feature = "clap",
        arg(long, value_name = "auto|full|A,B|P%,Q%|P%", allow_hyphen_values = true),
        arg(default_value = "auto")
    )]
    #[serde(with = "written")]
    pub range: RangeChoice,
    /// Mapping of values to colours: linear, log, or symlog, logarithmic on both sides of zero
    #[cfg_attr(feature = "clap", arg(long, default_value = "linear"))]
    #[serde(with = "written")]
    pub scale: Scale,
    /// Colours of values beyond the range: those of the map's ends, or contrasting ones that do not
    /// occur in the map
    #[cfg_attr(
        feature = "clap",
        arg(long = "extremes", value_parser = extremes(), default_value = "end"),
        arg(action = clap::ArgAction::Set, value_name = "end|contrast")
    )]
    pub contrast: bool,
    /// Number of bands of one colour each
    #[cfg_attr(
        feature = "clap",
        arg(long, value_name = "N"),
        arg(value_parser = clap::value_parser!(u16).range(1..=i64::from(MOST_BANDS)))
    )]
    pub bands: Option<u16>,
    /// Centre an automatic range that contains zero at zero, as diverging maps always do
    #[cfg_attr(feature = "clap", arg(long))]
    pub symmetric: bool,
    /// Colour of points of the body without a value, as #rrggbb [default: crosshatched]
    #[cfg_attr(feature = "clap", arg(long, value_name = "#RRGGBB"))]
    #[serde(with = "written::optional", skip_serializing_if = "Option::is_none")]
    pub nan_color: Option<Rgb>,
}

#[cfg(feature = "clap")]
fn maps() -> String {
    format!(
        "Colour map: {}; reversed with _r; or a file: a preset of ParaView, JSON, or CSV with red, green, blue \
         [default: viridis; of directions twilight]",
        ppum_render::colormap::NAMES.join(", ")
    )
}

/// True for colours that do not occur in the map.
#[cfg(feature = "clap")]
fn extremes() -> impl clap::builder::TypedValueParser<Value = bool> {
    use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser as _};

    let end = PossibleValue::new("end").help("Those of the map's ends");
    let contrast = PossibleValue::new("contrast").help("Colours that do not occur in the map");
    PossibleValuesParser::new([end, contrast]).map(|word| word == "contrast")
}

/// Most bands: more than eyes, and images, can tell apart.
pub const MOST_BANDS: u16 = 1000;

impl ColorOptions {
    /// The map: that of the name or file, by default one that suits the quantity.
    ///
    /// # Errors
    /// As [`map`].
    pub fn map(&self, quantity: Option<&Quantity>) -> Result<Colormap, MapError> {
        map(self.colormap.as_deref().unwrap_or(Self::default_map(quantity)))
    }

    /// The name of the map where none is given.
    #[must_use]
    pub fn default_map(quantity: Option<&Quantity>) -> &'static str {
        if quantity.and_then(period).is_some() { "twilight" } else { "viridis" }
    }

    /// The way a quantity's values become colours of a map, or those of cells.
    #[must_use]
    pub fn style(&self, quantity: Option<&Quantity>, mut colormap: Colormap) -> Style {
        let range = match (self.range, quantity.and_then(period)) {
            (RangeChoice::Auto, Some([from, to])) if colormap.cyclic => {
                RangeChoice::Fixed(from, to)
            }
            // values of cells have no peaks between the pixels
            (RangeChoice::Auto, None) if quantity.is_none() => RangeChoice::Full,
            (range, _) => range,
        };
        if self.contrast {
            colormap = colormap.contrasting();
        }
        if let Some(count) = self.bands {
            colormap = colormap.banded(count);
        }
        colormap.diverging |= self.symmetric;
        let (scale, nan_color) = (self.scale, self.nan_color);
        Style { colormap, range, scale, nan_color, ..Style::default() }
    }

    /// The style of images of one range. Few whole numbers have a colour each.
    pub fn style_of<'a>(
        &self,
        pictures: impl IntoIterator<Item = (&'a DisplayedQuantity, &'a RasterValues)> + Clone,
        colormap: Colormap,
    ) -> Style {
        let first = pictures.clone().into_iter().next();
        let style = self.style(first.and_then(|(shown, _)| shown.quantity()), colormap);
        self.classed(style, classes(pictures))
    }

    /// The style with a colour for each of some classes, unless range, scale or bands are given.
    #[must_use]
    pub fn classed(&self, style: Style, classes: Option<Vec<f64>>) -> Style {
        let is_free =
            self.range == RangeChoice::Auto && self.bands.is_none() && self.scale == Scale::Linear;
        match classes.filter(|_| is_free) {
            Some(classes) => style.classed(&classes),
            None => style,
        }
    }
}

/// A colour map that there is not, or that cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MapError {
    /// No such name, or a file that holds no map.
    #[error(transparent)]
    Colormap(#[from] ColormapError),
    /// A file that cannot be read.
    #[error("cannot read {name}: {error}")]
    File {
        /// Its name.
        name: String,
        /// The reason.
        error: io::Error,
    },
}

/// The map of a file, or the built-in one of that name; a text of several lines is a map itself.
/// Any other existing path is read as a file too, to say why it cannot be.
///
/// # Errors
/// An unknown name; a file that cannot be read, or holds no map.
pub fn map(name: &str) -> Result<Colormap, MapError> {
    if name.contains('\n') {
        return Ok(Colormap::from_text("colormap", name)?);
    }
    let path = Path::new(name);
    match Colormap::named(name) {
        Ok(map) if !path.is_file() => return Ok(map),
        Err(error) if !path.exists() => return Err(error.into()),
        _ => {}
    }
    let text = ppum_file::text(path, LONGEST);
    let text = text.map_err(|error| MapError::File { name: name.into(), error })?;
    Ok(Colormap::from_text(name, &text)?)
}

/// The values that an angle goes round through.
fn period(quantity: &Quantity) -> Option<[f64; 2]> {
    // π/2 rounded to single precision, as graphics cards have it, lies above π/2
    let quarter = f64::from(FRAC_PI_2 as f32);
    matches!(quantity, Quantity::PrincipalDirection).then_some([-quarter, quarter])
}
