//! The WGSL of formulas: valid whatever the formula, and giving what the corpus says.

use std::sync::Arc;

use ppum::formula::{Formula, FormulaJets, Scope, Table, WgslError, wgsl_prelude};
use ppum::library::{ELASTICITY, ENRICHMENTS, Entry, POISSON, WEIGHTS};
use ppum_testkit::corpus::{self, SHADER};
use ppum_testkit::random::Random;
use ppum_testkit::wgsl::{
    ELEMENTARY, Module, Shader, tells_wrong_derivative, with_wrong_derivative,
};

fn jets(texts: &[&str], scope: &Scope, order: usize) -> FormulaJets {
    let parse =
        |text: &&str| Formula::parse(text, scope).unwrap_or_else(|error| panic!("{text}\n{error}"));
    let formulas: Vec<Formula> = texts.iter().map(parse).collect();
    FormulaJets::new(&formulas.iter().collect::<Vec<_>>(), order).expect("one or two variables")
}

/// A valid module of some functions.
#[track_caller]
fn module(functions: &[String]) -> Module {
    let source = wgsl_prelude().to_owned() + &functions.concat();
    Module::new(&source).unwrap_or_else(|error| panic!("{error}"))
}

/// The values of one formula in a module of its own.
#[track_caller]
fn run(text: &str, scope: &Scope, order: usize, inputs: &[f32]) -> Vec<f32> {
    let module = module(&[jets(&[text], scope, order).wgsl("f")]);
    module.call("f", inputs).unwrap_or_else(|error| panic!("{text}: {error}"))
}

#[test]
fn corpus_conforms() {
    let cases = corpus::cases();
    let shader = Shader::new(&cases).unwrap_or_else(|error| panic!("{error}"));
    let report = corpus::check("WGSL, interpreted", |case| shader.evaluate(case), &SHADER, &cases);
    println!("{report}");
    assert!(report.failures.is_empty(), "{report}");
    assert_eq!(report.cases(), cases.len(), "every case is asserted or declared skipped");
    assert!(report.asserted >= 800, "{} cases", report.asserted);
}

/// Texts whose last derivative is wrong by more than what rounding may do do not conform.
#[test]
fn wrong_derivatives_fail() {
    let mut cases = corpus::cases();
    cases.retain(tells_wrong_derivative);
    let shader = Shader::with_edited(&cases, with_wrong_derivative)
        .unwrap_or_else(|error| panic!("{error}"));
    let report = corpus::check("WGSL, interpreted", |case| shader.evaluate(case), &SHADER, &cases);
    assert!(cases.len() >= 700, "{} cases", cases.len());
    assert_eq!(report.failures.len(), cases.len());
}

/// Values that decide: zeros of both signs, what overflows when it is squared, infinities, NaN.
const EDGES: [f32; 22] = [
    0.0,
    -0.0,
    0.3,
    -0.3,
    0.5,
    1.0,
    -1.0,
    2.0,
    -2.0,
    3.0,
    -3.0,
    -2.5,
    27.0,
    1e-30,
    -1e-44,
    3e30,
    -3e38,
    16_777_217.0,
    f32::MAX,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
];

/// The values of double precision, rounded, up to 4 roundoffs: cube root and common logarithm are
/// made of up to four rounded operations. The smallest numbers are sparse.
#[track_caller]
fn agrees(found: f32, exact: f64, place: &str) {
    let expected = exact as f32;
    let same = found.is_nan() && expected.is_nan() || found == expected;
    let limit = 2.0 * f32::EPSILON * expected.abs() + 4.0 * f32::from_bits(1);
    assert!(same || (found - expected).abs() <= limit, "{place}: {found:e}, not {expected:e}");
}

#[test]
fn functions_at_edges() {
    let calls = [
        "sqrt(a)",
        "cbrt(a)",
        "exp(a)",
        "log(a)",
        "log10(a)",
        "sin(a)",
        "cos(a)",
        "tan(a)",
        "asin(a)",
        "acos(a)",
        "atan(a)",
        "atan2(a, b)",
        "sinh(a)",
        "cosh(a)",
        "tanh(a)",
        "abs(a)",
        "sign(a)",
        "min(a, b)",
        "max(a, b)",
        "floor(a)",
        "hypot(a, b)",
        "a^b",
        "a < b",
        "not (a <= b)",
        "a == b",
        "a < b and b > 0",
        "a != b or b > 0",
        "clamp(a, -1, 2)",
        "a^3",
        "a^-2",
        "a/b",
        "a - b",
    ];
    let condition = |text: &str| text.contains(['<', '>', '=']);
    let scope = Scope::new(&["a", "b"]).expect("names");
    let formula = |text: &str| match condition(text) {
        true => Formula::parse_condition(text, &scope),
        false => Formula::parse(text, &scope),
    };
    let formulas: Vec<Formula> =
        calls.iter().map(|text| formula(text).expect("a formula")).collect();
    let jets = FormulaJets::new(&formulas.iter().collect::<Vec<_>>(), 0).expect("values");
    let module = module(&[jets.wgsl("f")]);
    let mut exact = vec![0.0; calls.len()];
    for a in EDGES {
        for b in EDGES {
            let found = module.call("f", &[a, b]).unwrap_or_else(|error| panic!("{error}"));
            jets.evaluate(&[f64::from(a), f64::from(b)], &mut Vec::new(), &mut exact);
            for ((found, exact), call) in found.iter().zip(&exact).zip(calls) {
                agrees(*found, *exact, &format!("{call} at {a:e}, {b:e}"));
            }
        }
    }
}

