//! The table `[growth]`.

use ppum::formula::Scope;

use super::super::document::Section;
use super::super::growth::{Criterion, GrowthRule, LoadControl, Paris};

const KEYS: [&str; 6] = ["criterion", "increment", "steps", "toughness", "load", "paris"];

const PARIS_KEYS: [&str; 4] = ["c", "m", "threshold", "ratio"];

const CRITERIA: [(&str, Criterion); 3] = [
    ("hoop", Criterion::Hoop),
    ("local-symmetry", Criterion::LocalSymmetry),
    ("energy", Criterion::Energy),
];

const LOADS: [(&str, LoadControl); 2] =
    [("constant", LoadControl::Constant), ("critical", LoadControl::Critical)];

/// The table. Values that are wrong are reported, and left at their defaults.
pub(super) fn growth(root: &Section<'_>, scope: &Scope) -> Option<GrowthRule> {
    let section = root.section("growth")?.only(&KEYS, &[]);
    let steps = section.require("steps", "steps = 20").and_then(|value| value.whole());
    let default = GrowthRule::new(steps.map_or(1, |n| n as usize));
    let choice = |key| section.get(key);
    Some(GrowthRule {
        criterion: choice("criterion").and_then(|v| v.choice(&CRITERIA)).unwrap_or_default(),
        load: choice("load").and_then(|v| v.choice(&LOADS)).unwrap_or_default(),
        increment: section.get("increment").and_then(|value| value.constant()),
        toughness: section.get("toughness").and_then(|value| value.expression(scope)),
        paris: section.section("paris").and_then(|section| paris(&section.only(&PARIS_KEYS, &[]))),
        ..default
    })
}

fn paris(section: &Section<'_>) -> Option<Paris> {
    let number = |key| section.get(key)?.constant();
    let c = section.require("c", "c = 1e-10").and_then(|value| value.constant());
    let m = section.require("m", "m = 3").and_then(|value| value.constant());
    let plain = Paris::new(c?, m?);
    Some(Paris {
        threshold: number("threshold").unwrap_or(plain.threshold),
        ratio: number("ratio").unwrap_or(plain.ratio),
        ..plain
    })
}
