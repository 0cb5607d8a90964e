//! Content → dataset: the layout of FORMAT.md, group by group, every name and shape checked.

mod tables;

use std::sync::Arc;

use ppum::dataset::{
    BoxPartition, Dataset, EIGENSTRAINS, EXPANSION, Eigenstrain, Elasticity, Equation, FieldData,
    Growth, Partition, Step,
};
use ppum::domain::Domain;
use ppum::expression::Expression;
use ppum::formula::Table;
use ppum::function::{Function, FunctionKind};
use ppum::mesh::Mesh;
use ppum::polynomial::PolynomialSpace;
use ppum::vec2::Rect;
use ppum::weight::{WeightError, WeightFunction};

use crate::content::{ArrayValues, ObjectKind, ObjectTree, step_path};
use crate::error::ReadError;
use crate::limits::FORMAT_VERSION;
pub(crate) use crate::reader::missing;
use crate::reader::{GroupReader, attempt, numbered, optional, read};
use crate::schema::{self, StoredFunction, StoredHole};
use crate::stored::{DomainKind, EquationKind, PartitionKind, StoredWord as _, WEIGHTS};
use tables::{Scopes, tables};

type DecodeResult<T> = Result<T, ReadError>;

/// The minor version, if this is a dataset and of a major version that can be read here.
pub(crate) fn check_version(content: &ObjectTree) -> DecodeResult<u32> {
    let name = ArrayValues::Text(vec!["ppum".to_owned()]);
    if content.get("@format").is_none_or(|array| array.values != name) {
        return Err(ReadError::NotADataset);
    }
    let version = |group: &GroupReader| group.attribute::<[u32; 2]>("format_version");
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
pub(crate) fn dataset(content: &ObjectTree) -> DecodeResult<Dataset> {
    read(content, whole).map_err(first)
}

/// Reads as much of a dataset as possible, and lists all errors in the objects of its content,
/// about which the dataset says nothing.
pub(crate) fn diagnose(content: &ObjectTree) -> (Dataset, Vec<ReadError>) {
    attempt(content, whole)
}

fn whole(root: &GroupReader) -> Dataset {
    let (mut dataset, scopes) = head_of(root);
    dataset.steps = numbered(root, "steps", |group| step(group, &scopes));
    if root.is_fine() {
        let domain: DomainKind = root.group("domain").attribute("kind");
        dataset.steps.iter().enumerate().for_each(|(k, step)| one_kind(root, domain, k, step));
    }
    dataset
}

/// A mesh is its own domain: domain and partition are both of the kind, or none of them.
fn one_kind(root: &GroupReader, domain: DomainKind, number: usize, step: &Step) {
    let is_mesh = step.partition.mesh().is_some();
    let own = if is_mesh { PartitionKind::Mesh } else { PartitionKind::Boxes };
    if is_mesh != (domain == DomainKind::Mesh) {
        let [own, domain] = [own.word(), domain.word()].map(Option::unwrap_or_default);
        let mistake = format!(
            "`{own}` does not belong to a domain of the kind `{domain}`: both or none must be `mesh`"
        );
        root.group(&step_path(number)).group("partition").error("@kind", mistake);
    }
}

/// The step of the dataset with these tables, in a content that holds nothing else.
pub(crate) fn one_step(
    content: &ObjectTree,
    path: &str,
    tables: &[Arc<Table>],
) -> DecodeResult<Step> {
    read(content, |root| step(&root.group(path), &scopes(root, tables))).map_err(first)
}

/// The members of a step that hold [`results`].
pub(crate) const RESULTS: &[&str] = &["cracks", "intensities", "history", "warnings", "growth"];

/// The cracks of a step, and what its solver tells of it, in a content that holds this alone. The
/// step has no patches.
pub(crate) fn results(content: &ObjectTree, path: &str) -> DecodeResult<Step> {
    let results = |root: &GroupReader| {
        let group = &root.group(path);
        let mut step = empty_step(group.attribute("load"));
        results_of(group, &mut step);
        step
    };
    read(content, results).map_err(first)
}

fn results_of(group: &GroupReader, step: &mut Step) {
    step.cracks = group.group("cracks").table(schema::CRACKS);
    step.intensities = optional(group, "intensities", |group| group.table(schema::INTENSITIES));
    step.history = optional(group, "history", |group| group.table(schema::HISTORY));
    step.warnings = optional(group, "warnings", |group| group.table(schema::WARNINGS));
    step.growth = optional(group, "growth", |group| Some(growth(group)));
}

/// A step with its load alone.
pub(crate) fn empty(content: &ObjectTree, path: &str) -> DecodeResult<Step> {
    read(content, |root| empty_step(root.group(path).attribute("load"))).map_err(first)
}

/// A step of this load, without patches.
pub(crate) fn empty_step(load: f64) -> Step {
    let mut step = Step::new(BoxPartition::EMPTY);
    step.load = load;
    step
}

/// The dataset without its steps.
pub(crate) fn head(content: &ObjectTree) -> DecodeResult<Dataset> {
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
    dataset.quantities = optional(root, "quantities", |group| group.table(schema::QUANTITIES));
    dataset.tables = tables;
    (dataset, scopes)
}

/// Scopes of formulas with these tables, if their names do not clash.
fn scopes(root: &GroupReader, tables: &[Arc<Table>]) -> Option<Scopes> {
    root.or_report(Scopes::new(tables))
}

fn domain(group: &GroupReader) -> Domain {
    let bounds = Rect::new(group.attribute("min"), group.attribute("max"));
    let holes = match group.known_attribute("kind") {
        Some(DomainKind::BoxWithHoles) => {
            let group = group.group("holes");
            let rows = group.table(schema::HOLES).into_iter();
            rows.filter_map(|row: StoredHole| row.hole(&group)).collect()
        }
        kind => {
            let words = kind.and_then(DomainKind::word);
            words.into_iter().for_each(|word| group.refuse("holes", ObjectKind::Group, word));
            Vec::new()
        }
    };
    Domain { bounds, holes }
}

/// Attributes of materials, without those of given strains.
const CONSTANTS: [&str; 4] = ["young", "poisson", "state", "conductivity"];

fn equation(group: &GroupReader, scopes: &Option<Scopes>) -> Equation {
    let constant = |name| constant(group, name, scopes);
    let kind: Option<EquationKind> = group.known_attribute("kind");
    let refuse = |names: &[&str]| {
        let word = match kind {
            Some(EquationKind::Eigenstrain) => Some(EquationKind::Elasticity),
            other => other,
        };
        let word = word.and_then(EquationKind::word).unwrap_or_default();
        names.iter().for_each(|name| group.refuse(name, ObjectKind::Attribute, word));
    };
    match kind {
        Some(kind @ (EquationKind::Elasticity | EquationKind::Eigenstrain)) => {
            refuse(&CONSTANTS[3..]);
            if kind == EquationKind::Elasticity {
                refuse(&[&EIGENSTRAINS[..], &[EXPANSION]].concat());
            }
            Equation::Elasticity(Elasticity {
                young: constant("young"),
                poisson: constant("poisson"),
                state: group.attribute("state"),
                eigenstrain: (kind == EquationKind::Eigenstrain).then(|| {
                    let expansion = group.has_attribute(EXPANSION).then(|| constant(EXPANSION));
                    Box::new(Eigenstrain { strains: EIGENSTRAINS.map(constant), expansion })
                }),
            })
        }
        Some(EquationKind::Poisson) => {
            refuse(&CONSTANTS[..3]);
            Equation::Poisson { conductivity: constant("conductivity") }
        }
        Some(EquationKind::None) => {
            refuse(&CONSTANTS);
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

fn step(group: &GroupReader, scopes: &Option<Scopes>) -> Step {
    let load = group.attribute("load");
    let mut step = Step::new(partition(&group.group("partition"), scopes));
    step.load = load;
    results_of(group, &mut step);
    let functions = group.group("functions");
    let rows: Vec<StoredFunction> = functions.table(schema::FUNCTIONS);
    let function = |(k, row): (usize, StoredFunction)| {
        let one = || Function { name: String::new(), kind: FunctionKind::One };
        row.function(&functions, k).unwrap_or_else(one)
    };
    step.functions = rows.into_iter().enumerate().map(function).collect();
    step.fields = numbered(group, "fields", field);
    step.attributes = optional(group, "attributes", |group| group.table(schema::ATTRIBUTES));
    step.reactions = optional(group, "reactions", |group| group.table(schema::REACTIONS));
    step
}

fn partition(group: &GroupReader, scopes: &Option<Scopes>) -> Partition {
    // of an unknown kind the arrays are read as what they look like: one error, not one for each
    // that is missing
    match group.known_attribute("kind") {
        Some(PartitionKind::Mesh) => mesh(group).into(),
        None if group.row_count("shape").is_some() => mesh(group).into(),
        _ => boxes(group, scopes).into(),
    }
}

fn mesh(group: &GroupReader) -> Mesh {
    let (n, mut mesh) = (group.count(schema::MESH), Mesh::default());
    group.take(schema::MESH, n, &mut mesh);
    let clips = schema::CLIPS.iter().map(|column| column.names.array);
    let mut clips = clips.chain([schema::CLIP_OFFSETS[0].names.array]);
    if clips.any(|name| group.holds(name, ObjectKind::Dataset)) {
        group.take(schema::CLIP_OFFSETS, n, &mut mesh);
        mesh.clips = group.table(schema::CLIPS);
    }
    mesh
}

fn boxes(group: &GroupReader, scopes: &Option<Scopes>) -> BoxPartition {
    let mut boxes = BoxPartition::EMPTY;
    group.take(schema::BOXES, group.count(schema::BOXES), &mut boxes);
    boxes.weight = weight(group, scopes).unwrap_or(WeightFunction::Linear);
    let cells = ["cell", "level"];
    let [cell, level] = cells.map(|name| group.holds(name, ObjectKind::Dataset));
    if cell != level {
        let [missing, other] = if level { cells } else { [cells[1], cells[0]] };
        group.error(
            missing,
            format!("is missing; a cover without cells has no `{other}` either, leave it out too"),
        );
    }
    boxes
}

fn weight(group: &GroupReader, scopes: &Option<Scopes>) -> Option<WeightFunction> {
    let word: Option<String> = group.known_attribute("weight");
    let breakpoints: Vec<f64> = group.list("weight_breakpoints");
    match group.word(WEIGHTS, &word?, "@weight")? {
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

fn field(group: &GroupReader) -> FieldData {
    let mut data = FieldData::new(&group.attribute::<String>("name"), &[]);
    data.unit = group.attribute("unit");
    group.take(schema::FIELD, group.count(schema::FIELD), &mut data);
    if !data.block_space.contains(&PolynomialSpace::Tensor) {
        data.block_space = Vec::new();
    }
    data
}

fn growth(group: &GroupReader) -> Growth {
    let mut growth = Growth::default();
    growth.cycles = group.holds("cycles", ObjectKind::Attribute).then(|| group.attribute("cycles"));
    if group.holds("stop", ObjectKind::Attribute) {
        growth.stop = group.known_attribute("stop");
    }
    growth.tips = group.table(schema::GROWTH);
    growth
}

#[cfg(test)]
mod tests;
