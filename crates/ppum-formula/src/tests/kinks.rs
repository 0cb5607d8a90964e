//! Kinks and singularities.

use std::sync::Arc;

use crate::{Formula, Kink, Scope, Table};

use super::{parse, polar};

/// The lines of the kinks, normalised: first coefficient that is not zero positive, largest of a,
/// b 1.
fn lines(text: &str) -> Vec<Option<[f64; 3]>> {
    let lines = parse(text).kinks().iter().map(Kink::line).collect::<Vec<_>>();
    lines.into_iter().map(|line| line.map(normalised)).collect()
}

fn normalised([a, b, c]: [f64; 3]) -> [f64; 3] {
    let size = a.abs().max(b.abs()) * if a < 0.0 || a == 0.0 && b < 0.0 { -1.0 } else { 1.0 };
    [a, b, c].map(|v| v / size)
}

fn texts(sets: &[Kink]) -> Vec<&str> {
    sets.iter().map(|kink| kink.value.text()).collect()
}

#[test]
fn lines_are_recognised() {
    let one = |a: f64, b: f64, c: f64| vec![Some(normalised([a, b, c]))];
    for (text, expected) in [
        ("x^2 + sin(y)", vec![]),
        ("abs(x)", one(1.0, 0.0, 0.0)),
        ("abs(x - 2*y + 3)", one(1.0, -2.0, 3.0)),
        ("sign(1 - (x + y)/2)", one(1.0, 1.0, -2.0)),
        ("max(x, y)", one(1.0, -1.0, 0.0)),
        ("min(x + y, 2*x)", one(1.0, -1.0, 0.0)),
        ("if(2*x < 1, 1, 3)", one(2.0, 0.0, -1.0)),
        ("if(not (x >= 0.5 and x > 0.5), 1, x)", one(2.0, 0.0, -1.0)),
        ("clamp(y, -1, 1)", [one(0.0, 1.0, 1.0), one(0.0, 1.0, -1.0)].concat()),
        ("abs(x)*abs(-3*x)*max(0, x)*sign(x^3)", one(1.0, 0.0, 0.0)),
        // products and quotients vanish with their factors
        ("sign(x*y)", [one(1.0, 0.0, 0.0), one(0.0, 1.0, 0.0)].concat()),
        ("abs((x - 1)/exp(y))", one(1.0, 0.0, -1.0)),
        ("abs(sqrt(x - 1)*cosh(y))", one(1.0, 0.0, -1.0)),
        (
            "abs(1 - 2*abs(x))",
            [one(1.0, 0.0, 0.0), one(1.0, 0.0, -0.5), one(1.0, 0.0, 0.5)].concat(),
        ),
        (
            "max(abs(y) - 3, 0)",
            [one(0.0, 1.0, 0.0), one(0.0, 1.0, -3.0), one(0.0, 1.0, 3.0)].concat(),
        ),
        ("max(3 + abs(y), 0)", one(0.0, 1.0, 0.0)),
        (
            "abs(5 - 3*min(x, y))",
            [one(1.0, -1.0, 0.0), one(1.0, 0.0, -5.0 / 3.0), one(0.0, 1.0, -5.0 / 3.0)].concat(),
        ),
        ("abs(abs(x) + y)", [one(1.0, 0.0, 0.0), one(1.0, 1.0, 0.0), one(1.0, -1.0, 0.0)].concat()),
        (
            "max(1 - abs(x), 0)*max(0, 1 - abs(x - y))",
            [
                one(1.0, 0.0, 0.0),
                one(1.0, 0.0, -1.0),
                one(1.0, 0.0, 1.0),
                one(1.0, -1.0, 0.0),
                one(1.0, -1.0, -1.0),
                one(1.0, -1.0, 1.0),
            ]
            .concat(),
        ),
        ("atan2(y - 1, x)", one(0.0, 1.0, -1.0)),
        // equalities are exceptions, constants have no zeros
        ("if(x == 0, 0, x^2)", vec![]),
        ("if(x != 0 or y == 1, 0, x^2)", vec![]),
        ("abs(2) + if(1 < 2, x, y) + sign(x - x)", vec![]),
        // not lines, though the gradient is constant where it exists
        ("abs(floor(x) + y)", vec![None, None]),
        ("abs(x^2 + y^2 - 1)", vec![None]),
        ("abs(sign(x) + y)", [one(1.0, 0.0, 0.0), vec![None]].concat()),
        ("abs(1/x + y)", vec![None]),
    ] {
        assert_eq!(lines(text), expected, "{text}");
    }
}

