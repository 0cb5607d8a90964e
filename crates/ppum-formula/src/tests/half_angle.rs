//! Half angles: accuracy near the cut, which arguments qualify, derivatives, the origin.

use std::f64::consts::PI;

use super::{Formula, Scope, assert_near, at_angle, jet_at, jets, polar};

fn parse(text: &str) -> Formula {
    Formula::parse(text, &Scope::polar()).unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// cos(θ/2) and sin(θ/2) at a point other than the origin, on the branch of the sign,
/// without cancellation.
fn half_angle([x, y]: [f64; 2], sign: f64) -> [f64; 2] {
    let r = x.hypot(y);
    let large = ((r + x.abs()) / (2.0 * r)).sqrt();
    let small = y.abs() / (2.0 * r * (r + x.abs())).sqrt();
    if x > 0.0 { [large, sign * small] } else { [small, sign * large] }
}

/// The inputs at (−r cos δ, ±r sin δ), that is at θ = ±(π − δ), found as callers find them; θ
/// itself is withheld.
fn near_the_cut(r: f64, delta: f64, sign: f64) -> [f64; 6] {
    let [x, y] = [-r * delta.cos(), sign * r * delta.sin()];
    let [c, s] = half_angle([x, y], sign);
    [x, y, x.hypot(y), f64::NAN, c, s]
}

/// cos and sin of kθ/2 at θ = π − δ, exact to the last digits for small δ too:
/// kθ/2 = kπ/2 − kδ/2.
fn closed(k: i32, delta: f64) -> [f64; 2] {
    let (s, c) = (f64::from(k) * delta / 2.0).sin_cos();
    match k.rem_euclid(4) {
        0 => [c, -s],
        1 => [s, c],
        2 => [-c, s],
        _ => [-s, -c],
    }
}

/// Relative accuracy, also of what all but vanishes at the cut.
#[test]
fn nothing_cancels_near_the_cut() {
    for k in 1..=64 {
        let [cos, sin] = ["cos", "sin"].map(|f| parse(&format!("{f}({k}*theta/2)")));
        let tan = parse(&format!("tan({k}*theta/2)"));
        for delta in [1e-300, 1e-100, 1e-12, 1e-7, 1e-3] {
            for sign in [1.0, -1.0] {
                let inputs = near_the_cut(0.37, delta, sign);
                let [c, s] = closed(k, delta);
                // two roundings a product, at most 1 + 2 log₂ k products; the closed form has
                // its own
                let tolerance = 1e-15 * (2.0 + f64::from(k));
                let what = format!("{k}θ/2 at π − {delta:e}");
                assert_near(cos.evaluate(&inputs), c, tolerance, c.abs(), &what);
                assert_near(sin.evaluate(&inputs), sign * s, tolerance, s.abs(), &what);
                let t = sign * s / c;
                assert_near(tan.evaluate(&inputs), t, 2.0 * tolerance, t.abs(), &what);
            }
        }
    }
}

/// Digits from an evaluation with 40 digits: θ = π − 10⁻¹².
#[test]
fn known_digits_near_the_cut() {
    let inputs = near_the_cut(2.5, 1e-12, 1.0);
    for (text, value) in [
        ("cos(theta/2)", 5e-13),
        ("cos(3*theta/2)", -1.5e-12),
        ("cos(5*theta/2)", 2.5e-12),
        ("sin(theta)", 1e-12),
        ("sin(2*theta)", -2e-12),
        ("tan(theta)", -1e-12),
        ("sin(theta)*cos(theta/2)", 5e-25),
    ] {
        // the next term of the series is 10⁻²⁴ smaller
        assert_near(parse(text).evaluate(&inputs), value, 1e-15, value.abs(), text);
    }
}

#[test]
fn accurate_at_all_angles() {
    for k in [-64_i32, -3, -1, 1, 2, 3, 4, 5, 7, 31, 64] {
        let [cos, sin] = ["cos", "sin"].map(|f| parse(&format!("{f}(theta*{k}/2)")));
        for i in -100..=100 {
            let theta = 0.0314 * f64::from(i);
            let inputs = at_angle([3.0 * theta.cos(), 3.0 * theta.sin()], 3.0, theta);
            let (s, c) = (f64::from(k) * theta / 2.0).sin_cos();
            // rounding of θ is magnified k/2 times in the closed form as well
            let tolerance = 1e-15 * (2.0 + f64::from(k.abs()));
            assert_near(cos.evaluate(&inputs), c, tolerance, 1.0, &format!("cos {k} {theta}"));
            assert_near(sin.evaluate(&inputs), s, tolerance, 1.0, &format!("sin {k} {theta}"));
        }
    }
}

/// Texts of kθ/2, and others that are not.
#[test]
fn linear_forms_qualify() {
    let scope = Scope::polar().with_parameter("lambda", 0.5).expect("new");
    let parse = |text: &str| Formula::parse(text, &scope).expect("valid");
    for (text, multiple) in [
        ("theta/2", 0.5),
        ("0.5*theta", 0.5),
        ("theta*0.5", 0.5),
        ("-theta/2", -0.5),
        ("-(theta/2)", -0.5),
        ("+theta", 1.0),
        ("3*theta/2", 1.5),
        ("3/2*theta", 1.5),
        ("theta*1.5", 1.5),
        ("(theta + theta)/4", 0.5),
        ("theta/2 + theta", 1.5),
        ("theta/2 - 3*theta", -2.5),
        ("lambda*theta", 0.5),
        ("(lambda + 1)*theta", 1.5),
        ("(2*lambda - 2)*theta", -1.0),
        ("let phi = theta/2; phi*3", 1.5),
        ("32*theta", 32.0),
    ] {
        for function in ["sin", "cos", "tan"] {
            let f = parse(&format!("{function}({text})"));
            assert!(!f.uses("theta"), "{text} needs no angle");
            let [x, y, r, theta, c, s] = polar(-0.4, 0.3);
            let angle = multiple * theta;
            let expected = match function {
                "sin" => angle.sin(),
                "cos" => angle.cos(),
                _ => angle.tan(),
            };
            let found = f.evaluate(&[x, y, r, f64::NAN, c, s]);
            assert_near(found, expected, 1e-13, 1.0 + expected.abs(), text);
        }
    }
    for text in [
        "theta/3",
        "0.3*theta",
        "32.5*theta",
        "theta + 0.1",
        "theta*x",
        "theta^2",
        "2/theta",
        "theta - theta",
        "abs(theta)",
        "0*theta",
    ] {
        let f = parse(&format!("sin({text})"));
        assert!(f.uses("theta"), "{text} needs the angle");
        let inputs = polar(-0.4, 0.3);
        let expected = parse(text).evaluate(&inputs).sin();
        assert_near(f.evaluate(&inputs), expected, 1e-15, 1.0, text);
    }
    assert!(parse("asin(theta/2)").uses("theta"));
    // without half angles theta is a name like any other
    let other = Scope::cartesian().with_dependent("theta", &["0", "1"]).expect("valid");
    let f = Formula::parse("sin(theta/2)", &other).expect("valid");
    assert_eq!(f.evaluate(&[0.0, 0.0, 1.0]), 0.5f64.sin());
}

/// Derivatives of r^λ cos(kθ/2) and sin of it by the rules of polar coordinates.
#[test]
fn derivatives_of_all_multiples() {
    let power = 1.5;
    for k in [1, 2, 3, 4, 7, 16, 33] {
        for (function, phase) in [("cos", 0.0), ("sin", -PI / 2.0)] {
            let jet = jets(&parse(&format!("r^1.5*{function}({k}/2*theta)")));
            for (r, theta) in
                [(0.3_f64, 0.2_f64), (0.3, -1.2), (2.0, 2.9), (1e-5, -3.1), (0.7, 3.13)]
            {
                let m = f64::from(k) / 2.0;
                let inputs = at_angle([r * theta.cos(), r * theta.sin()], r, theta);
                let found = jet_at(&jet, &inputs);
                let hand = super::westergaard::polar_jet(power, [r, theta], m, phase);
                for i in 0..6 {
                    let order = [0, 1, 1, 2, 2, 2][i];
                    let scale = r.powf(power) * (m.max(2.0) / r).powi(order);
                    let what = format!("{function} {k}, component {i} at {r}, {theta}");
                    assert_near(found[i], hand[i], 1e-14 * m.max(2.0), scale, &what);
                }
            }
        }
    }
}

/// The second derivatives of x/r and the like, by hand: exact zeros and no cancellation on
/// the axes.
#[test]
fn whole_angles_have_clean_derivatives() {
    let (r, y) = (2.0, 1e-9);
    let at = |text: &str, x: f64, y: f64| jet_at(&jets(&parse(text)), &polar(x, y));
    assert_eq!(at("cos(theta)", r, 0.0), [1.0, 0.0, 0.0, 0.0, 0.0, -1.0 / (r * r)]);
    assert_eq!(at("sin(theta)", r, 0.0), [0.0, 0.0, 0.5, 0.0, -0.25, 0.0]);
    let found = at("cos(theta)", r, y);
    // ∂²(x/r) = (−3xy², y (2x² − y²), x (2y² − x²)) / r⁵
    for (found, expected) in found[3..]
        .iter()
        .zip([-3.0 * r * y * y, 2.0 * r * r * y, -r * r * r].map(|d| d / r.powi(5)))
    {
        assert_near(*found, expected, 1e-15, expected.abs(), "∂² cos θ");
    }
    // ∂²r/∂x² = y²/r³ to full relative accuracy where 1 − (x/r)² has none
    let expected = y * y / r.powi(3);
    assert_near(at("r", r, y)[3], expected, 1e-15, expected, "∂²r/∂x²");
}

/// At r = 0 values are finite where the formula's limit is, and derivatives are NaN.
#[test]
fn values_at_the_origin() {
    let inputs = [0.0, 0.0, 0.0, f64::NAN, 1.0, 0.0];
    for text in [
        "sqrt(r)*cos(theta/2)",
        "sqrt(r)*sin(theta)*sin(theta/2)",
        "sqrt(r)*sin(theta)*cos(theta/2)",
        "r^1.5*cos(7*theta/2)",
        "r^(2/3)*sin(2*theta)",
    ] {
        let found = jet_at(&jets(&parse(text)), &inputs);
        assert_eq!(found[0], 0.0, "{text}");
        assert!(!found[1].is_finite() || text.contains("1.5"), "{text}: {found:?}");
    }
    let values = ["cos(theta)", "sin(theta)", "cos(theta/2)", "sin(3*theta/2)"]
        .map(|text| parse(text).evaluate(&inputs));
    assert_eq!(values, [1.0, 0.0, 1.0, 0.0]);
    // a NaN of the coordinates is not hidden
    let nan = [f64::NAN; 6];
    assert!(parse("sin(theta)").evaluate(&nan).is_nan());
    assert!(parse("cos(2*theta)").evaluate(&nan).is_nan());
}

/// Half angles written as products share them.
#[test]
fn products_are_shared() {
    let all: Vec<String> = (1..=64).map(|k| format!("sin({k}*theta/2)*cos({k}*theta/2)")).collect();
    let f = parse(&all.join(" + "));
    assert!(f.program.ops().len() < 64 * 14, "{} operations", f.program.ops().len());
    let one = parse("cos(3*theta/2)");
    // 6 inputs, constants and comparisons of x/r and y/r, 2 inputs, 2 products, 1 difference
    assert!(one.program.ops().len() <= 15, "{} operations", one.program.ops().len());
}

#[test]
fn printed_derivatives_are_readable_and_parse_again() {
    let dx = |text: &str| parse(text).derivative("x").expect("small");
    assert_eq!(dx("sin(theta/2)").text(), "-(sin(theta)*cos(theta/2)/(2*r))");
    assert_eq!(dx("r").text(), "cos(theta)");
    assert_eq!(parse("sin(theta)").derivative("y").expect("small").text(), "cos(theta)^2/r");
    for text in ["cos(5*theta/2)*sqrt(r)", "r^2*sin(3*theta)", "tan(theta/2)", "theta*sin(theta)"] {
        let (dx, inputs) = (dx(text), polar(-0.4, 0.3));
        let again = parse(dx.text());
        assert_eq!(again.evaluate(&inputs), dx.evaluate(&inputs), "{}", dx.text());
        assert_eq!(again.uses("theta"), dx.uses("theta"), "{}", dx.text());
    }
}
