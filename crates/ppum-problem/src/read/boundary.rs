//! The tables `[[boundary]]`.

use ppum::border::touch;
use ppum::domain::Hole;
use ppum::expression::Expression;
use ppum::vec2::{Rect, Vec2, vec2};

use crate::data::{
    BoundaryCondition, BoundaryPart, Condition, ConditionPlace, DomainEdge, EquationKind, OUTLINE,
    Symmetry,
};
use crate::file::{DocumentValue, FromValue as _, Section, all, no_such};
use crate::read::body::BodyShape;

/// The conditions; none at all if one of them cannot be read, as the checks count them. `exact` is
/// the exact solution: empty if there is none, `None` if it cannot be read.
pub(super) fn boundary(
    root: &Section<'_>,
    kind: EquationKind,
    body: &mut BodyShape,
    exact: Option<&[Expression]>,
) -> Vec<BoundaryCondition> {
    root.each("boundary", |section| {
        let on = section.required("on").and_then(|value| part(&value, body));
        if section.mentions_any(&SPECIAL) {
            return special(&section, on, body);
        }
        let components = conditions(&section, kind, exact);
        let exchange = exchange(&section);
        Some(BoundaryCondition { exchange: exchange?, ..BoundaryCondition::new(on?, components?) })
    })
}

/// The parts of the boundary that the text has conditions on; without those that cannot be read.
pub(super) fn places(root: &Section<'_>, body: &mut BodyShape) -> Vec<ConditionPlace> {
    let place = |section: Section<'_>| {
        let on = section.value("on")?;
        let part = part(&on, body)?;
        Some(ConditionPlace { part, on: on.source().to_owned(), at: section.position() })
    };
    root.sections("boundary").into_iter().filter_map(place).collect()
}

/// Keys that say all components.
const SPECIAL: [&str; 3] = ["pressure", "symmetry", "antisymmetry"];

/// A pressure, symmetry or antisymmetry, which say all components.
fn special(
    section: &Section<'_>,
    on: Option<BoundaryPart>,
    body: &BodyShape,
) -> Option<BoundaryCondition> {
    let [pressure, symmetry, antisymmetry] = SPECIAL;
    let given = section.given(&[pressure, symmetry, antisymmetry, "displacement", "traction"]);
    if let [(_, first), (second, _), ..] = &given[..] {
        let what = format!("says all components, and so does `{second}`; write two [[boundary]]");
        return first.error(&what);
    }
    if section.mentions(pressure) {
        let pressure = section.get(pressure)?;
        return Some(BoundaryCondition::pressure(on?, pressure));
    }
    let is_symmetric = section.mentions(symmetry);
    let value = section.value(if is_symmetric { symmetry } else { antisymmetry })?;
    if !bool::read(&value)? {
        return value.error("is false, which says nothing; leave this [[boundary]] out");
    }
    let Some(normal) = normal(on?, body) else {
        return value.error(
            "is for edges and for pieces of outlines and holes that are straight; divide this one, or give a \
             displacement or a traction here",
        );
    };
    let kind = if is_symmetric { Symmetry::Symmetric } else { Symmetry::Antisymmetric };
    Some(BoundaryCondition::symmetry_on(on?, normal, kind))
}

/// The normal of a part of the boundary all of which has one direction; that of an axis, if
/// rounding is all that they differ by.
fn normal(on: BoundaryPart, body: &BodyShape) -> Option<Vec2> {
    let piece = match on {
        BoundaryPart::Edge { edge, .. } => return Some(edge.normal()),
        BoundaryPart::Piece(piece) => &body.pieces[piece],
        _ => return None,
    };
    let holes = body.holes.as_ref()?;
    let sides = || piece.runs.iter().flat_map(|run| run.edges(&holes[run.hole]));
    if sides().any(|side| side.is_arc()) {
        return None;
    }
    let along = || sides().map(|side| side.chord());
    let longest = along().max_by(|a, b| a.length().total_cmp(&b.length()))?;
    let touch = touch(&holes[piece.runs[0].hole].rim_bounds());
    let is_normal = |normal: &Vec2| along().all(|way| normal.dot(way).abs() <= touch);
    [vec2(1.0, 0.0), vec2(0.0, 1.0), longest.unit().left()].into_iter().find(is_normal)
}

/// The coefficient of an exchange, if there is one.
fn exchange(section: &Section<'_>) -> Option<Option<Expression>> {
    let Some(value) = section.value("exchange") else { return Some(None) };
    if !section.mentions("value") {
        return value.error("needs the `value` of the surroundings; add it");
    }
    let exchange = Expression::read(&value)?;
    if exchange.constant().is_some_and(|h| h <= 0.0) {
        return value.error("must be positive; leave it out where nothing is exchanged");
    }
    Some(Some(exchange))
}

