//! The table `[adaptivity]`.

use super::super::adaptivity::{AdaptKind, Adaptivity, Keep};
use super::super::document::Section;

const KEYS: [&str; 6] = ["steps", "fraction", "max_unknowns", "tolerance", "kind", "keep"];

const KINDS: [(&str, AdaptKind); 3] =
    [("h", AdaptKind::H), ("p", AdaptKind::P), ("hp", AdaptKind::Hp)];

const KEEPS: [(&str, Keep); 2] = [("last", Keep::Last), ("all", Keep::All)];

/// The table, or its defaults for the accuracy that `[discretization]` asks for. Values that are
/// wrong are reported, and left at their defaults.
pub(super) fn adaptivity(root: &Section<'_>) -> Option<Adaptivity> {
    let asked = root.section("discretization").and_then(|section| section.get("accuracy"));
    let accuracy = asked.and_then(|value| value.number());
    let default = accuracy.map_or_else(Adaptivity::default, Adaptivity::to);
    if !root.mentions("adaptivity") {
        return accuracy.map(|_| default);
    }
    let section = root.section("adaptivity")?.only(&KEYS, &[]);
    let number = |key| section.get(key)?.number();
    let whole = |key| section.get(key)?.whole().map(|n| n as usize);
    Some(Adaptivity {
        steps: whole("steps").unwrap_or(default.steps),
        fraction: number("fraction").unwrap_or(default.fraction),
        max_unknowns: whole("max_unknowns").unwrap_or(default.max_unknowns),
        tolerance: number("tolerance"),
        accuracy,
        kind: section.get("kind").and_then(|v| v.choice(&KINDS)).unwrap_or(default.kind),
        keep: section.get("keep").and_then(|v| v.choice(&KEEPS)).unwrap_or_default(),
    })
}
