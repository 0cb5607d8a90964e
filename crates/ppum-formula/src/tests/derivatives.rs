//! Derivatives against closed forms and differences, and at kinks.

use std::f64::consts::LN_10;

use super::{Formula, Scope, assert_near, jet_at, jets, parse, polar};

type ReferenceFunction = fn(f64) -> f64;

/// Text, first and second derivative, where to test.
const CLOSED_FORMS: [(&str, ReferenceFunction, ReferenceFunction, [f64; 3]); 27] = [
    ("sqrt(x)", |x| 0.5 / x.sqrt(), |x| -0.25 * x.powf(-1.5), [0.1, 1.0, 9.0]),
    (
        "cbrt(x)",
        |x| x.powi(2).cbrt().recip() / 3.0,
        |x| -2.0 / 9.0 * x.cbrt().powi(-5),
        [-2.0, 0.1, 5.0],
    ),
    ("exp(x)", f64::exp, f64::exp, [-3.0, 0.0, 2.0]),
    ("log(x)", |x| 1.0 / x, |x| -1.0 / (x * x), [0.1, 1.0, 7.0]),
    ("log10(x)", |x| 1.0 / (x * LN_10), |x| -1.0 / (x * x * LN_10), [0.1, 1.0, 7.0]),
    ("sin(x)", f64::cos, |x| -x.sin(), [-3.0, 0.4, 2.0]),
    ("cos(x)", |x| -x.sin(), |x| -x.cos(), [-3.0, 0.4, 2.0]),
    (
        "tan(x)",
        |x| 1.0 + x.tan().powi(2),
        |x| 2.0 * x.tan() * (1.0 + x.tan().powi(2)),
        [-1.2, 0.0, 1.0],
    ),
    ("asin(x)", |x| (1.0 - x * x).powf(-0.5), |x| x * (1.0 - x * x).powf(-1.5), [-0.9, 0.0, 0.5]),
    ("acos(x)", |x| -(1.0 - x * x).powf(-0.5), |x| -x * (1.0 - x * x).powf(-1.5), [-0.9, 0.0, 0.5]),
    ("atan(x)", |x| 1.0 / (1.0 + x * x), |x| -2.0 * x / (1.0 + x * x).powi(2), [-4.0, 0.0, 1.5]),
    ("sinh(x)", f64::cosh, f64::sinh, [-2.0, 0.0, 1.5]),
    ("cosh(x)", f64::sinh, f64::cosh, [-2.0, 0.0, 1.5]),
    ("tanh(x)", |x| x.cosh().powi(-2), |x| -2.0 * x.tanh() * x.cosh().powi(-2), [-2.0, 0.5, 15.0]),
    ("abs(x)", f64::signum, |_| 0.0, [-2.0, 0.5, 3.0]),
    ("sign(x)", |_| 0.0, |_| 0.0, [-2.0, 0.5, 3.0]),
    ("floor(x)", |_| 0.0, |_| 0.0, [-2.4, 0.5, 3.1]),
    ("x^5", |x| 5.0 * x.powi(4), |x| 20.0 * x.powi(3), [-2.0, 0.5, 3.0]),
    ("x^-2", |x| -2.0 * x.powi(-3), |x| 6.0 * x.powi(-4), [-2.0, 0.5, 3.0]),
    ("x^2.5", |x| 2.5 * x.powf(1.5), |x| 3.75 * x.sqrt(), [0.2, 1.0, 3.0]),
    ("x^40", |x| 40.0 * x.powi(39), |x| 1560.0 * x.powi(38), [-1.1, 0.5, 1.2]),
    ("2^x", |x| 2f64.ln() * 2f64.powf(x), |x| 2f64.ln().powi(2) * 2f64.powf(x), [-2.0, 0.5, 3.0]),
    (
        "x^x",
        |x| x.powf(x) * (x.ln() + 1.0),
        |x| x.powf(x) * ((x.ln() + 1.0).powi(2) + 1.0 / x),
        [0.2, 1.0, 3.0],
    ),
    ("hypot(x, 2)", |x| x / x.hypot(2.0), |x| 4.0 / x.hypot(2.0).powi(3), [-2.0, 0.5, 3.0]),
    (
        "atan2(2, x)",
        |x| -2.0 / (x * x + 4.0),
        |x| 4.0 * x / (x * x + 4.0).powi(2),
        [-2.0, 0.5, 3.0],
    ),
    (
        "clamp(x^2, 1, 4)",
        |x| if x * x > 1.0 && x * x < 4.0 { 2.0 * x } else { 0.0 },
        |x| if x * x > 1.0 && x * x < 4.0 { 2.0 } else { 0.0 },
        [-1.5, 0.5, 3.0],
    ),
    (
        "1/x - (3*x - 1)/(x + 9)",
        |x| -1.0 / (x * x) - 28.0 / (x + 9.0).powi(2),
        |x| 2.0 / x.powi(3) + 56.0 / (x + 9.0).powi(3),
        [-2.0, 0.5, 3.0],
    ),
];

