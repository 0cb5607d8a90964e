//! Overlays over the colours of an image, as data.

use std::fmt;
use std::str::FromStr;

#[cfg(feature = "clap")]
use clap::ValueEnum as _;
use ppum::text::exact;
#[cfg(feature = "clap")]
use ppum_render::glyph::LEAST_SPACING;
use serde::{Deserialize, Serialize};

use crate::request::list::numbers;

/// Distance of arrows and crosses if none is given, see [`Overlays::arrows`].
pub const SPACING: f64 = 36.0;

/// The overlays over the colours. Distances of arrows and crosses are pixels of a bare image of
/// at most 1024 × 768; in larger ones and in figures they have the scale of lines and letters.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[serde(default)]
pub struct Overlays {
    /// Overlays, in any number and order; figures always show the cracks
    #[cfg_attr(
        feature = "clap",
        arg(long = "overlay", value_enum, value_name = "NAME,…", value_delimiter = ',')
    )]
    pub shown: Vec<Overlay>,
    /// Leave the cracks out of a figure or a page
    #[cfg_attr(feature = "clap", arg(long))]
    pub no_cracks: bool,
    /// Isolines of the quantity: at round levels (auto), at about so many, or at these values
    #[cfg_attr(
        feature = "clap",
        arg(long, value_name = "auto|N|A,B,…", allow_hyphen_values = true)
    )]
    pub isolines: Option<IsolineLevels>,
    /// Label the isolines with their levels, where there is room
    #[cfg_attr(feature = "clap", arg(long, requires = "isolines"))]
    pub level_labels: bool,
    /// Arrows of the displacement or of the gradient of a potential; PIXELS is their distance in a
    /// bare image, 36 if not given
    #[cfg_attr(
        feature = "clap",
        arg(long, value_name = "PIXELS", num_args = 0..=1, require_equals = true),
        arg(default_missing_value = SPACING_TEXT, value_parser = spacing)
    )]
    pub arrows: Option<f64>,
    /// Crosses of the principal stresses; PIXELS is their distance in a bare image, 36 if not given
    #[cfg_attr(
        feature = "clap",
        arg(long, value_name = "PIXELS", num_args = 0..=1, require_equals = true),
        arg(default_missing_value = SPACING_TEXT, value_parser = spacing)
    )]
    pub crosses: Option<f64>,
}

/// [`SPACING`] as an option has it.
#[cfg(feature = "clap")]
const SPACING_TEXT: &str = "36";

/// Distance of arrows and crosses.
#[cfg(feature = "clap")]
fn spacing(text: &str) -> Result<f64, String> {
    let value = crate::request::arguments::positive(text)?;
    let is_apart = value >= LEAST_SPACING;
    is_apart.then_some(value).ok_or_else(|| format!("write at least {LEAST_SPACING} pixels"))
}

/// In the order in which they are drawn, the lowest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum Overlay {
    /// Supports of the patches, which overlap.
    Patches,
    /// Borders of the cover's cells.
    Cells,
    /// Boxes of the cells, coloured by the kind of enrichment.
    Boxes,
    /// Points the cover was made from.
    Points,
    /// Centres of the cells, coloured by the kind of enrichment.
    Centers,
    /// Rings that the stress intensity factors are integrated over.
    Rings,
    /// Cracks with their tips, rims of holes, and lines along which elements are cut.
    Cracks,
    /// Supports of the body and exchanges of a potential, as its problem file has them.
    Supports,
    /// Loads on the body, as its problem file has them.
    Loads,
}

impl Overlay {
    /// All of them, the lowest first.
    pub const ALL: [Self; 9] = [
        Self::Patches,
        Self::Cells,
        Self::Boxes,
        Self::Points,
        Self::Centers,
        Self::Rings,
        Self::Cracks,
        Self::Supports,
        Self::Loads,
    ];

    /// Its word.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Patches => "patches",
            Self::Cells => "cells",
            Self::Boxes => "boxes",
            Self::Points => "points",
            Self::Centers => "centers",
            Self::Rings => "rings",
            Self::Cracks => "cracks",
            Self::Supports => "supports",
            Self::Loads => "loads",
        }
    }

    /// Describes it in the words of the command line.
    #[cfg(feature = "clap")]
    #[must_use]
    pub fn meaning(self) -> String {
        let help = self.to_possible_value().and_then(|value| value.get_help().cloned());
        help.map(|help| help.to_string()).unwrap_or_default()
    }

    /// True if the deformed body has it too.
    #[must_use]
    pub fn is_deformable(self) -> bool {
        matches!(self, Self::Cells | Self::Cracks)
    }

    /// True if it draws the borders of cells.
    #[must_use]
    pub fn is_of_cells(self) -> bool {
        matches!(self, Self::Cells | Self::Boxes)
    }
}