#[test]
fn curves_are_formulas_of_the_same_scope() {
    let f =
        Formula::parse("max(1 - r^2, 0) + abs(abs(theta) - 1)", &Scope::polar()).expect("valid");
    let kinks = f.kinks();
    assert_eq!(texts(&kinks), ["1 - r^2", "theta", "theta - 1", "1 + theta"]);
    assert!(kinks.iter().all(|kink| kink.line().is_none()));
    for kink in &kinks {
        let inputs = polar(0.3, 0.4);
        let again = Formula::parse(kink.value.text(), f.scope()).expect("printed text");
        assert_eq!(again.evaluate(&inputs), kink.value.evaluate(&inputs));
    }
    let sides = Scope::cartesian().with_sides(1);
    let f = Formula::parse("abs(side(0)/2 + x)", &sides).expect("valid");
    assert_eq!(f.kinks()[0].line(), None, "it jumps on the crack");
}

/// Lines of a scope whose variables stand in another order, or are not x and y.
#[test]
fn lines_go_by_name() {
    let line = |names: &[&str]| {
        let f = Formula::parse("abs(2*x + 3)", &Scope::new(names).expect("names")).expect("valid");
        f.kinks()[0].line()
    };
    assert_eq!(line(&["y", "x"]), Some([2.0, 0.0, 3.0]));
    assert_eq!(line(&["x", "t"]), None);
}

/// Whatever the formula: where no kink is near, differences of the slopes are small.
#[test]
fn between_kinks_slopes_are_continuous() {
    for text in [
        "abs(x^2 - 0.3)*max(x, 0.2) + min(x*y, x + y)",
        "if(x^2 + y^2 < 0.7, x, y*floor(3*x)) + clamp(x - y, -0.1, 0.4)",
        "sign(sin(4*x + y))*x + atan2(x - 0.11, y - 0.7)",
    ] {
        let f = parse(text);
        let (kinks, dx) = (f.kinks(), f.derivative("x").expect("small"));
        let (mut jumps, n) = (0, 3999);
        for (a, b) in (0..n)
            .map(|k| [k, k + 1].map(|k| 2.0 * f64::from(k) / f64::from(n) - 1.01))
            .map(|[a, b]| (a, b))
        {
            let at = |g: &Formula, x: f64| g.evaluate(&[x, 0.37]);
            let crossed = |kink: &Kink| at(&kink.value, a) * at(&kink.value, b) <= 0.0;
            let jump = [&f, &dx].iter().any(|g| (at(g, a) - at(g, b)).abs() > 0.05);
            jumps += i32::from(jump);
            assert!(!jump || kinks.iter().any(crossed), "{text} jumps at {a}");
        }
        assert!(jumps > 0, "{text} should jump somewhere");
    }
}

fn table() -> Arc<Table> {
    Arc::new(Table::curve("k", vec![0.25, 0.5, 1.5, 2.0], vec![1.0, 2.0, 0.0, 1.0]).expect("valid"))
}

#[test]
fn tables_have_kinks_at_the_ends_of_their_range() {
    let scope = Scope::cartesian().with_table(table()).expect("new");
    let kinks = |text: &str| {
        let kinks = Formula::parse(text, &scope).expect("valid").kinks();
        kinks.iter().map(|kink| kink.line().expect("a line")[2]).collect::<Vec<_>>()
    };
    assert_eq!(kinks("table(k, x)"), [-0.25, -2.0]);
    assert_eq!(kinks("dtable(k, 1, x)"), [-0.25, -2.0]);
    assert_eq!(kinks("dtable(k, 2, x)"), [-0.25, -0.5, -1.5, -2.0]);
    let knots = vec![0.0, 1.0];
    let surface = Table::surface("g", knots.clone(), knots, vec![1.0; 4]).expect("valid");
    let scope = Scope::cartesian().with_table(Arc::new(surface)).expect("new");
    let kinks = Formula::parse("table(g, x, 2*y)", &scope).expect("valid").kinks();
    assert_eq!(texts(&kinks), ["x", "x - 1", "y", "2*y - 1"]);
}

fn breakpoints(text: &str, lo: f64, hi: f64) -> Vec<f64> {
    let scope = Scope::new(&["t"]).and_then(|scope| scope.with_table(table())).expect("names");
    Formula::parse(text, &scope).unwrap_or_else(|e| panic!("{e}")).breakpoints(lo, hi)
}

