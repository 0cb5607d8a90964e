//! What the tips of a step do next.

use ppum::crack::TipId;
use ppum::dataset::{Advance, Fate, Growth};
use ppum::text::{short, trimmed};
use serde::Serialize;

use crate::number::Number;

/// The growth of a step.
#[derive(Debug, Serialize)]
pub(super) struct GrowthRow {
    /// Load cycles up to the step.
    pub(super) cycles: Option<f64>,
    /// Why the series ends with it.
    pub(super) stop: Option<&'static str>,
    pub(super) tips: Vec<AdvanceRow>,
}

/// What a tip does next.
#[derive(Debug, Serialize)]
pub(super) struct AdvanceRow {
    crack: u32,
    end: &'static str,
    fate: String,
    strength: Number,
    /// Direction and length of the next increment.
    direction: f64,
    length: f64,
    /// Growth that is due and has not been made.
    due: f64,
    /// Length grown since the first step.
    extension: f64,
    #[serde(skip)]
    way: String,
}

impl GrowthRow {
    pub(super) fn new(growth: &Growth) -> Self {
        Self {
            cycles: growth.cycles,
            stop: growth.stop.map(|stop| stop.words()),
            tips: growth.tips.iter().map(AdvanceRow::new).collect(),
        }
    }

    /// For people: the cycles, a line for each tip, and the end.
    pub(super) fn lines(&self) -> Vec<String> {
        let cycles = self.cycles.map(|cycles| format!("after {} cycles", trimmed(cycles)));
        let end = self.stop.map(|stop| format!("ends here: {stop}"));
        cycles.into_iter().chain(self.tips.iter().map(AdvanceRow::line)).chain(end).collect()
    }
}

impl AdvanceRow {
    fn new(row: &Advance) -> Self {
        let TipId { crack, end } = row.tip;
        Self {
            crack,
            end: end.name(),
            fate: row.fate.words(),
            strength: Number(row.strength),
            direction: row.direction,
            length: row.length,
            due: row.due,
            extension: row.extension,
            way: way(row),
        }
    }

    fn line(&self) -> String {
        let Self { crack, end, way, extension, .. } = self;
        format!("crack {crack} {end}: {way}; grown by {}", short(*extension))
    }
}

/// The next increment, and what ends it, or why the tip stays: `0.1 at 12.00°, meets hole 0`.
pub(in crate::commands) fn way(row: &Advance) -> String {
    match row.fate {
        fate if !fate.goes_on() => fate.words(),
        fate => {
            // no minus before a zero
            let angle = (100.0 * row.direction.to_degrees()).round() / 100.0 + 0.0;
            let way = format!("{} at {angle:.2}°", short(row.length));
            if fate == Fate::Grows { way } else { format!("{way}, {}", fate.words()) }
        }
    }
}
