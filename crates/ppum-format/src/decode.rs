//! Content → dataset: the layout of FORMAT.md, group by group, every name and shape checked.

mod functions;
mod group;
mod growth;
mod mesh;
mod tables;

use std::sync::Arc;

use ppum::crack::{Crack, CrackEnd};
use ppum::dataset::{
    Attribute, BoxPartition, Dataset, EIGENSTRAINS, EXPANSION, Eigenstrain, Elasticity, Equation,
    FieldData, NamedQuantity, Partition, Reaction, Record, Ring, Step, StressState, TipIntensity,
    Warning,
};
use ppum::domain::{Domain, Hole};
use ppum::expression::Expression;
use ppum::formula::Table;
use ppum::polynomial::PolynomialSpace;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::{WeightError, WeightFunction};

use crate::content::{ArrayValues, Content, Element, ObjectKind, step_path};
use crate::error::ReadError;
use crate::limits::FORMAT_VERSION;
use crate::names::{
    BOX_WITH_HOLES, BOXES, CRACK_ENDS, ELASTICITY, EQUATIONS, EquationKind, HOLES, MESH,
    NO_EQUATION, PLAIN_BOX, POISSON, STRESS_STATES, WEIGHTS,
};
use functions::functions;
pub(crate) use group::missing;
use group::{GroupReader, attempt, numbered, optional, read};
use growth::{growth, tip_ids};
use mesh::mesh;
use tables::{Scopes, tables};

type Read<T> = Result<T, ReadError>;

/// The minor version, if this is a dataset and of a major version that can be read here.
pub(crate) fn check_version(content: &Content) -> Read<u32> {
    let name = ArrayValues::Text(vec!["ppum".to_owned()]);
    if content.get("@format").is_none_or(|array| array.values != name) {
        return Err(ReadError::NotADataset);
    }
    let version = |group: &GroupReader| group.version();
    let [major, minor] = read(content, version).map_err(first)?;
    match major {
        0 => Err(ReadError::object("@format_version", "the major version is at least 1")),
        major if major > FORMAT_VERSION.0 => {
            Err(ReadError::TooNew { major: major.into(), minor: minor.into() })
        }
        _ => Ok(minor),
    }
}

fn first(errors: Vec<ReadError>) -> ReadError {
    errors.into_iter().next().unwrap_or(ReadError::NotADataset)
}

/// The dataset in a content. Shapes and words are right afterwards, meaning is not yet checked.
pub(crate) fn dataset(content: &Content) -> Read<Dataset> {
    read(content, whole).map_err(first)
}

/// What can be read of a dataset, and all that is wrong with the objects of its content, about
/// which the dataset says nothing.
pub(crate) fn diagnose(content: &Content) -> (Dataset, Vec<ReadError>) {
    attempt(content, whole)
}

fn whole(root: &GroupReader) -> Dataset {
    let (mut dataset, scopes) = head_of(root);
    dataset.steps = numbered(root, "steps", |group| step(group, &scopes));
    if root.is_fine() {
        let domain: String = root.group("domain").attribute("kind");
        dataset.steps.iter().enumerate().for_each(|(k, step)| one_kind(root, &domain, k, step));
    }
    dataset
}

/// A mesh is its own domain: domain and partition are both of the kind, or none of them.
fn one_kind(root: &GroupReader, domain: &str, number: usize, step: &Step) {
    let is_mesh = step.partition.mesh().is_some();
    if is_mesh != (domain == MESH) {
        let own = if is_mesh { MESH } else { BOXES };
        let mistake = format!(
            "`{own}` does not belong to a domain of the kind `{domain}`: both or none must be `{MESH}`"
        );
        root.group(&step_path(number)).group("partition").error("@kind", mistake);
    }
}

/// The step of the dataset with these tables, in a content that holds nothing else.
pub(crate) fn one_step(content: &Content, path: &str, tables: &[Arc<Table>]) -> Read<Step> {
    read(content, |root| step(&root.group(path), &scopes(root, tables))).map_err(first)
}

