//! The table `[discretization]`.

use ppum::library;
use ppum::text::nearest;
use ppum::weight::{WeightError, WeightFunction};

use crate::data::{Adaptivity, BaseCells, Discretization, PolynomialOrder, scopes};
use crate::file::{DocumentValue, FileSource, FromValue as _, Section, points};
use crate::read::enrichment::is_word;

/// Optional values that are wrong are reported, and left at their defaults.
pub(super) fn discretization(section: &Section<'_>) -> Option<Discretization> {
    let cells = cells(section);
    let default = Discretization::new(BaseCells::Level(0));
    let order = section.value("order").and_then(|value| match value.as_text() {
        Some(_) => section.get("order").map(PolynomialOrder::Formula),
        None => usize::read(&value).map(PolynomialOrder::Uniform),
    });
    let weight = section.value("weight").and_then(|value| weight(&value));
    let set = with_keys!(section, default, refine, overlap, enrichment, interfaces, tip_degree);
    let new = Discretization {
        order: order.unwrap_or(set.order),
        weight: weight.unwrap_or(set.weight),
        enrichment_radius: section.get("enrichment_radius"),
        tip_terms: section.get("tip_terms"),
        ..set
    };
    Some(Discretization { cells: cells?, ..new })
}

/// A B-spline, another weight of the library, or a formula of t.
fn weight(value: &DocumentValue<'_>) -> Option<WeightFunction> {
    let text = value.text()?;
    if let Some(spline) = WeightFunction::from_name(text) {
        return Some(spline);
    }
    let words = library::WEIGHTS.map(|entry| entry.name);
    let formula = match library::weight(text) {
        Some(entry) => entry.texts[0],
        None if is_word(text) && text != "t" => {
            let near = nearest(text, words.iter().copied())
                .map(|near| format!("; did you mean \"{near}\"?"));
            let (words, near) = (words.join(", "), near.unwrap_or_default());
            return value
                .error(&format!("cannot be \"{text}\", only {words}, or a formula of t{near}"));
        }
        None => text,
    };
    match WeightFunction::formula(formula, &scopes::weight(value.document.tables()).ok()?) {
        Ok(weight) => Some(weight),
        Err(WeightError::Formula(error)) => value.inside(text, Err(error)),
        Err(error) => value.error(&format!("cannot be used: {error}")),
    }
}

fn cells(section: &Section<'_>) -> Option<BaseCells> {
    let given = section.given(&["level", "cells", "points"]);
    match &given[..] {
        [("level", _)] => section.get("level").map(BaseCells::Level),
        [("cells", _)] => section.get("cells").map(BaseCells::Grid),
        [(_, points)] => match section.document.source {
            FileSource::Folder(folder) => {
                let found = points::read(&points.file(folder)?);
                found.map(BaseCells::Points).map_err(|errors| points.add(errors)).ok()
            }
            FileSource::Stored(dataset) => {
                let points = dataset.steps.first()?.partition.boxes().points.clone();
                // a temperature is solved for on the cells of its body, which may have none
                let is_other = section.document.heated.is_some() && points.is_empty();
                Some(if is_other { BaseCells::Level(0) } else { BaseCells::Points(points) })
            }
        },
        // the steps to an accuracy begin somewhere
        [] if section.mentions("accuracy") => {
            section.get("accuracy").map(Adaptivity::first_level).map(BaseCells::Level)
        }
        [] if section.mentions_any(&["level", "cells", "points"]) => None,
        [] => section.error("[discretization] has no cells; add e.g. `level = 5`"),
        [.., (_, last)] => {
            last.error("contradicts another key; give only one of `level`, `cells`, `points`")
        }
    }
}