/// A part of the boundary: the name of an edge, or a table.
fn part(value: &DocumentValue<'_>, body: &mut BodyShape) -> Option<BoundaryPart> {
    let domain = &body.bounds.unwrap_or(Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0)));
    let Some(section) = value.as_section() else {
        return if value.as_text() == Some(OUTLINE) {
            outline(value, body)
        } else {
            Some(BoundaryPart::edge(value.choice()?, domain))
        };
    };
    let mut given =
        ["hole", "piece", "crack", "edge"].into_iter().filter(|key| section.mentions(key));
    let (key, second) = (given.next().unwrap_or("edge"), given.next());
    if second.is_some() {
        return value.error("names several parts of the border; write one [[boundary]] for each");
    }
    let others: &[_] = match key {
        "hole" => &["from", "to", "face"],
        "crack" => &["from", "to"],
        _ => &["face"],
    };
    if let Some((_, other)) = section.given(others).first() {
        return other.error(&format!("has no meaning with `{key}`; remove it"));
    }
    match key {
        "hole" => {
            let (hole, count) = (section.get("hole")?, body.holes.as_ref().map(|h| bounded(h)));
            match count {
                // the outline has no number
                Some(count) if hole >= count => {
                    section.value("hole")?.report(&no_such("hole", hole, count));
                    None
                }
                _ => Some(BoundaryPart::Hole(hole)),
            }
        }
        "piece" => {
            let whole = piece(&section.value("piece")?, body);
            let ends = [section.optional("from")?, section.optional("to")?];
            let Some(end) = section.value("from").or(section.value("to")) else { return whole };
            let BoundaryPart::Piece(whole) = whole? else { return None };
            match body.part_of(whole, ends) {
                Ok(part) => Some(BoundaryPart::Piece(part)),
                Err(message) => end.error(&message),
            }
        }
        "crack" => {
            let (crack, face) = (section.get("crack"), section.optional("face"));
            Some(BoundaryPart::Crack { crack: crack?, face: face? })
        }
        _ => {
            let edge: DomainEdge = section.require("edge")?;
            let [first, last] = edge.range(domain);
            let (from, to) = (section.or("from", first), section.or("to", last));
            Some(BoundaryPart::Edge { edge, from: from?, to: to? })
        }
    }
}

/// The number of holes without what is outside of the outline.
fn bounded(holes: &[Hole]) -> usize {
    holes.iter().filter(|hole| !hole.is_outside()).count()
}

/// The outline of the body; if it cannot be read, any part.
fn outline(value: &DocumentValue<'_>, body: &BodyShape) -> Option<BoundaryPart> {
    let holes = body.holes.as_ref()?;
    match holes.iter().position(Hole::is_outside) {
        Some(hole) => Some(BoundaryPart::Hole(hole)),
        None => value.error("is the outline, but [domain] has none; name an edge, or give one"),
    }
}

/// The piece of a name.
fn piece(value: &DocumentValue<'_>, body: &BodyShape) -> Option<BoundaryPart> {
    let name = String::read(value)?;
    body.holes.as_ref()?;
    let names: Vec<_> = body.pieces.iter().map(|piece| format!("`{}`", piece.name)).collect();
    match body.pieces.iter().position(|piece| piece.name == name) {
        Some(piece) => Some(BoundaryPart::Piece(piece)),
        None if names.is_empty() => value.error(&format!(
            "is \"{name}\", but no piece of a `path` has a `name`; give it one, in [domain.outline] or [[hole]]"
        )),
        None => {
            value.error(&format!("is \"{name}\", but known pieces are {}", names.join(", ")))
        }
    }
}

/// The conditions of one `[[boundary]]`, which may give some components of u and others of the
/// traction.
fn conditions(
    section: &Section<'_>,
    kind: EquationKind,
    exact: Option<&[Expression]>,
) -> Option<Vec<Condition>> {
    let [_, unknown, load] = kind.keys();
    if !section.mentions_any(&[unknown, load]) {
        section.error::<()>(format!("[[boundary]] says nothing; add `{unknown}` or `{load}`"));
    }
    let loads = section.value(load);
    let free = || Some(vec![Condition::Free; kind.components()]);
    let given = section.value(unknown).map_or_else(free, |value| dirichlet(&value, unknown, exact));
    let loaded = loads.as_ref().map_or_else(free, neumann);
    let pairs = given?.into_iter().zip(loaded?);
    all(pairs.map(|pair| match pair {
        (condition, Condition::Free) | (Condition::Free, condition) => Some(condition),
        _ => loads.as_ref()?.error(&format!(
            "gives a component that `{unknown}` gives as well; make one of them \"free\""
        )),
    }))
}

fn dirichlet(
    value: &DocumentValue<'_>,
    unknown: &str,
    exact: Option<&[Expression]>,
) -> Option<Vec<Condition>> {
    // the exact solution must have been given where a value asks for it
    let known = |value: &DocumentValue<'_>| match exact? {
        [] => {
            value.error(&format!("is \"exact\", but there is no [exact]; add it with `{unknown}`"))
        }
        exact => Some(exact),
    };
    if value.as_text() == Some("exact") {
        return Some(known(value)?.iter().cloned().map(Condition::Dirichlet).collect());
    }
    let condition = |(component, value): (usize, &DocumentValue<'_>)| match value.as_text() {
        Some("free") => Some(Condition::Free),
        Some("exact") => Some(Condition::Dirichlet(known(value)?[component].clone())),
        _ => Expression::read(value).map(Condition::Dirichlet),
    };
    all(value.components()?.iter().enumerate().map(condition))
}

fn neumann(value: &DocumentValue<'_>) -> Option<Vec<Condition>> {
    let condition = |value: &DocumentValue<'_>| match value.as_text() {
        Some("free") => Some(Condition::Free),
        Some("exact") => value.error("cannot be \"exact\"; write its formula"),
        _ => Expression::read(value).map(Condition::Neumann),
    };
    if value.as_text() == Some("exact") {
        return condition(value).map(|condition| vec![condition]);
    }
    all(value.components()?.iter().map(condition))
}