/// Tables in and outside their range, on knots, at NaN, all derivatives.
#[test]
fn tables_at_edges() {
    let curve = Table::curve("k", vec![-1.0, 0.0, 2.0, 4.0], vec![1.0, -2.0, 8.0, 0.5]);
    let values = (0..12).map(|i| f64::from(i * i % 7)).collect();
    let surface = Table::surface("s", vec![0.0, 1.0, 3.0], vec![-2.0, -1.0, 0.0, 0.5], values);
    let tables = [curve.map(Arc::new), surface.map(Arc::new)].map(|t| t.expect("a table"));
    let scope =
        Scope::new(&["a", "b"]).and_then(|scope| scope.with_tables(&tables)).expect("names");
    let texts: Vec<String> = (0..4)
        .flat_map(|m| (0..4).map(move |n| format!("dtable(s, {m}, {n}, a, b)")))
        .chain((0..4).map(|m| format!("dtable(k, {m}, a)")))
        .collect();
    let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
    let jets = jets(&texts, &scope, 0);
    let module = module(&[jets.wgsl("f")]);
    let mut exact = vec![0.0; texts.len()];
    let places = [-2.0, -1.0, -0.0, 0.25, 0.5, 1.0, 2.0, 2.75, 4.0, 5.0];
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    for a in places.into_iter().chain(odd) {
        for b in places.into_iter().chain(odd) {
            let found = module.call("f", &[a, b]).unwrap_or_else(|error| panic!("{error}"));
            jets.evaluate(&[f64::from(a), f64::from(b)], &mut Vec::new(), &mut exact);
            for ((found, exact), text) in found.iter().zip(&exact).zip(&texts) {
                // coefficients and partial sums of these tables are below 64, with some
                // 20 roundings
                let near = (f64::from(*found) - exact).abs() <= 64.0 * 20.0 * 6e-8;
                assert!(
                    near || found.is_nan() && exact.is_nan(),
                    "{text} at {a}, {b}: {found} {exact}"
                );
            }
        }
    }
}

/// Constants that single precision has not are infinite or 0, and no errors of
/// constant expressions.
#[test]
fn constants_beyond_single_precision() {
    let scope = Scope::new(&["x"]).expect("a name");
    let at_2 = |text: &str| run(text, &scope, 0, &[2.0])[0];
    assert_eq!(at_2("x*1e40"), f32::INFINITY);
    assert_eq!(at_2("x - 1e300"), f32::NEG_INFINITY);
    assert_eq!(at_2("x*1e-50"), 0.0);
    assert_eq!(at_2("1e-50"), 0.0);
    assert_eq!(at_2("1/(1e-60)"), f32::INFINITY);
    assert_eq!(at_2("min(x, 1/0)"), 2.0);
    assert_eq!(at_2("x/0"), f32::INFINITY);
    assert_eq!(at_2("1/(x*-0.0)"), f32::NEG_INFINITY);
    assert_eq!(at_2("if(x > 1, 3.4028235e38, 1e-45)"), f32::MAX);
    assert!(at_2("x + log(-1)").is_nan());
    assert!(at_2("0/0").is_nan());
    let steep = Table::curve("k", vec![0.0, 1.0], vec![0.0, 1e60]).expect("finite");
    let scope = scope.with_table(Arc::new(steep)).expect("a new name");
    assert_eq!(run("table(k, x)", &scope, 1, &[2.0]), [f32::INFINITY, 0.0]);
}

/// The names of parameters are part of the interface.
#[test]
fn inputs_have_names() {
    let scope = Scope::polar().with_dependent("a", &["0", "0"]).expect("a new name").with_sides(2);
    let text = jets(&["x"], &scope, 2).wgsl("f");
    let head = "fn f(x: f32, y: f32, r: f32, theta: f32, cos_half_theta: f32, sin_half_theta: f32, \
                in_a: f32, side_0: f32, side_1: f32) -> array<f32, 6> {\n";
    assert!(text.starts_with(head), "{text}");
}

