//! The report of `ppum info`, in the shape of its JSON.

use std::collections::{BTreeMap, BTreeSet};

use ppum::crack::{self, tips};
use ppum::dataset::{self, BoxPartition, Dataset, FieldData, Step};
use ppum::field::{Field, FieldError};
use ppum::mesh::{Mesh, Shape};
use ppum::quantity::{available, face_names};
use ppum::text::LocationText;
use ppum_render::cells;
use ppum_scene::facts::{CommonFacts, CrackFacts, RecordFacts, ResultFacts};
use ppum_scene::range::places;
use ppum_solve::report::{is_convergence_record, is_of_level, is_of_phase};
use serde::Serialize;

use super::formulas::{self, FunctionRow, QuantityRow, TableRow};
use super::series::SeriesStepRow;
use crate::families::{Family, blocks, families};

#[derive(Debug, Serialize)]
pub(super) struct InfoReport {
    pub(super) file: String,
    #[serde(flatten)]
    pub(super) about: CommonFacts,
    pub(super) quantities: Vec<QuantityRow>,
    pub(super) tables: Vec<TableRow>,
    /// The number of steps.
    pub(super) count: usize,
    /// All steps in short, if that is asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) series: Option<Vec<SeriesStepRow>>,
    /// The step that is told of, the only one of its list.
    pub(super) steps: [StepReport; 1],
    /// The writer of places for people.
    #[serde(skip)]
    pub(super) places: LocationText,
    /// The larger side of the domain's box.
    #[serde(skip)]
    pub(super) arm: f64,
}

#[derive(Debug, Serialize)]
pub(super) struct StepReport {
    pub(super) step: usize,
    pub(super) load: f64,
    pub(super) patches: usize,
    pub(super) cells: usize,
    pub(super) points: usize,
    pub(super) weight: &'static str,
    pub(super) weight_formula: String,
    pub(super) weight_breakpoints: Vec<f64>,
    pub(super) levels: Vec<LevelCount>,
    /// The elements, if the patches are those of a mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) mesh: Option<MeshRow>,
    pub(super) orders: Vec<OrderRow>,
    pub(super) cracks: Vec<CrackFacts>,
    pub(super) tips: Vec<TipRow>,
    pub(super) functions: Vec<FunctionRow>,
    /// The functions for people.
    #[serde(skip)]
    pub(super) families: Vec<Family>,
    pub(super) fields: Vec<FieldRow>,
    pub(super) quantities: Vec<String>,
    /// Quantities of the faces of cracks.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) face_quantities: Vec<&'static str>,
    pub(super) attributes: Vec<String>,
    /// The values that `render` draws on the cells.
    pub(super) cell_values: Vec<String>,
    #[serde(flatten)]
    pub(super) results: ResultFacts,
    /// Records that no table tells of.
    #[serde(skip)]
    pub(super) other_history: Vec<String>,
}

/// The elements of a mesh.
#[derive(Debug, Serialize)]
pub(super) struct MeshRow {
    pub(super) elements: usize,
    pub(super) triangles: usize,
    pub(super) squares: usize,
    /// Patches that are parts of elements.
    pub(super) clipped: usize,
    /// Least and largest degree of the maps.
    pub(super) map_degrees: [u8; 2],
}

impl MeshRow {
    fn new(mesh: &Mesh) -> Self {
        let n = mesh.len();
        let triangles = mesh.shape.iter().filter(|shape| **shape == Shape::Triangle).count();
        let degrees = mesh.map_degree.iter().copied();
        Self {
            elements: mesh.element.iter().collect::<BTreeSet<_>>().len(),
            triangles,
            squares: n - triangles,
            clipped: (0..n).filter(|&patch| !mesh.clips(patch).is_empty()).count(),
            map_degrees: [degrees.clone().min(), degrees.max()].map(Option::unwrap_or_default),
        }
    }
}

/// Cells of a level of the tree.
#[derive(Debug, Serialize)]
pub(super) struct LevelCount {
    pub(super) level: u8,
    pub(super) cells: usize,
}

/// Patches whose polynomials have an order.
#[derive(Debug, Serialize)]
pub(super) struct OrderRow {
    pub(super) order: u8,
    pub(super) patches: usize,
}

