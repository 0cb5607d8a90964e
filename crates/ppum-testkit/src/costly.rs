//! Small files that ask for much: many of each thing that a file can have many of.
//!
//! All of them are datasets as a writer could make them, most of equal numbers, so that thousands
//! of patches, cracks or operations are some ten kilobytes of a file. They are read and drawn
//! within the bounds of docs/commands/cost.md.

use ppum::cover::Cover;
use ppum::crack::{Crack, CrackEnd, TipId, tips};
use ppum::dataset::{
    Attribute, BoxPartition, Dataset, Elasticity, Equation, FieldData, Material, NamedQuantity,
    Record, Step, StressState,
};
use ppum::domain::Hole;
use ppum::expression::Expression;
use ppum::formula::{Scope, Table};
use ppum::function::{Frame, Function, FunctionKind, WESTERGAARD};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;
use std::fmt::Write as _;
use std::sync::Arc;

/// A name, and what makes the dataset.
type CostlyCase = (&'static str, fn() -> Dataset);

const ALL: [CostlyCase; 13] = [
    ("patches", patches),
    ("patches-piled", patches_piled),
    ("fields", fields),
    ("steps", steps),
    ("attributes", attributes),
    ("functions", functions),
    ("cracks", cracks),
    ("crack-of-vertices", crack_of_vertices),
    ("tips-in-cells", tips_in_cells),
    ("holes", holes),
    ("formula-long", formula_long),
    ("quantities", quantities),
    ("table-of-two", table_of_two),
];

/// All datasets with their names, the things that there are many of.
pub fn all() -> impl Iterator<Item = (&'static str, Dataset)> {
    ALL.into_iter().map(|(name, make)| (name, make()))
}

/// The dataset of this name.
///
/// # Panics
/// If there is none.
#[must_use]
pub fn named(name: &str) -> Dataset {
    let maker = ALL.into_iter().find(|maker| maker.0 == name);
    (maker.unwrap_or_else(|| panic!("there is no costly dataset `{name}`")).1)()
}

/// The plate all of them are made from: [0, 1]², cells × cells patches of the order, with cracks.
fn plate(cells: u32, order: u8, cracks: Vec<Crack>) -> Dataset {
    let domain = Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0));
    let cover = Cover::grid(domain, [cells, cells]).expect("a cover");
    let partition = cover.partition(1.3, WeightFunction::Linear).expect("a partition");
    let blocks = vec![vec![(0, order)]; partition.len()];
    let one = FunctionKind::One;
    let mut step = Step::new(partition).with_function("one", one).with_field(displacement(&blocks));
    step.cracks = cracks;
    step.history = vec![Record { name: "energy".into(), value: 1.0, unit: String::new() }];
    let material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
    let mut dataset = Dataset::new(domain, Equation::elasticity(material)).with_step(step);
    (dataset.title, dataset.program) = ("costly".into(), "ppum".into());
    dataset
}

/// A displacement whose patches have blocks of these functions and degrees, all coefficients alike.
fn displacement(patches: &[Vec<(u32, u8)>]) -> FieldData {
    let mut data = FieldData::new("displacement", &["ux", "uy"]);
    patches.iter().for_each(|blocks| data.push_patch(blocks));
    data.coefficients.iter_mut().for_each(|component| component.fill(0.5));
    data
}

/// A partition of patches that all lie over the whole plate, their cells strips of it.
fn piled(patches: usize) -> BoxPartition {
    let (center, half) = (vec2(0.5, 0.5), vec2(1.0, 1.0));
    let at = |k: usize| k as f64 / patches as f64;
    let strip = |k: usize| Rect::new(vec2(0.0, at(k)), vec2(1.0, at(k + 1)));
    BoxPartition {
        weight: WeightFunction::Linear,
        center: vec![center; patches],
        half: vec![half; patches],
        origin: vec![center; patches],
        scale: vec![half; patches],
        cell: (0..patches).map(strip).collect(),
        level: vec![0; patches],
        point: vec![None; patches],
        points: Vec::new(),
    }
}

/// A crack from the left to the right with two tips.
fn straight(left: Vec2, length: f64) -> Crack {
    Crack::polyline(vec![left, left + vec2(length, 0.0)], [CrackEnd::Tip; 2])
}

/// One crack in the middle.
fn middle() -> Vec<Crack> {
    vec![straight(vec2(0.25, 0.4375), 0.5)]
}

/// The plate with blocks of the functions, which every patch has.
fn with_functions(mut dataset: Dataset, functions: Vec<Function>) -> Dataset {
    let step = &mut dataset.steps[0];
    let blocks: Vec<_> = (0..functions.len() as u32).map(|function| (function, 1)).collect();
    step.fields = vec![displacement(&vec![blocks; step.partition.len()])];
    step.functions = functions;
    dataset
}

/// As many patches as fit into a file.
fn patches() -> Dataset {
    plate(256, 0, middle())
}

/// Patches that all cover everything.
fn patches_piled() -> Dataset {
    let mut dataset = plate(1, 0, middle());
    let n = 1 << 17;
    dataset.steps[0].partition = piled(n).into();
    dataset.steps[0].fields = vec![displacement(&vec![vec![(0, 0)]; n])];
    dataset
}

/// Fields of a step.
fn fields() -> Dataset {
    let mut dataset = plate(1, 0, Vec::new());
    let step = &mut dataset.steps[0];
    let field = step.fields[0].clone();
    for k in 0..50 {
        step.fields.push(field.clone());
        step.fields[k + 1].name = format!("field {k}");
    }
    dataset
}

