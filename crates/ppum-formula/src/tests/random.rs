//! Random formulas against an independent evaluation, and random texts against the parser.

use std::sync::Arc;

use ppum_testkit::random::Random;

use crate::Table;

use super::{Formula, Scope, jet_at, jets, polar, same};

/// Value, gradient and Hessian carried along numerically (order v, x, y, xx, xy, yy): an evaluation
/// that shares nothing with the graph.
#[derive(Clone, Copy)]
pub(super) struct NumericJet([f64; 6]);

impl NumericJet {
    fn constant(v: f64) -> Self {
        Self([v, 0.0, 0.0, 0.0, 0.0, 0.0])
    }

    /// g(u) from g, g′, g″ at u.
    fn chain(self, g: f64, g1: f64, g2: f64) -> Self {
        let [_, x, y, xx, xy, yy] = self.0;
        Self([g, g1 * x, g1 * y, g1 * xx + g2 * x * x, g1 * xy + g2 * x * y, g1 * yy + g2 * y * y])
    }

    fn plus(self, b: Self, factor: f64) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + factor * b.0[i]))
    }

    fn times(self, b: Self) -> Self {
        let ([a, ax, ay, axx, axy, ayy], [b, bx, by, bxx, bxy, byy]) = (self.0, b.0);
        Self([
            a * b,
            ax * b + a * bx,
            ay * b + a * by,
            axx * b + 2.0 * ax * bx + a * bxx,
            axy * b + ax * by + ay * bx + a * bxy,
            ayy * b + 2.0 * ay * by + a * byy,
        ])
    }

    fn function(self, name: &str) -> Self {
        let u = self.0[0];
        let (g, g1, g2) = match name {
            "sin" => (u.sin(), u.cos(), -u.sin()),
            "cos" => (u.cos(), -u.sin(), -u.cos()),
            "atan" => (u.atan(), 1.0 / (1.0 + u * u), -2.0 * u / (1.0 + u * u).powi(2)),
            "tanh" => {
                let slope = 1.0 - u.tanh().powi(2);
                (u.tanh(), slope, -2.0 * u.tanh() * slope)
            }
            "exp" => (u.exp(), u.exp(), u.exp()),
            "sqrt" => (u.sqrt(), 0.5 / u.sqrt(), -0.25 / (u * u.sqrt())),
            "log" => (u.ln(), 1.0 / u, -1.0 / (u * u)),
            "abs" => (u.abs(), u.signum(), 0.0),
            "-" => (-u, -1.0, 0.0),
            "reciprocal" => (1.0 / u, -1.0 / (u * u), 2.0 / (u * u * u)),
            "square" => (u * u, 2.0 * u, 2.0),
            "table" => {
                // the cubic of the scope's table, constant outside
                let (v, inside) =
                    (u.clamp(-2.0, 3.0), f64::from(u8::from((-2.0..=3.0).contains(&u))));
                (v * v * v - 2.0 * v, inside * (3.0 * v * v - 2.0), inside * 6.0 * v)
            }
            other => panic!("no function {other}"),
        };
        self.chain(g, g1, g2)
    }
}

/// A random formula: its text and its jet at a point.
pub(super) struct RandomFormula {
    pub(super) text: String,
    jet: NumericJet,
    /// Largest number met on the way: bounds the rounding errors.
    pub(super) largest: f64,
}

pub(super) fn sample(random: &mut Random, point: &[NumericJet; 4], depth: usize) -> RandomFormula {
    if depth == 0 || random.below(8) == 0 {
        return leaf(random, point);
    }
    let a = sample(random, point, depth - 1);
    if random.below(3) == 0 {
        return call(random, a);
    }
    let b = sample(random, point, depth - 1);
    join(random, a, b)
}

fn node(text: String, jet: NumericJet, parts: &[f64]) -> RandomFormula {
    let largest = jet.0.iter().map(|v| v.abs()).chain(parts.iter().copied()).fold(0.0, f64::max);
    // `max` would lose a NaN
    let largest = if jet.0.iter().all(|v| v.is_finite()) { largest } else { f64::INFINITY };
    RandomFormula { text, jet, largest }
}

