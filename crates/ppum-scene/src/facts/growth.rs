//! The next increments of the tips of a step.

use ppum::dataset::{self, GrowthStop, TipStatus};
use ppum::text::{short, trimmed};
use serde::Serialize;

use super::JsonNumber;

/// The growth of a step.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GrowthFacts {
    /// Load cycles up to the step.
    pub cycles: Option<f64>,
    /// Why the series ends with it.
    pub stop: Option<&'static str>,
    tips: Vec<IncrementFacts>,
}

/// The next increment of a tip.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct IncrementFacts {
    crack: u32,
    end: &'static str,
    fate: String,
    strength: JsonNumber,
    /// Direction and length of the next increment.
    direction: f64,
    length: f64,
    /// Growth that is due and has not been made.
    due: f64,
    /// Length grown since the first step.
    extension: f64,
    #[serde(skip)]
    increment: String,
}

impl GrowthFacts {
    /// The facts of a step's growth.
    #[must_use]
    pub fn new(growth: &dataset::Growth) -> Self {
        Self {
            cycles: growth.cycles,
            stop: growth.stop.map(GrowthStop::words),
            tips: growth.tips.iter().map(IncrementFacts::new).collect(),
        }
    }

    /// For people: the cycles, a line for each tip, and the end.
    #[must_use]
    pub fn lines(&self) -> Vec<String> {
        let cycles = self.cycles.map(|cycles| format!("after {} cycles", trimmed(cycles)));
        let end = self.stop.map(|stop| format!("ends here: {stop}"));
        cycles.into_iter().chain(self.tips.iter().map(IncrementFacts::line)).chain(end).collect()
    }
}

impl IncrementFacts {
    fn new(row: &dataset::TipIncrement) -> Self {
        Self {
            crack: row.tip.crack,
            end: row.tip.end.name(),
            fate: row.fate.words(),
            strength: JsonNumber(row.k_eq),
            direction: row.direction,
            length: row.length,
            due: row.due,
            extension: row.extension,
            increment: increment(row),
        }
    }

    fn line(&self) -> String {
        let Self { crack, end, increment, extension, .. } = self;
        format!("crack {crack} {end}: {increment}; grown by {}", short(*extension))
    }
}

/// The next increment, and what ends it, or why the tip stays: `0.1 at 12.00°, meets hole 0`.
#[must_use]
pub fn increment(row: &dataset::TipIncrement) -> String {
    if !row.fate.goes_on() {
        return row.fate.words();
    }
    // no minus before a zero
    let angle = (100.0 * row.direction.to_degrees()).round() / 100.0 + 0.0;
    let increment = format!("{} at {angle:.2}°", short(row.length));
    match row.fate {
        TipStatus::Grows => increment,
        fate => format!("{increment}, {}", fate.words()),
    }
}
