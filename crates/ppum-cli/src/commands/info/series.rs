//! The steps of a series in a table.

use std::io::{self, Write};

use ppum::crack::{Crack, TipId};
use ppum::dataset::{Step, TipIntensity};
use ppum::text::{short, trimmed};
use serde::Serialize;

use crate::number::{Number, count};

/// A step, as far as its solver tells of it.
#[derive(Debug, Serialize)]
pub(super) struct StepRow {
    step: usize,
    load: f64,
    /// Of the solver's report; NaN if that has none.
    unknowns: Number,
    /// Length of all cracks.
    crack_length: f64,
    tips: Vec<TipRow>,
}

#[derive(Debug, Serialize)]
struct TipRow {
    crack: u32,
    end: &'static str,
    k1: Number,
    k2: Number,
}

impl StepRow {
    pub(super) fn new(number: usize, step: &Step) -> Self {
        Self {
            step: number,
            load: step.load,
            unknowns: Number(step.record("unknowns").unwrap_or(f64::NAN)),
            crack_length: step.cracks.iter().map(Crack::length).sum(),
            tips: step.intensities.iter().map(TipRow::new).collect(),
        }
    }

    fn words(&self) -> Vec<String> {
        let number = |value: f64| if value.is_nan() { "–".into() } else { short(value) };
        let unknowns = match self.unknowns.0 {
            n if n.is_nan() => "–".into(),
            n => trimmed(n),
        };
        let first =
            [self.step.to_string(), trimmed(self.load), unknowns, number(self.crack_length)];
        let tips = self.tips.iter().take(TIPS).flat_map(|tip| [tip.k1.0, tip.k2.0].map(number));
        first.into_iter().chain(tips).collect()
    }
}

impl TipRow {
    fn new(intensity: &TipIntensity) -> Self {
        let TipIntensity { tip: TipId { crack, end }, k1, k2, .. } = intensity;
        Self { crack: *crack, end: end.name(), k1: Number(*k1), k2: Number(*k2) }
    }
}

/// Tips that a line of the table has room for: two of an inner crack, two of another one.
const TIPS: usize = 4;

/// A line for each step: load, unknowns, length of all cracks, K_I and K_II of the first tips.
pub(super) fn table(out: &mut dyn Write, rows: &[StepRow]) -> io::Result<()> {
    let tips = rows.iter().map(|row| row.tips.len()).max().unwrap_or(0);
    let heads = ["step", "load", "unknowns", "length"].map(str::to_owned);
    let of_tip = |tip: usize| match tips {
        1 => ["K_I".to_owned(), "K_II".to_owned()],
        _ => [format!("K_I {tip}"), format!("K_II {tip}")],
    };
    let heads: Vec<_> = heads.into_iter().chain((0..tips.min(TIPS)).flat_map(of_tip)).collect();
    let lines: Vec<_> = [heads].into_iter().chain(rows.iter().map(StepRow::words)).collect();
    let width = |column: usize| {
        let words = lines.iter().filter_map(|line| line.get(column));
        words.map(|word| word.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<_> = (0..lines[0].len()).map(width).collect();
    for line in &lines {
        let words = line.iter().zip(&widths).map(|(word, &width)| format!("{word:>width$}"));
        writeln!(out, "{}", words.collect::<Vec<_>>().join("  "))?;
    }
    if tips > TIPS {
        let more = count(tips - TIPS, "tip", "tips");
        writeln!(out, "and {more} more, see `ppum sif` or --json")?;
    }
    Ok(())
}
