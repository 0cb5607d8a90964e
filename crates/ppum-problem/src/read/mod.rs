//! From the text of a problem file to a problem.
//!
//! Every reader of a table reports what is wrong and returns something harmless in its place (or
//! `None` where nothing is harmless), so that one reading finds all errors.

/// A value whose fields are what keys of their names say, or as they are where these are left out.
macro_rules! with_keys {
    ($section:expr, $value:expr, $($key:ident),+) => {{
        let mut value = $value;
        $(value.$key = $section.get(stringify!($key)).unwrap_or(value.$key);)+
        value
    }};
}

mod anisotropy;
mod body;
mod boundary;
mod curve;
mod discretization;
mod enrichment;
mod steps;
mod support;
mod table;
mod temperature;

use std::collections::BTreeSet;
use std::path::Path;

use ppum::crack::Crack;
use ppum::dataset::{
    Dataset, Elasticity, Equation, MAX_QUANTITIES, MAX_QUANTITY_TEXT, NamedQuantity, StressState,
};
use ppum::expression::Expression;
use ppum::quantity::QuantityFormulaError;
use toml::de::DeTable;

use crate::check;
use crate::data::{
    Adaptivity, BodyText, BoundaryPart, Diagnostic, Discretization, EquationKind, HeatedBody,
    PolynomialOrder, Problem, ProblemData, ProblemError, ProblemLocation, RefinementRegion,
    SolverSettings, default_order, quantities,
};
use crate::file::keys::ROOT;
use crate::file::{
    DiagnosticList, DocumentValue, FileSource, FromValue as _, MAX_LENGTH, ProblemDocument,
    Section, all,
};
use anisotropy::{anisotropy, is_anisotropic};
use body::BodyShape;

impl Problem {
    /// Reads a problem file of at most [`MAX_LENGTH`] bytes. Paths in it are relative to its
    /// folder, and lead to files of at most 64 MiB.
    ///
    /// # Errors
    /// Everything that is wrong, with file, line, column and remedy, of a file of numbers the first
    /// 100 errors; or that the file cannot be read.
    pub fn read(path: &Path) -> Result<Self, ProblemError> {
        let file = path.display().to_string();
        let text = ppum_file::text(path, MAX_LENGTH).map_err(|error| Diagnostic {
            location: ProblemLocation::File(file.clone()),
            message: format!("cannot read the problem file: {error}"),
        })?;
        Self::parse(&text, &file, path.parent().unwrap_or(Path::new("")))
    }

    /// Reads a problem from the text of a problem file.
    ///
    /// `file_name` is for messages, and the title if the text has none; paths in the text are
    /// relative to `base_dir`.
    ///
    /// # Errors
    /// Everything that is wrong, with file, line, column and remedy.
    pub fn parse(text: &str, file_name: &str, base_dir: &Path) -> Result<Self, ProblemError> {
        read(text, file_name, FileSource::Folder(base_dir))
    }

    /// Reads the body of a text, and where the text has conditions on its boundary, whatever is
    /// missing or wrong in the rest: to be drawn while the text is written. No rule is applied to
    /// it. `None` if a part of the body cannot be read.
    #[must_use]
    pub fn body_of(text: &str, base_dir: &Path) -> Option<BodyText> {
        let document = ProblemDocument::new("problem", text, FileSource::Folder(base_dir));
        let table = DeTable::parse(text).ok()?;
        let root = Section::unchecked(&document, &ROOT, table.get_ref(), 0);
        let kind = equation_kind(&root).unwrap_or(EquationKind::Elasticity);
        document.equation.set(Some(kind));
        let root = &root.checked();
        document.tables.get_or_init(|| table::tables(root, &kind.example()));
        let (cracks, _) = cracks(root, None);
        let mut shape = body::body(root, None);
        let conditions = boundary::places(root, &mut shape);
        let body = shape.body()?.with_lines(cracks);
        Some(BodyText { body, conditions, load_key: kind.keys()[2] })
    }

    /// The problem of a dataset, from the text it holds; none if it holds none. Tables and points
    /// that were read from files are those of the dataset: the files need not be there any more.
    ///
    /// # Errors
    /// Everything that is wrong in the text.
    pub fn of_dataset(dataset: &Dataset) -> Result<Option<Self>, ProblemError> {
        let read = |text: &String| Self::parse_with(text, dataset);
        dataset.problem.as_ref().map(read).transpose()
    }