/// Names that mean something to WGSL, to the prelude or to the writer are names of variables
/// as others.
#[test]
fn any_name_is_valid() {
    let words = naga_words();
    let ours = [
        "v0",
        "v1",
        "in_x",
        "side_0",
        "f",
        "table_0_of_f",
        "ppum_pow",
        "_",
        "__",
        "cos_half_theta",
    ];
    let mut count = 0;
    for names in words.iter().map(String::as_str).chain(ours).collect::<Vec<_>>().chunks(40) {
        let free: Vec<&str> = names.iter().copied().filter(|n| Scope::new(&[n]).is_ok()).collect();
        let scope = Scope::new(&free).expect("names");
        let sum = free.iter().map(|name| format!("{name}^1.5")).collect::<Vec<_>>().join(" + ");
        let found = run(&sum, &scope, 0, &vec![4.0; free.len()])[0];
        assert_eq!(found, 8.0 * free.len() as f32);
        count += free.len();
    }
    assert!(count > 200, "{count} names");
}

/// Keywords, reserved words and predeclared names of WGSL.
fn naga_words() -> Vec<String> {
    use naga::keywords::wgsl::{BUILTIN_IDENTIFIERS, RESERVED};
    RESERVED.iter().chain(BUILTIN_IDENTIFIERS).map(|&word| word.to_owned()).collect()
}

#[test]
fn library_is_valid() {
    let of = |entries: &[Entry], scope: &Scope| -> Vec<FormulaJets> {
        let jets_of = |entry: &Entry| {
            let parameters = entry.parameters.iter();
            let scope = parameters.fold(scope.clone(), |scope, &(name, value)| {
                scope.with_parameter(name, value).expect("a new name")
            });
            jets(entry.texts, &scope, 2)
        };
        entries.iter().map(jets_of).collect()
    };
    let mut all = of(&WEIGHTS, &Scope::new(&["t"]).expect("a name"));
    all.extend(of(&ENRICHMENTS, &Scope::polar()));
    let elastic =
        ["ux", "uy", "dux_dx", "dux_dy", "duy_dx", "duy_dy", "mu", "lambda", "out_of_plane"];
    all.extend(quantities(&ELASTICITY, &elastic));
    all.extend(quantities(&POISSON, &["u", "du_dx", "du_dy", "conductivity"]));
    let texts: Vec<String> = (0..).zip(&all).map(|(i, j)| j.wgsl(&format!("f_{i}"))).collect();
    let module = module(&texts);
    assert!(module.functions().count() > all.len());
}

/// Angles to a few units of the last place, all round and at any distance: WGSL promises four
/// digits of its own.
#[test]
fn angles_are_accurate() {
    let atan2 = module(&[jets(&["atan2(y, x)"], &Scope::cartesian(), 0).wgsl("f")]);
    let atan = module(&[jets(&["atan(x)"], &Scope::cartesian(), 0).wgsl("f")]);
    let near = |found: f32, expected: f64| {
        (f64::from(found) - expected).abs() <= 4.0 * f64::from(f32::EPSILON) * expected.abs()
    };
    for k in -999..1000 {
        let angle = f64::from(k) / 1000.0 * std::f64::consts::PI;
        for size in [1e-30, 1.0, 1e30] {
            let (x, y) = ((size * angle.cos()) as f32, (size * angle.sin()) as f32);
            let found = atan2.call("f", &[x, y]).expect("a number")[0];
            assert!(near(found, f64::from(y).atan2(f64::from(x))), "{x:e} {y:e}: {found:e}");
        }
        let x = angle.sinh() as f32;
        let found = atan.call("f", &[x, 0.0]).expect("a number")[0];
        assert!(near(found, f64::from(x).atan()), "{x:e}: {found:e}");
    }
}

#[test]
fn functions_are_accurate() {
    for function in ELEMENTARY {
        let module = module(&[function.jets(0).wgsl("f")]);
        for a in function.arguments(2000) {
            let found = module.call("f", &[a]).unwrap_or_else(|error| panic!("{error}"));
            function.check(a, found[0]);
        }
    }
}