#[derive(Debug, Serialize)]
pub(super) struct TipRow {
    pub(super) crack: u32,
    pub(super) end: &'static str,
    pub(super) at: [f64; 2],
}

#[derive(Debug, Serialize)]
pub(super) struct FieldRow {
    pub(super) name: String,
    pub(super) unit: String,
    pub(super) components: Vec<String>,
    pub(super) exact: Vec<String>,
}

impl InfoReport {
    /// The report of a dataset and one of its steps.
    pub(super) fn new(file: String, dataset: &Dataset, step: usize) -> Result<Self, FieldError> {
        let size = dataset.domain.bounds.size();
        Ok(Self {
            file,
            about: CommonFacts::new(dataset),
            quantities: formulas::quantities(dataset),
            tables: formulas::tables(dataset),
            count: dataset.steps.len(),
            series: None,
            steps: [StepReport::new(dataset, step)?],
            places: places(dataset),
            arm: size.x.max(size.y),
        })
    }
}

impl StepReport {
    fn new(dataset: &Dataset, index: usize) -> Result<Self, FieldError> {
        let field = Field::new(dataset, index)?;
        let Step { load, partition, cracks, functions, attributes, history, .. } = field.step;
        let mesh = partition.mesh().map(MeshRow::new);
        let (patches, partition) = (partition.len(), partition.boxes());
        let blocks = blocks(functions, field.data);
        let attribute = |a: &dataset::Attribute| a.name.clone();
        let other = history.iter().filter(|record| !is_in_tables(record));
        Ok(Self {
            step: index,
            load: *load,
            patches,
            cells: partition.cell.len(),
            points: partition.points.len(),
            weight: if mesh.is_some() { "" } else { partition.weight.name() },
            weight_formula: if mesh.is_some() {
                String::new()
            } else {
                formulas::weight(partition)
            },
            weight_breakpoints: match mesh {
                Some(_) => Vec::new(),
                None => partition.weight.breakpoints().to_vec(),
            },
            levels: levels(partition),
            mesh,
            orders: orders(field.data),
            cracks: cracks.iter().map(CrackFacts::new).collect(),
            tips: tip_rows(cracks),
            functions: formulas::functions(functions, &blocks),
            families: families(functions, &blocks),
            fields: field.step.fields.iter().map(field_row).collect(),
            quantities: available(&field),
            face_quantities: face_names(&field).collect(),
            attributes: attributes.iter().map(attribute).collect(),
            cell_values: cells::names(&field),
            results: ResultFacts::new(dataset, index),
            other_history: other.map(|record| RecordFacts::new(record).line()).collect(),
        })
    }
}

/// The number of times each value occurs, in rising order.
fn tally(values: impl Iterator<Item = u8>) -> BTreeMap<u8, usize> {
    let mut counts = BTreeMap::new();
    values.for_each(|value| *counts.entry(value).or_default() += 1);
    counts
}

fn levels(partition: &BoxPartition) -> Vec<LevelCount> {
    let counts = tally(partition.level.iter().copied());
    counts.into_iter().map(|(level, cells)| LevelCount { level, cells }).collect()
}

/// The order of a patch is the largest degree of its blocks.
fn orders(data: &FieldData) -> Vec<OrderRow> {
    let patches = 0..data.patch_blocks.len() - 1;
    let order = |patch| data.blocks(patch).map(|b| data.block_degree[b]).max().unwrap_or(0);
    let counts = tally(patches.map(order));
    counts.into_iter().map(|(order, patches)| OrderRow { order, patches }).collect()
}

fn tip_rows(cracks: &[crack::Crack]) -> Vec<TipRow> {
    let row = |tip: crack::TipId| TipRow {
        crack: tip.crack,
        end: tip.end.name(),
        at: cracks[tip.crack as usize].end_point(tip.end).into(),
    };
    tips(cracks).map(row).collect()
}

fn field_row(data: &FieldData) -> FieldRow {
    FieldRow {
        name: data.name.clone(),
        unit: data.unit.clone(),
        components: data.components.clone(),
        exact: data.exact.clone(),
    }
}

/// True for records that the table of the solver tells, or that only programs want.
fn is_in_tables(record: &dataset::Record) -> bool {
    is_of_phase(record) || is_of_level(record) || is_convergence_record(&record.name)
}