/// The members of a step that hold [`results`].
pub(crate) const RESULTS: &[&str] = &["cracks", "intensities", "history", "warnings", "growth"];

/// The cracks of a step, and what its solver tells of it, in a content that holds this alone. The
/// step has no patches.
pub(crate) fn results(content: &Content, path: &str) -> Read<Step> {
    let results = |root: &GroupReader| {
        let group = &root.group(path);
        let mut step = empty_step(group.attribute("load"));
        step.cracks = cracks(&group.group("cracks"));
        step.intensities = optional(group, "intensities", intensities);
        step.history = optional(group, "history", history);
        step.warnings = optional(group, "warnings", warnings);
        step.growth = optional(group, "growth", |group| Some(growth(group)));
        step
    };
    read(content, results).map_err(first)
}

/// A step with its load alone.
pub(crate) fn empty(content: &Content, path: &str) -> Read<Step> {
    read(content, |root| empty_step(root.group(path).attribute("load"))).map_err(first)
}

/// A step of this load, without patches.
pub(crate) fn empty_step(load: f64) -> Step {
    let mut step = Step::new(BoxPartition::EMPTY);
    step.load = load;
    step
}

/// The dataset without its steps.
pub(crate) fn head(content: &Content) -> Read<Dataset> {
    read(content, |root| head_of(root).0).map_err(first)
}

/// The dataset without its steps, and the scopes of its formulas if nothing is wrong with
/// the tables.
fn head_of(root: &GroupReader) -> (Dataset, Option<Scopes>) {
    let tables = tables(root);
    let scopes = if root.is_fine() { scopes(root, &tables) } else { None };
    let title = root.attribute("title");
    let program = root.attribute("program");
    let problem = root.holds("problem", ObjectKind::Dataset).then(|| root.scalar("problem"));
    let domain = domain(&root.group("domain"));
    let mut dataset = Dataset::new(domain, equation(&root.group("equation"), &scopes));
    (dataset.title, dataset.program, dataset.problem) = (title, program, problem);
    dataset.quantities = optional(root, "quantities", quantities);
    dataset.tables = tables;
    (dataset, scopes)
}

/// Scopes of formulas with these tables, if their names do not clash.
fn scopes(root: &GroupReader, tables: &[Arc<Table>]) -> Option<Scopes> {
    root.or_report(Scopes::new(tables))
}

fn domain(group: &GroupReader) -> Domain {
    let bounds = Rect::new(group.attribute_point("min"), group.attribute_point("max"));
    let words = [PLAIN_BOX, BOX_WITH_HOLES, MESH].map(|word| (word, word));
    let holes = match group.attribute_word(&words, "kind") {
        Some(BOX_WITH_HOLES) => holes(&group.group("holes")),
        Some(word) => {
            group.refuse("holes", ObjectKind::Group, word);
            Vec::new()
        }
        None => Vec::new(),
    };
    Domain { bounds, holes }
}

fn holes(group: &GroupReader) -> Vec<Hole> {
    let n = group.rows_of(&["kind", "radius"]);
    let (kinds, radii) = (group.column::<String>("kind", n), group.column::<f64>("radius", n));
    let parts = group.parts("offsets", n, ("points", &group.points("points")));
    let rows = kinds.iter().zip(parts).zip(radii);
    let hole = |((kind, points), radius): ((&String, Vec<Vec2>), f64)| {
        match (group.word(HOLES, kind, "kind")?, &*points) {
            (None, &[center]) => return Some(Hole::Circle { center, radius }),
            (None, _) if group.is_wrong("points") => {}
            (None, other) => {
                group.error("offsets", format!("a circle has 1 point, not {}", other.len()));
            }
            (Some(side), _) if radius == 0.0 => return Some(Hole::Polygon { points, side }),
            (Some(_), _) => group.error("radius", format!("is {radius} of a polygon, must be 0")),
        }
        None
    };
    rows.filter_map(hole).collect()
}

