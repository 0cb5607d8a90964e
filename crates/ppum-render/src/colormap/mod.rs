//! Colour maps: from the position in a range to a colour.
//!
//! | name | for |
//! |---|---|
//! | viridis, plasma, inferno, magma | magnitudes; lightness grows evenly |
//! | cividis | the same, and alike for readers who do not see red and green apart |
//! | turbo | much detail; lightness is *not* monotone |
//! | batlow | magnitudes, in more colours |
//! | coolwarm, vik, roma | signed values around zero |
//! | twilight | angles: it ends as it begins |
//!
//! `_r` behind a name reverses a map; [`banded`](Colormap::banded) makes steps of it. Values
//! [below](Colormap::below) and [above](Colormap::above) the range have the colours of the map's
//! ends, or [contrasting](Colormap::contrasting) ones, which do not occur in it: where lightness
//! grows they are black (slate blue in the maps that begin with black) and white; turbo has grey
//! and white, coolwarm, vik and twilight cyan and yellow.
//!
//! [Files](Colormap::from_text) are presets of ParaView, or text.

mod json;
mod paint;
mod space;
mod stops;
mod table;

use crate::image::Rgba;
pub use paint::Rgb;
use ppum::text::hint;
use space::ColorSpace;
use stops::{ColorFileError, Stops};

/// Names of the built-in maps.
pub const NAMES: [&str; 11] = [
    "viridis", "plasma", "inferno", "magma", "cividis", "turbo", "batlow", "coolwarm", "vik",
    "roma", "twilight",
];

const BLACK: Rgba = [0, 0, 0, 255];
const WHITE: Rgba = [255, 255, 255, 255];
const SLATE: Rgba = [61, 90, 128, 255];
const GREY: Rgba = [140, 140, 140, 255];
const CYAN: Rgba = [0, 190, 230, 255];
const YELLOW: Rgba = [255, 212, 0, 255];

/// A sequence of sRGB colours, linearly interpolated, for positions 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Colormap {
    /// Its name, with `_r` if it is reversed.
    pub name: String,
    /// Colour of values below the range.
    pub below: Rgba,
    /// Colour of values above the range.
    pub above: Rgba,
    /// True if its middle stands for zero: an automatic range is then symmetric.
    pub diverging: bool,
    /// True if it ends as it begins: for angles.
    pub cyclic: bool,
    /// The number of bands of one colour, if it is made of such.
    bands: Option<u16>,
    /// The values that have a colour each, if it is made for such.
    classes: Vec<f64>,
    /// Colours below and above that do not occur in it.
    contrast: [Rgba; 2],
    /// Red, green, blue, 0 to 255; at least two entries.
    entries: Vec<[f64; 3]>,
    /// Positions of the entries, from 0 to 1, never falling; empty if they are even.
    positions: Vec<f64>,
}

/// The reason why there is no such colour map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ColormapError {
    /// No map of that name.
    #[error("no colour map is named `{name}`{}; there are {}, each also reversed with _r",
        hint(name, NAMES), NAMES.join(", "))]
    Unknown {
        /// The name asked for.
        name: String,
    },
    /// A file that is not understood.
    #[error("colour map `{name}`, {place}: {mistake}")]
    File {
        /// Name of the map.
        name: String,
        /// Line, column or key.
        place: String,
        /// The error, and what to write.
        mistake: String,
    },
}

/// Longest text of a file, in bytes; a colour map needs some thousands.
pub const LONGEST: u64 = 1 << 24;

/// Between a class and the end of the range: half of the distance of whole numbers.
pub(crate) const HALF: f64 = 0.5;