fn leaf(random: &mut Random, point: &[NumericJet; 4]) -> RandomFormula {
    let index = random.below(7);
    if let Some(jet) = point.get(index) {
        return node(["x", "y", "r", "theta"][index].to_owned(), *jet, &[]);
    }
    if index == 4 {
        let multiple = random.pick(&[0.5, -0.5, 1.5, 2.0, -3.0, 3.5]);
        let jet = NumericJet::constant(0.0).plus(point[3], multiple);
        return node(format!("(theta*{multiple})"), jet, &[]);
    }
    let value = random.pick(&[0.5, 2.0, 3.0, 0.1, 1.0, 0.0, 7.25]);
    node(format!("{value}"), NumericJet::constant(value), &[])
}

fn call(random: &mut Random, a: RandomFormula) -> RandomFormula {
    let name = random
        .pick(&["sin", "cos", "atan", "tanh", "exp", "sqrt", "log", "abs", "-", "square", "table"]);
    let text = match name {
        "-" => format!("-({})", a.text),
        "square" => format!("({})^2", a.text),
        "table" => format!("table(k, {})", a.text),
        _ => format!("{name}({})", a.text),
    };
    let near = |kink: f64| (a.jet.0[0] - kink).abs() < TIE;
    let at_kink = name == "abs" && near(0.0) || name == "table" && (near(-2.0) || near(3.0));
    node(text, a.jet.function(name), &[a.largest, excluded(at_kink)])
}

/// Closer to a tie rounding may choose the other piece: no comparison there.
const TIE: f64 = 1e-9;

/// A size that excludes the sample from comparison.
fn excluded(yes: bool) -> f64 {
    if yes { f64::INFINITY } else { 0.0 }
}

fn join(random: &mut Random, a: RandomFormula, b: RandomFormula) -> RandomFormula {
    let larger = a.jet.0[0] > b.jet.0[0];
    let sign = random.pick(&["+", "-", "*", "/", "max", "min", "if", "hypot"]);
    let jet = match sign {
        "+" => a.jet.plus(b.jet, 1.0),
        "-" => a.jet.plus(b.jet, -1.0),
        "*" => a.jet.times(b.jet),
        "/" => a.jet.times(b.jet.function("reciprocal")),
        "min" => {
            if larger {
                b.jet
            } else {
                a.jet
            }
        }
        "hypot" => a.jet.function("square").plus(b.jet.function("square"), 1.0).function("sqrt"),
        _ => {
            if larger {
                a.jet
            } else {
                b.jet
            }
        }
    };
    let (s, t) = (a.text, b.text);
    let text = match sign {
        "if" => {
            // a name that no inner block has
            let c = format!("c{}", random.bits());
            format!("(let {c} = {s} > {t}; if(not {c}, {t}, {s}))")
        }
        "max" | "min" | "hypot" => format!("{sign}({s}, {t})"),
        _ => format!("(({s}) {sign} ({t}))"),
    };
    let gap = (a.jet.0[0] - b.jet.0[0]).abs();
    let tied = matches!(sign, "if" | "max" | "min") && gap < TIE;
    node(text, jet, &[a.largest, b.largest, excluded(tied)])
}

pub(super) fn point(x: f64, y: f64) -> [NumericJet; 4] {
    let [_, _, r, theta, ..] = polar(x, y);
    let (c, s) = (x / r, y / r);
    [
        NumericJet([x, 1.0, 0.0, 0.0, 0.0, 0.0]),
        NumericJet([y, 0.0, 1.0, 0.0, 0.0, 0.0]),
        NumericJet([r, c, s, s * s / r, -s * c / r, c * c / r]),
        NumericJet([
            theta,
            -s / r,
            c / r,
            2.0 * s * c / (r * r),
            (s * s - c * c) / (r * r),
            -2.0 * s * c / (r * r),
        ]),
    ]
}

/// Polar coordinates and k(x) = x³ − 2x on [−2, 3].
pub(super) fn scope() -> Scope {
    let knots = [-2.0, -0.5, 1.0, 2.0, 3.0];
    let values = knots.iter().map(|x: &f64| x.powi(3) - 2.0 * x).collect();
    let table = Table::curve("k", knots.to_vec(), values).expect("valid");
    Scope::polar().with_table(Arc::new(table)).expect("a new name")
}