#[test]
fn closed_forms() {
    for (text, first, second, points) in CLOSED_FORMS {
        let f = parse(text);
        let (dx, jet) = (f.derivative("x").expect("small"), jets(&f));
        for x in points {
            let all = jet_at(&jet, &[x, 0.0]);
            assert_eq!(all[0], f.evaluate(&[x, 0.0]), "{text}");
            // together with others, a quotient may be a product with a reciprocal
            assert_near(all[1], dx.evaluate(&[x, 0.0]), 4e-16, all[1].abs(), text);
            let scale = |v: f64| v.abs().max(1e-3);
            assert_near(all[1], first(x), 1e-14, scale(first(x)), &format!("{text}′ at {x}"));
            assert_near(all[3], second(x), 1e-13, scale(second(x)), &format!("{text}″ at {x}"));
            assert_eq!([all[2], all[4], all[5]], [0.0; 3], "{text} does not depend on y");
        }
    }
}

/// Central difference of fourth order.
fn difference(f: impl Fn(f64) -> f64, x: f64) -> f64 {
    let h = 1e-3;
    (8.0 * (f(x + h) - f(x - h)) - (f(x + 2.0 * h) - f(x - 2.0 * h))) / (12.0 * h)
}

#[test]
fn differences_of_one_variable() {
    for (text, _, _, points) in CLOSED_FORMS {
        let f = parse(text);
        let dx = f.derivative("x").expect("small");
        let dxx = dx.derivative("x").expect("small");
        for x in points {
            for (f, d) in [(&f, &dx), (&dx, &dxx)] {
                let (found, expected) =
                    (d.evaluate(&[x, 0.0]), difference(|x| f.evaluate(&[x, 0.0]), x));
                assert_near(found, expected, 1e-5, 1.0 + expected.abs(), &format!("{text} at {x}"));
            }
        }
    }
}

#[test]
fn differences_in_the_plane() {
    let scope = Scope::polar().with_parameter("nu", 0.3).expect("new");
    for text in [
        "x^3*y - 2*x*y^2 + nu",
        "exp(-x^2)*sin(3*y)/(1 + r)",
        "r^1.7*cos(1.5*theta)",
        "atan2(y - 1, x + 2)*hypot(x, y - 3)",
        "let k = (1 - nu)/(1 + nu); sqrt(r)*(k*cos(theta/2) - cos(3*theta/2))",
        "if(x*y > 0, x^2*y, sin(x)*y) + max(x, y)*min(x^2, y) + abs(x - 2*y)",
        "log(1 + r^2)*tanh(x*y) - cbrt(3 + x)*x^y^2",
    ] {
        let text = text.replace("x^y^2", "(x^2 + 1)^(y^2)");
        let f = Formula::parse(&text, &scope).expect("valid");
        let jet = jets(&f);
        let at = |x: f64, y: f64| jet_at(&jet, &polar(x, y));
        for (x, y) in [(0.7, 0.4), (-0.5, 1.1), (-0.9, -0.8), (1.3, -0.2)] {
            let all = at(x, y);
            let pairs = [
                (all[1], difference(|x| at(x, y)[0], x)),
                (all[2], difference(|y| at(x, y)[0], y)),
                (all[3], difference(|x| at(x, y)[1], x)),
                (all[4], difference(|y| at(x, y)[1], y)),
                (all[4], difference(|x| at(x, y)[2], x)),
                (all[5], difference(|y| at(x, y)[2], y)),
            ];
            for (found, expected) in pairs {
                let what = format!("{text} at {x}, {y}");
                assert_near(found, expected, 1e-8, 1.0 + expected.abs(), &what);
            }
        }
    }
}

/// The tie of a kink belongs to the right piece, then to the upper one.
#[test]
fn kinks() {
    // text, the point, the gradient there
    let cases: [(&str, [f64; 2], [f64; 2]); 17] = [
        ("abs(x)", [0.0, 3.0], [1.0, 0.0]),
        ("abs(-x)", [0.0, 3.0], [1.0, 0.0]),
        ("abs(1 - x)", [1.0, 0.0], [1.0, 0.0]),
        ("abs(x)", [-0.0, 3.0], [1.0, 0.0]),
        ("abs(2 - y)", [0.0, 2.0], [0.0, 1.0]),
        ("abs(x - y)", [2.0, 2.0], [1.0, -1.0]),
        ("abs(y - x)", [2.0, 2.0], [1.0, -1.0]),
        ("abs(y - x^2)", [0.0, 0.0], [0.0, 1.0]),
        ("abs(y - x^2)", [1.0, 1.0], [2.0, -1.0]),
        ("max(x, 0)", [0.0, 0.0], [1.0, 0.0]),
        ("max(0, x)", [0.0, 0.0], [1.0, 0.0]),
        ("max(1 - x, 0)", [1.0, 0.0], [0.0, 0.0]),
        ("min(x, 0)", [0.0, 0.0], [0.0, 0.0]),
        ("min(0, -y)", [0.0, 0.0], [0.0, -1.0]),
        // of `if` the author decides to which branch the tie belongs
        ("if(x < 0, -x, 2*x)", [0.0, 0.0], [2.0, 0.0]),
        ("if(x <= 0, -x, 2*x)", [0.0, 0.0], [-1.0, 0.0]),
        ("x*floor(y) + x*sign(y)", [1.0, 2.0], [3.0, 0.0]),
    ];
    for (text, [x, y], gradient) in cases {
        let all = jet_at(&jets(&parse(text)), &[x, y]);
        assert_eq!([all[1], all[2]], gradient, "{text} at {x}, {y}");
    }
}

