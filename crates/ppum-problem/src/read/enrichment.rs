//! The tables `[[enrichment]]`.

use ppum::expression::Expression;
use ppum::formula::{Formula, FormulaJets, Scope, ScopeError};
use ppum::function::{NonsmoothPoints, function_scope};
use ppum::library::{self, Entry};
use ppum::text::nearest;
use ppum::vec2::Vec2;

use crate::data::{EnrichmentRegion, LocalEnrichment, Site};
use crate::file::{DocumentValue, FromValue as _, Section, all};

/// The enrichment of a problem with so many cracks.
pub(super) fn enrichment(section: &Section<'_>, cracks: usize) -> Option<LocalEnrichment> {
    let functions = functions(section, cracks);
    let (site, region, declared) = (site(section), region(section), declared(section));
    let (name, degree) = (section.optional("name"), section.optional("degree"));
    let functions = functions?;
    Some(LocalEnrichment {
        name: name?.unwrap_or(functions.name),
        site: site?,
        region: region?,
        degree: degree?,
        declared: declared?,
        ..functions
    })
}

/// The functions with their parameters; their name is that in the library, if one was given.
fn functions(section: &Section<'_>, cracks: usize) -> Option<LocalEnrichment> {
    let given = given(section)?;
    let entries: Vec<_> = given.iter().filter_map(entry).collect();
    let of_library = entries.len() == given.len();
    let scope =
        |constants: &[(String, f64)]| function_scope(constants, cracks, section.document.tables());
    let parameters = parameters(section, &entries, of_library, scope)?;
    let scope = scope(&parameters).ok()?;
    let texts = all(given.iter().map(|value| texts(value, &scope)))?.concat();
    let name = match entries[..] {
        [entry] if of_library => entry.name.to_owned(),
        _ => String::new(),
    };
    let new = LocalEnrichment::new(&[], Site::World);
    Some(LocalEnrichment { name, functions: texts, parameters, ..new })
}

/// The values of `function` or `functions`.
fn given<'a>(section: &Section<'a>) -> Option<Vec<DocumentValue<'a>>> {
    match (section.value("function"), section.value("functions")) {
        (Some(one), None) => Some(vec![one]),
        (None, Some(list)) => list.list(),
        (Some(_), Some(list)) => list.error("contradicts `function`; put all into `functions`"),
        (None, None) => {
            if section.mentions_any(&["function", "functions"]) {
                return None;
            }
            section.error("[[enrichment]] has no function; add e.g. `function = \"abs(y)\"`")
        }
    }
}

/// The entry of the library that a value names.
fn entry(value: &DocumentValue<'_>) -> Option<&'static Entry> {
    library::enrichment(value.as_text()?)
}

/// The parameters that are given, and the defaults of the others. Where all functions are of the
/// library, parameters must be theirs.
fn parameters(
    section: &Section<'_>,
    entries: &[&Entry],
    of_library: bool,
    scope: impl Fn(&[(String, f64)]) -> Result<Scope, ScopeError>,
) -> Option<Vec<(String, f64)>> {
    let defaults: Vec<_> = entries.iter().flat_map(|entry| entry.parameters).collect();
    let table = match section.value("parameters") {
        Some(value) => Some(value.table()?),
        None => None,
    };
    let read = |(name, value): (&str, DocumentValue<'_>)| {
        if of_library && !defaults.iter().any(|(known, _)| *known == name) {
            return value.error(&no_parameter(name, &defaults));
        }
        let scope = scope(&[(name.to_owned(), 1.0)]);
        scope.map_err(|error| value.report(&error.to_string())).ok()?;
        Some((name.to_owned(), f64::read(&value)?))
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
fn texts(value: &DocumentValue<'_>, scope: &Scope) -> Option<Vec<String>> {
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
    let (at, angle) = (section.value("at"), section.value("angle"));
    let point = at.as_ref().filter(|at| at.as_text().is_none());
    if let (Some(angle), None) = (&angle, point) {
        return angle.error("has no meaning without a point in `at`; remove it");
    }
    match (at, section.value("along")) {
        (Some(_), Some(along)) => along.error("contradicts `at`; give one of them"),
        (None, Some(along)) => <[Vec2; 2]>::read(&along).map(Site::Along),
        (Some(at), None) if at.as_text().is_some() => at.choice(),
        (Some(at), None) => {
            let (at, angle) = (Vec2::read(&at), section.or("angle", 0.0));
            Some(Site::Point { at: at?, angle: angle? })
        }
        (None, None) => Some(Site::World),
    }
}

fn region(section: &Section<'_>) -> Option<EnrichmentRegion> {
    match (section.value("radius"), section.value("where")) {
        (Some(_), Some(condition)) => condition.error("contradicts `radius`; give one of them"),
        (Some(_), None) => section.get("radius").map(EnrichmentRegion::Near),
        (None, Some(value)) => {
            let (text, scope) = (value.text()?, section.document.scope()?);
            value.inside(text, Expression::condition(text, scope)).map(EnrichmentRegion::Where)
        }
        (None, None) => Some(EnrichmentRegion::Default),
    }
}

fn declared(section: &Section<'_>) -> Option<NonsmoothPoints> {
    let (kinks, singular) = (section.or("kinks", Vec::new()), section.or("singular", Vec::new()));
    Some(NonsmoothPoints { kinks: kinks?, singular: singular? })
}
