//! From the text of a problem file to a problem.
//!
//! Every reader of a table reports what is wrong and returns something harmless in its place (or
//! `None` where nothing is harmless), so that one reading finds all mistakes.

mod adaptivity;
mod boundary;
mod curve;
mod discretization;
mod enrichment;
mod growth;
mod hole;
mod quantity;
mod refinement;
mod table;

use std::collections::BTreeSet;
use std::path::Path;

use ppum::dataset::{Dataset, Elasticity, Equation, Material, StressState};
use ppum::domain::Domain;
use ppum::formula::Scope;
use ppum::vec2::{Rect, Vec2};
use toml::de::DeTable;

use super::check::mistakes;
use super::document::{Instead, Report, Section, Value};
use super::error::ProblemError;
use super::stiffness::default_order;
use super::{Adaptivity, BorderPart, Order, Problem, RefinementRegion, Solver, SolverKind, scopes};
use adaptivity::adaptivity;
use boundary::boundary;
use curve::course;
use discretization::discretization;
use enrichment::enrichments;
use growth::growth;
use hole::holes;
use ppum::expression::Expression;
use quantity::quantities;
use refinement::refinements;
use table::tables;

/// The folder of the files that a text names.
#[derive(Clone, Copy)]
pub(super) enum Files<'a> {
    /// In a folder.
    In(&'a Path),
    /// Nowhere any more: the text is that of a dataset, which holds what was in them.
    Stored(&'a Dataset),
}

pub(super) fn read(text: &str, file: &str, files: Files<'_>) -> Result<Problem, ProblemError> {
    let report = Report::new(file, text);
    let (document, errors) = DeTable::parse_recoverable(text);
    report_syntax(&report, &errors);
    let problem = if errors.is_empty() {
        problem(Section::root(&report, document.get_ref()), files)
    } else {
        None
    };
    if let Some(problem) = &problem {
        report_violations(&report, document.get_ref(), problem);
    }
    let files = report.files();
    let mistakes = report.into_findings();
    let problem = match problem {
        Some(problem) if mistakes.is_empty() => problem,
        _ => return Err(ProblemError::new(mistakes)),
    };
    let title = match problem.title.as_str() {
        "" => Path::new(file).file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        title => title.to_owned(),
    };
    // mistakes are about the vertices of the file
    let cracks = super::cracks::settled(problem.cracks, &problem.domain);
    Ok(Problem { title, cracks, text: Some(text.to_owned()), files, ..problem })
}

/// The message where a bracket is open; every line that follows is then read as a part of
/// the array.
const IN_ARRAY: &str = "missing comma between array elements";

/// Reports what is no TOML; only the first mistake of a line, as the others mostly follow from it,
/// and nothing after an open bracket.
fn report_syntax(report: &Report<'_>, errors: &[toml::de::Error]) {
    let mut seen = BTreeSet::new();
    for error in errors {
        let offset = error.span().map_or(0, |span| span.start);
        let (line, _) = report.position(offset);
        if seen.insert(line) {
            report.at(offset, format!("the file is no valid TOML here: {}", error.message()));
        }
        if error.message().starts_with(IN_ARRAY) {
            break;
        }
    }
}

fn report_violations(report: &Report<'_>, document: &DeTable<'_>, problem: &Problem) {
    for mistake in mistakes(problem) {
        let other = mistake.other.map_or(String::new(), |key| {
            let (line, _) = report.position(key.span(document).start);
            format!(" (the other is on line {line})")
        });
        report.at(mistake.key.span(document).start, mistake.message + &other);
    }
}

/// The kind of equation, which decides what other tables may say.
#[derive(Clone, Copy, PartialEq)]
enum EquationKind {
    Elasticity,
    Poisson,
}

/// Words of a problem file that differ with the equation.
struct EquationKeys {
    /// Table of the right-hand side.
    source: &'static str,
    /// Key of the unknown field.
    unknown: &'static str,
    /// Key of its Neumann data.
    neumann: &'static str,
    /// The form of an array of components.
    components: usize,
}

impl EquationKind {
    fn words(self) -> EquationKeys {
        let (source, unknown, neumann, components) = match self {
            Self::Elasticity => ("body_force", "displacement", "traction", 2),
            Self::Poisson => ("source", "value", "flux", 1),
        };
        EquationKeys { source, unknown, neumann, components }
    }

    /// An equation of this kind.
    fn example(self) -> Equation {
        let state = StressState::PlaneStress;
        match self {
            Self::Elasticity => Equation::elasticity(Material { young: 1.0, poisson: 0.0, state }),
            Self::Poisson => Equation::poisson(1.0),
        }
    }

    /// Keys of the other equation, and what to write instead.
    fn foreign(self) -> &'static [(&'static str, Instead)] {
        match self {
            Self::Elasticity => &[
                ("source", Instead(&["body_force"])),
                ("value", Instead(&["displacement"])),
                ("flux", Instead(&["traction"])),
                ("conductivity", Instead(&["young", "poisson", "state"])),
            ],
            Self::Poisson => &[
                ("body_force", Instead(&["source"])),
                ("displacement", Instead(&["value"])),
                ("traction", Instead(&["flux"])),
                ("young", Instead(&["conductivity"])),
                ("poisson", Instead(&["conductivity"])),
                ("state", Instead(&[])),
            ],
        }
    }
}