impl Colormap {
    /// The built-in map of that name; `_r` behind it reverses the map.
    ///
    /// # Errors
    /// An unknown name, with the nearest known one.
    pub fn named(name: &str) -> Result<Self, ColormapError> {
        if let Some(base) = name.strip_suffix("_r") {
            return Self::named(base).map(Self::reversed);
        }
        let (table, contrast) = match name {
            "viridis" => (include_str!("../../data/viridis.txt"), [BLACK, WHITE]),
            "plasma" => (include_str!("../../data/plasma.txt"), [BLACK, WHITE]),
            "inferno" => (include_str!("../../data/inferno.txt"), [SLATE, WHITE]),
            "magma" => (include_str!("../../data/magma.txt"), [SLATE, WHITE]),
            "cividis" => (include_str!("../../data/cividis.txt"), [BLACK, WHITE]),
            "turbo" => (include_str!("../../data/turbo.txt"), [GREY, WHITE]),
            "batlow" => (include_str!("../../data/batlow.txt"), [BLACK, WHITE]),
            "coolwarm" => (include_str!("../../data/coolwarm.txt"), [CYAN, YELLOW]),
            "vik" => (include_str!("../../data/vik.txt"), [CYAN, YELLOW]),
            "roma" => (include_str!("../../data/roma.txt"), [BLACK, WHITE]),
            "twilight" => (include_str!("../../data/twilight.txt"), [CYAN, YELLOW]),
            _ => return Err(ColormapError::Unknown { name: name.to_owned() }),
        };
        let diverging = ["coolwarm", "vik", "roma"].contains(&name);
        let map = Self::from_text(name, table)?;
        Ok(Self { contrast, diverging, cyclic: name == "twilight", ..map })
    }

    /// A map from the text of a file; its form is found from the content.
    ///
    /// - Text: red, green and blue on each line, with or without a position in front, apart by
    ///   commas, semicolons, tabs or blanks; a first line may name the columns, and `#` begins a
    ///   comment.
    /// - JSON: a preset of ParaView, in RGB, HSV, Lab or Diverging, with the colours below and
    ///   above if it uses them. A diverging one has zero in its middle.
    ///
    /// The numbers of colours lie all within 0 to 1 or all within 0 to 255. Positions may be of any
    /// range and uneven, and are scaled to 0 … 1; where two are equal the map jumps. Below and
    /// above are the colours of its ends if the file has none, and black and white in contrast.
    /// Opacity is left out, and so is ParaView's colour for NaN, which here is outside the domain.
    ///
    /// # Errors
    /// An entry that is no colour, with its place; fewer than two colours; more than 65,536; a form
    /// or a colour space that is not supported.
    pub fn from_text(name: &str, text: &str) -> Result<Self, ColormapError> {
        let found = read(text).and_then(|stops| Ok((stops.entries()?, stops)));
        let ((positions, entries), stops) =
            found.map_err(|ColorFileError { place, text: mistake }| ColormapError::File {
                name: name.to_owned(),
                place,
                mistake,
            })?;
        let mut map = Self {
            name: name.to_owned(),
            below: BLACK,
            above: WHITE,
            diverging: stops.space == ColorSpace::Diverging,
            cyclic: false,
            bands: None,
            classes: Vec::new(),
            contrast: [stops.below.unwrap_or(BLACK), stops.above.unwrap_or(WHITE)],
            entries,
            positions,
        };
        map.below = stops.below.unwrap_or(map.color(0.0));
        map.above = stops.above.unwrap_or(map.color(1.0));
        Ok(map)
    }

    /// The map with colours below and above the range that do not occur in it.
    #[must_use]
    pub fn contrasting(self) -> Self {
        let [below, above] = self.contrast;
        Self { below, above, ..self }
    }

    /// The map in `count` ≥ 1 bands of one colour each, the first and the last in those of its
    /// ends. A single band has the colour of the middle, and a cyclic map does not repeat its end.
    #[must_use]
    pub fn banded(self, count: u16) -> Self {
        let count = count.max(1);
        let last = f64::from(if self.cyclic { count } else { count - 1 });
        let share = |k: u16| if last > 0.0 && count > 1 { f64::from(k) / last } else { 0.5 };
        let border = |k: u16| f64::from(k) / f64::from(count);
        let exact = |k: u16| self.mixed(share(k));
        Self {
            entries: (0..count).flat_map(|k| [exact(k); 2]).collect(),
            positions: (0..count).flat_map(|k| [border(k), border(k + 1)]).collect(),
            bands: Some(count),
            classes: Vec::new(),
            ..self
        }
    }

