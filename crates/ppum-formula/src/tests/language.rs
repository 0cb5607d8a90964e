//! Grammar and values.

use std::f64::consts::{E, PI};

use super::{Formula, Scope, parse, value};

type UnaryCase = fn(f64) -> f64;
type BinaryCase = fn(f64, f64) -> f64;

#[test]
fn precedence_and_grouping() {
    for (text, expected) in [
        ("1 + 2*3", 7.0),
        ("(1 + 2)*3", 9.0),
        ("8 - 3 - 2", 3.0),
        ("16/4/2", 2.0),
        ("2^3^2", 512.0),
        ("(2^3)^2", 64.0),
        ("-2^2", -4.0),
        ("(-2)^2", 4.0),
        ("2^-1", 0.5),
        ("2^-2^2", 0.0625),
        ("2^-1*4", 2.0),
        ("-2*3", -6.0),
        ("2*-3", -6.0),
        ("2 - -3", 5.0),
        ("--2", 2.0),
        ("+2 - +1", 1.0),
        ("-3 + 5", 2.0),
        ("6/2*3", 9.0),
        ("1e2 + .5", 100.5),
        ("5.", 5.0),
        ("2−1", 1.0),
    ] {
        assert_eq!(value(text, 0.0, 0.0), expected, "{text}");
    }
}

#[test]
fn conditions() {
    for (text, expected) in [
        ("if(x < y, 1, 0)", 1.0),
        ("if(x <= 1, 1, 0)", 1.0),
        ("if(x > y, 1, 0)", 0.0),
        ("if(y >= 2, 1, 0)", 1.0),
        ("if(x == 1, 1, 0)", 1.0),
        ("if(x != 1, 1, 0)", 0.0),
        ("if(x + 1 < y*3, 1, 0)", 1.0),
        ("if(not x < y, 1, 0)", 0.0),
        ("if(not x < y or y > 0, 1, 0)", 1.0),
        // `and` binds tighter than `or`
        ("if(x == 1 or x == 5 and y == 5, 1, 0)", 1.0),
        ("if((x == 1 or x == 5) and y == 5, 1, 0)", 0.0),
        ("if(not (x == 1 and y == 5), 1, 0)", 1.0),
        ("let inside = x^2 + y^2 < 6; if(inside, 1, 0)", 1.0),
    ] {
        assert_eq!(value(text, 1.0, 2.0), expected, "{text}");
    }
}

#[test]
fn comparisons_with_nan_are_false() {
    for (text, expected) in [
        ("if(x < y, 1, 0)", 0.0),
        ("if(x >= y, 1, 0)", 0.0),
        ("if(not x < y, 1, 0)", 1.0),
        ("if(x == x, 1, 0)", 0.0),
        ("if(x != x, 1, 0)", 1.0),
    ] {
        assert_eq!(value(text, f64::NAN, 1.0), expected, "{text}");
    }
}

#[test]
fn names_bound_by_let() {
    assert_eq!(value("let a = x + 1; let b = a*a; b - a", 2.0, 0.0), 6.0);
    assert_eq!(value("2*(let a = x; a*a) + (let a = y; a)", 3.0, 4.0), 22.0);
    assert_eq!(value("max(let a = x; a*a, y)", 3.0, 4.0), 9.0);
    assert_eq!(value("let unused = 1/0; x", 3.0, 4.0), 3.0);
}

#[test]
fn comments_and_blanks() {
    assert_eq!(value("# the radius\n  sqrt( x^2 # squared\r\n\t+ y^2 )  # done", 3.0, 4.0), 5.0);
}

#[test]
fn constants_and_parameters() {
    assert_eq!(value("pi", 0.0, 0.0), PI);
    assert_eq!(value("e", 0.0, 0.0), E);
    let scope = Scope::cartesian().with_parameter("k", 2.5).expect("new");
    let f = Formula::parse("k*x", &scope).expect("valid");
    assert_eq!(f.evaluate(&[2.0, 0.0]), 5.0);
}

