//! Stress intensity factors as `solve`, `info` and `sif` show them.

use std::fmt::Display;
use std::io::{self, Write};

use ppum::dataset::{Ring, Step, TipIntensity};
use serde::Serialize;

use crate::number::{Number, point, short};

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
            spread: Number(spread(intensity)),
            rings: rings.iter().map(RingRow::new).collect(),
        }
    }
}

impl RingRow {
    fn new(ring: &Ring) -> Self {
        Self { r1: ring.r1, r2: ring.r2, k1: Number(ring.k1), k2: Number(ring.k2) }
    }
}

/// The largest difference of two rings, |ΔK| / |K| with K = (K_I, K_II) and the preferred ring's in
/// the denominator; NaN where that is zero, or without rings.
fn spread(intensity: &TipIntensity) -> f64 {
    let rings = &intensity.rings;
    let difference = |a: &Ring, b: &Ring| (a.k1 - b.k1).hypot(a.k2 - b.k2);
    let pairs = rings.iter().flat_map(|a| rings.iter().map(move |b| difference(a, b)));
    pairs.fold(f64::NAN, f64::max) / intensity.k1.hypot(intensity.k2)
}

/// Spread above which the factors of a tip are not to be trusted.
const LARGE_SPREAD: f64 = 0.01;

/// What a specialist would remark on, for standard error.
pub(crate) fn warnings(tips: &[Tip]) -> Vec<String> {
    let of_tip = |tip: &Tip| {
        let (at, k1, spread) = (point(tip.tip), tip.k1.0, tip.spread.0);
        let overlap = (k1 < 0.0).then(|| {
            format!("tip {at}: K_I < 0, the faces of the crack overlap and the solution has no meaning there")
        });
        let apart = (spread > LARGE_SPREAD).then(|| {
            format!(
                "tip {at}: the values at three radii differ by {:.0} %; use smaller cells there",
                100.0 * spread
            )
        });
        overlap.into_iter().chain(apart)
    };
    tips.iter().flat_map(of_tip).collect()
}

/// Writes the warnings of some tips to standard error.
pub(crate) fn warn(tips: &[Tip]) {
    for warning in warnings(tips) {
        eprintln!("warning: {warning}");
    }
}

/// A table, one line a tip; tips are numbered in each step.
pub(crate) fn table(out: &mut dyn Write, tips: &[Tip]) -> io::Result<()> {
    let has_steps = tips.iter().any(|tip| tip.step != tips[0].step);
    let step = |text: &dyn Display| if has_steps { format!("{text:>4}  ") } else { String::new() };
    let head = format!("{:>24}  {:>12}  {:>12}  {:>7}", "position", "K_I", "K_II", "spread");
    writeln!(out, "{}tip  crack  {head}", step(&"step"))?;
    for group in tips.chunk_by(|a, b| a.step == b.step) {
        for (number, tip) in group.iter().enumerate() {
            let Tip { crack, tip: at, spread, .. } = tip;
            let [k1, k2] = [tip.k1, tip.k2].map(|k| short(k.0));
            let spread = if spread.0.is_nan() { "–".into() } else { format!("{:.0e}", spread.0) };
            let row = format!("{:>24}  {k1:>12}  {k2:>12}  {spread:>7}", point(*at));
            writeln!(out, "{}{number:>3}  {crack:>5}  {row}", step(&tip.step))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use ppum::crack::{End, TipId};

    use super::*;

    #[test]
    fn the_spread_is_that_of_both_factors() {
        let ring = |k1, k2| Ring { r1: 0.0, r2: 1.0, k1, k2 };
        let tip = TipId { crack: 0, end: End::Start };
        let rings = vec![ring(3.0, 4.03), ring(3.04, 4.0), ring(3.0, 4.0)];
        let intensity = TipIntensity { tip, k1: 3.0, k2: 4.0, rings };
        assert!((spread(&intensity) - 0.01).abs() < 1e-15);
        assert!(spread(&TipIntensity { rings: Vec::new(), ..intensity }).is_nan());
    }

    #[test]
    fn overlap_and_spread_are_remarked_on() {
        let tip = |k1, spread| Tip {
            step: 0,
            crack: 0,
            tip: [0.5, 0.0],
            angle: 0.0,
            k1: Number(k1),
            k2: Number(0.0),
            spread: Number(spread),
            rings: Vec::new(),
        };
        assert_eq!(warnings(&[tip(1.0, 1e-3), tip(1.0, f64::NAN)]), [""; 0]);
        let found = warnings(&[tip(-1.0, 0.2)]);
        assert!(found[0].contains("overlap") && found[1].contains("20 %"), "{found:?}");
    }
}
