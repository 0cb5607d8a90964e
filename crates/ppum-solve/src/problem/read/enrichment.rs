//! The tables `[[enrichment]]`.

use std::sync::Arc;

use ppum::expression::Expression;
use ppum::formula::{Formula, FormulaJets, Scope, ScopeError, Table};
use ppum::function::{Declared, function_scope};
use ppum::library::{self, Entry};
use ppum::vec2::Vec2;

use super::super::document::{Section, Value, nearest};
use super::super::enrichment::{LocalEnrichment, Region, Site};
use super::super::scopes;
use super::all;

const KEYS: [&str; 12] = [
    "name",
    "function",
    "functions",
    "parameters",
    "at",
    "angle",
    "along",
    "radius",
    "where",
    "degree",
    "kinks",
    "singular",
];

/// Names that formulas of enrichments may use beside their parameters.
pub(super) struct Names<'n> {
    pub(super) cracks: usize,
    pub(super) tables: &'n [Arc<Table>],
}

impl Names<'_> {
    fn scope(&self, parameters: &[(String, f64)]) -> Result<Scope, ScopeError> {
        function_scope(parameters, self.cracks, self.tables)
    }
}

/// The enrichments; none at all if one of them cannot be read, as the checks count them.
pub(super) fn enrichments(root: &Section<'_>, names: &Names<'_>) -> Vec<LocalEnrichment> {
    let read = |section: Section<'_>| enrichment(&section.only(&KEYS, &[]), names);
    all(root.sections("enrichment").into_iter().map(read)).unwrap_or_default()
}

fn enrichment(section: &Section<'_>, names: &Names<'_>) -> Option<LocalEnrichment> {
    let functions = functions(section, names);
    let site = site(section);
    let region = region(section, names.tables);
    let declared = declared(section);
    let name = section.get("name").map_or(Some(None), |value| value.text().map(Some));
    let degree = section.get("degree").map_or(Some(None), |value| value.whole().map(Some));
    let functions = functions?;
    Some(LocalEnrichment {
        name: name?.unwrap_or(&functions.name).to_owned(),
        functions: functions.texts,
        parameters: functions.parameters,
        site: site?,
        region: region?,
        degree: degree?.map(|degree| degree as usize),
        declared: declared?,
    })
}

/// The values of `function`, `functions` and `parameters`.
struct Functions {
    /// The name in the library, if that is what was given.
    name: String,
    texts: Vec<String>,
    parameters: Vec<(String, f64)>,
}

fn functions(section: &Section<'_>, names: &Names<'_>) -> Option<Functions> {
    let given = given(section)?;
    let entries: Vec<_> = given.iter().filter_map(entry).collect();
    let of_library = entries.len() == given.len();
    let parameters = parameters(section, &entries, of_library, names)?;
    let scope = names.scope(&parameters).ok()?;
    let texts = all(given.iter().map(|value| texts(value, &scope)))?.concat();
    let name = match entries[..] {
        [entry] if of_library => entry.name.to_owned(),
        _ => String::new(),
    };
    Some(Functions { name, texts, parameters })
}

/// The values of `function` or `functions`.
fn given<'a>(section: &Section<'a>) -> Option<Vec<Value<'a>>> {
    match (section.get("function"), section.get("functions")) {
        (Some(one), None) => Some(vec![one]),
        (None, Some(list)) => list.list("a list of formulas in quotes"),
        (Some(_), Some(list)) => list.error("contradicts `function`; put all into `functions`"),
        (None, None) => {
            if !["function", "functions"].iter().any(|key| section.mentions(key)) {
                section.error("[[enrichment]] has no function; add e.g. `function = \"abs(y)\"`");
            }
            None
        }
    }
}

