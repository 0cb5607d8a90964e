//! The solver's results of a step.

use ppum::dataset::{self, Dataset, GrowthStop, TipStatus};
use ppum::text::{short, trimmed};
use ppum_solve::report::{SolverReport, word};
use serde::Serialize;

use super::{JsonNumber, ReactionFacts, SolverFacts, Tip, all_tips, reactions};

/// The solver's results of a step.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ResultFacts {
    /// Number of unknowns.
    pub unknowns: usize,
    /// Energy of the solution, if the solver reports it.
    energy: Option<JsonNumber>,
    /// The solver's work; none of a step whose history does not tell.
    pub solver: Option<SolverFacts>,
    history: Vec<RecordFacts>,
    /// The next increments of the tips, in a series of cracks that grow.
    pub growth: Option<GrowthFacts>,
    /// The tips that have factors.
    pub intensities: Vec<Tip>,
    /// The warnings of the diagnostics.
    pub warnings: Vec<WarningFacts>,
    /// The reactions of the supports on the body.
    pub reactions: Vec<ReactionFacts>,
    /// All tips in their order, also those without factors.
    #[serde(skip)]
    pub tips: Vec<Tip>,
}

impl ResultFacts {
    /// The results of step number `index`.
    #[must_use]
    pub fn new(dataset: &Dataset, index: usize) -> Self {
        let step = &dataset.steps[index];
        let tip = |known| Tip::new(dataset, index, known);
        Self {
            unknowns: step.unknowns(),
            energy: SolverReport::of(&step.history).energy.map(JsonNumber),
            solver: SolverFacts::new(&step.history),
            history: step.history.iter().map(RecordFacts::new).collect(),
            growth: step.growth.as_ref().map(GrowthFacts::new),
            intensities: step.intensities.iter().map(tip).collect(),
            warnings: warnings(index, &step.warnings),
            reactions: reactions(dataset, step),
            tips: all_tips(dataset, index),
        }
    }
}

/// A record of the solver's report.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RecordFacts {
    name: String,
    value: JsonNumber,
    unit: String,
}

impl RecordFacts {
    /// A record of a history.
    #[must_use]
    pub fn new(record: &dataset::Record) -> Self {
        let dataset::Record { name, value, unit } = record.clone();
        Self { name, value: JsonNumber(value), unit }
    }

    /// Name, value and unit; codes in words.
    #[must_use]
    pub fn line(&self) -> String {
        let Self { name, value: JsonNumber(value), unit } = self;
        let value = word(name, *value).map_or_else(|| trimmed(*value), str::to_owned);
        format!("{name} {value} {unit}").trim_end().to_owned()
    }
}

/// A warning about a step.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WarningFacts {
    /// Number of the step.
    pub step: usize,
    /// A word for its kind.
    pub kind: String,
    at: Option<[f64; 2]>,
    value: JsonNumber,
    limit: JsonNumber,
    /// The finding and its remedy.
    pub message: String,
}

/// The warnings about step number `step`.
#[must_use]
pub fn warnings(step: usize, warnings: &[dataset::Warning]) -> Vec<WarningFacts> {
    let row = |warning: &dataset::Warning| {
        let dataset::Warning { kind, at, value, limit, message } = warning.clone();
        let (at, value, limit) = (at.map(Into::into), JsonNumber(value), JsonNumber(limit));
        let kind = kind.to_string();
        WarningFacts { step, kind, at, value, limit, message }
    };
    warnings.iter().map(row).collect()
}

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
