//! The report of `ppum info`, in the shape of its JSON.

use std::collections::BTreeMap;
use std::fmt;

use ppum::crack::{Crack, CrackEnd, tips};
use ppum::dataset::{Dataset, Equation, FieldData, Partition, Record, Step, StressState};
use ppum::domain::Hole;
use ppum::expression::Expression;
use ppum::field::{Field, FieldError};
use ppum::quantity::available;
use ppum::text::{Places, trimmed};
use ppum::vec2::Vec2;
use ppum_render::cells;
use ppum_solve::report::{SolverReport, is_of_course, is_of_level, is_of_phase};
use serde::Serialize;

use super::formulas::{self, FunctionRow, QuantityRow, TableRow};
use super::growth::GrowthRow;
use super::reactions::{self, ReactionRow};
use super::series::StepRow;
use super::solver::SolverRow;
use ppum_scene::range::places;

use crate::families::{Family, blocks, families};
use crate::number::Number;
use crate::tips::{Tip, all_tips};
use crate::warnings::{WarningRow, rows};

#[derive(Debug, Serialize)]
pub(super) struct Report {
    pub(super) file: String,
    pub(super) title: String,
    pub(super) program: String,
    pub(super) domain: Domain,
    pub(super) equation: EquationRow,
    pub(super) quantities: Vec<QuantityRow>,
    pub(super) tables: Vec<TableRow>,
    /// The number of steps.
    pub(super) count: usize,
    /// All steps in short, if that is asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) series: Option<Vec<StepRow>>,
    /// The step that is told of, the only one of its list.
    pub(super) steps: [StepReport; 1],
    /// The writer of places for people.
    #[serde(skip)]
    pub(super) places: Places,
}

#[derive(Debug, Serialize)]
pub(super) struct Domain {
    pub(super) min: [f64; 2],
    pub(super) max: [f64; 2],
    pub(super) holes: Vec<HoleRow>,
}

#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub(super) enum HoleRow {
    Circle { center: [f64; 2], radius: f64 },
    Polygon { points: Vec<[f64; 2]> },
}

impl From<&Hole> for HoleRow {
    fn from(hole: &Hole) -> Self {
        match hole {
            Hole::Circle { center, radius } => {
                Self::Circle { center: (*center).into(), radius: *radius }
            }
            Hole::Polygon { points } => {
                Self::Polygon { points: points.iter().copied().map(Vec2::into).collect() }
            }
        }
    }
}

#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub(super) enum EquationRow {
    Elasticity { young: Constant, poisson: Constant, state: &'static str },
    Poisson { conductivity: Constant },
}

/// A constant of the material: a number, or the text of a formula.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub(super) enum Constant {
    Number(f64),
    Formula(String),
}

impl From<&Expression> for Constant {
    fn from(expression: &Expression) -> Self {
        match expression.constant() {
            Some(value) => Self::Number(value),
            None => Self::Formula(expression.text().to_owned()),
        }
    }
}

impl fmt::Display for Constant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(value) => f.write_str(&trimmed(*value)),
            Self::Formula(text) => f.write_str(text),
        }
    }
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
    pub(super) levels: Vec<Level>,
    pub(super) orders: Vec<Order>,
    pub(super) cracks: Vec<CrackRow>,
    pub(super) tips: Vec<TipRow>,
    pub(super) functions: Vec<FunctionRow>,
    /// The functions for people.
    #[serde(skip)]
    pub(super) families: Vec<Family>,
    pub(super) fields: Vec<FieldRow>,
    pub(super) quantities: Vec<String>,
    pub(super) attributes: Vec<String>,
    /// What `render` draws on the cells.
    pub(super) cell_values: Vec<String>,
    pub(super) unknowns: usize,
    /// Energy of the solution, if the solver has told it.
    pub(super) energy: Option<Number>,
    pub(super) solver: Option<SolverRow>,
    pub(super) history: Vec<HistoryRow>,
    /// What the tips do next, in a series of cracks that grow.
    pub(super) growth: Option<GrowthRow>,
    /// Records that no table tells of.
    #[serde(skip)]
    pub(super) other_history: Vec<HistoryRow>,
    pub(super) intensities: Vec<Tip>,
    /// Those, and the tips that have none.
    #[serde(skip)]
    pub(super) all_tips: Vec<Tip>,
    pub(super) warnings: Vec<WarningRow>,
    pub(super) reactions: Vec<ReactionRow>,
}

/// Cells of a level of the tree.
#[derive(Debug, Serialize)]
pub(super) struct Level {
    pub(super) level: u8,
    pub(super) cells: usize,
}

/// Patches whose polynomials have an order.
#[derive(Debug, Serialize)]
pub(super) struct Order {
    pub(super) order: u8,
    pub(super) patches: usize,
}

