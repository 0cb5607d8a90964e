//! Stress intensity factors as `solve`, `info` and `sif` show them.

use std::fmt::Display;
use std::io::{self, Write};

use anyhow::{Context as _, ensure};
use ppum::crack::{TipId, tips};
use ppum::dataset::{Ring, Step, TipIntensity};
use ppum::field::Field;
use ppum::text::Places;
use ppum::vec2::Vec2;
use ppum_scene::tips::words;
use serde::Serialize;

use crate::number::{Number, count};

/// The tip of a number that was given as `--tip`.
pub(crate) fn numbered(field: &Field<'_>, number: usize) -> anyhow::Result<TipId> {
    let cracks = &field.step.cracks;
    let n_tips = tips(cracks).count();
    ensure!(n_tips > 0, "--tip {number}: the dataset has no crack tips");
    tips(cracks).nth(number).with_context(|| {
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
    /// Largest relative difference of two rings: no estimate of the error.
    spread: Number,
    rings: Vec<RingRow>,
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
    pub(crate) fn without_factors(index: usize, step: &Step, tip: TipId) -> Self {
        let none = TipIntensity { tip, k1: f64::NAN, k2: f64::NAN, rings: Vec::new() };
        Self::new(index, step, &none)
    }

    /// The intensities of a tip of step number `index`.
    pub(crate) fn new(index: usize, step: &Step, intensity: &TipIntensity) -> Self {
        let TipIntensity { tip, k1, k2, rings } = intensity;
        let crack = &step.cracks[tip.crack as usize];
        let axis = crack.growth_direction(tip.end);
        Self {
            step: index,
            crack: tip.crack,
            tip: crack.end_point(tip.end).into(),
            angle: axis.y.atan2(axis.x),
            k1: Number(*k1),
            k2: Number(*k2),
            spread: Number(intensity.spread()),
            rings: rings.iter().map(RingRow::new).collect(),
        }
    }
}

impl RingRow {
    fn new(ring: &Ring) -> Self {
        Self { r1: ring.r1, r2: ring.r2, k1: Number(ring.k1), k2: Number(ring.k2) }
    }
}

/// The tips of step number `index` with the factors that are stored, and those that have none.
pub(crate) fn all_tips(index: usize, step: &Step) -> Vec<Tip> {
    let tip = |tip: TipId| match step.intensities.iter().find(|known| known.tip == tip) {
        Some(factors) => Tip::new(index, step, factors),
        None => Tip::without_factors(index, step, tip),
    };
    tips(&step.cracks).map(tip).collect()
}

/// A table, one line per tip; tips are numbered in each step. The one of K_I and K_II that is rounding of the other
/// is shown as zero.
pub(crate) fn table(out: &mut dyn Write, tips: &[Tip], places: &Places) -> io::Result<()> {
    let has_steps = tips.iter().any(|tip| tip.step != tips[0].step);
    let step = |text: &dyn Display| if has_steps { format!("{text:>4}  ") } else { String::new() };
    let head = format!("{:>24}  {:>12}  {:>12}  {:>7}", "position", "K_I", "K_II", "spread");
    writeln!(out, "{}tip  crack  {head}", step(&"step"))?;
    for group in tips.chunk_by(|a, b| a.step == b.step) {
        for (number, tip) in group.iter().enumerate() {
            let Tip { crack, tip: at, spread, .. } = tip;
            let [k1, k2, spread] = words(tip.k1.0, tip.k2.0, spread.0);
            let at = places.show(Vec2::from(*at));
            let row = format!("{at:>24}  {k1:>12}  {k2:>12}  {spread:>7}");
            writeln!(out, "{}{number:>3}  {crack:>5}  {row}", step(&tip.step))?;
        }
    }
    if !tips.is_empty() {
        writeln!(
            out,
            "spread: relative difference between three radii, a check and no estimate of the error"
        )?;
    }
    Ok(())
}
