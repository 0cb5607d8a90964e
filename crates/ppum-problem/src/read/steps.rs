//! The tables `[adaptivity]`, `[growth]` and `[[refine]]`.

use ppum::vec2::{Rect, vec2};

use crate::data::{Adaptivity, GrowthRule, LocalRefinement, Paris, RefinementRegion};
use crate::file::Section;

/// The table, or its defaults for the accuracy that `[discretization]` asks for. Values that are
/// wrong are reported, and left at their defaults.
pub(super) fn adaptivity(root: &Section<'_>, accuracy: Option<f64>) -> Option<Adaptivity> {
    let default = accuracy.map_or_else(Adaptivity::default, Adaptivity::to);
    let Some(section) = root.section("adaptivity") else { return accuracy.map(|_| default) };
    let set = with_keys!(section, default, steps, fraction, max_unknowns, kind, keep);
    Some(Adaptivity { tolerance: section.get("tolerance"), ..set })
}

/// The table. Values that are wrong are reported, and left at their defaults.
pub(super) fn growth(section: &Section<'_>) -> GrowthRule {
    let rule = GrowthRule::new(section.require("steps").unwrap_or(1));
    GrowthRule {
        increment: section.get("increment"),
        toughness: section.get("toughness"),
        paris: section.section("paris").and_then(|section| paris(&section)),
        ..with_keys!(section, rule, criterion, load)
    }
}

fn paris(section: &Section<'_>) -> Option<Paris> {
    let (c, m) = (section.require("c"), section.require("m"));
    Some(with_keys!(section, Paris::new(c?, m?), threshold, ratio))
}

pub(super) fn refinement(section: &Section<'_>) -> Option<LocalRefinement> {
    let place = place(section);
    let (distance, size) = (section.or("distance", 0.0), section.require("size"));
    Some(LocalRefinement { place: place?, distance: distance?, size: size? })
}

fn place(section: &Section<'_>) -> Option<RefinementRegion> {
    let is_disc = |key: &str| ["center", "radius"].contains(&key);
    let mut given = section.given(&["box", "center", "radius", "hole", "crack"]);
    given.dedup_by(|b, a| is_disc(a.0) && is_disc(b.0));
    if let [_, (_, second), ..] = &given[..] {
        return second.error("names another place; write one [[refine]] for each");
    }
    if section.mentions_any(&["center", "radius"]) {
        let (center, radius) = (section.require("center"), section.require("radius"));
        return Some(RefinementRegion::Disc { center: center?, radius: radius? });
    }
    match given.first().map_or("", |(key, _)| key) {
        "box" => {
            let [x0, y0, x1, y1] = section.get("box")?;
            Some(RefinementRegion::Box(Rect::new(vec2(x0, y0), vec2(x1, y1))))
        }
        "hole" => section.get("hole").map(RefinementRegion::Hole),
        "crack" => section.get("crack").map(RefinementRegion::Crack),
        _ => Some(RefinementRegion::Plate),
    }
}
