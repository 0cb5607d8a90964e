//! Rules for what the tips of a step do next.

use std::collections::{BTreeMap, BTreeSet};

use super::errors::{CheckResult, Errors, fail, require};
use crate::crack::tips;
use crate::dataset::Step;
use crate::growth::TipIncrement;

/// The rows belong to tips of the step, each to another; lengths are none or positive, everything
/// but strengths is finite.
pub(super) fn check_growth(step: &Step, errors: &mut Errors) {
    let Some(growth) = &step.growth else { return };
    if growth.cycles.is_some_and(|cycles| !(cycles >= 0.0 && cycles.is_finite())) {
        errors.add(fail("growth.cycles", "must be a number, not negative".into()));
    }
    let known: BTreeSet<_> = tips(&step.cracks).collect();
    let first: BTreeMap<_, _> =
        growth.tips.iter().enumerate().map(|(k, row)| (row.tip, k)).rev().collect();
    errors.each("growth.tips", &growth.tips, |k, row| {
        if !known.contains(&row.tip) {
            return fail("", "is of no tip of the step".into());
        }
        if first[&row.tip] != k {
            return fail("", "is of the same tip as one before; keep one".into());
        }
        check_row(row)
    });
}

fn check_row(row: &TipIncrement) -> CheckResult {
    require(!row.k_eq.is_infinite(), "strength", || {
        "must be finite, or NaN where there is none".into()
    })?;
    for (name, value) in [("direction", row.direction), ("curvature", row.curvature)] {
        require(value.is_finite(), name, || "must be finite".into())?;
    }
    for (name, value) in [("length", row.length), ("due", row.due), ("extension", row.extension)] {
        require(value >= 0.0 && value.is_finite(), name, || {
            "must be a number, not negative".into()
        })?;
    }
    require(row.path.iter().all(|p| p.is_finite()), "path", || "must be finite".into())?;
    let goes_on = row.fate.goes_on();
    require(goes_on != row.path.is_empty(), "path", || {
        "must have vertices of a tip that goes on, and none of one that stays".into()
    })?;
    require(goes_on == (row.length > 0.0), "length", || {
        "must be positive of a tip that goes on, and zero of one that stays".into()
    })
}