/// Functions that are no operations of the processor are right to two units in the last place, and
/// those of the platform, which they are compared with here, to one. How far off they are
/// tells `elementary/tests.rs`.
fn agree(found: f64, expected: f64, is_exact: bool) -> bool {
    let unit = if is_exact { 0.0 } else { 3.0 * f64::EPSILON };
    let is_special = !expected.is_finite() || expected == 0.0;
    let equal = found == expected || found.is_nan() && expected.is_nan();
    equal || !is_special && (found - expected).abs() <= unit * expected.abs()
}

#[test]
fn functions_of_one_number() {
    let cases: [(&str, UnaryCase); 17] = [
        ("sqrt", f64::sqrt),
        ("cbrt", f64::cbrt),
        ("exp", f64::exp),
        ("log", f64::ln),
        ("log10", f64::log10),
        ("sin", f64::sin),
        ("cos", f64::cos),
        ("tan", f64::tan),
        ("asin", f64::asin),
        ("acos", f64::acos),
        ("atan", f64::atan),
        ("sinh", f64::sinh),
        ("cosh", f64::cosh),
        ("tanh", f64::tanh),
        ("abs", f64::abs),
        ("floor", f64::floor),
        ("sign", |a| if a == 0.0 { 0.0 } else { a.signum() }),
    ];
    for (name, function) in cases {
        let f = parse(&format!("{name}(x)"));
        for x in [-1e300, -2.5, -1.0, -0.3, 0.0, 1e-300, 0.3, 1.0, 2.5, 1e300, f64::INFINITY] {
            let (found, expected) = (f.evaluate(&[x, 0.0]), function(x));
            let is_exact = ["sqrt", "abs", "floor", "sign"].contains(&name);
            assert!(agree(found, expected, is_exact), "{name}({x}): {found:e}, not {expected:e}");
        }
        assert!(f.evaluate(&[f64::NAN, 0.0]).is_nan(), "{name} of NaN");
    }
}

#[test]
fn functions_of_several_numbers() {
    let cases: [(&str, BinaryCase); 8] = [
        ("atan2(x, y)", f64::atan2),
        ("hypot(x, y)", f64::hypot),
        ("min(x, y)", f64::min),
        ("max(x, y)", f64::max),
        ("x^y", f64::powf),
        ("x^2.5 + y", |x, y| x.powf(2.5) + y),
        ("clamp(x, -1, y)", |x, y| x.max(-1.0).min(y)),
        ("if(x > y, x - y, 2)", |x, y| if x > y { x - y } else { 2.0 }),
    ];
    for (text, function) in cases {
        for (x, y) in [(1.5, 2.0), (2.0, 1.5), (-1.5, 0.5), (-3.0, -2.0), (0.0, 1.0), (4.0, -0.5)] {
            let (found, expected) = (value(text, x, y), function(x, y));
            let is_exact = ["min", "max", "clamp", "if"].iter().any(|name| text.starts_with(name));
            assert!(
                agree(found, expected, is_exact),
                "{text} at {x}, {y}: {found:e}, not {expected:e}"
            );
        }
    }
}

#[test]
fn special_values() {
    assert_eq!(value("1/x", 0.0, 0.0), f64::INFINITY);
    assert_eq!(value("log(x)", 0.0, 0.0), f64::NEG_INFINITY);
    assert!(value("x/x", 0.0, 0.0).is_nan());
    assert!(value("0*x", f64::INFINITY, 0.0).is_nan(), "folding must not hide a NaN");
    assert!(value("x - x", f64::INFINITY, 0.0).is_nan());
    assert!(value("max(x, 0)", f64::NAN, 0.0).is_nan());
}

#[test]
fn constant_formulas_are_known() {
    assert_eq!(parse("2*sqrt(4) + 1").constant(), Some(5.0));
    assert_eq!(parse("if(1 < 2, 3, x)").constant(), Some(3.0));
    assert_eq!(parse("x + 1").constant(), None);
    assert!(parse("x + 1").uses("x"));
    assert!(!parse("x + 1").uses("y"));
    assert!(!parse("x + 1").uses("nothing"));
}
