//! The contents of files of all forms: colours, with positions where the file gives them.

use super::space::ColorSpace;
use crate::image::Rgba;

/// Most colours in a file; more are no colour map.
pub(super) const MOST: usize = 1 << 16;

/// Entries that a map of another colour space is sampled at, and least ones between two colours:
/// linear interpolation between them is off by less than a step of a byte.
const SAMPLES: usize = 1024;
const LEAST_SAMPLES: usize = 8;

/// An error in a file, and its place.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ColorFileError {
    pub(super) place: String,
    pub(super) text: String,
}

impl ColorFileError {
    pub(super) fn new(place: impl Into<String>, text: impl Into<String>) -> Self {
        Self { place: place.into(), text: text.into() }
    }
}

/// A colour at a position, which is missing where the file gives none.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ColorStop {
    pub(super) at: Option<f64>,
    /// Red, green and blue, 0 to 255 or 0 to 1 as all the file's numbers are.
    pub(super) color: [f64; 3],
    pub(super) place: String,
}

/// A file's content.
#[derive(Clone, Debug)]
pub(super) struct Stops {
    pub(super) stops: Vec<ColorStop>,
    pub(super) space: ColorSpace,
    pub(super) below: Option<Rgba>,
    pub(super) above: Option<Rgba>,
}

impl From<Vec<ColorStop>> for Stops {
    fn from(stops: Vec<ColorStop>) -> Self {
        Self { stops, space: ColorSpace::Rgb, below: None, above: None }
    }
}

/// Positions from 0 to 1, empty if they are even, and sRGB entries, 0 to 255.
pub(super) type ColorEntries = (Vec<f64>, Vec<[f64; 3]>);

impl Stops {
    /// Colours and positions, checked and scaled.
    pub(super) fn entries(&self) -> Result<ColorEntries, ColorFileError> {
        if self.stops.len() < 2 {
            return Err(ColorFileError::new(
                "the whole file",
                "has fewer than two colours; give at least two",
            ));
        }
        if self.stops.len() > MOST {
            return Err(ColorFileError::new(&self.stops[MOST].place, too_many()));
        }
        let (positions, colors) = (self.positions()?, self.colors());
        Ok(match self.space {
            ColorSpace::Rgb => (positions, colors),
            space => sampled(space, &positions, &colors),
        })
    }

    fn colors(&self) -> Vec<[f64; 3]> {
        let is_small = self.stops.iter().flat_map(|stop| stop.color).all(|c| c <= 1.0);
        let scale = if is_small { 255.0 } else { 1.0 };
        self.stops.iter().map(|stop| stop.color.map(|c| c * scale)).collect()
    }

    /// Positions scaled to 0 … 1; none if the file gives none.
    fn positions(&self) -> Result<Vec<f64>, ColorFileError> {
        let given: Vec<f64> = self.stops.iter().filter_map(|stop| stop.at).collect();
        if given.is_empty() {
            return Ok(given);
        }
        for (pair, stop) in given.windows(2).zip(&self.stops[1..]) {
            if pair[1] < pair[0] {
                let mistake =
                    format!("position {:?} follows {:?}; positions must grow", pair[1], pair[0]);
                return Err(ColorFileError::new(&stop.place, mistake));
            }
        }
        let (first, last) = (given[0], given[given.len() - 1]);
        if !(last - first).is_finite() || last == first {
            let mistake = format!("run from {first:?} to {last:?}; they must span a finite range");
            return Err(ColorFileError::new("positions", mistake));
        }
        Ok(given.iter().map(|at| (at - first) / (last - first)).collect())
    }
}

pub(super) fn too_many() -> String {
    format!("more than {MOST} colours; no picture can show them, give fewer")
}

/// Entries so close that linear interpolation between them shows the colours of another space.
fn sampled(space: ColorSpace, positions: &[f64], colors: &[[f64; 3]]) -> ColorEntries {
    let count = colors.len() - 1;
    let steps = SAMPLES.div_ceil(count).max(LEAST_SAMPLES);
    let position = |k: usize| positions.get(k).copied().unwrap_or(k as f64 / count as f64);
    let unit = |k: usize| colors[k].map(|c| c / 255.0);
    let (mut at, mut entries) = (Vec::new(), Vec::new());
    for k in 0..count {
        let (low, high) = (position(k), position(k + 1));
        for step in 0..=steps {
            let share = step as f64 / steps as f64;
            at.push(low + share * (high - low));
            entries.push(space.between(unit(k), unit(k + 1), share).map(|c| c * 255.0));
        }
    }
    (at, entries)
}