    /// The problem of another text, with the tables and points of a dataset in place of the files
    /// that the text names.
    ///
    /// # Errors
    /// Everything that is wrong in the text.
    pub fn parse_with(text: &str, dataset: &Dataset) -> Result<Self, ProblemError> {
        read(text, "problem", FileSource::Stored(dataset))
    }
}

fn read(text: &str, file: &str, source: FileSource<'_>) -> Result<Problem, ProblemError> {
    read_document(text, file, ProblemDocument::new(file, text, source))
}

/// Reads the problem of a temperature in a body from a text that begins at a line and column of a
/// file.
fn read_heat(
    text: &str,
    (file, line, column): (&str, usize, usize),
    source: FileSource<'_>,
    heated: &HeatedBody<'_>,
) -> Result<Problem, ProblemError> {
    let mut document = ProblemDocument::new(file, text, source);
    document.report.begins_at(line, column);
    document.heated = Some(heated);
    read_document(text, file, document)
}

fn read_document(
    text: &str,
    file: &str,
    document: ProblemDocument<'_>,
) -> Result<Problem, ProblemError> {
    let (table, errors) = DeTable::parse_recoverable(text);
    report_syntax(&document.report, &errors);
    let problem = if errors.is_empty() { problem(&document, table.get_ref()) } else { None };
    if let Some(problem) = &problem {
        report_violations(&document, table.get_ref(), problem);
    }
    let (files, notes) = (document.files.take(), document.report.notes());
    let errors = document.report.into_errors();
    let problem = match problem {
        Some(problem) if errors.is_empty() => problem,
        _ => return Err(ProblemError::new(errors)),
    };
    let title = match problem.title.as_str() {
        "" => Path::new(file).file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        title => title.to_owned(),
    };
    // errors are about the vertices of the file
    let text = Some(temperature::with_text(text, table.get_ref(), &problem));
    let body = (*problem.body).clone().settled().into();
    Ok(Problem::of_checked(ProblemData { title, body, text, files, notes, ..problem }))
}

/// The tables that give a body; the problem of a temperature need not repeat them.
const BODY: [&str; 3] = ["domain", "hole", "crack"];

/// The message where a bracket is open; every line that follows is then read as a part of
/// the array.
const IN_ARRAY: &str = "missing comma between array elements";