fn equation(group: &GroupReader, scopes: &Option<Scopes>) -> Equation {
    let constant = |name| constant(group, name, scopes);
    match group.attribute_word(EQUATIONS, "kind") {
        Some(kind @ (EquationKind::Elasticity | EquationKind::Eigenstrain)) => {
            group.refuse("conductivity", ObjectKind::Attribute, ELASTICITY);
            if kind == EquationKind::Elasticity {
                let refuse = |name| group.refuse(name, ObjectKind::Attribute, ELASTICITY);
                EIGENSTRAINS.into_iter().chain([EXPANSION]).for_each(refuse);
            }
            Equation::Elasticity(Elasticity {
                young: constant("young"),
                poisson: constant("poisson"),
                state: group
                    .attribute_word(STRESS_STATES, "state")
                    .unwrap_or(StressState::PlaneStrain),
                eigenstrain: (kind == EquationKind::Eigenstrain).then(|| {
                    let expansion = group.has_attribute(EXPANSION).then(|| constant(EXPANSION));
                    Box::new(Eigenstrain { strains: EIGENSTRAINS.map(constant), expansion })
                }),
            })
        }
        Some(EquationKind::Poisson) => {
            for name in ["young", "poisson", "state"] {
                group.refuse(name, ObjectKind::Attribute, POISSON);
            }
            Equation::Poisson { conductivity: constant("conductivity") }
        }
        Some(EquationKind::None) => {
            for name in ["young", "poisson", "state", "conductivity"] {
                group.refuse(name, ObjectKind::Attribute, NO_EQUATION);
            }
            Equation::None
        }
        None => Equation::poisson(1.0),
    }
}

/// A constant of the material: a number, or the text of a formula.
fn constant(group: &GroupReader, name: &str, scopes: &Option<Scopes>) -> Expression {
    if !group.has_text(name) {
        return Expression::number(group.attribute(name));
    }
    let text: String = group.attribute(name);
    let parsed = scopes.as_ref().and_then(|scopes| {
        let parsed = Expression::parse_in(&text, &scopes.plane);
        parsed.map_err(|error| group.error(&format!("@{name}"), error.to_string())).ok()
    });
    parsed.unwrap_or_else(|| Expression::number(1.0))
}

fn quantities(group: &GroupReader) -> Vec<NamedQuantity> {
    let n = group.rows_of(&["name", "formula", "unit"]);
    let [names, formulas, units] =
        ["name", "formula", "unit"].map(|name| group.column::<String>(name, n));
    let all = names.into_iter().zip(formulas).zip(units);
    all.map(|((name, text), unit)| NamedQuantity { name, text, unit }).collect()
}

fn step(group: &GroupReader, scopes: &Option<Scopes>) -> Step {
    let load = group.attribute("load");
    let mut step = Step::new(partition(&group.group("partition"), scopes));
    step.load = load;
    step.cracks = cracks(&group.group("cracks"));
    step.functions = functions(&group.group("functions"));
    step.fields = numbered(group, "fields", field);
    step.attributes = optional(group, "attributes", attributes);
    step.intensities = optional(group, "intensities", intensities);
    step.history = optional(group, "history", history);
    step.warnings = optional(group, "warnings", warnings);
    step.reactions = optional(group, "reactions", reactions);
    step.growth = optional(group, "growth", |group| Some(growth(group)));
    step
}

fn partition(group: &GroupReader, scopes: &Option<Scopes>) -> Partition {
    let kind = group.attribute_word(&[(false, BOXES), (true, MESH)], "kind");
    // of an unknown kind the arrays are read as what they look like: one error, not one for each
    // that is missing
    match kind.unwrap_or_else(|| group.row_count("shape").is_some()) {
        true => mesh(group).into(),
        false => boxes(group, scopes).into(),
    }
}

/// The optional arrays of cells.
const CELLS: [&str; 2] = ["cell", "level"];

fn boxes(group: &GroupReader, scopes: &Option<Scopes>) -> BoxPartition {
    let n = group.rows_of(&["center", "half", "origin", "scale", "cell", "level", "point"]);
    let has_cells = has_cells(group);
    let point = group.column::<i64>("point", n);
    BoxPartition {
        weight: weight(group, scopes).unwrap_or(WeightFunction::Linear),
        center: group.point_rows("center", n),
        half: group.point_rows("half", n),
        origin: group.point_rows("origin", n),
        scale: group.point_rows("scale", n),
        cell: if has_cells { cells(group, n) } else { Vec::new() },
        level: if has_cells { group.column("level", n) } else { Vec::new() },
        point: point.into_iter().map(|p| point_index(group, p)).collect(),
        points: group.points("points"),
    }
}

