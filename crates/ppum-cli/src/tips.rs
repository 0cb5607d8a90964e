//! Stress intensity factors as `solve`, `info` and `sif` show them.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::io::{self, Write};

use anyhow::{Context as _, ensure};
use ppum::crack::{TipId, tips as tips_of};
use ppum::dataset::{Dataset, Ring, TipIntensity};
use ppum::field::Field;
use ppum::text::Places;
use ppum::vec2::Vec2;
use ppum_scene::tips::{self, HEADS, MEANING};
use serde::Serialize;

use crate::number::{Number, count};

/// The tip of a number that was given as `--tip`.
pub(crate) fn numbered(field: &Field<'_>, number: usize) -> anyhow::Result<TipId> {
    let cracks = &field.step.cracks;
    let n_tips = tips_of(cracks).count();
    ensure!(n_tips > 0, "--tip {number}: the dataset has no crack tips");
    tips_of(cracks).nth(number).with_context(|| {
        format!("--tip {number}: the dataset has {}, numbered from 0", count(n_tips, "tip", "tips"))
    })
}

/// The stress intensity factors at a tip.
#[derive(Debug, Serialize)]
pub(crate) struct Tip {
    step: usize,
    crack: u32,
    tip: [f64; 2],
    /// Direction of growth, radians.
    angle: f64,
    k1: Number,
    k2: Number,
    t_stress: Number,
    j: Number,
    /// (K_I² + K_II²) / E′ with the material at the tip.
    g: Number,
    /// Direction of the largest hoop stress, radians from `angle`.
    growth_angle: Number,
    /// Estimated error of (K_I, K_II).
    error: Number,
    /// Largest relative difference of two rings: no estimate of the error.
    spread: Number,
    rings: Vec<RingRow>,
    #[serde(skip)]
    words: [String; 8],
}

#[derive(Debug, Serialize)]
struct RingRow {
    r1: f64,
    r2: f64,
    k1: Number,
    k2: Number,
}

impl Tip {
    /// A tip of step number `index` that has no factors.
    pub(crate) fn without_factors(dataset: &Dataset, index: usize, tip: TipId) -> Self {
        Self::new(dataset, index, &TipIntensity::new(tip, f64::NAN, f64::NAN))
    }

    /// The intensities of a tip of step number `index`.
    pub(crate) fn new(dataset: &Dataset, index: usize, intensity: &TipIntensity) -> Self {
        let tip = tips::Tip::new(dataset, &dataset.steps[index], intensity.tip, Some(intensity));
        Self {
            step: index,
            crack: tip.id.crack,
            tip: tip.at.into(),
            angle: tip.angle,
            k1: Number(tip.k1),
            k2: Number(tip.k2),
            t_stress: Number(tip.t_stress),
            j: Number(tip.j),
            g: Number(tip.g),
            growth_angle: Number(tip.growth_angle),
            error: Number(intensity.error.unwrap_or(f64::NAN)),
            spread: Number(tip.spread),
            rings: intensity.rings.iter().map(RingRow::new).collect(),
            words: tip.words(),
        }
    }

    /// The number of its step.
    pub(crate) fn step(&self) -> usize {
        self.step
    }

    /// The same tip of the step of another number.
    pub(crate) fn of_step(self, step: usize) -> Self {
        Self { step, ..self }
    }
}

impl RingRow {
    fn new(ring: &Ring) -> Self {
        Self { r1: ring.r1, r2: ring.r2, k1: Number(ring.k1), k2: Number(ring.k2) }
    }
}

/// The tips of step number `index` with the factors that are stored, and those that have none.
pub(crate) fn all_tips(dataset: &Dataset, index: usize) -> Vec<Tip> {
    let step = &dataset.steps[index];
    // of several factors of a tip the first ones count
    let stored = step.intensities.iter().rev();
    let known: BTreeMap<TipId, &TipIntensity> = stored.map(|known| (known.tip, known)).collect();
    let tip = |tip: TipId| match known.get(&tip) {
        Some(factors) => Tip::new(dataset, index, factors),
        None => Tip::without_factors(dataset, index, tip),
    };
    tips_of(&step.cracks).map(tip).collect()
}

/// A table, one line per tip; tips are numbered in each step. The one of K_I and K_II that is rounding of the other
/// is shown as zero.
pub(crate) fn table(out: &mut dyn Write, tips: &[Tip], places: &Places) -> io::Result<()> {
    let has_steps = tips.iter().any(|tip| tip.step != tips[0].step);
    let step = |text: &dyn Display| if has_steps { format!("{text:>4}  ") } else { String::new() };
    let heads: Vec<&str> = ["position"].into_iter().chain(HEADS).collect();
    let row = |tip: &Tip| {
        [places.show(Vec2::from(tip.tip))].into_iter().chain(tip.words.clone()).collect()
    };
    let rows: Vec<Vec<String>> = tips.iter().map(row).collect();
    let width = |k: usize| {
        let words = rows.iter().map(|row| row[k].chars().count());
        words.fold(heads[k].len(), usize::max)
    };
    let widths: Vec<usize> = (0..heads.len()).map(width).collect();
    let line = |words: &mut dyn Iterator<Item = &str>| -> String {
        words.zip(&widths).map(|(word, &width)| format!("  {word:>width$}")).collect()
    };
    writeln!(out, "{}tip  crack{}", step(&"step"), line(&mut heads.iter().copied()))?;
    let mut number = 0;
    for (k, (tip, row)) in tips.iter().zip(&rows).enumerate() {
        number = if k > 0 && tips[k - 1].step == tip.step { number + 1 } else { 0 };
        let row = line(&mut row.iter().map(String::as_str));
        writeln!(out, "{}{number:>3}  {:>5}{row}", step(&tip.step), tip.crack)?;
    }
    if tips.is_empty() { Ok(()) } else { writeln!(out, "{MEANING}") }
}
