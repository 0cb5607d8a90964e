//! Tests of the whole path, from text to derivatives.

mod derivatives;
mod errors;
mod half_angle;
mod hostile;
mod jets;
mod kinks;
mod lanes;
mod language;
mod random;
mod sides;
mod tables;
mod westergaard;

use super::{Formula, FormulaJets, Scope};

/// The functions around a crack tip, the enrichments that half angles are made for.
const WESTERGAARD: [&str; 4] = [
    "sqrt(r)*cos(theta/2)",
    "sqrt(r)*sin(theta/2)",
    "sqrt(r)*sin(theta)*sin(theta/2)",
    "sqrt(r)*sin(theta)*cos(theta/2)",
];

/// The value of a formula of x and y.
fn value(text: &str, x: f64, y: f64) -> f64 {
    parse(text).evaluate(&[x, y])
}

/// A formula of x and y.
fn parse(text: &str) -> Formula {
    Formula::parse(text, &Scope::cartesian()).unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// A formula with its gradient and Hessian.
fn jets(formula: &Formula) -> FormulaJets {
    FormulaJets::new(&[formula], 2).expect("small, of two variables")
}

/// v, x, y, xx, xy, yy of a formula at a point.
fn jet_at(jets: &FormulaJets, inputs: &[f64]) -> [f64; 6] {
    let mut out = [0.0; 6];
    jets.evaluate(inputs, &mut Vec::new(), &mut out);
    out
}

/// The inputs of the polar scope at a point.
fn polar(x: f64, y: f64) -> [f64; 6] {
    at_angle([x, y], x.hypot(y), y.atan2(x))
}

/// The inputs of the polar scope where they do not follow from the point.
fn at_angle([x, y]: [f64; 2], r: f64, theta: f64) -> [f64; 6] {
    [x, y, r, theta, (theta / 2.0).cos(), (theta / 2.0).sin()]
}

/// Asserts |a − b| ≤ tolerance · scale.
#[track_caller]
fn assert_near(a: f64, b: f64, tolerance: f64, scale: f64, what: &str) {
    assert!((a - b).abs() <= tolerance * scale, "{what}: {a:e} is not {b:e}");
}

/// Same bits, or both NaN.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}