#[test]
fn breakpoints_of_linear_functions_are_exact() {
    for (text, expected) in [
        ("t^2 + exp(t)", vec![]),
        ("if(t < 0.3, 1, 0)", vec![0.3]),
        ("abs(3*t - 1)", vec![1.0 / 3.0]),
        ("max(1 - t, 0)^3 + max(0.5 - t, 0)^3", vec![0.5, 1.0]),
        ("if(t < 1, exp(1 - 1/(1 - t^2)), 0)", vec![1.0]),
        ("clamp(t, 0, 2)", vec![0.0, 2.0]),
        ("clamp(t, 0.1, 2.1)", vec![0.1]),
        ("floor(4*t)", vec![0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0]),
        ("floor(0.5 - 2*t)", vec![0.25, 0.75, 1.25, 1.75]),
        ("table(k, t)", vec![0.25, 2.0]),
        ("sqrt(0.5 - t) + log(t - 0.25)", vec![0.25, 0.5]),
        ("1/(t - 1) + (t - 1.5)^-2 + asin(t)", vec![1.0, 1.5]),
        ("abs(t - 5)", vec![]),
        ("floor(1e300*t)", vec![]),
    ] {
        assert_eq!(breakpoints(text, 0.0, 2.0), expected, "{text}");
    }
}

#[test]
fn breakpoints_of_curves_are_found_to_rounding() {
    let pi = std::f64::consts::PI;
    for (text, expected) in [
        ("abs(t^2 - 2)", vec![2f64.sqrt()]),
        ("abs(sin(3*t + 1))", vec![(pi - 1.0) / 3.0, (2.0 * pi - 1.0) / 3.0]),
        ("sign(exp(t) - 3)", vec![3f64.ln()]),
        ("max(t^3, 0.001)", vec![0.1]),
        ("floor(t^2)", vec![0.0, 1.0, 2f64.sqrt(), 3f64.sqrt(), 2.0]),
        ("floor(abs(t - 1) + 1)", vec![0.0, 1.0, 2.0]),
        // touched only
        ("abs(t^2 - 0.6*t + 0.09)", vec![0.3]),
        ("if(1 - cos(t - 1.1) <= 0, 5, t)", vec![1.1]),
        // a jump that is no zero, a pole, NaN on one side
        ("abs(sign(t - 0.7) + 0.5)", vec![0.7]),
        ("sign(1/(t^3 - 1))", vec![1.0]),
        ("abs(sqrt(t - 0.2) - 0.3)", vec![0.2, 0.29]),
        ("floor(sin(1e9*t) + 7.5)*0 + abs(t - 1)", vec![1.0]),
    ] {
        let found = breakpoints(text, 0.0, 2.0);
        if text.contains("1e9") {
            assert!(found.contains(&1.0), "{text}");
            continue;
        }
        assert_eq!(found.len(), expected.len(), "{text}: {found:?}");
        for (a, b) in found.iter().zip(expected) {
            // a touched zero is where the slope vanishes; its rounding is that of the coefficients
            assert!((a - b).abs() < 2e-15, "{text}: {a} is not {b}");
        }
    }
}

#[test]
fn useless_ranges_have_no_breakpoints() {
    for (lo, hi) in [(1.0, 0.0), (f64::NAN, 1.0), (0.0, f64::INFINITY), (-f64::MAX, f64::MAX)] {
        assert_eq!(breakpoints("abs(t - 0.5)", lo, hi), [0.0; 0]);
    }
    assert_eq!(breakpoints("abs(t - 0.5)", 0.5, 0.5), [0.5]);
}

#[test]
fn singular_sets() {
    let scope = Scope::polar();
    let f = |text: &str| Formula::parse(text, &scope).expect("valid");
    let sets = |text: &str| {
        let sets = f(text).singularities();
        sets.iter().map(|set| set.value.text().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(sets("(x + y)^1.5*cbrt(x)/(y - 1)"), ["x + y", "x", "y - 1"]);
    assert_eq!(sets("x^3 + exp(y)"), [""; 0]);
    assert_eq!(sets("hypot(x - 1, y)^0.7"), ["hypot(x - 1, y)"]);
    for (text, singular, branch) in [
        ("x*y", false, false),
        ("r^1.5", true, false),
        ("theta", true, true),
        ("sin(theta/2)", true, true),
        ("x + cos(theta)", true, false),
        ("cos(2*theta)", true, false),
        ("tan(3*theta/2)", true, true),
    ] {
        assert_eq!(
            (f(text).singular_at_origin(), f(text).uses_branch()),
            (singular, branch),
            "{text}"
        );
    }
}

/// Thousands of nested kinks are cut off before they fill the memory.
#[test]
fn hostile_numbers_of_kinks() {
    let mut text = "let a0 = x;".to_owned();
    for i in 0..2500 {
        text += &format!("let a{} = abs(a{i}-.1);", i + 1);
    }
    let nested = parse(&format!("{text} a2500")).kinks();
    assert!(!nested.is_empty() && nested.len() <= 1024);
    let total: usize = nested.iter().map(|kink| kink.value.program.ops().len()).sum();
    assert!(total < 1 << 17, "{total} operations");
    let many: String = (0..4000).map(|i| format!("abs(x-{i})+")).collect();
    assert_eq!(parse(&format!("{many}0")).kinks().len(), 1024);
}
