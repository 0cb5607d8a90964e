//! Dataset → content: the layout of FORMAT.md, group by group.

use std::sync::Arc;

use ppum::dataset::{BoxPartition, Dataset, Equation, FieldData, Growth, Partition, Step};
use ppum::domain::Domain;
use ppum::formula::Table;
use ppum::mesh::Mesh;
use ppum::weight::WeightFunction;

use crate::content::{Array, ArrayValues, ObjectTree, step_path};
use crate::error::WriteError;
use crate::limits::{FORMAT_VERSION, MAX_TABLE_VALUES};
use crate::schema::{self, StoredFunction, StoredHole};
use crate::stored::{DomainKind, EquationKind, PartitionKind};
use crate::writer::{EncodeResult, GroupWriter};

/// Everything of a dataset under its names in the file, without checksums.
pub(crate) fn content(dataset: &Dataset) -> Result<ObjectTree, WriteError> {
    beginning(dataset, dataset.steps.len())
}

/// Encodes the first steps alone.
pub(crate) fn beginning(dataset: &Dataset, steps: usize) -> Result<ObjectTree, WriteError> {
    let mut content = ObjectTree::new();
    let mut root = GroupWriter { path: String::new(), content: &mut content };
    root.attribute("format", &"ppum".to_owned())?;
    root.attribute("format_version", &<[u32; 2]>::from(FORMAT_VERSION))?;
    root.attribute("program", &dataset.program)?;
    root.attribute("title", &dataset.title)?;
    if let Some(problem) = &dataset.problem {
        root.array("problem", Array::scalar(problem.clone()));
    }
    let is_mesh = dataset.steps.iter().any(|step| step.partition.mesh().is_some());
    domain(&mut root.group("domain"), &dataset.domain, is_mesh)?;
    equation(&mut root.group("equation"), &dataset.equation)?;
    tables(&mut root, &dataset.tables)?;
    root.group("quantities").table_of_some(schema::QUANTITIES, &dataset.quantities)?;
    for (k, s) in dataset.steps.iter().take(steps).enumerate() {
        step(&mut root.group(&step_path(k)), s)?;
    }
    Ok(content)
}

/// A step under its names in the file.
pub(crate) fn one_step(number: usize, one: &Step) -> Result<ObjectTree, WriteError> {
    let mut content = ObjectTree::new();
    step(&mut GroupWriter { path: step_path(number), content: &mut content }, one)?;
    Ok(content)
}

fn domain(group: &mut GroupWriter, domain: &Domain, is_mesh: bool) -> EncodeResult {
    let kind = match (is_mesh, domain.holes.is_empty()) {
        (true, _) => DomainKind::Mesh,
        (false, true) => DomainKind::Box,
        (false, false) => DomainKind::BoxWithHoles,
    };
    group.attribute("kind", &kind)?;
    group.attribute("min", &domain.bounds.min)?;
    group.attribute("max", &domain.bounds.max)?;
    let holes: Vec<_> = domain.holes.iter().map(StoredHole::of).collect();
    group.group("holes").table_of_some(schema::HOLES, &holes)
}

fn equation(group: &mut GroupWriter, equation: &Equation) -> EncodeResult {
    for (name, expression) in equation.constants() {
        match expression.constant() {
            Some(value) => group.attribute(name, &value)?,
            None => group.attribute(name, &expression.text().to_owned())?,
        }
    }
    let kind = match equation {
        Equation::Elasticity(elasticity) => {
            group.attribute("state", &elasticity.state)?;
            let is_strained = elasticity.eigenstrain.is_some();
            if is_strained { EquationKind::Eigenstrain } else { EquationKind::Elasticity }
        }
        Equation::Poisson { .. } => EquationKind::Poisson,
        Equation::None => EquationKind::None,
    };
    group.attribute("kind", &kind)
}