#[test]
fn random_formulas_agree_with_numerical_jets() {
    let scope = scope();
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let mut compared = 0;
    for _ in 0..10_000 {
        let (x, y) = (random.between(-2.0, 2.0), random.between(-2.0, 2.0));
        let sample = sample(&mut random, &point(x, y), 5);
        let text = &sample.text;
        let f = Formula::parse(text, &scope).unwrap_or_else(|e| panic!("{text}: {e}"));
        let jet = jets(&f);
        let found = jet_at(&jet, &polar(x, y));
        assert!(same(found[0], f.evaluate(&polar(x, y))), "{text}");
        if sample.largest > 1e4 {
            continue;
        }
        compared += 1;
        for (i, (a, b)) in found.into_iter().zip(sample.jet.0).enumerate() {
            let scale = 1.0 + sample.largest * sample.largest;
            assert!((a - b).abs() < 1e-11 * scale, "{text}\ncomponent {i} at {x}, {y}: {a} or {b}");
        }
    }
    assert!(compared > 5_000, "only {compared} formulas compared");
}

#[test]
fn random_derivatives_print_and_parse_again() {
    let scope = scope();
    let mut random = Random(0xD1B5_4A32_D192_ED03);
    for _ in 0..2_000 {
        let (x, y) = (random.between(-2.0, 2.0), random.between(-2.0, 2.0));
        let text = sample(&mut random, &point(x, y), 4).text;
        let f = Formula::parse(&text, &scope).expect("valid");
        for derivative in [f.derivative("x"), f.derivative("y").and_then(|d| d.derivative("x"))] {
            let derivative = derivative.expect("small");
            let printed = derivative.text();
            let again = Formula::parse(printed, &scope)
                .unwrap_or_else(|error| panic!("{text}\n{printed}\n{error}"));
            let (a, b) = (derivative.evaluate(&polar(x, y)), again.evaluate(&polar(x, y)));
            assert!(same(a, b), "{text}\n{printed}\n{a} or {b}");
        }
    }
}

const PIECES: [&str; 54] = [
    "x",
    "y",
    "r",
    "theta",
    "pi",
    "e",
    "a",
    "1",
    "2.5",
    "1e-3",
    "0",
    ".5",
    "+",
    "-",
    "*",
    "/",
    "^",
    "(",
    ")",
    "(",
    ")",
    ",",
    ";",
    "=",
    "==",
    "!=",
    "<",
    "<=",
    ">",
    ">=",
    "and",
    "or",
    "not",
    "let",
    "if",
    "sin",
    "sqrt",
    "atan2",
    "max",
    "abs",
    "clamp",
    "table",
    "#",
    "table(k,",
    "dtable(k,1,",
    "side(0)",
    "cos(theta/2)",
    "theta/2",
    "k",
    "\n",
    "é",
    "$",
    "1e",
    "..",
];

/// Whatever the text: an error with a place in it, or a formula that evaluates and differentiates.
#[test]
fn random_texts_do_not_crash() {
    let scope = scope();
    let mut random = Random(0x2545_F491_4F6C_DD1D);
    let mut valid = 0;
    for _ in 0..200_000 {
        let n = random.below(12);
        let blank = random.pick(&["", " "]);
        let text: String = (0..n).map(|_| random.pick(&PIECES).to_owned() + blank).collect();
        match Formula::parse(&text, &scope) {
            Ok(f) => {
                valid += 1;
                let jet = jets(&f);
                let _ = jet_at(&jet, &polar(0.3, -0.4));
            }
            Err(error) => {
                let lines = text.split('\n').collect::<Vec<_>>();
                let line = lines[error.line - 1];
                assert!(error.column <= line.chars().count() + 1, "{text:?}: {error}");
                assert!(!error.to_string().is_empty());
            }
        }
    }
    assert!(valid > 2_000, "only {valid} valid texts");
}

#[test]
fn random_bytes_do_not_crash() {
    let mut random = Random(0x1234_5678_9ABC_DEF1);
    for _ in 0..50_000 {
        let n = random.below(40);
        let bytes: Vec<u8> = (0..n).map(|_| random.bits() as u8).collect();
        let text = String::from_utf8_lossy(&bytes);
        if let Err(error) = Formula::parse(&text, &Scope::cartesian()) {
            assert!(error.line >= 1 && error.column >= 1);
        }
    }
}
