//! The table `[discretization]`.

use std::path::Path;
use std::sync::Arc;

use ppum::formula::{Scope, Table};
use ppum::library;
use ppum::weight::{WeightError, WeightFunction};

use super::super::adaptivity::Adaptivity;
use super::super::discretization::{Cells, Discretization, Enrichment, Order};
use super::super::document::{Section, Value, nearest};
use super::super::{points, scopes};
use super::Files;
use super::enrichment::is_word;

const KEYS: [&str; 13] = [
    "level",
    "cells",
    "points",
    "refine",
    "order",
    "overlap",
    "weight",
    "enrichment",
    "interfaces",
    "enrichment_radius",
    "tip_degree",
    "tip_terms",
    "accuracy",
];

/// Optional values that are wrong are reported, and left at their defaults.
pub(super) fn discretization(
    root: &Section<'_>,
    files: Files<'_>,
    tables: &[Arc<Table>],
) -> Option<Discretization> {
    if !root.mentions("discretization") {
        root.error("the table [discretization] is missing; add it with e.g. `level = 5`");
    }
    let section = root.section("discretization")?.only(&KEYS, &[]);
    let cells = cells(&section, files);
    let mut new = Discretization::new(Cells::Level(0));
    let scope = scopes::position(tables).ok()?;
    let enrichments = Enrichment::ALL.map(|enrichment| (enrichment.name(), enrichment));
    let get = |key| section.get(key);
    let number = |key| get(key).and_then(|value| value.number());
    let whole = |key| get(key).and_then(|value| value.whole());
    replace(&mut new.refine, get("refine").and_then(|value| value.boolean()));
    replace(&mut new.order, get("order").and_then(|value| order(&value, &scope)));
    replace(&mut new.overlap, number("overlap"));
    replace(&mut new.weight, get("weight").and_then(|value| weight(&value, tables)));
    replace(&mut new.enrichment, get("enrichment").and_then(|value| value.choice(&enrichments)));
    replace(&mut new.interfaces, get("interfaces").and_then(|value| value.boolean()));
    new.enrichment_radius = number("enrichment_radius");
    replace(&mut new.tip_degree, whole("tip_degree").map(|degree| degree as usize));
    new.tip_terms = whole("tip_terms").map(|terms| terms as usize);
    Some(Discretization { cells: cells?, ..new })
}

fn replace<T>(place: &mut T, value: Option<T>) {
    if let Some(value) = value {
        *place = value;
    }
}

fn order(value: &Value<'_>, scope: &Scope) -> Option<Order> {
    match value.as_text() {
        Some(_) => value.expression(scope).map(Order::Formula),
        None => value.whole().map(|order| Order::Uniform(order as usize)),
    }
}

/// A B-spline, another weight of the library, or a formula of t.
fn weight(value: &Value<'_>, tables: &[Arc<Table>]) -> Option<WeightFunction> {
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
    match WeightFunction::formula(formula, &scopes::weight(tables).ok()?) {
        Ok(weight) => Some(weight),
        Err(WeightError::Formula(error)) => value.inside(text, Err(error)),
        Err(error) => value.error(&format!("cannot be used: {error}")),
    }
}

fn cells(section: &Section<'_>, files: Files<'_>) -> Option<Cells> {
    let given = ["level", "cells", "points"].map(|key| section.get(key));
    match &given {
        [Some(level), None, None] => level.whole().map(Cells::Level),
        [None, Some(cells), None] => {
            let [nx, ny] = cells.pair("two whole numbers [nx, ny]")?;
            let (nx, ny) = (nx.whole(), ny.whole());
            Some(Cells::Grid([nx?, ny?]))
        }
        [None, None, Some(points)] => match files {
            Files::In(folder) => point_file(points, folder),
            Files::Stored(dataset) => dataset
                .steps
                .first()
                .map(|step| Cells::Points(step.partition.boxes().points.clone())),
        },
        // the steps to an accuracy begin somewhere
        [None, None, None] if section.mentions("accuracy") => {
            let accuracy = section.get("accuracy")?.number()?;
            Some(Cells::Level(Adaptivity::first_level(accuracy)))
        }
        [None, None, None] => {
            if !["level", "cells", "points"].iter().any(|key| section.mentions(key)) {
                section.error("[discretization] has no cells; add e.g. `level = 5`");
            }
            None
        }
        _ => {
            let last = given.iter().flatten().next_back()?;
            last.error("contradicts another key; give only one of `level`, `cells`, `points`")
        }
    }
}

fn point_file(value: &Value<'_>, folder: &Path) -> Option<Cells> {
    let found = points::read(&value.file(folder)?);
    let report = |mistakes: Vec<_>| mistakes.into_iter().for_each(|mistake| value.add(mistake));
    found.map(Cells::Points).map_err(report).ok()
}
