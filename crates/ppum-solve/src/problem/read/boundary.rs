//! The tables `[[boundary]]`.

use ppum::formula::Scope;
use ppum::vec2::{Rect, vec2};

use super::super::boundary::{BoundaryCondition, Condition, Edge};
use super::super::document::{Section, Value};
use super::{Kind, Later, Words, all, components};
use ppum::expression::Expression;

/// What conditions may use.
pub(super) struct Data<'e> {
    pub(super) scope: &'e Scope,
    /// The exact solution: empty if there is none, `None` if it cannot be read.
    pub(super) exact: Option<&'e [Expression]>,
}

/// The conditions; none at all if one of them cannot be read, as the checks count them.
pub(super) fn boundary(
    root: &Section<'_>,
    kind: Kind,
    domain: Option<Rect>,
    data: &Data<'_>,
) -> Vec<BoundaryCondition> {
    let domain = domain.unwrap_or(Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0)));
    let condition = |section: Section<'_>| {
        let Words { unknown, neumann, .. } = kind.words();
        let section = section.only(&["on", unknown, neumann], kind.foreign());
        let place = section.require("on", "on = \"top\"").and_then(|value| piece(&value, &domain));
        let components = conditions(&section, kind, data);
        let (edge, [from, to]) = place?;
        Some(BoundaryCondition { edge, from, to, components: components? })
    };
    all(root.sections("boundary").into_iter().map(condition)).unwrap_or_default()
}

/// A piece of an edge: its name, or a table.
fn piece(value: &Value<'_>, domain: &Rect) -> Option<(Edge, [f64; 2])> {
    let edges = Edge::ALL.map(|edge| (edge.name(), edge));
    let Some(section) = value.as_section("`on`") else {
        let edge = value.choice(&edges)?;
        return Some((edge, edge.range(domain)));
    };
    let section = section
        .only(&["edge", "from", "to"], &["hole", "crack"].map(|key| (key, Later(&["edge"]))));
    let edge = section.require("edge", "edge = \"top\"")?.choice(&edges)?;
    let [first, last] = edge.range(domain);
    let limit = |key, whole| section.get(key).map_or(Some(whole), |value| value.number());
    let (from, to) = (limit("from", first), limit("to", last));
    Some((edge, [from?, to?]))
}

/// The conditions of one `[[boundary]]`, which may give some components of u and others of the
/// traction.
fn conditions(section: &Section<'_>, kind: Kind, data: &Data<'_>) -> Option<Vec<Condition>> {
    let words = kind.words();
    let (given, loads) = (section.get(words.unknown), section.get(words.neumann));
    let Words { unknown, neumann: load, .. } = words;
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

fn dirichlet(value: &Value<'_>, kind: Kind, data: &Data<'_>) -> Option<Vec<Condition>> {
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
fn known<'e>(value: &Value<'_>, exact: &'e [Expression], kind: Kind) -> Option<&'e [Expression]> {
    let unknown = kind.words().unknown;
    let missing = format!("is \"exact\", but there is no [exact]; add it with `{unknown}`");
    if exact.is_empty() { value.error(&missing) } else { Some(exact) }
}

fn neumann(value: &Value<'_>, kind: Kind, scope: &Scope) -> Option<Vec<Condition>> {
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
