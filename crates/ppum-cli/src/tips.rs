//! Stress intensity factors as `solve`, `info` and `sif` show them.

use std::io::{self, Write};

use ppum::text::LocationText;
use ppum_scene::facts::{HEADS, MEANING, Tip};

use crate::number::columns;

/// A table, one line per tip; tips are numbered in each step. The one of K_I and K_II that is
/// rounding of the other is shown as zero.
pub(crate) fn table(out: &mut dyn Write, tips: &[Tip], places: &LocationText) -> io::Result<()> {
    let has_steps = tips.iter().any(|tip| tip.step != tips[0].step);
    let heads = ["step", "tip", "crack", "position"].into_iter().chain(HEADS).map(str::to_owned);
    let row = |(number, tip): (usize, &Tip)| {
        let numbers = [tip.step, number, tip.crack as usize].map(|n| n.to_string());
        numbers.into_iter().chain([places.show(tip.at.into())]).chain(tip.words()).collect()
    };
    let steps = tips.chunk_by(|a, b| a.step == b.step);
    let rows = steps.flat_map(|tips| tips.iter().enumerate().map(row));
    let mut lines: Vec<Vec<String>> = [heads.collect()].into_iter().chain(rows).collect();
    if !has_steps {
        lines.iter_mut().for_each(|line| drop(line.remove(0)));
    }
    columns(out, &lines, false)?;
    if tips.is_empty() { Ok(()) } else { writeln!(out, "{MEANING}") }
}
