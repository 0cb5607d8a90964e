//! The formulas of a dataset: functions, weight, quantities, tables.

use ppum::crack::SegmentId;
use ppum::dataset::{BoxPartition, Dataset, NamedQuantity};
use ppum::formula::Table;
use ppum::function::{Cut, Frame, Function, FunctionKind, NonsmoothPoints};
use ppum::library;
use ppum::vec2::Vec2;
use ppum::weight::WeightFunction;
use serde::Serialize;

/// A function of a step.
#[derive(Debug, Serialize)]
pub(super) struct FunctionRow {
    name: String,
    kind: &'static str,
    /// Blocks of the first field that use it.
    blocks: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    crack: Option<u32>,
    /// The cuts of a component, as in the file.
    #[serde(skip_serializing_if = "Option::is_none")]
    cuts: Option<Vec<[i64; 4]>>,
    #[serde(flatten)]
    formula: Option<FormulaRow>,
}

#[derive(Debug, Serialize)]
struct FormulaRow {
    formula: String,
    role: &'static str,
    frame: FrameRow,
    parameters: Vec<ParameterRow>,
    declared: DeclarationRow,
}

#[derive(Debug, Serialize)]
struct ParameterRow {
    name: String,
    value: f64,
}

#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
enum FrameRow {
    World,
    Fixed {
        origin: [f64; 2],
        angle: f64,
    },
    Tip {
        crack: u32,
        end: &'static str,
    },
    /// The fields that are x and y.
    Levels {
        fields: [u32; 2],
    },
    Other,
}

#[derive(Debug, Serialize)]
struct DeclarationRow {
    kinks: Vec<[[f64; 2]; 2]>,
    singular: Vec<[f64; 2]>,
}

pub(super) fn functions(table: &[Function], blocks: &[usize]) -> Vec<FunctionRow> {
    table.iter().zip(blocks).map(|(function, &blocks)| FunctionRow::new(function, blocks)).collect()
}

impl FunctionRow {
    fn new(function: &Function, blocks: usize) -> Self {
        let (mut crack, mut cuts, mut formula) = (None, None, None);
        let kind = match &function.kind {
            FunctionKind::One => "one",
            FunctionKind::Side { crack: of } => {
                crack = Some(*of);
                "side"
            }
            FunctionKind::Component { cuts: of } => {
                cuts = Some(of.iter().map(cut).collect());
                "component"
            }
            FunctionKind::Formula { text, frame, parameters, declared, role } => {
                formula = Some(FormulaRow {
                    formula: text.clone(),
                    role: role.name(),
                    frame: FrameRow::new(frame),
                    parameters: self::parameters(parameters),
                    declared: DeclarationRow::new(declared),
                });
                "formula"
            }
            FunctionKind::Level { .. } => "level",
            _ => "other",
        };
        Self { name: function.name.clone(), kind, blocks, crack, cuts, formula }
    }
}

/// Crack, segment, and the numbers of what follows on the left and on the right.
fn cut(&Cut { segment: SegmentId { crack, segment }, left, right }: &Cut) -> [i64; 4] {
    [crack.into(), segment.into(), left.number(), right.number()]
}

fn parameters(parameters: &[(String, f64)]) -> Vec<ParameterRow> {
    let parameter =
        |(name, value): &(String, f64)| ParameterRow { name: name.clone(), value: *value };
    parameters.iter().map(parameter).collect()
}

impl FrameRow {
    fn new(frame: &Frame) -> Self {
        match *frame {
            Frame::World => Self::World,
            Frame::Fixed { origin, angle } => Self::Fixed { origin: origin.into(), angle },
            Frame::Tip(tip) => Self::Tip { crack: tip.crack, end: tip.end.name() },
            Frame::Levels(fields) => Self::Levels { fields },
            _ => Self::Other,
        }
    }
}

impl DeclarationRow {
    fn new(declared: &NonsmoothPoints) -> Self {
        Self {
            kinks: declared.kinks.iter().map(|kink| kink.map(Vec2::into)).collect(),
            singular: declared.singular.iter().copied().map(Vec2::into).collect(),
        }
    }
}

/// The weight as a formula of t; that of a B-spline from the library.
pub(super) fn weight(partition: &BoxPartition) -> String {
    match &partition.weight {
        WeightFunction::Formula(formula) => formula.text().to_owned(),
        spline => library::weight(spline.name()).map_or("", |entry| entry.texts[0]).to_owned(),
    }
}

/// A quantity that the dataset names.
#[derive(Debug, Serialize)]
pub(super) struct QuantityRow {
    pub(super) name: String,
    pub(super) formula: String,
    pub(super) unit: String,
}

pub(super) fn quantities(dataset: &Dataset) -> Vec<QuantityRow> {
    let row = |NamedQuantity { name, text, unit }: &NamedQuantity| QuantityRow {
        name: name.clone(),
        formula: text.clone(),
        unit: unit.clone(),
    };
    dataset.quantities.iter().map(row).collect()
}

/// A table; the values of one with two arguments in rows of constant y.
#[derive(Debug, Serialize)]
pub(super) struct TableRow {
    pub(super) name: String,
    pub(super) x: Vec<f64>,
    pub(super) y: Vec<f64>,
    pub(super) values: Vec<f64>,
}

pub(super) fn tables(dataset: &Dataset) -> Vec<TableRow> {
    let row = |table: &Table| TableRow {
        name: table.name().to_owned(),
        x: table.x().to_vec(),
        y: table.y().to_vec(),
        values: table.values().to_vec(),
    };
    dataset.tables.iter().map(|table| row(table)).collect()
}