fn problem(root: Section<'_>, files: Files<'_>) -> Option<Problem> {
    let kind = kind(&root);
    let root = &sections(root, kind);
    let title = root.get("title").and_then(|value| value.text()).unwrap_or_default();
    let domain = domain(root);
    let tables = tables(root, files, &kind.unwrap_or(EquationKind::Elasticity).example());
    let scope = scopes::position(&tables).ok()?;
    let discretization = discretization(root, files, &tables);
    let solver = solver(root);
    let cracks = cracks(root);
    let holes = holes(root);
    let names = enrichment::Names { cracks: cracks.len(), tables: &tables };
    let enrichments = enrichments(root, &names);
    let mut refinements = refinements(root, &tables);
    let kind = kind?;
    let exact = exact(root, kind, &scope);
    let source = source(root, kind, &scope);
    let equation = equation(root, kind, &scope);
    let quantities = quantities(root, &equation, &tables);
    let given = boundary::ConditionNames { scope: &scope, exact: exact.as_deref() };
    let mut boundary = boundary(root, kind, domain, &given);
    if cracks.is_empty() && root.mentions("crack") {
        // none could be read: what is said of them cannot be judged
        boundary.retain(|condition| !matches!(condition.on, BorderPart::Crack { .. }));
        refinements.retain(|new| !matches!(new.place, RefinementRegion::Crack(_)));
    }
    let domain = Domain { bounds: domain?, holes: holes? };
    let (mut discretization, adaptivity) = (discretization?, adaptivity(root));
    if root.section("discretization").is_some_and(|section| !section.mentions("order")) {
        let accuracy = adaptivity.as_ref().and_then(|set| set.accuracy);
        let first = accuracy.map_or(0, Adaptivity::first_order);
        discretization.order = Order::Uniform(default_order(&equation, &domain).max(first));
    }
    Some(Problem {
        title: title.to_owned(),
        cracks: super::cracks::with_ends(cracks, &domain),
        domain,
        equation,
        boundary,
        source,
        exact: exact.unwrap_or_default(),
        quantities,
        tables,
        enrichments,
        discretization,
        adaptivity,
        growth: growth(root, &scope),
        refinements,
        solver,
        text: None,
        files: Vec::new(),
    })
}

