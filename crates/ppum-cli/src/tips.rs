//! Stress intensity factors as `solve`, `info` and `sif` show them.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::io::{self, Write};

use anyhow::{Context as _, ensure};
use ppum::crack::{TipId, tips};
use ppum::dataset::{Dataset, Ring, TipIntensity};
use ppum::field::Field;
use ppum::text::{Places, beside, short};
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
        let TipIntensity { tip, k1, k2, t_stress, j, error, rings } = intensity;
        let crack = &dataset.steps[index].cracks[tip.crack as usize];
        let axis = crack.growth_direction(tip.end);
        let at = crack.end_point(tip.end);
        let elastic = dataset.equation.elastic();
        let known = |value: Option<f64>| Number(value.unwrap_or(f64::NAN));
        Self {
            step: index,
            crack: tip.crack,
            tip: at.into(),
            angle: axis.y.atan2(axis.x),
            k1: Number(*k1),
            k2: Number(*k2),
            t_stress: known(*t_stress),
            j: known(*j),
            g: known(elastic.map(|body| intensity.energy_release(&body.at(at)))),
            growth_angle: known(intensity.growth_angle()),
            error: known(*error),
            spread: Number(intensity.spread()),
            rings: rings.iter().map(RingRow::new).collect(),
        }
    }

    /// The same tip of the step of another number.
    pub(crate) fn of_step(self, step: usize) -> Self {
        Self { step, ..self }
    }

    /// The words of a line of the table; what is not known is a dash.
    fn words(&self, places: &Places) -> Vec<String> {
        let [k1, k2, spread] = words(self.k1.0, self.k2.0, self.spread.0);
        let number = |value: f64| if value.is_nan() { DASH.into() } else { short(value) };
        let angle = match self.growth_angle.0 {
            angle if angle.is_nan() => DASH.into(),
            // zero has no sign
            angle => format!("{:.1}°", (10.0 * angle.to_degrees()).round() / 10.0 + 0.0),
        };
        // where T is zero, it is found as rounding of the stresses in the disc
        let size = self.k1.0.hypot(self.k2.0) / self.reach().sqrt();
        let part = |part: f64| match part {
            part if part.is_finite() => format!("{part:.0e}"),
            _ => DASH.into(),
        };
        let error = part(self.error.0 / self.k1.0.hypot(self.k2.0));
        let check = part((self.j.0 / self.g.0 - 1.0).abs());
        let t_stress = number(beside(self.t_stress.0, size));
        let at = places.show(Vec2::from(self.tip));
        vec![at, k1, k2, t_stress, number(self.g.0), angle, error, spread, check]
    }

    /// Radius of the largest disc.
    fn reach(&self) -> f64 {
        self.rings.iter().map(|ring| ring.r2).fold(f64::NAN, f64::max)
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
    tips(&step.cracks).map(tip).collect()
}

const DASH: &str = "–";

/// Heads of the columns after the numbers of tip and crack.
const HEADS: [&str; 9] = ["position", "K_I", "K_II", "T", "G", "angle", "error", "spread", "J/G-1"];

/// What they mean.
const MEANING: &str =
    "angle: of growth (hoop stress); error: of K, estimated, relative; spread, J/G-1: checks alone";

/// A table, one line per tip; tips are numbered in each step. The one of K_I and K_II that is rounding of the other
/// is shown as zero.
pub(crate) fn table(out: &mut dyn Write, tips: &[Tip], places: &Places) -> io::Result<()> {
    let has_steps = tips.iter().any(|tip| tip.step != tips[0].step);
    let step = |text: &dyn Display| if has_steps { format!("{text:>4}  ") } else { String::new() };
    let rows: Vec<Vec<String>> = tips.iter().map(|tip| tip.words(places)).collect();
    let width = |k: usize| {
        let words = rows.iter().map(|row| row[k].chars().count());
        words.fold(HEADS[k].len(), usize::max)
    };
    let widths: Vec<usize> = (0..HEADS.len()).map(width).collect();
    let line = |words: &mut dyn Iterator<Item = &str>| -> String {
        words.zip(&widths).map(|(word, &width)| format!("  {word:>width$}")).collect()
    };
    writeln!(out, "{}tip  crack{}", step(&"step"), line(&mut HEADS.into_iter()))?;
    let mut number = 0;
    for (k, (tip, row)) in tips.iter().zip(&rows).enumerate() {
        number = if k > 0 && tips[k - 1].step == tip.step { number + 1 } else { 0 };
        let row = line(&mut row.iter().map(String::as_str));
        writeln!(out, "{}{number:>3}  {:>5}{row}", step(&tip.step), tip.crack)?;
    }
    if tips.is_empty() { Ok(()) } else { writeln!(out, "{MEANING}") }
}
