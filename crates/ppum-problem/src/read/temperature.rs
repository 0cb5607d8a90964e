//! `[temperature]` and `[strain]`: what strains a body without stress.

use std::path::Path;

use ppum::dataset::{Eigenstrain, Equation};
use ppum::expression::Expression;
use toml::de::DeTable;

use super::anisotropy::{angle, is_anisotropic};
use crate::data::{Body, Problem, ProblemData, ProblemError, SolvedTemperature};
use crate::file::{DocumentValue, FileSource, FromValue as _, MAX_LENGTH, Section, all};

/// Reads the problem of a text that begins at a line and column of a file.
type TemperatureReader<'r> =
    &'r dyn Fn(&str, (&str, usize, usize), FileSource<'_>) -> Result<Problem, ProblemError>;

/// ε⁰ = α ΔT I + what is given beside; none if nothing is. A temperature that another problem gives
/// leaves α.
pub(super) fn eigenstrain(
    root: &Section<'_>,
    material: Option<&Section<'_>>,
) -> Option<Box<Eigenstrain>> {
    let temperature = root.section("temperature");
    let given = root.section("strain");
    if temperature.is_none() && given.is_none() {
        return None;
    }
    let is_missing = material.is_none_or(|material| !material.mentions("expansion"));
    if let Some(section) = temperature.as_ref().filter(|_| is_missing) {
        let message =
            "`expansion` is missing in [material]; a change of temperature strains the body by it";
        section.error::<()>(message);
    }
    let is_solved = |section: &&Section<'_>| section.mentions("problem");
    let value = material.and_then(|material| material.value("expansion"));
    let by_axes = value.as_ref().filter(|value| value.is_list());
    let along: [Option<String>; 4] = match (by_axes, material) {
        (Some(value), Some(material)) => by_axes_of(value, material)?.map(Some),
        _ => [None, None, Some("0".into()), None],
    };
    let alpha = value.filter(|value| !value.is_list()).and_then(|value| Expression::read(&value));
    let alpha = alpha.unwrap_or(0.0.into());
    let formula = temperature.as_ref().filter(|section| !is_solved(section));
    let change = formula.map(|section| text_of(section, "value"));
    let component = |(name, along): (&'static str, Option<String>)| {
        let swelling = change.as_ref().filter(|_| along.as_deref() != Some("0"));
        let along = along.as_deref().unwrap_or(alpha.text());
        let swelling = swelling.map(|change| format!("({along})*({change})"));
        let beside = given.as_ref().filter(|section| section.mentions(name));
        let beside =
            beside.map(|section| text_of(section, name)).filter(|text| text.parse() != Ok(0.0));
        let parts = swelling.iter().chain(&beside);
        let parts: Vec<&str> = parts.map(String::as_str).collect();
        let text = if parts.is_empty() { "0".to_owned() } else { parts.join(" + ") };
        // the parts are formulas, so that their sum is one except for its size
        Expression::parse_in(&text, root.document.scope()?).ok()
    };
    let mut of_names = ["xx", "yy", "xy", "zz"].into_iter().zip(along);
    let strains = std::array::from_fn(|_| {
        of_names.next().and_then(component).unwrap_or(Expression::number(0.0))
    });
    let expansion = temperature.as_ref().filter(is_solved).map(|_| alpha.clone());
    Some(Box::new(Eigenstrain { strains, expansion }))
}

/// The coefficients of expansion α_xx, α_yy, α_xy and α_zz of a body with those of [α₁, α₂] or
/// [α₁, α₂, α₃] along its axes.
fn by_axes_of(value: &DocumentValue<'_>, material: &Section<'_>) -> Option<[String; 4]> {
    if !is_anisotropic(material) {
        return value.error("is a list, but the body is isotropic; give one number");
    }
    let list = all(value.list()?.iter().map(Expression::read))?;
    let [a, b, rest @ ..] = &*list else {
        return value.error("must be [α1, α2] or [α1, α2, α3]");
    };
    let axis = angle(material)?;
    let (a, b, axis) = (a.text(), b.text(), axis.text());
    let out = rest.first().map_or("0", Expression::text);
    Some([
        format!("({a})*cos({axis})^2 + ({b})*sin({axis})^2"),
        format!("({a})*sin({axis})^2 + ({b})*cos({axis})^2"),
        format!("(({a}) - ({b}))*sin({axis})*cos({axis})"),
        out.to_owned(),
    ])
}

/// The text of an expression that must be there; zero if it is missing or wrong.
fn text_of(section: &Section<'_>, key: &str) -> String {
    section.require::<Expression>(key).map_or("0".to_owned(), |e| e.text().to_owned())
}