/// Steps.
fn steps() -> Dataset {
    let mut dataset = plate(4, 1, middle());
    dataset.steps = vec![dataset.steps[0].clone(); 12];
    dataset
}

/// Values of patches.
fn attributes() -> Dataset {
    let mut dataset = plate(8, 0, middle());
    let attribute = |k| Attribute { name: format!("a{k}"), values: vec![1.0; 64] };
    dataset.steps[0].attributes = (0..10_000).map(attribute).collect();
    dataset
}

fn side(crack: u32) -> Function {
    Function { name: format!("side {crack}"), kind: FunctionKind::Side { crack } }
}

/// Functions of which each patch of many has one of its own.
fn functions() -> Dataset {
    let mut dataset = plate(64, 0, row(64));
    let step = &mut dataset.steps[0];
    step.functions.extend((0..4096).map(side));
    let own = |k: u32| vec![(0, 0), (k + 1, 0)];
    let blocks: Vec<_> = (0..step.partition.len() as u32).map(own).collect();
    step.fields = vec![displacement(&blocks)];
    dataset
}

/// Cracks in rows and columns, `n` of them a row.
fn row(n: u32) -> Vec<Crack> {
    let width = 1.0 / f64::from(n);
    let at = |k: u32| vec2((f64::from(k % n) + 0.25) * width, (f64::from(k / n) + 0.5) * width);
    (0..n * n).map(|k| straight(at(k), 0.5 * width)).collect()
}

/// Cracks, each with two tips, on few cells.
fn cracks() -> Dataset {
    plate(32, 1, row(64))
}

/// A crack that goes forth and back many times.
fn zigzag(n: u32, y: f64) -> Crack {
    let at = |k: u32| vec2(0.25 + 0.5 * f64::from(k) / f64::from(n), y + f64::from(k % 2) / 128.0);
    Crack::polyline((0..=n).map(at).collect(), [CrackEnd::Tip; 2])
}

fn tip_functions(cracks: &[Crack]) -> Vec<Function> {
    let of = |tip: TipId| {
        WESTERGAARD.map(|text| {
            let kind = FunctionKind::formula(text, Frame::Tip(tip));
            Function { name: format!("tip {}", tip.crack), kind }
        })
    };
    tips(cracks).flat_map(of).collect()
}

/// One crack of thousands of vertices, with the functions of a solver everywhere.
fn crack_of_vertices() -> Dataset {
    let crack = zigzag(1 << 13, 0.375);
    let mut functions = vec![Function { name: "one".into(), kind: FunctionKind::One }, side(0)];
    functions.extend(tip_functions(std::slice::from_ref(&crack)));
    with_functions(plate(8, 1, vec![crack]), functions)
}

/// Tips whose discs hold all cells.
fn tips_in_cells() -> Dataset {
    plate(128, 0, vec![straight(vec2(-0.5, 0.5), 1.0); 8192])
}

/// Holes that lie over each other, and cells beside them.
fn holes() -> Dataset {
    let mut dataset = plate(64, 0, middle());
    let hole = |_| Hole::Circle { center: vec2(0.5, 0.875), radius: 0.25 };
    dataset.domain.holes = (0..1 << 14).map(hole).collect();
    dataset
}

/// A sum of many different terms.
fn terms(n: usize, term: impl Fn(usize) -> String) -> String {
    (0..n).fold("0".to_owned(), |mut text, k| {
        write!(text, "+{}", term(k)).expect("a text takes everything");
        text
    })
}

/// As long as a formula may be.
fn formula_long() -> Dataset {
    let text = terms(5000, |k| format!("sin({k}*x)"));
    with_functions(
        plate(2, 0, middle()),
        vec![Function { name: "f".into(), kind: FunctionKind::formula(&text, Frame::World) }],
    )
}

/// Quantities, each of which uses the one before twice.
fn quantities() -> Dataset {
    let mut dataset = plate(4, 1, middle());
    let next = |k: u32| {
        let text = match k {
            0 => "von_mises".to_owned(),
            _ => format!("sin(q{0})*q{0} + dux_dx/q{0}", k - 1),
        };
        NamedQuantity { name: format!("q{k}"), text, unit: String::new() }
    };
    dataset.quantities = (0..256).map(next).collect();
    dataset
}

/// A material that is a table of two arguments, with a kink at each knot.
fn table_of_two() -> Dataset {
    let mut dataset = plate(16, 1, middle());
    let knots: Vec<f64> = (0..1024).map(|k| f64::from(k) / 1023.0).collect();
    let values = (0..1 << 20).map(|k| f64::from(1 + (k + k / 1024) % 2)).collect();
    let table = Table::surface("big", knots.clone(), knots, values).expect("a table");
    dataset.tables = vec![Arc::new(table)];
    with_young(&mut dataset, "2 + 0.1*table(big, x, y)");
    dataset
}

fn with_young(dataset: &mut Dataset, text: &str) {
    let scope = Scope::cartesian().with_tables(&dataset.tables).expect("new names");
    dataset.equation = Equation::Elasticity(Elasticity {
        young: Expression::parse_in(text, &scope).expect("a formula"),
        poisson: 0.3.into(),
        state: StressState::PlaneStrain,
        eigenstrain: None,
        anisotropy: None,
    });
}