/// True if there are cells; an error if there is one of their arrays without the other.
fn has_cells(group: &GroupReader) -> bool {
    let [cell, level] = CELLS.map(|name| group.holds(name, ObjectKind::Dataset));
    if cell != level {
        let [missing, other] = if level { CELLS } else { [CELLS[1], CELLS[0]] };
        group.error(
            missing,
            format!("is missing; a cover without cells has no `{other}` either, leave it out too"),
        );
    }
    cell && level
}

fn cells(group: &GroupReader, rows: usize) -> Vec<Rect> {
    let cell = |[x0, y0, x1, y1]: [f64; 4]| Rect::new(vec2(x0, y0), vec2(x1, y1));
    group.rows("cell", rows).into_iter().map(cell).collect()
}

fn weight(group: &GroupReader, scopes: &Option<Scopes>) -> Option<WeightFunction> {
    let word: Option<Option<WeightFunction>> = group.attribute_word(WEIGHTS, "weight");
    let breakpoints = group.vector::<f64>("weight_breakpoints");
    match word? {
        None => {
            if !breakpoints.is_sorted_by(|a, b| a < b) {
                group.error("weight_breakpoints", "must increase from each to the next");
                return None;
            }
            let text: String = group.attribute("weight_formula");
            let scope = &scopes.as_ref()?.weight;
            let weight = WeightFunction::formula_with_breakpoints(&text, scope, &breakpoints);
            let place = |error: &WeightError| match error {
                WeightError::Breakpoint(_) => "weight_breakpoints",
                _ => "@weight_formula",
            };
            weight.map_err(|error| group.error(place(&error), error.to_string())).ok()
        }
        Some(weight) => {
            let name = weight.name();
            group.refuse("weight_formula", ObjectKind::Attribute, name);
            let right = weight.breakpoints();
            if breakpoints != right {
                let mistake = format!("are {breakpoints:?}, but those of `{name}` are {right:?}");
                group.error("weight_breakpoints", mistake);
            }
            Some(weight)
        }
    }
}

fn point_index(group: &GroupReader, p: i64) -> Option<u32> {
    let index = u32::try_from(p).ok();
    if index.is_none() && p != -1 {
        group.error("point", format!("{p} is neither an index nor -1"));
    }
    index
}

fn cracks(group: &GroupReader) -> Vec<Crack> {
    let by_offsets = || group.rows_of(&["offsets"]).saturating_sub(1);
    let n = group.row_count("ends").unwrap_or_else(by_offsets);
    let ends = group.rows::<String, 2>("ends", n);
    let parts = group.parts("offsets", n, ("points", &group.points("points")));
    let kind = |word: &str| group.word(CRACK_ENDS, word, "ends").unwrap_or(CrackEnd::Tip);
    let all = parts.into_iter().zip(ends);
    all.map(|(points, [start, last])| Crack { points, ends: [kind(&start), kind(&last)] }).collect()
}

fn field(group: &GroupReader) -> FieldData {
    let components = group.rows_of(&["components", "coefficients"]);
    let blocks = group.rows_of(&["block_function", "block_degree", "block_offset"]);
    let mut data = FieldData::new(&group.attribute::<String>("name"), &[]);
    data.unit = group.attribute("unit");
    data.exact = optional_vector(group, "exact").unwrap_or_default();
    data.patch_blocks = group.vector("patch_blocks");
    data.block_function = group.column("block_function", blocks);
    data.block_degree = group.column("block_degree", blocks);
    data.block_offset = group.column("block_offset", blocks);
    if group.holds("block_space", ObjectKind::Dataset) {
        let spaces = mesh::spaces(group, "block_space", blocks);
        data.block_space =
            if spaces.contains(&PolynomialSpace::Tensor) { spaces } else { Vec::new() };
    }
    data.coefficients = group.matrix("coefficients", components);
    data.components = group.column("components", components);
    data
}

