//! Rules for what the tips of a step do next.

use std::collections::BTreeSet;

use super::{Checked, fail};
use crate::crack::tips;
use crate::dataset::Step;
use crate::growth::Advance;

/// The rows belong to tips of the step, each to another; lengths are none or positive, everything but strengths is finite.
pub(super) fn check_growth(step: &Step) -> Checked {
    let Some(growth) = &step.growth else { return Ok(()) };
    if growth.cycles.is_some_and(|cycles| !(cycles >= 0.0 && cycles.is_finite())) {
        return fail("growth.cycles", "must be a number, not negative".into());
    }
    let known: BTreeSet<_> = tips(&step.cracks).collect();
    let mut seen = BTreeSet::new();
    for (k, row) in growth.tips.iter().enumerate() {
        let place = format!("growth.tips[{k}]");
        if !known.contains(&row.tip) {
            return fail(&place, "is of no tip of the step".into());
        }
        if !seen.insert(row.tip) {
            return fail(&place, "is of the same tip as one before; keep one".into());
        }
        check_row(row).map_err(|e| e.inside(&place))?;
    }
    Ok(())
}

fn check_row(row: &Advance) -> Checked {
    if row.strength.is_infinite() {
        return fail("strength", "must be finite, or NaN where there is none".into());
    }
    for (name, value) in [("direction", row.direction), ("curvature", row.curvature)] {
        if !value.is_finite() {
            return fail(name, "must be finite".into());
        }
    }
    for (name, value) in [("length", row.length), ("due", row.due), ("extension", row.extension)] {
        if !(value >= 0.0 && value.is_finite()) {
            return fail(name, "must be a number, not negative".into());
        }
    }
    if row.path.iter().any(|p| !p.is_finite()) {
        return fail("path", "must be finite".into());
    }
    if row.fate.goes_on() == row.path.is_empty() {
        return fail(
            "path",
            "must have vertices of a tip that goes on, and none of one that stays".into(),
        );
    }
    if row.fate.goes_on() != (row.length > 0.0) {
        return fail(
            "length",
            "must be positive of a tip that goes on, and zero of one that stays".into(),
        );
    }
    Ok(())
}