/// Only what is used is a parameter; what WGSL cannot hold is an error with the table's name.
#[test]
fn parameters_that_are_used_and_limits() {
    let scope = Scope::polar().with_sides(300);
    let text = jets(&["y*side(299)"], &scope, 0).wgsl_of_used("f").expect("two inputs");
    assert_eq!(module(&[text]).call("f", &[3.0, -1.0]), Ok(vec![-3.0]));
    let sum: Vec<String> = (0..256).map(|k| format!("side({k})")).collect();
    let error = jets(&[&sum.join("+")], &scope, 0).wgsl_of_used("f").expect_err("256 inputs");
    assert_eq!(error, WgslError::Inputs { count: 256 });

    let knots = |n: usize| (0..n).map(|k| k as f64).collect::<Vec<_>>();
    let curve = |n| Table::curve("long", knots(n), knots(n)).expect("a table");
    let surface = |n| Table::surface("long", knots(n), knots(24), vec![1.0; 24 * n]);
    for (table, text, fits) in [
        (curve(2047), "table(long, x)", true),
        (curve(2048), "table(long, x)", false),
        (curve(2048), "x", true),
        (surface(23).expect("a table"), "table(long, x, y)", true),
        (surface(24).expect("a table"), "table(long, x, y)", false),
    ] {
        let scope = Scope::cartesian().with_table(Arc::new(table)).expect("a new name");
        match jets(&[text], &scope, 1).wgsl_of_used("f") {
            Ok(text) if fits => drop(module(&[text])),
            Err(WgslError::Table { name, elements }) if !fits => {
                assert!(name == "long" && elements > 2047);
            }
            other => panic!("{text}: {other:?}"),
        }
    }
}

/// Each definition after those it may use.
fn quantities(definitions: &[(&str, &str)], names: &[&str]) -> Vec<FormulaJets> {
    let scope = Scope::new(names).expect("names");
    let mut before = String::new();
    let mut all = Vec::new();
    for (name, text) in definitions {
        all.push(jets(&[&format!("{before}{text}")], &scope, 0));
        before += &format!("let {name} = {text}; ");
    }
    all
}

/// A random number in the language.
fn random_number(random: &mut Random, depth: usize) -> String {
    const LEAVES: [&str; 12] = [
        "x",
        "y",
        "r",
        "theta",
        "side(0)",
        "0.5",
        "0",
        "-1e39",
        "1e-60",
        "7",
        "pi",
        "sin(1.5*theta)",
    ];
    const CALLS: [&str; 26] = [
        "-", "sqrt", "cbrt", "exp", "log", "log10", "sin", "cos", "tan", "asin", "acos", "atan",
        "sinh", "cosh", "tanh", "abs", "sign", "floor", "+", "min", "max", "hypot", "atan2", "^",
        "if", "table",
    ];
    if depth == 0 || random.below(8) == 0 {
        return LEAVES[random.below(LEAVES.len())].to_owned();
    }
    let call = CALLS[random.below(CALLS.len())];
    let a = random_number(random, depth - 1);
    match call {
        "^" => format!("({a})^({})", ["-3", "2", "7", "0.3", "y", "-16"][random.below(6)]),
        "table" => format!("table(curve_of_test, {a})"),
        "min" | "max" | "hypot" | "atan2" | "+" | "if" => {
            let b = random_number(random, depth - 1);
            match call {
                "+" => format!("(({a}) {} ({b}))", ["+", "-", "*", "/"][random.below(4)]),
                "if" => format!("if({}, {a}, {b})", random_condition(random, depth - 1)),
                _ => format!("{call}({a}, {b})"),
            }
        }
        _ => format!("{call}({a})"),
    }
}

fn random_condition(random: &mut Random, depth: usize) -> String {
    let sign = ["<", "<=", ">", ">=", "==", "!="][random.below(6)];
    let (a, b) = (random_number(random, depth / 2), random_number(random, depth / 2));
    let plain = format!("({a}) {sign} ({b})");
    match random.below(4) {
        0 if depth > 0 => format!("not ({plain})"),
        1 if depth > 0 => format!("({plain}) and ({})", random_condition(random, depth / 2)),
        2 if depth > 0 => format!("({plain}) or ({})", random_condition(random, depth / 2)),
        _ => plain,
    }
}

#[test]
fn random_formulas_are_valid() {
    let table = Table::curve("curve_of_test", vec![-1.0, 0.0, 1.0, 2.0], vec![1.0, 0.0, 1.0, 8.0]);
    let scope = Scope::polar()
        .with_table(Arc::new(table.expect("a table")))
        .expect("a new name")
        .with_sides(1);
    let mut random = Random(7);
    let texts: Vec<String> = (0..400).map(|i| random_number(&mut random, 2 + i % 3)).collect();
    let compiled = (0..).zip(&texts).map(|(i, text)| (format!("f_{i}"), jets(&[text], &scope, 2)));
    let compiled: Vec<(String, FormulaJets)> = compiled.collect();
    let module = module(&compiled.iter().map(|(name, jets)| jets.wgsl(name)).collect::<Vec<_>>());
    for ((name, jets), text) in compiled.iter().zip(&texts) {
        let (x, y) = (random.between(-2.0, 2.0), random.between(-2.0, 2.0));
        let (r, theta) = (f64::hypot(x, y), f64::atan2(y, x));
        let inputs = [x, y, r, theta, (theta / 2.0).cos(), (theta / 2.0).sin(), 1.0];
        let found = module
            .call(name, &inputs.map(|input| input as f32))
            .unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(found.len(), jets.n_outputs());
    }
}