#[test]
fn kinks_have_the_hessian_of_their_piece() {
    let at = |text: &str, x: f64, y: f64| jet_at(&jets(&parse(text)), &[x, y]);
    assert_eq!(at("abs(x^3 - x)", 1.0, 0.0)[3], 6.0);
    assert_eq!(at("abs(x^3 - x)", -1.0, 0.0)[3], -6.0);
    // |x³ − x| falls from 0 to the right of 0 as x − x³
    assert_eq!(at("abs(x^3 - x)", 0.0, 0.0)[1], 1.0);
    assert_eq!(at("max(1 - x, 0)^2", 0.5, 0.0)[3], 2.0);
    assert_eq!(at("max(1 - x, 0)^2", 1.0, 0.0)[3], 0.0);
}

/// A branch that is constant has slope zero, whatever stands around it.
#[test]
fn constant_branches_do_not_make_nan() {
    for text in ["sqrt(max(x, 0))", "max(x, 0)^0.3", "cbrt(3*max(0, x))/7", "log(max(x, 0) + 0)"] {
        let f = parse(text).derivative("x").expect("small");
        assert_eq!(f.evaluate(&[-1.0, 0.0]), 0.0, "{text}");
    }
    let jet = jets(&parse("sqrt(max(x, 0))"));
    assert_eq!(jet_at(&jet, &[-1.0, 2.0]), [0.0; 6]);
    let f = jets(&parse("if(x > 0, exp(-1/x), 0)"));
    assert_eq!(jet_at(&f, &[0.0, 0.0]), [0.0; 6]);
}

/// Layers: functions that are flat far out have derivatives 0 there, though parts overflow.
#[test]
fn layers_are_flat_far_out() {
    for text in ["tanh(x/1e-3)", "1/cosh(x/1e-3)", "exp(-x/1e-3)", "y/exp(x/1e-3)", "atan(x)"] {
        let x = if text == "atan(x)" { 1e200 } else { 0.9 };
        let all = jet_at(&jets(&parse(text)), &[x, 1.0]);
        assert_eq!(all[1..], [0.0; 5], "{text}");
    }
    // and to full relative accuracy on the way
    let slope = parse("tanh(x)").derivative("x").expect("small").evaluate(&[30.0, 0.0]);
    assert_near(slope, 4.0 * (-60f64).exp(), 1e-14, slope, "slope of tanh at 30");
}

#[test]
fn dependent_variables_follow_their_rules() {
    // d = x + 2y, with a wrong value on purpose: the caller's value is taken as it is
    let scope = Scope::cartesian().with_dependent("d", &["1", "2"]).expect("valid");
    let jet = jets(&Formula::parse("d^2*x", &scope).expect("valid"));
    let found = jet_at(&jet, &[3.0, 0.0, 10.0]);
    assert_eq!(found, [300.0, 160.0, 120.0, 46.0, 52.0, 24.0]);
}

/// Texts of derivatives are formulas of the same scope, with the same values to the last bit.
#[test]
fn printed_derivatives_parse_again() {
    let scope = Scope::polar().with_parameter("s1", 0.25).expect("new");
    for text in ["sqrt(r)*sin(theta)*sin(theta/2)", "if(x^2 > 2, -x^-3, 0/0)*s1", "abs(x*y)^(-x)"] {
        let dx = Formula::parse(text, &scope).expect("valid").derivative("x").expect("small");
        let again = Formula::parse(dx.text(), &scope).expect("printed text");
        for (x, y) in [(0.5, 0.2), (-1.5, 0.3), (2.5, -3.0)] {
            let (a, b) = (dx.evaluate(&polar(x, y)), again.evaluate(&polar(x, y)));
            assert!(super::same(a, b), "{}", dx.text());
        }
    }
    assert_eq!(parse("x^3 + 2*x*y").derivative("x").expect("small").text(), "3*x^2 + 2*y");
    assert_eq!(parse("sin(2*x)").derivative("x").expect("small").text(), "2*cos(2*x)");
}