/// The temperature of a body that another problem gives, if one does.
pub(super) fn solved(
    root: &Section<'_>,
    equation: &Equation,
    body: &Body,
    read: TemperatureReader<'_>,
) -> Option<SolvedTemperature> {
    let expansion = equation.expansion()?.clone();
    let section = root.section("temperature")?;
    if let Some(value) = section.value("value") {
        return value.error("contradicts `problem`; give one of them");
    }
    let value = section.value("problem")?;
    if root.document.heated.is_some() {
        return value.error("is in the problem of a temperature, which has none itself");
    }
    let found = problem_of(&value, value.text()?, read)?;
    let problem = found.map_err(|error| value.add(error.mistakes().to_vec())).ok()?;
    // the tables of a dataset are those of its whole problem
    let has_tables =
        matches!(root.document.source, FileSource::Folder(_)) && !problem.tables.is_empty();
    match mistake(&problem, has_tables, (body, equation)) {
        Some(message) => value.error(message),
        None => {
            // what a file and the text of a dataset need not have in common
            let (title, files, tables) = (String::new(), Vec::new(), Vec::new());
            let text = problem.text.as_ref().map(|text| format!("{}\n", text.trim_end()));
            let data = ProblemData { title, files, tables, text, ..problem.into_data() };
            Some(SolvedTemperature { problem: Box::new(Problem::of_checked(data)), expansion })
        }
    }
}

/// The problem of a text of several lines, or of the file of that name.
fn problem_of(
    value: &DocumentValue<'_>,
    text: &str,
    read: TemperatureReader<'_>,
) -> Option<Result<Problem, ProblemError>> {
    let source = value.document.source;
    if text.contains('\n') {
        return Some(read(text, value.start_of_text(), source));
    }
    let FileSource::Folder(folder) = source else {
        return value
            .error("is the name of a file, but of the text of a dataset the problem is a part");
    };
    let path = value.file(folder)?;
    let text = ppum_file::text(&path, MAX_LENGTH);
    let text = text.map_err(|error| value.error::<()>(&format!("cannot be read: {error}"))).ok()?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let name = path.display().to_string();
    let problem = read(&text, (&name, 1, 1), FileSource::Folder(folder));
    let files = problem.iter().flat_map(|problem| problem.files.iter().cloned());
    value.document.files.borrow_mut().extend(files);
    Some(problem)
}

/// Returns the error in the problem of a temperature in a body with cracks.
fn mistake(
    problem: &Problem,
    has_tables: bool,
    (body, equation): (&Body, &Equation),
) -> Option<&'static str> {
    let paths = |body: &Body| body.cracks().iter().map(|c| c.points.clone()).collect::<Vec<_>>();
    match problem.equation {
        Equation::Poisson { .. } if has_tables => Some(
            "has a [[table]], which the problem of a temperature cannot; write its formulas without",
        ),
        Equation::Poisson { axisymmetric, .. } if axisymmetric != equation.is_axisymmetric() => {
            Some(
                "is in the plane, and its body one of revolution, or the other way round; write `axisymmetric = true` \
                 in its [equation] where `state = \"axisymmetric\"`",
            )
        }
        Equation::Poisson { .. } if problem.domain() != body.domain() => Some(
            "has another body; leave out its [domain] and [[hole]], and name pieces without `from` and `to`",
        ),
        Equation::Poisson { .. } => {
            let is_other = paths(&problem.body) != paths(&body.clone().settled());
            is_other.then_some("has other cracks; leave all [domain], [[hole]] and [[crack]] out")
        }
        _ => {
            Some("must be one of Poisson's equation; write `kind = \"poisson\"` in its [equation]")
        }
    }
}

/// The text of a problem with that of its temperature's in place of the name of its file.
pub(super) fn with_text(text: &str, document: &DeTable<'_>, problem: &ProblemData) -> String {
    let heat = problem.temperature.as_ref().and_then(|heat| heat.problem.text.as_ref());
    let section = document.get("temperature").and_then(|section| section.get_ref().as_table());
    let value = section.and_then(|section| section.get("problem"));
    match (heat, value) {
        (Some(heat), Some(value))
            if !value.get_ref().as_str().is_some_and(|v| v.contains('\n')) =>
        {
            let (before, after) = (&text[..value.span().start], &text[value.span().end..]);
            format!("{before}{}{after}", quoted(heat))
        }
        _ => text.to_owned(),
    }
}

/// A text of several lines in quotes: as it is, so that its formulas can be read, unless it has
/// such quotes itself.
fn quoted(text: &str) -> String {
    if text.contains("'''") {
        let text = text.replace('\\', "\\\\").replace('"', "\\\"");
        return format!("\"\"\"\n{text}\"\"\"");
    }
    format!("'''\n{text}'''")
}