/// Reports tables that are not known, and that none acts. Without a kind those of all kinds are.
fn sections(root: Section<'_>, kind: Option<EquationKind>) -> Section<'_> {
    let mut known = vec!["title", "domain", "equation", "material", "crack", "hole", "boundary"];
    known.extend([
        "exact",
        "discretization",
        "adaptivity",
        "growth",
        "refine",
        "solver",
        "table",
        "enrichment",
        "quantity",
    ]);
    let mut remedies = Vec::new();
    match kind {
        Some(kind) => {
            known.push(kind.words().source);
            remedies.extend(kind.foreign());
        }
        None => known.extend(["body_force", "source"]),
    }
    let root = root.only(&known, &remedies);
    if !["boundary", "body_force", "source"].iter().any(|key| root.mentions(key)) {
        root.error("nothing acts on the plate; add [[boundary]]");
    }
    root
}

/// A table that must be there, with the keys it may have.
fn required<'a>(
    root: &Section<'a>,
    key: &'static str,
    known: &[&'static str],
    remedies: &[(&'static str, Instead)],
) -> Option<Section<'a>> {
    if !root.mentions(key) {
        let keys: Vec<_> = known.iter().map(|key| format!("`{key}`")).collect();
        let keys = keys.join(", ");
        root.error(format!("the table [{key}] is missing; add it with its keys {keys}"));
    }
    Some(root.section(key)?.only(known, remedies))
}

fn domain(root: &Section<'_>) -> Option<Rect> {
    let section = required(root, "domain", &["min", "max"], &[])?;
    let min = section.require("min", "min = [-1.0, -1.0]").and_then(|value| value.point());
    let max = section.require("max", "max = [1.0, 1.0]").and_then(|value| value.point());
    Some(Rect::new(min?, max?))
}

fn kind(root: &Section<'_>) -> Option<EquationKind> {
    if !root.mentions("equation") {
        return Some(EquationKind::Elasticity);
    }
    let section = root.section("equation")?.only(&["kind"], &[]);
    let choices = [("elasticity", EquationKind::Elasticity), ("poisson", EquationKind::Poisson)];
    section.require("kind", "kind = \"elasticity\"")?.choice(&choices)
}

fn equation(root: &Section<'_>, kind: EquationKind, scope: &Scope) -> Equation {
    match kind {
        EquationKind::Elasticity => Equation::Elasticity(material(root, scope)),
        EquationKind::Poisson => {
            let read = || {
                let section = root.section("material")?.only(&["conductivity"], kind.foreign());
                section.get("conductivity")?.expression(scope)
            };
            Equation::Poisson { conductivity: read().unwrap_or(1.0.into()) }
        }
    }
}

/// Values that are missing or wrong are reported, and replaced by possible ones.
fn material(root: &Section<'_>, scope: &Scope) -> Elasticity {
    let states =
        [("plane-strain", StressState::PlaneStrain), ("plane-stress", StressState::PlaneStress)];
    let keys = ["young", "poisson", "state"];
    let section = required(root, "material", &keys, EquationKind::Elasticity.foreign());
    let value = |key, example| section.as_ref()?.require(key, example);
    let constant = |key, example| value(key, example)?.expression(scope);
    let state = || value("state", "state = \"plane-strain\"")?.choice(&states);
    Elasticity {
        young: constant("young", "young = 1.0").unwrap_or(1.0.into()),
        poisson: constant("poisson", "poisson = 0.3").unwrap_or(0.0.into()),
        state: state().unwrap_or(StressState::PlaneStress),
    }
}

/// The cracks; none at all if one of them cannot be read, as the checks count them.
fn cracks(root: &Section<'_>) -> Vec<Vec<Vec2>> {
    all(root.sections("crack").into_iter().map(course)).unwrap_or_default()
}

fn points(value: &Value<'_>) -> Option<Vec<Vec2>> {
    all(value.list("a list of points [[x, y], …]")?.iter().map(Value::point))
}

fn source(root: &Section<'_>, kind: EquationKind, scope: &Scope) -> Vec<Expression> {
    let words = kind.words();
    let read = || {
        let section = root.section(words.source)?.only(&["value"], &[]);
        let example =
            if kind == EquationKind::Poisson { "value = 1.0" } else { "value = [0.0, -1.0]" };
        expressions(&section.require("value", example)?, kind, scope)
    };
    read().unwrap_or_else(|| vec![Expression::number(0.0); words.components])
}

/// The exact solution: empty if there is none, `None` if it cannot be read.
fn exact(root: &Section<'_>, kind: EquationKind, scope: &Scope) -> Option<Vec<Expression>> {
    if !root.mentions("exact") {
        return Some(Vec::new());
    }
    let unknown = kind.words().unknown;
    let section = root.section("exact")?.only(&[unknown], kind.foreign());
    let formulas = if kind == EquationKind::Poisson { "\"x*y\"" } else { "[\"x*y\", \"x + y\"]" };
    let value = section.require(unknown, &format!("{unknown} = {formulas}"))?;
    expressions(&value, kind, scope)
}

/// One value per component: those of an array, or the value itself if there is but one.
fn components<'a>(value: &Value<'a>, kind: EquationKind) -> Option<Vec<Value<'a>>> {
    match kind {
        EquationKind::Elasticity => value.pair("an array of two, one per component").map(Vec::from),
        EquationKind::Poisson => Some(vec![value.clone()]),
    }
}

fn expressions(value: &Value<'_>, kind: EquationKind, scope: &Scope) -> Option<Vec<Expression>> {
    all(components(value, kind)?.iter().map(|value| value.expression(scope)))
}

/// Everything, or nothing if one is missing; unlike `collect` it asks all of them, so that each can
/// report.
fn all<T>(items: impl Iterator<Item = Option<T>>) -> Option<Vec<T>> {
    let items: Vec<_> = items.collect();
    items.into_iter().collect()
}

fn solver(root: &Section<'_>) -> Solver {
    let kinds = [
        ("auto", SolverKind::Auto),
        ("direct", SolverKind::Direct),
        ("multilevel", SolverKind::Multilevel),
    ];
    let section = root.section("solver").map(|s| s.only(&["kind", "tolerance", "kernels"], &[]));
    let get = |key| section.as_ref()?.get(key);
    let tolerance = get("tolerance").and_then(|value| value.number());
    Solver {
        tolerance: tolerance.unwrap_or(Solver::default().tolerance),
        kind: get("kind").and_then(|value| value.choice(&kinds)).unwrap_or_default(),
        kernels: get("kernels").and_then(|value| value.boolean()).unwrap_or(true),
    }
}