/// The entry of the library that a value names.
fn entry(value: &Value<'_>) -> Option<&'static Entry> {
    library::enrichment(value.as_text()?)
}

/// The parameters that are given, and the defaults of the others. Where all functions are of the
/// library, parameters must be theirs.
fn parameters(
    section: &Section<'_>,
    entries: &[&Entry],
    of_library: bool,
    names: &Names<'_>,
) -> Option<Vec<(String, f64)>> {
    let defaults: Vec<_> = entries.iter().flat_map(|entry| entry.parameters).collect();
    let table = match section.get("parameters") {
        Some(value) => Some(value.table("`parameters`", "{ lambda = 0.6 }")?),
        None => None,
    };
    let read = |(name, value): (&str, Value<'_>)| {
        if of_library && !defaults.iter().any(|(known, _)| *known == name) {
            return value.error(&no_parameter(name, &defaults));
        }
        let scope = names.scope(&[(name.to_owned(), 1.0)]);
        scope.map_err(|error| value.report(&error.to_string())).ok()?;
        Some((name.to_owned(), value.constant()?))
    };
    let mut found = all(table.iter().flat_map(|table| table.entries()).map(read))?;
    for &&(name, value) in &defaults {
        if found.iter().all(|(known, _)| known != name) {
            found.push((name.to_owned(), value));
        }
    }
    Some(found)
}

fn no_parameter(name: &str, known: &[&(&'static str, f64)]) -> String {
    let known: Vec<_> = known.iter().map(|(name, _)| *name).collect();
    let remedy = match nearest(name, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None if known.is_empty() => "it has none".to_owned(),
        None => format!("it has {}", known.join(", ")),
    };
    format!("is no parameter of the function; {remedy}")
}

/// The formulas of a text: those of the library that it names, or the one it is.
fn texts(value: &Value<'_>, scope: &Scope) -> Option<Vec<String>> {
    if let Some(entry) = entry(value) {
        return Some(entry.texts.iter().map(|&text| text.to_owned()).collect());
    }
    let text = value.text()?;
    let formula = Formula::parse(text, scope);
    if formula.is_err() && is_word(text) {
        let names = library::ENRICHMENTS.map(|entry| entry.name);
        if let Some(near) = nearest(text, names.iter().copied()) {
            return value.error(&format!("is no formula; did you mean \"{near}\"?"));
        }
    }
    let formula = value.inside(text, formula)?;
    FormulaJets::new(&[&formula], 2).map_err(|error| value.report(&error.to_string())).ok()?;
    Some(vec![text.to_owned()])
}

/// True if a text can be meant as a name of the library.
pub(super) fn is_word(text: &str) -> bool {
    text.chars().all(|c| c.is_ascii_alphanumeric() || "-_".contains(c))
}

fn site(section: &Section<'_>) -> Option<Site> {
    let (at, angle, along) = (section.get("at"), section.get("angle"), section.get("along"));
    let point = at.as_ref().filter(|at| at.as_text().is_none());
    if let (Some(angle), None) = (&angle, point) {
        return angle.error("has no meaning without a point in `at`; remove it");
    }
    match (at, along) {
        (Some(_), Some(along)) => along.error("contradicts `at`; give one of them"),
        (None, Some(along)) => segment(&along).map(Site::Along),
        (Some(at), None) if at.as_text().is_some() => at.choice(&[("tips", Site::Tips)]),
        (Some(at), None) => {
            let (at, angle) = (at.point(), angle.map_or(Some(0.0), |angle| angle.constant()));
            Some(Site::Point { at: at?, angle: angle? })
        }
        (None, None) => Some(Site::World),
    }
}

fn region(section: &Section<'_>, tables: &[Arc<Table>]) -> Option<Region> {
    match (section.get("radius"), section.get("where")) {
        (Some(_), Some(condition)) => condition.error("contradicts `radius`; give one of them"),
        (Some(radius), None) => radius.number().map(Region::Near),
        (None, Some(value)) => {
            let scope = scopes::position(tables).ok()?;
            let text = value.text()?;
            value.inside(text, Expression::condition(text, &scope)).map(Region::Where)
        }
        (None, None) => Some(Region::Default),
    }
}

fn declared(section: &Section<'_>) -> Option<Declared> {
    let list =
        |key: &str, what: &str| section.get(key).map_or(Some(Vec::new()), |value| value.list(what));
    let kinks = list("kinks", "a list of segments [[[x0, y0], [x1, y1]], …]")
        .and_then(|kinks| all(kinks.iter().map(segment)));
    let singular = list("singular", "a list of points [[x, y], …]")
        .and_then(|points| all(points.iter().map(Value::point)));
    Some(Declared { kinks: kinks?, singular: singular? })
}

/// Two points.
fn segment(value: &Value<'_>) -> Option<[Vec2; 2]> {
    let [from, to] = value.pair("two points [[x0, y0], [x1, y1]]")?;
    let (from, to) = (from.point(), to.point());
    Some([from?, to?])
}