fn optional_vector<T: Element>(group: &GroupReader, name: &str) -> Option<Vec<T>> {
    group.holds(name, ObjectKind::Dataset).then(|| group.vector(name))
}

fn attributes(group: &GroupReader) -> Vec<Attribute> {
    let n = group.rows_of(&["name", "values"]);
    let (names, values) = (group.column::<String>("name", n), group.matrix("values", n));
    std::iter::zip(names, values).map(|(name, values)| Attribute { name, values }).collect()
}

fn intensities(group: &GroupReader) -> Vec<TipIntensity> {
    let n = group.rows_of(&["crack", "end", "k1", "k2"]);
    let tips = tip_ids(group, n);
    let (k1, k2) = (group.column::<f64>("k1", n), group.column::<f64>("k2", n));
    let ring = |[r1, r2, k1, k2]: [f64; 4]| Ring { r1, r2, k1, k2 };
    let rings: Vec<Ring> = group.all_rows("rings").into_iter().map(ring).collect();
    let parts = group.parts("ring_offsets", n, ("rings", &rings));
    let [t_stress, j, error] = ["t_stress", "j", "error"].map(|name| known(group, name, n));
    let intensity = |(k, rings): (usize, Vec<Ring>)| TipIntensity {
        t_stress: t_stress[k],
        j: j[k],
        error: error[k],
        rings,
        ..TipIntensity::new(tips[k], k1[k], k2[k])
    };
    parts.into_iter().enumerate().map(intensity).collect()
}

/// Values that are not there, or NaN, where they are not known.
fn known(group: &GroupReader, name: &str, n: usize) -> Vec<Option<f64>> {
    if !group.holds(name, ObjectKind::Dataset) {
        return vec![None; n];
    }
    let values = group.column::<f64>(name, n);
    values.into_iter().map(|v| (!v.is_nan()).then_some(v)).collect()
}

fn history(group: &GroupReader) -> Vec<Record> {
    let n = group.rows_of(&["name", "value", "unit"]);
    let [names, units] = ["name", "unit"].map(|name| group.column::<String>(name, n));
    let values = group.column::<f64>("value", n);
    let records = names.into_iter().zip(values).zip(units);
    records.map(|((name, value), unit)| Record { name, value, unit }).collect()
}

fn warnings(group: &GroupReader) -> Vec<Warning> {
    let n = group.rows_of(&["kind", "message", "at", "value", "limit"]);
    let [kinds, messages] = ["kind", "message"].map(|name| group.column::<String>(name, n));
    let at = group.point_rows("at", n);
    let [values, limits] = ["value", "limit"].map(|name| group.column::<f64>(name, n));
    let place = |k: usize| (!at[k].x.is_nan() || !at[k].y.is_nan()).then_some(at[k]);
    let texts = kinds.into_iter().zip(messages).enumerate();
    let warning = |(k, (kind, message))| {
        let (value, limit) = (values[k], limits[k]);
        Warning { kind, at: place(k), value, limit, message }
    };
    texts.map(warning).collect()
}

fn reactions(group: &GroupReader) -> Vec<Reaction> {
    let n = group.rows_of(&["on", "held", "force", "moment"]);
    let places = group.column::<String>("on", n);
    let (held, forces) = (group.matrix("held", n), group.matrix("force", n));
    let moments = group.column::<f64>("moment", n);
    let is_held = |h: f64| {
        if h != 0.0 && h != 1.0 {
            group.error("held", format!("{h}: expected 0 or 1"));
        }
        h == 1.0
    };
    let results = places.into_iter().zip(held).zip(forces.into_iter().zip(moments));
    let reaction = |((on, held), (force, moment)): ((String, Vec<f64>), (Vec<f64>, f64))| {
        Reaction { on, held: held.into_iter().map(is_held).collect(), force, moment }
    };
    results.map(reaction).collect()
}

#[cfg(test)]
mod tests;