/// Reports what is no TOML; only the first error of a line, as the others mostly follow from it,
/// and nothing after an open bracket.
fn report_syntax(report: &DiagnosticList<'_>, errors: &[toml::de::Error]) {
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

fn report_violations(
    ProblemDocument { report, misnamed, .. }: &ProblemDocument<'_>,
    document: &DeTable<'_>,
    problem: &ProblemData,
) {
    let misnamed = misnamed.borrow();
    for error in check::errors(problem).into_iter().filter(|one| !one.key.is_in_any(&misnamed)) {
        let other = error.other.map_or(String::new(), |key| {
            let (line, _) = report.position(key.span(document).start);
            format!(" (the other is on line {line})")
        });
        report.at(error.key.span(document).start, error.message + &other);
    }
}

fn problem<'a>(document: &'a ProblemDocument<'a>, table: &'a DeTable<'a>) -> Option<ProblemData> {
    let root = Section::unchecked(document, &ROOT, table, 0);
    let kind = equation_kind(&root);
    document.equation.set(kind);
    let root = &root.checked();
    document.misnamed.replace(root.misnamed_keys());
    let heated = document.heated.filter(|_| !root.mentions_any(&BODY));
    // errors in the body are those of the problem that it stands in
    document.misnamed.borrow_mut().extend(heated.iter().flat_map(|_| BODY));
    let loads = ["boundary", "force", "body_force", "source", "temperature", "strain"];
    if !root.mentions_any(&loads) {
        root.error::<()>("nothing acts on the plate; add [[boundary]]");
    }
    let title = root.get("title").unwrap_or_default();
    let example = kind.unwrap_or(EquationKind::Elasticity).example();
    let tables = document.tables.get_or_init(|| table::tables(root, &example)).clone();
    document.scope()?;
    let (plan, discretization) = plan(root);
    document.misnamed.borrow_mut().extend(plan.is_none().then_some("discretization"));
    let accuracy = plan.as_ref().and_then(|plan| plan.get("accuracy"));
    let solver = solver(root);
    let (cracks, frictions) = cracks(root, heated);
    let mut shape = match heated {
        Some(heated) => BodyShape::of(heated.body),
        None => body::body(root, discretization.as_ref()),
    };
    let enrichments = root.each("enrichment", |new| enrichment::enrichment(&new, cracks.len()));
    let mut refinements = root.each("refine", |new| steps::refinement(&new));
    let kind = kind?;
    let (exact, source) = (exact(root, kind), source(root, kind));
    let equation = equation(root, kind);
    let quantities = quantities(root, &equation);
    let mut boundary = boundary::boundary(root, kind, &mut shape, exact.as_deref());
    if cracks.is_empty() && root.mentions("crack") {
        // none could be read: what is said of them cannot be judged
        boundary.retain(|condition| !matches!(condition.on, BoundaryPart::Crack { .. }));
        refinements.retain(|new| !matches!(new.place, RefinementRegion::Crack(_)));
    }
    let body = shape.body()?.with_lines(cracks);
    let body = match kind {
        EquationKind::Elasticity => body.with_contacts(frictions),
        EquationKind::Poisson => body,
    };
    let mut discretization = discretization?;
    let heated = HeatedBody { body: &body, discretization: &discretization };
    let read = |text: &str, place: (&str, usize, usize), source: FileSource<'_>| {
        read_heat(text, place, source, &heated)
    };
    let temperature = temperature::solved(root, &equation, &body, &read);
    let equation = equation.without_expansion();
    if plan.is_some_and(|plan| !plan.mentions("order")) {
        let first = accuracy.map_or(0, Adaptivity::first_order);
        discretization.order =
            PolynomialOrder::Uniform(default_order(&equation, body.domain()).max(first));
    }
    Some(ProblemData {
        title,
        body: body.into(),
        temperature,
        equation,
        boundary,
        forces: support::forces(root),
        supports: support::supports(root),
        source,
        exact: exact.unwrap_or_default(),
        quantities,
        tables,
        enrichments,
        discretization,
        adaptivity: steps::adaptivity(root, accuracy),
        growth: root.section("growth").map(|section| steps::growth(&section)),
        refinements,
        solver,
        text: None,
        files: Vec::new(),
        notes: Vec::new(),
    })
}

/// The kind of the equation; none if it cannot be read.
fn equation_kind(root: &Section<'_>) -> Option<EquationKind> {
    if !root.mentions("equation") {
        return Some(EquationKind::Elasticity);
    }
    root.section("equation")?.or("kind", EquationKind::Elasticity)
}

/// The table `[discretization]`, which the problem of a temperature need not have, and what it
/// says.
fn plan<'a>(root: &Section<'a>) -> (Option<Section<'a>>, Option<Discretization>) {
    match root.document.heated {
        Some(heated) if !root.mentions("discretization") => {
            (None, Some(heated.discretization.clone()))
        }
        _ => {
            let plan = root.required_section("discretization");
            let read = plan.as_ref().and_then(discretization::discretization);
            (plan, read)
        }
    }
}

/// The courses of the cracks, and the friction of those whose faces touch.
fn cracks(root: &Section<'_>, heated: Option<&HeatedBody<'_>>) -> (Vec<Crack>, Vec<Option<f64>>) {
    match heated {
        Some(HeatedBody { body, .. }) => {
            body.cracks().iter().map(|crack| (crack.clone(), None)).unzip()
        }
        None => {
            let read = |section| Some((curve::course(&section)?, friction(&section)?));
            root.each("crack", read).into_iter().unzip()
        }
    }
}

