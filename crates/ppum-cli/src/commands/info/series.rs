//! The steps of a series in a table.

use std::io::{self, Write};

use ppum::crack::{Crack, TipId};
use ppum::dataset::{Step, TipIntensity};
use ppum::text::{short, trimmed};
use ppum_scene::facts::{GrowthFacts, increment};
use serde::Serialize;

use crate::number::{JsonNumber, columns, count};

/// A step, as far as its solver tells of it.
#[derive(Debug, Serialize)]
pub(super) struct SeriesStepRow {
    step: usize,
    load: f64,
    /// Unknowns from the solver's report; NaN if that has none.
    unknowns: JsonNumber,
    /// Length of all cracks.
    crack_length: f64,
    tips: Vec<SeriesTipRow>,
    /// The next growth of the tips, in a series of cracks that grow.
    growth: Option<GrowthFacts>,
    /// The lines of the tips for people, in such a series.
    #[serde(skip)]
    grown: Vec<Vec<String>>,
}

#[derive(Debug, Serialize)]
struct SeriesTipRow {
    crack: u32,
    end: &'static str,
    k1: JsonNumber,
    k2: JsonNumber,
    /// Small along a path that its increments resolve; NaN where K_I is within its error of zero.
    k2_over_k1: JsonNumber,
}

impl SeriesStepRow {
    pub(super) fn new(number: usize, step: &Step) -> Self {
        Self {
            step: number,
            load: step.load,
            unknowns: JsonNumber(step.record("unknowns").unwrap_or(f64::NAN)),
            crack_length: step.cracks.iter().map(Crack::length).sum(),
            tips: step.intensities.iter().map(SeriesTipRow::new).collect(),
            growth: step.growth.as_ref().map(GrowthFacts::new),
            grown: grown(step),
        }
    }

    /// Step, load, unknowns and length.
    fn first_words(&self) -> Vec<String> {
        let unknowns = match self.unknowns.0 {
            n if n.is_nan() => "–".into(),
            n => trimmed(n),
        };
        vec![self.step.to_string(), trimmed(self.load), unknowns, number(self.crack_length)]
    }

    fn words(&self) -> Vec<String> {
        let tips = self.tips.iter().take(TIPS).flat_map(|tip| [tip.k1.0, tip.k2.0].map(number));
        self.first_words().into_iter().chain(tips).collect()
    }

    /// The lines of a step of cracks that grow: what is of the step stands in the first.
    fn grown_words(&self, has_cycles: bool) -> Vec<Vec<String>> {
        let mut first = self.first_words();
        let cycles = self.growth.as_ref().and_then(|growth| growth.cycles);
        if has_cycles {
            first.insert(2, cycles.map_or_else(|| "–".into(), short));
        }
        let blank = vec![String::new(); first.len()];
        let tips = self.grown.iter().take(GROWING).enumerate();
        let mut lines: Vec<_> = tips
            .map(
                |(k, tip)| {
                    if k == 0 { [&first[..], tip].concat() } else { [&blank[..], tip].concat() }
                },
            )
            .collect();
        if lines.is_empty() {
            lines.push(first);
        }
        lines
    }
}

impl SeriesTipRow {
    fn new(intensity: &TipIntensity) -> Self {
        let TipIntensity { tip: TipId { crack, end }, k1, k2, .. } = intensity;
        let k2_over_k1 = JsonNumber(ratio(intensity));
        Self {
            crack: *crack,
            end: end.name(),
            k1: JsonNumber(*k1),
            k2: JsonNumber(*k2),
            k2_over_k1,
        }
    }
}

/// K_II / K_I of a tip; NaN where K_I is within its error of zero, as where faces are closed.
fn ratio(&TipIntensity { k1, k2, error, .. }: &TipIntensity) -> f64 {
    if k1 > error.unwrap_or(0.0) { k2 / k1 } else { f64::NAN }
}

fn number(value: f64) -> String {
    if value.is_nan() { "–".into() } else { short(value) }
}

/// Returns the name, factors and their ratio, extension and status of each tip.
fn grown(step: &Step) -> Vec<Vec<String>> {
    let rows = step.growth.iter().flat_map(|growth| &growth.tips);
    let line = |row: &ppum::dataset::TipIncrement| {
        let factors = step.intensities.iter().find(|found| found.tip == row.tip);
        let [k1, k2] = factors.map_or([f64::NAN; 2], |found| [found.k1, found.k2]).map(number);
        let ratio = match factors.map_or(f64::NAN, ratio) {
            ratio if ratio.is_nan() => "–".into(),
            ratio => format!("{ratio:.4}"),
        };
        let tip = format!("{} {}", row.tip.crack, row.tip.end.name());
        vec![tip, k1, k2, ratio, short(row.extension), increment(row)]
    };
    rows.map(line).collect()
}

/// Tips that a line of the table has room for: two of an inner crack, two of another one.
const TIPS: usize = 4;

/// Lines of tips that grow for each step: a dozen cracks.
const GROWING: usize = 24;

/// The steps: load, unknowns, length of all cracks, K_I and K_II of the first tips. For cracks that
/// grow, each tip has a line with its next increment.
pub(super) fn table(out: &mut dyn Write, rows: &[SeriesStepRow]) -> io::Result<()> {
    if rows.iter().any(|row| row.growth.is_some()) {
        return table_of_growth(out, rows);
    }
    let tips = rows.iter().map(|row| row.tips.len()).max().unwrap_or(0);
    let heads = ["step", "load", "unknowns", "length"].map(str::to_owned);
    let of_tip = |tip: usize| match tips {
        1 => ["K_I".to_owned(), "K_II".to_owned()],
        _ => [format!("K_I {tip}"), format!("K_II {tip}")],
    };
    let heads: Vec<_> = heads.into_iter().chain((0..tips.min(TIPS)).flat_map(of_tip)).collect();
    let lines: Vec<_> = [heads].into_iter().chain(rows.iter().map(SeriesStepRow::words)).collect();
    columns(out, &lines, false)?;
    and_more(out, tips, TIPS)
}

fn table_of_growth(out: &mut dyn Write, rows: &[SeriesStepRow]) -> io::Result<()> {
    let has_cycles = rows.iter().flat_map(|row| &row.growth).any(|g| g.cycles.is_some());
    let cycles = has_cycles.then_some("cycles");
    let heads = ["step", "load"].into_iter().chain(cycles);
    let heads =
        heads.chain(["unknowns", "length", "tip", "K_I", "K_II", "K_II/K_I", "grown by", "next"]);
    let heads: Vec<_> = heads.map(str::to_owned).collect();
    let steps = rows.iter().flat_map(|row| row.grown_words(has_cycles));
    columns(out, &[heads].into_iter().chain(steps).collect::<Vec<_>>(), true)?;
    and_more(out, rows.iter().map(|row| row.grown.len()).max().unwrap_or(0), GROWING)?;
    let Some(last) = rows.last() else { return Ok(()) };
    match last.growth.as_ref().and_then(|growth| growth.stop) {
        Some(stop) => writeln!(out, "ended with step {}: {stop}", last.step),
        None => writeln!(
            out,
            "not ended by itself: all increments are made, or the run was interrupted"
        ),
    }
}

fn and_more(out: &mut dyn Write, tips: usize, told: usize) -> io::Result<()> {
    if tips > told {
        let more = count(tips - told, "tip", "tips");
        writeln!(out, "and {more} more, see `ppum sif` or --json")?;
    }
    Ok(())
}