impl Overlays {
    /// The first of them that the deformed body does not have.
    #[must_use]
    pub fn undeformable(&self) -> Option<Overlay> {
        self.shown.iter().copied().find(|overlay| !overlay.is_deformable())
    }

    /// Those that the deformed body has.
    #[must_use]
    pub fn deformable(&self) -> Self {
        let shown = self.shown.iter().copied().filter(|overlay| overlay.is_deformable());
        Self { shown: shown.collect(), ..self.clone() }
    }

    /// True if supports or loads are shown, which stand outside of the body.
    #[must_use]
    pub fn have_stations(&self) -> bool {
        self.shown.iter().any(|o| matches!(o, Overlay::Supports | Overlay::Loads))
    }

    /// Room around the body for what stands outside of it, in parts of the body's larger side, in
    /// an image of so many pixels with lines and letters of a scale.
    #[must_use]
    pub fn margin(&self, pixels: [u32; 2], scale: f64) -> f64 {
        let side = f64::from(pixels[0].min(pixels[1]));
        let room = (MARGIN * scale).min(MARGIN_PART * side);
        if self.have_stations() { room / (side - 2.0 * room) } else { 0.0 }
    }
}

/// Room for supports and loads around the body: a little more than the longest arrow, in units of
/// the scale.
const MARGIN: f64 = 48.0;
/// The margin relative to the image's shorter side, at most.
const MARGIN_PART: f64 = 0.15;

/// The levels of isolines: written `auto`, a number, or values with commas between.
#[derive(Clone, Debug, PartialEq)]
pub enum IsolineLevels {
    /// Round ones, some fourteen at most.
    Auto,
    /// About so many.
    Count(usize),
    /// These.
    At(Vec<f64>),
}

impl FromStr for IsolineLevels {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let text = text.trim();
        if text == "auto" {
            return Ok(Self::Auto);
        }
        if !text.contains(',') {
            let count = text.parse().ok().filter(|count| (1..=1000).contains(count));
            return count.map(Self::Count).ok_or(
                "write auto, a number of levels from 1 to 1000, or their values with commas, `0.5,` for one",
            );
        }
        let values = numbers(text).filter(|values| !values.is_empty());
        Ok(Self::At(values.ok_or("write finite values with commas between")?))
    }
}

impl fmt::Display for IsolineLevels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Count(count) => write!(f, "{count}"),
            Self::At(values) => f.write_str(&listed(values)),
        }
    }
}

/// Values with commas between; one value has a comma too, to tell it from a number of them.
pub(crate) fn listed(values: &[f64]) -> String {
    let texts: Vec<_> = values.iter().map(|value| exact(*value)).collect();
    let end = if values.len() == 1 { "," } else { "" };
    texts.join(",") + end
}

crate::request::written::as_text!(IsolineLevels);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_written_as_they_are_read() {
        let all = [
            IsolineLevels::Auto,
            IsolineLevels::Count(7),
            IsolineLevels::At(vec![0.5]),
            IsolineLevels::At(vec![-1e-300, 0.1 + 0.2, 3e25]),
        ];
        for levels in all {
            assert_eq!(levels.to_string().parse(), Ok(levels));
        }
        for wrong in ["", ",", "0", "1001", "a", "1,a", "inf,1", "nan,"] {
            assert!(wrong.parse::<IsolineLevels>().is_err(), "{wrong}");
        }
    }

    #[cfg(feature = "clap")]
    #[test]
    fn the_distance_in_texts_is_that_of_programs() {
        assert_eq!(spacing(SPACING_TEXT), Ok(SPACING));
    }

    #[test]
    fn all_overlays_are_listed_in_their_order() {
        assert!(Overlay::ALL.is_sorted());
        let mut names = Overlay::ALL.map(Overlay::name).to_vec();
        names.dedup();
        assert_eq!(names.len(), 9);
    }
}