/// Values that are missing or wrong are reported, and replaced by possible ones.
fn equation(root: &Section<'_>, kind: EquationKind) -> Equation {
    if kind == EquationKind::Poisson {
        let conductivity = root.section("material").and_then(|section| section.get("conductivity"));
        let section = root.section("equation");
        let axisymmetric = section.and_then(|s| s.or("axisymmetric", false)).unwrap_or(false);
        return Equation::Poisson {
            conductivity: conductivity.unwrap_or(1.0.into()),
            axisymmetric,
        };
    }
    let around = root.section("equation").filter(|_| root.mentions("equation"));
    if let Some(value) = around.as_ref().and_then(|section| section.value("axisymmetric")) {
        value.error::<()>(
            "is for Poisson's equation; write `state = \"axisymmetric\"` in [material]",
        );
    }
    let section = root.required_section("material");
    if let Some(material) = section.as_ref().filter(|section| is_anisotropic(section)) {
        let state = material.require("state").unwrap_or(StressState::PlaneStress);
        if let Some(law) = anisotropy(material, state) {
            let eigenstrain = temperature::eigenstrain(root, Some(material));
            return Equation::Elasticity(law.body(state, eigenstrain));
        }
        return EquationKind::Elasticity.example();
    }
    let constant = |key| section.as_ref()?.require::<Expression>(key);
    Equation::Elasticity(Elasticity {
        anisotropy: None,
        young: constant("young").unwrap_or(1.0.into()),
        poisson: constant("poisson").unwrap_or(0.0.into()),
        state: section
            .as_ref()
            .and_then(|s| s.require("state"))
            .unwrap_or(StressState::PlaneStress),
        eigenstrain: temperature::eigenstrain(root, section.as_ref()),
    })
}

/// The coefficient of friction of a `[[crack]]`; none if its faces do not touch.
fn friction(section: &Section<'_>) -> Option<Option<f64>> {
    let (touches, friction) = (section.or("contact", false)?, section.optional("friction")?);
    match section.value("friction") {
        Some(value) if !touches => value.error("is for faces that touch; add `contact = true`"),
        _ => Some(touches.then_some(friction.unwrap_or(0.0))),
    }
}

fn source(root: &Section<'_>, kind: EquationKind) -> Vec<Expression> {
    let [source, ..] = kind.keys();
    let section = root.section(source);
    let given = section.and_then(|section| expressions(&section.required("value")?));
    given.unwrap_or_else(|| vec![Expression::number(0.0); kind.components()])
}

/// The exact solution: empty if there is none, `None` if it cannot be read.
fn exact(root: &Section<'_>, kind: EquationKind) -> Option<Vec<Expression>> {
    if !root.mentions("exact") {
        return Some(Vec::new());
    }
    let [_, unknown, _] = kind.keys();
    expressions(&root.section("exact")?.required(unknown)?)
}

fn expressions(value: &DocumentValue<'_>) -> Option<Vec<Expression>> {
    all(value.components()?.iter().map(Expression::read))
}

fn solver(root: &Section<'_>) -> SolverSettings {
    let default = SolverSettings::default();
    let section = root.section("solver");
    section.map_or(default, |section| with_keys!(section, default, tolerance, kind, kernels))
}

/// The quantities that can be read, each of which may use those before it.
fn quantities(root: &Section<'_>, equation: &Equation) -> Vec<NamedQuantity> {
    let mut found = Vec::new();
    let sections = root.sections_at_most(MAX_QUANTITIES, "quantity");
    if is_too_long(&sections) {
        return found;
    }
    for section in sections {
        found.extend(quantity(&section, equation, &found));
    }
    found
}

/// Reports formulas that are longer together than a dataset can hold: each is read with all
/// before it.
fn is_too_long(sections: &[Section<'_>]) -> bool {
    let mut sum = 0;
    let too_long = sections.iter().find(|section| {
        let formula = section.value("formula");
        sum += formula.and_then(|value| value.as_text()).map_or(0, str::len);
        sum > MAX_QUANTITY_TEXT
    });
    let message = format!(
        "the formulas of the quantities are longer than {MAX_QUANTITY_TEXT} bytes together; leave some out"
    );
    too_long.inspect(|section| _ = section.error::<()>(message)).is_some()
}

fn quantity(
    section: &Section<'_>,
    equation: &Equation,
    earlier: &[NamedQuantity],
) -> Option<NamedQuantity> {
    let name = section.require("name");
    let formula = section.required("formula").and_then(|value| {
        let text = value.text()?;
        match quantities::parse(text, equation, section.document.tables(), earlier) {
            Ok(_) => Some(text),
            Err(QuantityFormulaError::Formula(error)) => value.inside(text, Err(error)),
            Err(error) => value.error(&format!("cannot be used: {error}")),
        }
    });
    let unit = section.or("unit", String::new());
    Some(NamedQuantity { name: name?, text: formula?.to_owned(), unit: unit? })
}
