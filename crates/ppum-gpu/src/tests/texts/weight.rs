use std::sync::Arc;

use ppum::formula::{Scope, Table};
use ppum::library::WEIGHTS;
use ppum::weight::WeightFunction;

use super::{call, module};
use crate::error::GpuError;
use crate::shader::texts::{JET, WEIGHT};
use crate::shader::weight::weight_wgsl;

/// The function under test, and the numbers of its vector.
fn test_module(weight: &WeightFunction) -> ppum_testkit::wgsl::Module {
    let numbers = "fn numbers(xi: f32) -> array<f32, 2> {
        let w = weight(xi);
        return array<f32, 2>(w.x, w.y);
    }";
    let declared = "const ORDER = 1u; alias Lanes = vec2<f32>;";
    module(&[JET, WEIGHT, declared, &weight_wgsl(weight).expect("a text"), numbers])
}

fn places() -> impl Iterator<Item = f32> {
    let grid = (-130..=130i16).map(|k| f32::from(k) / 100.0 + 0.0037);
    let ends = [1.0f32, 0.5, 1.0 / 3.0, 0.0].into_iter();
    grid.chain(ends.flat_map(|t| [t, t.next_up(), t.next_down(), -t, -t.next_up(), -t.next_down()]))
}

/// Single precision: a few units of the last place of the largest number that takes part.
const ROUNDING: f64 = 2e-6;

fn compare(weight: &WeightFunction) {
    let module = test_module(weight);
    let rows: Vec<_> = places()
        .map(|xi| (xi, call(&module, "numbers", &[xi]), weight.spline(f64::from(xi))))
        .collect();
    for k in 0..2 {
        let size = rows.iter().map(|(_, _, expected)| expected[k].abs()).fold(0.0, f64::max);
        for (xi, found, expected) in &rows {
            // beside a knot single precision does not tell the pieces apart
            let beside = |t: f64| t > 0.0 && (f64::from(xi.abs()) - t).abs() < 1e-7;
            let knot = weight.breakpoints().iter().any(|&t| beside(t));
            let near = (found[k] - expected[k]).abs() <= ROUNDING * size;
            assert!(near || knot && k > 0, "{k} at {xi:e}: {found:?} {expected:?}");
        }
    }
}

#[test]
fn weights_of_the_library() {
    let scope = Scope::new(&["t"]).expect("a name");
    for entry in WEIGHTS {
        compare(&WeightFunction::from_library(entry.name).expect("of the library"));
        compare(&WeightFunction::formula(entry.texts[0], &scope).expect("of the library"));
    }
}

#[test]
fn weights_of_formulas() {
    let knots = vec![0.0, 0.25, 0.5, 1.0];
    let table = Table::curve("flank", knots, vec![1.0, 0.8, 0.5, 0.0]).expect("a table");
    let scope = Scope::new(&["t"]).expect("a name").with_tables(&[Arc::new(table)]).expect("new");
    for text in ["table(flank, t)", "min(1 - t, 0.75 - 0.5*t)", "sqrt(1 - t)*(1 - t)", "(1 - t)^5"]
    {
        compare(&WeightFunction::formula(text, &scope).expect("a weight"));
    }
}

#[test]
fn a_table_too_long_is_an_error() {
    let knots: Vec<f64> = (0..3000).map(|k| f64::from(k) / 2999.0).collect();
    let values = knots.iter().map(|t| 1.0 - t).collect();
    let table = Arc::new(Table::curve("long", knots, values).expect("a table"));
    let scope = Scope::new(&["t"]).expect("a name").with_tables(&[table]).expect("new");
    let weight = WeightFunction::formula("table(long, t)", &scope).expect("a weight");
    let error = weight_wgsl(&weight).expect_err("a table too long");
    assert!(matches!(error, GpuError::FormulaTooLarge { .. }), "{error}");
    assert!(error.to_string().contains("`long`"), "{error}");
}
