//! The tables `[[boundary]]`.

use ppum::crack::Side;
use ppum::formula::Scope;
use ppum::vec2::{Rect, vec2};

use super::super::boundary::{BorderPart, BoundaryCondition, Condition, Edge};
use super::super::document::{Section, Value};
use super::{EquationKeys, EquationKind, all, components};
use ppum::expression::Expression;

/// Names that conditions may use.
pub(super) struct ConditionNames<'e> {
    pub(super) scope: &'e Scope,
    /// The exact solution: empty if there is none, `None` if it cannot be read.
    pub(super) exact: Option<&'e [Expression]>,
}

/// The conditions; none at all if one of them cannot be read, as the checks count them.
pub(super) fn boundary(
    root: &Section<'_>,
    kind: EquationKind,
    domain: Option<Rect>,
    data: &ConditionNames<'_>,
) -> Vec<BoundaryCondition> {
    let domain = domain.unwrap_or(Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0)));
    let condition = |section: Section<'_>| {
        let EquationKeys { unknown, neumann, .. } = kind.words();
        let known: &[_] = match kind {
            EquationKind::Elasticity => &["on", unknown, neumann, "pressure", "symmetry"],
            EquationKind::Poisson => &["on", unknown, neumann],
        };
        let section = section.only(known, kind.foreign());
        let on = section.require("on", "on = \"top\"").and_then(|value| part(&value, &domain));
        if section.mentions("pressure") || section.mentions("symmetry") {
            return special(&section, on, kind, data);
        }
        let components = conditions(&section, kind, data);
        Some(BoundaryCondition::new(on?, components?))
    };
    all(root.sections("boundary").into_iter().map(condition)).unwrap_or_default()
}

/// A pressure, or symmetry, which say all components.
fn special(
    section: &Section<'_>,
    on: Option<BorderPart>,
    kind: EquationKind,
    data: &ConditionNames<'_>,
) -> Option<BoundaryCondition> {
    let EquationKeys { unknown, neumann, .. } = kind.words();
    let keys = ["pressure", "symmetry", unknown, neumann];
    let given: Vec<_> = keys.into_iter().filter(|key| section.mentions(key)).collect();
    if let [first, second, ..] = given[..] {
        let what = format!("says all components, and so does `{second}`; write two [[boundary]]");
        return section.get(first)?.error(&what);
    }
    if section.mentions("pressure") {
        let pressure = section.get("pressure")?.expression(data.scope)?;
        return Some(BoundaryCondition::pressure(on?, pressure));
    }
    let value = section.get("symmetry")?;
    if !value.boolean()? {
        return value.error("is false, which says nothing; leave this [[boundary]] out");
    }
    let BorderPart::Edge { edge, .. } = on? else {
        return value.error("is for edges of the domain; give a displacement or a traction here");
    };
    let normal = edge.normal();
    let condition = |along: f64| match along == 0.0 {
        true => Condition::Free,
        false => Condition::Dirichlet(0.0.into()),
    };
    Some(BoundaryCondition::new(on?, vec![condition(normal.x), condition(normal.y)]))
}

/// A part of the border: the name of an edge, or a table.
fn part(value: &Value<'_>, domain: &Rect) -> Option<BorderPart> {
    let edges = Edge::ALL.map(|edge| (edge.name(), edge));
    let Some(section) = value.as_section("`on`") else {
        return Some(BorderPart::edge(value.choice(&edges)?, domain));
    };
    let kinds = ["edge", "hole", "crack"].into_iter().filter(|key| section.mentions(key));
    match kinds.collect::<Vec<_>>()[..] {
        ["hole"] => {
            let section = section.only(&["hole"], &[]);
            Some(BorderPart::Hole(section.get("hole")?.whole()? as usize))
        }
        ["crack"] => {
            let section = section.only(&["crack", "face"], &[]);
            let sides = [("above", Some(Side::Above)), ("below", Some(Side::Below))];
            let face = section.get("face").map_or(Some(None), |value| value.choice(&sides));
            let crack = section.get("crack")?.whole()? as usize;
            Some(BorderPart::Crack { crack, face: face? })
        }
        ["edge"] | [] => {
            let section = section.only(&["edge", "from", "to"], &[]);
            let edge = section.require("edge", "edge = \"top\"")?.choice(&edges)?;
            let [first, last] = edge.range(domain);
            let limit = |key, whole| section.get(key).map_or(Some(whole), |value| value.number());
            let (from, to) = (limit("from", first), limit("to", last));
            Some(BorderPart::Edge { edge, from: from?, to: to? })
        }
        _ => value.error("names several parts of the border; write one [[boundary]] for each"),
    }
}

/// The conditions of one `[[boundary]]`, which may give some components of u and others of the
/// traction.
fn conditions(
    section: &Section<'_>,
    kind: EquationKind,
    data: &ConditionNames<'_>,
) -> Option<Vec<Condition>> {
    let words = kind.words();
    let (given, loads) = (section.get(words.unknown), section.get(words.neumann));
    let EquationKeys { unknown, neumann: load, .. } = words;
    if !section.mentions(unknown) && !section.mentions(load) {
        section.error(format!("[[boundary]] says nothing; add `{unknown}` or `{load}`"));
    }
    let free = || Some(vec![Condition::Free; words.components]);
    let given_list = given.map_or_else(free, |value| dirichlet(&value, kind, data));
    let load_list = loads.as_ref().map_or_else(free, |value| neumann(value, kind, data.scope));
    let pairs = given_list?.into_iter().zip(load_list?);
    all(pairs.map(|pair| match pair {
        (condition, Condition::Free) | (Condition::Free, condition) => Some(condition),
        _ => loads.as_ref()?.error(&format!(
            "gives a component that `{unknown}` gives as well; make one of them \"free\""
        )),
    }))
}

fn dirichlet(
    value: &Value<'_>,
    kind: EquationKind,
    data: &ConditionNames<'_>,
) -> Option<Vec<Condition>> {
    if value.as_text() == Some("exact") {
        let exact = known(value, data.exact?, kind)?;
        return Some(exact.iter().cloned().map(Condition::Dirichlet).collect());
    }
    let condition = |(component, value): (usize, &Value<'_>)| match value.as_text() {
        Some("free") => Some(Condition::Free),
        Some("exact") => {
            let exact = known(value, data.exact?, kind)?;
            Some(Condition::Dirichlet(exact[component].clone()))
        }
        _ => value.expression(data.scope).map(Condition::Dirichlet),
    };
    all(components(value, kind)?.iter().enumerate().map(condition))
}

/// The exact solution, which must have been given where a value asks for it.
fn known<'e>(
    value: &Value<'_>,
    exact: &'e [Expression],
    kind: EquationKind,
) -> Option<&'e [Expression]> {
    let unknown = kind.words().unknown;
    let missing = format!("is \"exact\", but there is no [exact]; add it with `{unknown}`");
    if exact.is_empty() { value.error(&missing) } else { Some(exact) }
}

fn neumann(value: &Value<'_>, kind: EquationKind, scope: &Scope) -> Option<Vec<Condition>> {
    let condition = |value: &Value<'_>| match value.as_text() {
        Some("free") => Some(Condition::Free),
        Some("exact") => value.error("cannot be \"exact\"; write its formula"),
        _ => value.expression(scope).map(Condition::Neumann),
    };
    if value.as_text() == Some("exact") {
        return condition(value).map(|condition| vec![condition]);
    }
    all(components(value, kind)?.iter().map(condition))
}
