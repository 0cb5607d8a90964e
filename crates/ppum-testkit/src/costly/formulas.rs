//! Formulas and tables.

use super::{CostlyCase, middle, plate, straight, with_functions};
use ppum::dataset::{Dataset, Elasticity, Equation, NamedQuantity, StressState};
use ppum::expression::Expression;
use ppum::formula::{Scope, Table};
use ppum::function::{Frame, Function, FunctionKind};
use ppum::vec2::vec2;
use ppum::weight::WeightFunction;
use std::fmt::Write as _;
use std::sync::Arc;

pub(super) const ALL: &[CostlyCase] = &[
    ("functions-and-table", None, functions_and_table),
    ("functions-of-table", None, functions_of_table),
    ("parameters", None, parameters),
    ("tables", None, tables),
    ("table-of-two", None, table_of_two),
    ("formula-in-frames", None, formula_in_frames),
    ("formula-of-products", None, formula_of_products),
    ("formula-long", None, formula_long),
    ("quantities", None, quantities),
    ("quantities-long", None, quantities_long),
    ("weight", Some("at a point"), weight),
    ("weight-of-patches", None, weight_of_patches),
    ("material", None, material),
    ("material-noise", None, material_noise),
    ("kinks", None, kinks),
];

fn function(name: String, text: &str, frame: Frame) -> Function {
    Function { name, kind: FunctionKind::formula(text, frame) }
}

/// A table of 2²⁰ values.
fn large_table() -> Arc<Table> {
    let knots: Vec<f64> = (0..1024).map(f64::from).collect();
    let table = Table::surface("big", knots.clone(), knots, vec![0.0; 1 << 20]);
    Arc::new(table.expect("a table"))
}

/// Functions beside a table that none of them reads.
fn functions_and_table() -> Dataset {
    let own = |k: u32| function(format!("f{k}"), &format!("x*{k}"), Frame::World);
    let mut dataset = with_functions(plate(1, 0, middle()), (0..1000).map(own).collect());
    dataset.tables = vec![large_table()];
    dataset
}

/// Functions of the same text, with places of their own, that read the table.
fn functions_of_table() -> Dataset {
    let own = |k: u32| {
        let frame = Frame::Fixed { origin: vec2(f64::from(k) / 1000.0, 0.5), angle: 0.0 };
        function(format!("f{k}"), "table(big, x, y)", frame)
    };
    let mut dataset = with_functions(plate(1, 0, middle()), (0..500).map(own).collect());
    dataset.tables = vec![large_table()];
    dataset
}

/// Functions with parameters, each of which is looked up.
fn parameters() -> Dataset {
    let names: Vec<_> = (0..400).map(|k| (format!("p{k}"), 1.0)).collect();
    let sum: Vec<_> = names.iter().map(|(name, _)| name.as_str()).collect();
    let mut own = function("f".into(), &format!("x + {}", sum.join("+")), Frame::World);
    if let FunctionKind::Formula { parameters, .. } = &mut own.kind {
        *parameters = names;
    }
    with_functions(plate(1, 0, middle()), vec![own; 20])
}