#[derive(Debug, Serialize)]
pub(super) struct CrackRow {
    pub(super) points: Vec<[f64; 2]>,
    pub(super) ends: [&'static str; 2],
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

#[derive(Debug, Serialize)]
pub(crate) struct HistoryRow {
    pub(super) name: String,
    pub(super) value: Number,
    pub(super) unit: String,
}

impl Report {
    /// The report of a dataset and one of its steps.
    pub(super) fn new(file: String, dataset: &Dataset, step: usize) -> Result<Self, FieldError> {
        Ok(Self {
            file,
            title: dataset.title.clone(),
            program: dataset.program.clone(),
            domain: domain(&dataset.domain),
            equation: equation(&dataset.equation),
            quantities: formulas::quantities(dataset),
            tables: formulas::tables(dataset),
            count: dataset.steps.len(),
            series: None,
            steps: [StepReport::new(dataset, step)?],
            places: places(dataset),
        })
    }
}

impl StepReport {
    fn new(dataset: &Dataset, index: usize) -> Result<Self, FieldError> {
        let field = Field::new(dataset, index)?;
        let Step { load, partition, cracks, functions, attributes, history, intensities, .. } =
            field.step;
        let blocks = blocks(functions, field.data);
        let attribute = |a: &ppum::dataset::Attribute| a.name.clone();
        Ok(Self {
            step: index,
            load: *load,
            patches: partition.len(),
            cells: partition.cell.len(),
            points: partition.points.len(),
            weight: partition.weight.name(),
            weight_formula: formulas::weight(partition),
            weight_breakpoints: partition.weight.breakpoints().to_vec(),
            levels: levels(partition),
            orders: orders(field.data),
            cracks: cracks.iter().map(crack).collect(),
            tips: tip_rows(cracks),
            functions: formulas::functions(functions, &blocks),
            families: families(functions, &blocks),
            fields: field.step.fields.iter().map(field_row).collect(),
            quantities: available(&field),
            attributes: attributes.iter().map(attribute).collect(),
            cell_values: cells::names(&field),
            unknowns: field.step.unknowns(),
            energy: SolverReport::of(history).energy.map(Number),
            solver: SolverRow::new(history),
            history: history.iter().map(history_row).collect(),
            growth: field.step.growth.as_ref().map(GrowthRow::new),
            other_history: history.iter().filter(|r| !is_in_tables(r)).map(history_row).collect(),
            intensities: intensities.iter().map(|t| Tip::new(dataset, index, t)).collect(),
            all_tips: all_tips(dataset, index),
            warnings: rows(index, &field.step.warnings),
            reactions: reactions::rows(dataset, field.step),
        })
    }
}

fn domain(domain: &ppum::domain::Domain) -> Domain {
    Domain {
        min: domain.bounds.min.into(),
        max: domain.bounds.max.into(),
        holes: domain.holes.iter().map(HoleRow::from).collect(),
    }
}

fn equation(equation: &Equation) -> EquationRow {
    match equation {
        Equation::Elasticity(m) => EquationRow::Elasticity {
            young: (&m.young).into(),
            poisson: (&m.poisson).into(),
            state: match m.state {
                StressState::PlaneStrain => "plane-strain",
                StressState::PlaneStress => "plane-stress",
            },
        },
        Equation::Poisson { conductivity } => {
            EquationRow::Poisson { conductivity: conductivity.into() }
        }
    }
}

/// The number of times each value occurs, in rising order.
fn tally(values: impl Iterator<Item = u8>) -> BTreeMap<u8, usize> {
    let mut counts = BTreeMap::new();
    values.for_each(|value| *counts.entry(value).or_default() += 1);
    counts
}

fn levels(partition: &Partition) -> Vec<Level> {
    let counts = tally(partition.level.iter().copied());
    counts.into_iter().map(|(level, cells)| Level { level, cells }).collect()
}

/// The order of a patch is the largest degree of its blocks.
fn orders(data: &FieldData) -> Vec<Order> {
    let patches = 0..data.patch_blocks.len() - 1;
    let order = |patch| data.blocks(patch).map(|b| data.block_degree[b]).max().unwrap_or(0);
    let counts = tally(patches.map(order));
    counts.into_iter().map(|(order, patches)| Order { order, patches }).collect()
}

fn crack(crack: &Crack) -> CrackRow {
    let ends = crack.ends.map(|end| match end {
        CrackEnd::Tip => "tip",
        CrackEnd::Mouth => "mouth",
        CrackEnd::Junction => "junction",
    });
    CrackRow { points: crack.points.iter().copied().map(Vec2::into).collect(), ends }
}

fn tip_rows(cracks: &[Crack]) -> Vec<TipRow> {
    let row = |tip: ppum::crack::TipId| TipRow {
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
fn is_in_tables(record: &Record) -> bool {
    is_of_phase(record) || is_of_level(record) || is_of_course(&record.name)
}

/// A record of the solver's report.
pub(crate) fn history_row(record: &Record) -> HistoryRow {
    let Record { name, value, unit } = record.clone();
    HistoryRow { name, value: Number(value), unit }
}
