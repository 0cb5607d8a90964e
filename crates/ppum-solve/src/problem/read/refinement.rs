//! The tables `[[refine]]`.

use std::sync::Arc;

use ppum::formula::Table;
use ppum::vec2::{Rect, vec2};

use super::super::document::{Section, Value};
use super::super::refinement::{LocalRefinement, RefinementRegion};
use super::super::scopes;
use super::all;

const KEYS: [&str; 7] = ["box", "center", "radius", "hole", "crack", "distance", "size"];

/// The refinements; none at all if one of them cannot be read, as the checks count them.
pub(super) fn refinements(root: &Section<'_>, tables: &[Arc<Table>]) -> Vec<LocalRefinement> {
    let read = |section: Section<'_>| refinement(&section.only(&KEYS, &[]), tables);
    all(root.sections("refine").into_iter().map(read)).unwrap_or_default()
}

fn refinement(section: &Section<'_>, tables: &[Arc<Table>]) -> Option<LocalRefinement> {
    let place = place(section);
    let distance = section.get("distance").map_or(Some(0.0), |value| value.constant());
    let scope = scopes::position(tables).ok()?;
    let size = section.require("size", "size = 0.01").and_then(|value| value.expression(&scope));
    Some(LocalRefinement { place: place?, distance: distance?, size: size? })
}

fn place(section: &Section<'_>) -> Option<RefinementRegion> {
    let round = section.get("center").or_else(|| section.get("radius"));
    let given = [section.get("box"), round, section.get("hole"), section.get("crack")];
    let mut given = given.iter().flatten();
    if let (Some(_), Some(second)) = (given.next(), given.next()) {
        return second.error("names another place; write one [[refine]] for each");
    }
    if let Some(value) = section.get("box") {
        return rect(&value).map(RefinementRegion::Box);
    }
    if let Some(hole) = section.get("hole") {
        return hole.whole().map(|hole| RefinementRegion::Hole(hole as usize));
    }
    if let Some(crack) = section.get("crack") {
        return crack.whole().map(|crack| RefinementRegion::Crack(crack as usize));
    }
    if section.mentions("center") || section.mentions("radius") {
        let center = section.require("center", "center = [0.0, 0.0]").and_then(|v| v.point());
        let radius = section.require("radius", "radius = 0.5").and_then(|v| v.constant());
        return Some(RefinementRegion::Disc { center: center?, radius: radius? });
    }
    Some(RefinementRegion::Plate)
}

fn rect(value: &Value<'_>) -> Option<Rect> {
    let numbers = value.array::<4>("four numbers [x0, y0, x1, y1]")?;
    let [x0, y0, x1, y1] = numbers.map(|number| number.constant());
    Some(Rect::new(vec2(x0?, y0?), vec2(x1?, y1?)))
}