/// Many tables of many values.
fn tables() -> Dataset {
    let knots: Vec<f64> = (0..4096).map(f64::from).collect();
    let table = |k: u32| {
        let curve = Table::curve(&format!("t{k}"), knots.clone(), vec![0.0; 4096]);
        Arc::new(curve.expect("a table"))
    };
    let own = |k: u32| function(format!("f{k}"), &format!("table(t{k}, x)"), Frame::World);
    let mut dataset = with_functions(plate(1, 0, middle()), (0..128).map(own).collect());
    dataset.tables = (0..128).map(table).collect();
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

/// A sum of many different terms.
fn terms(n: usize, term: impl Fn(usize) -> String) -> String {
    (0..n).fold("0".to_owned(), |mut text, k| {
        write!(text, "+{}", term(k)).expect("a text takes everything");
        text
    })
}

/// One long formula in many frames, all of them in one patch.
fn formula_in_frames() -> Dataset {
    let text = format!("{}x*y{}", "exp(x*sin(".repeat(80), "))".repeat(80));
    let own = |k: u32| {
        let frame = Frame::Fixed { origin: vec2(f64::from(k) / 128.0, 0.5), angle: 0.0 };
        function(format!("f{k}"), &text, frame)
    };
    with_functions(plate(1, 0, middle()), (0..128).map(own).collect())
}

/// Products whose second derivatives have as many terms as pairs of factors.
fn formula_of_products() -> Dataset {
    let text =
        |k: u32| format!("{k}{}", terms(3000, |j| format!("1*(x + {j})")).replace("+1", "*1"));
    let own = |k: u32| function(format!("f{k}"), &text(k), Frame::World);
    with_functions(plate(1, 0, middle()), (1..4).map(own).collect())
}

/// As long as a formula may be.
fn formula_long() -> Dataset {
    let text = terms(5000, |k| format!("sin({k}*x)"));
    with_functions(plate(2, 0, middle()), vec![function("f".into(), &text, Frame::World)])
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

/// Quantities that are as long as all may be together.
fn quantities_long() -> Dataset {
    let mut dataset = plate(4, 1, middle());
    let next = |k: u32| {
        let own = terms(15, |j| format!("sin({j}.{k}*s1)"));
        let text = if k == 0 { own } else { format!("q{} + {own}", k - 1) };
        NamedQuantity { name: format!("q{k}"), text, unit: String::new() }
    };
    dataset.quantities = (0..256).map(next).collect();
    dataset
}

fn with_weight(mut dataset: Dataset, terms_of_it: usize) -> Dataset {
    let text = format!("(1 - t)*(1 + 0*({}))", terms(terms_of_it, |k| format!("sin({k}*t)")));
    let scope = Scope::new(&["t"]).expect("a name");
    let weight = WeightFunction::formula(&text, &scope).expect("a weight");
    dataset.steps[0].partition.boxes_mut().expect("boxes").weight = weight;
    dataset
}

/// A weight that is as long as a formula may be, on patches over each other.
fn weight() -> Dataset {
    let mut dataset = plate(1, 0, middle());
    dataset.steps[0].partition = super::piled(100).into();
    dataset.steps[0].fields = vec![super::displacement(&vec![vec![(0, 0)]; 100])];
    with_weight(dataset, 4500)
}

/// A weight of some length on many patches.
fn weight_of_patches() -> Dataset {
    with_weight(plate(64, 0, middle()), 200)
}

fn with_young(dataset: &mut Dataset, text: &str) {
    let scope = Scope::cartesian().with_tables(&dataset.tables).expect("new names");
    dataset.equation = Equation::Elasticity(Elasticity {
        young: Expression::parse_in(text, &scope).expect("a formula"),
        poisson: 0.3.into(),
        state: StressState::PlaneStrain,
        eigenstrain: None,
    });
}

/// A material that is as long as a formula may be.
fn material() -> Dataset {
    let mut dataset = plate(8, 1, middle());
    with_young(&mut dataset, &format!("2 + 1e-6*({})", terms(4500, |k| format!("sin({k}*x)"))));
    dataset
}

/// A material that jumps everywhere, and many tips in it.
fn material_noise() -> Dataset {
    let mut dataset = plate(16, 1, Vec::new());
    let at = |k: u32| vec2((f64::from(k % 16) + 0.3) / 16.0, (f64::from(k / 16) + 0.5) / 16.0);
    dataset.steps[0].cracks = (0..256).map(|k| straight(at(k), 0.02)).collect();
    with_young(&mut dataset, "if(sin(1e4*x)*sin(1e4*y) > 0, 1, 2)");
    dataset
}

/// A function with many declared kinks, in every patch.
fn kinks() -> Dataset {
    let mut own = function("f".into(), "abs(x - 0.3)", Frame::World);
    if let FunctionKind::Formula { declared, .. } = &mut own.kind {
        let at = |k: u32| f64::from(k) / 20_000.0;
        declared.kinks = (0..20_000).map(|k| [vec2(at(k), 0.0), vec2(at(k), 1.0)]).collect();
        declared.singular = (0..20_000).map(|k| vec2(at(k), 0.5)).collect();
    }
    let one = Function { name: "one".into(), kind: FunctionKind::One };
    with_functions(plate(16, 1, middle()), vec![one, own])
}