fn tables(root: &mut GroupWriter, tables: &[Arc<Table>]) -> EncodeResult {
    for (k, table) in tables.iter().enumerate() {
        let mut group = root.group(&format!("tables/{k:04}"));
        let (x, y, values) = (table.x(), table.y(), table.values());
        group.attribute("name", &table.name().to_owned())?;
        group.put("x", x)?;
        if y.is_empty() {
            group.put("values", values)?;
        } else {
            group.put("y", y)?;
            let shape = vec![y.len() as u64, x.len() as u64];
            group.array("values", Array { shape, values: ArrayValues::F64(values.to_vec()) });
        }
    }
    let total: usize = tables.iter().map(|table| table.values().len()).sum();
    if total > MAX_TABLE_VALUES {
        let mistake = format!("have {total} values together; at most {MAX_TABLE_VALUES} may be");
        return Err(WriteError::object("tables", mistake));
    }
    Ok(())
}

fn step(group: &mut GroupWriter, step: &Step) -> EncodeResult {
    group.attribute("load", &step.load)?;
    match &step.partition {
        Partition::Boxes(boxes) => partition(&mut group.group("partition"), boxes)?,
        Partition::Mesh(one) => mesh(&mut group.group("partition"), one)?,
        _ => return Err(group.unknown("partition")),
    }
    group.group("cracks").columns(schema::CRACKS, &step.cracks)?;
    let mut functions = group.group("functions");
    let rows: Option<Vec<_>> = step.functions.iter().map(StoredFunction::of).collect();
    functions.columns(schema::FUNCTIONS, &rows.ok_or_else(|| functions.unknown("kind"))?)?;
    for (k, f) in step.fields.iter().enumerate() {
        field(&mut group.group(&format!("fields/{k:04}")), f)?;
    }
    let mut attributes = group.group("attributes");
    attributes.columns(schema::ATTRIBUTES, &step.attributes)?;
    if step.attributes.is_empty() {
        attributes.array("values", Array::matrix(&[[]; 0], step.partition.len()));
    }
    group.group("intensities").columns(schema::INTENSITIES, &step.intensities)?;
    group.group("history").columns(schema::HISTORY, &step.history)?;
    group.group("warnings").table_of_some(schema::WARNINGS, &step.warnings)?;
    group.group("reactions").table_of_some(schema::REACTIONS, &step.reactions)?;
    step.growth.iter().try_for_each(|g| growth(&mut group.group("growth"), g))
}

fn partition(group: &mut GroupWriter, partition: &BoxPartition) -> EncodeResult {
    let weight = &partition.weight;
    group.attribute("kind", &PartitionKind::Boxes)?;
    group.attribute("weight", &weight.name().to_owned())?;
    if let WeightFunction::Formula(formula) = weight {
        group.attribute("weight_formula", &formula.text().to_owned())?;
    }
    group.put("weight_breakpoints", weight.breakpoints())?;
    group.columns(schema::BOXES, partition)
}

fn mesh(group: &mut GroupWriter, mesh: &Mesh) -> EncodeResult {
    group.attribute("kind", &PartitionKind::Mesh)?;
    group.columns(schema::MESH, mesh)?;
    if !mesh.clips.is_empty() {
        group.columns(schema::CLIP_OFFSETS, mesh)?;
        group.columns(schema::CLIPS, &mesh.clips)?;
    }
    Ok(())
}

fn field(group: &mut GroupWriter, field: &FieldData) -> EncodeResult {
    group.attribute("name", &field.name)?;
    group.attribute("unit", &field.unit)?;
    group.columns(schema::FIELD, field)
}

fn growth(group: &mut GroupWriter, growth: &Growth) -> EncodeResult {
    growth.cycles.iter().try_for_each(|cycles| group.attribute("cycles", cycles))?;
    growth.stop.iter().try_for_each(|stop| group.attribute("stop", stop))?;
    group.columns(schema::GROWTH, &growth.tips)
}
