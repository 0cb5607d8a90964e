//! The smallest and the largest value of a quantity in the plate, with their places.

use std::io::{self, Write};

use anyhow::Context as _;
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum::text::LocationText;
use ppum::vec2::Vec2;
use ppum_render::extrema::{
    BodyRegion, Extremum, ExtremumSite, SingularKind, SingularPoint, extrema,
};
use serde::Serialize;

use crate::number::JsonNumber;
use crate::progress::ProgressLine;
use ppum_scene::range::{value, words};

/// The extrema of a quantity.
#[derive(Debug, Serialize)]
pub(super) struct ExtremaReport {
    quantity: String,
    min: ExtremumRow,
    max: ExtremumRow,
    /// Points where the quantity is infinite.
    singular: Vec<ExtremumLocation>,
}

#[derive(Debug, Serialize)]
struct ExtremumRow {
    value: JsonNumber,
    at: [f64; 2],
    /// The feature that the place lies on: `inside`, `border`, `face`, `rim`, `interface`,
    /// `singular`; `pixel` where only pixels were looked at.
    on: &'static str,
    /// Index of the crack or the hole; of a face with its side.
    #[serde(skip_serializing_if = "Option::is_none")]
    index: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    side: Option<&'static str>,
    #[serde(skip)]
    words: String,
}

#[derive(Debug, Serialize)]
struct ExtremumLocation {
    kind: &'static str,
    at: [f64; 2],
}

impl ExtremaReport {
    /// Finds them.
    pub(super) fn new(field: &Field<'_>, name: &str, quantity: &Quantity) -> anyhow::Result<Self> {
        let found = extrema(field, &BodyRegion::whole(field), quantity, &ProgressLine::new())?;
        let found = found.with_context(|| format!("{name}: is nowhere defined"))?;
        let place = |offset: Vec2| (found.center + offset).into();
        let row = |extremum: &Extremum| ExtremumRow::new(extremum, place(extremum.offset));
        let point =
            |s: &SingularPoint| ExtremumLocation { kind: kind(s.kind), at: place(s.offset) };
        Ok(Self {
            quantity: name.to_owned(),
            min: row(&found.min),
            max: row(&found.max),
            singular: found.singular.iter().map(point).collect(),
        })
    }

    /// Writes a line for each.
    pub(super) fn write(&self, places: &LocationText, out: &mut dyn Write) -> io::Result<()> {
        let finite =
            [&self.min, &self.max].map(|row| row.value.0).into_iter().filter(|v| v.is_finite());
        let largest = finite.map(f64::abs).fold(0.0, f64::max);
        for (name, row) in [("min", &self.min), ("max", &self.max)] {
            let value = value(row.value.0, largest);
            writeln!(out, "{name}  {value}  at {}{}", places.show(row.at.into()), row.words)?;
        }
        for point in &self.singular {
            writeln!(out, "infinite at {} ({})", places.show(point.at.into()), point.kind)?;
        }
        Ok(())
    }
}

impl ExtremumRow {
    fn new(extremum: &Extremum, at: [f64; 2]) -> Self {
        let (index, side) = match extremum.on {
            ExtremumSite::Face(segment, side) => (Some(segment.crack), Some(side.name())),
            ExtremumSite::Rim(hole) => (u32::try_from(hole).ok(), None),
            _ => (None, None),
        };
        let on = extremum.on.name();
        let words = words(extremum.on).map_or_else(String::new, |words| format!(", {words}"));
        Self { value: JsonNumber(extremum.value), at, on, index, side, words }
    }
}

fn kind(kind: SingularKind) -> &'static str {
    match kind {
        SingularKind::Tip(_) => "tip",
        SingularKind::Kink(_) => "kink",
        SingularKind::Corner(_) => "corner",
        SingularKind::Origin => "origin of a function",
    }
}