    /// The map with one colour for each of some rising values, for the range from half below the
    /// first to half above the last: it jumps in the middle between two of them. Without values it
    /// is the map itself.
    #[must_use]
    pub fn classed(self, values: &[f64]) -> Self {
        let (Some(first), Some(last)) = (values.first(), values.last()) else { return self };
        let (low, span) = (first - HALF, last - first + 2.0 * HALF);
        let borders = values.windows(2).map(|pair| (0.5 * (pair[0] + pair[1]) - low) / span);
        let doubled = borders.flat_map(|at| [at; 2]);
        Self {
            positions: [0.0].into_iter().chain(doubled).chain([1.0]).collect(),
            classes: values.to_vec(),
            bands: None,
            ..self.banded(u16::try_from(values.len()).unwrap_or(u16::MAX))
        }
    }

    /// The values that have a colour each, rising, if the map is [made for](Self::classed) such.
    #[must_use]
    pub fn classes(&self) -> &[f64] {
        &self.classes
    }

    /// The colour of a class, by its place among [`classes`](Self::classes).
    ///
    /// # Panics
    /// If there is no such class.
    #[must_use]
    pub fn class_color(&self, class: usize) -> Rgba {
        assert!(class < self.classes.len(), "one of the classes");
        let [red, green, blue] = self.entries[2 * class].map(|c| c.round() as u8);
        [red, green, blue, 255]
    }

    /// The number of bands of one colour each, all equally wide, if the map is made of such.
    #[must_use]
    pub fn bands(&self) -> Option<u16> {
        self.bands
    }

    /// The map from its other end; below and above change places.
    #[must_use]
    pub fn reversed(mut self) -> Self {
        self.entries.reverse();
        self.positions.reverse();
        self.positions.iter_mut().for_each(|at| *at = 1.0 - *at);
        self.classes.clear();
        self.contrast.reverse();
        std::mem::swap(&mut self.below, &mut self.above);
        self.name = match self.name.strip_suffix("_r") {
            Some(base) => base.to_owned(),
            None => format!("{}_r", self.name),
        };
        self
    }

    /// The colour at position `t`, held at the ends outside \[0, 1\].
    #[must_use]
    pub fn color(&self, t: f64) -> Rgba {
        // not `round`, a call of a library for each of the thousands of colours of a table
        let [red, green, blue] = self.mixed(t).map(|c| (c + 0.5) as u8);
        [red, green, blue, 255]
    }

    fn mixed(&self, t: f64) -> [f64; 3] {
        let (index, share) = self.place(t.clamp(0.0, 1.0));
        let (low, high) = (self.entries[index], self.entries[index + 1]);
        [0, 1, 2].map(|k| low[k] + share * (high[k] - low[k]))
    }

    /// True if the map jumps somewhere, so that a table of its colours is not exact.
    pub(crate) fn has_jumps(&self) -> bool {
        self.positions.windows(2).any(|pair| pair[0] >= pair[1])
    }

    /// The entry below position `t` ∈ \[0, 1\], and the share of the way to the next one.
    fn place(&self, t: f64) -> (usize, f64) {
        let last = self.entries.len() - 1;
        if self.positions.is_empty() {
            let at = t * last as f64;
            let index = (at as usize).min(last - 1);
            return (index, at - index as f64);
        }
        let passed = self.positions.partition_point(|&at| at <= t);
        let index = passed.saturating_sub(1).min(last - 1);
        let (low, high) = (self.positions[index], self.positions[index + 1]);
        // at the end of the map the last two may be equal
        (index, if high > low { (t - low) / (high - low) } else { 1.0 })
    }

    /// `count` ≥ 2 colours at even positions, the ends included.
    #[must_use]
    pub fn palette(&self, count: usize) -> Vec<Rgba> {
        (0..count).map(|k| self.color(k as f64 / (count - 1) as f64)).collect()
    }
}

/// Reads a file of any form.
fn read(text: &str) -> Result<Stops, ColorFileError> {
    let text = text.trim_start_matches('\u{feff}');
    if text.len() as u64 > LONGEST {
        return Err(ColorFileError::new(
            "the whole file",
            "has more than 16 MiB; a colour map has some thousand colours",
        ));
    }
    match text.trim_start().chars().next() {
        Some('[' | '{') => json::read(text),
        Some('<') => {
            let mistake = "XML is not supported; ParaView reads it and exports it as JSON";
            Err(ColorFileError::new("the whole file", mistake))
        }
        _ => table::read(text).map(Stops::from),
    }
}

#[cfg(test)]
mod tests;
