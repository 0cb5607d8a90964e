//! Tables, weights, enrichments, quantities and materials given by formulas.

use std::sync::Arc;

use ppum::dataset::NamedQuantity;
use ppum::formula::Table;
use ppum::function::{Declared, WESTERGAARD};
use ppum::library;

use super::*;

/// A plate with one of everything. Line numbers: 1 domain, 4 material, 8 crack, 10 and 13 boundary,
/// 16 and 20 table, 25, 32, 38 and 42 enrichment, 45 quantity, 49 discretization.
const FORMULAS: &str = r#"[domain]
min = [-1.0, -1.0]
max = [1.0, 1.0]
[material]
young = "if(y > 0.5, 10, table(k, x))"
poisson = 0.3
state = "plane-strain"
[[crack]]
points = [[-1.0, 0.0], [0.0, 0.0]]
[[boundary]]
on = "top"
traction = [0.0, "table(g, x, y)"]
[[boundary]]
on = "bottom"
traction = [0.0, -1.0]
[[table]]
name = "k"
x = [-2.0, 0.0, 2.0]
values = [3.0, 1.0, 3.0]
[[table]]
name = "g"
x = [0.0, 1.0]
y = [-1.0, 1.0, 2.0]
values = [[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]
[[enrichment]]
name = "corner of mine"
functions = ["r^lambda*cos(m*theta)", "table(k, y)"]
parameters = { lambda = 0.6, m = "pi/4" }
at = [0.5, 0.25]
angle = "pi/2"
radius = 0.3
[[enrichment]]
function = "kink"
along = [[-1.0, 0.5], [1.0, 0.5]]
degree = 2
kinks = [[[0.0, 0.0], [1.0, 0.0]]]
singular = [[0.5, 0.0]]
[[enrichment]]
function = "westergaard"
at = "tips"
radius = 0
[[enrichment]]
function = "exp(-x/0.01)"
where = "x < -0.5 and table(k, x) > 1"
[[quantity]]
name = "slip-rate"
formula = "sqrt(ux^2 + uy^2)*table(k, x)"
unit = "mm"
[discretization]
level = 4
enrichment = "jumps"
weight = "exp(1 - 1/(1 - t^2))"
order = "2 + table(g, x, y)/6"
"#;

#[test]
fn everything_given_by_formulas() {
    let problem = good(FORMULAS);
    let p = vec2(1.0, 0.0);
    let elastic = problem.equation.elastic().expect("elasticity");
    // the parabola through (−2, 3), (0, 1), (2, 3)
    assert_eq!((elastic.young.value(p), elastic.young.value(vec2(1.0, 0.6))), (1.5, 10.0));
    let Condition::Neumann(top) = &problem.boundary[0].components[1] else { panic!("a load") };
    assert_eq!(top.value(vec2(0.5, -1.0)), 1.5);
    let names: Vec<_> = problem.tables.iter().map(|table| table.name()).collect();
    assert_eq!(names, ["k", "g"]);
    assert_eq!(problem.discretization.enrichment, Enrichment::Jumps);
    assert!(matches!(problem.discretization.weight, WeightFunction::Formula(_)));
    let text = "sqrt(ux^2 + uy^2)*table(k, x)".to_owned();
    let quantity = NamedQuantity { name: "slip-rate".to_owned(), text, unit: "mm".to_owned() };
    assert_eq!(problem.quantities, [quantity]);
    assert_eq!(problem.check(), Ok(()));
}

#[test]
fn enrichments() {
    let problem = good(FORMULAS);
    let [corner, kink, tips, layer] = problem.enrichments.as_slice() else { panic!("four") };
    let angle = std::f64::consts::FRAC_PI_2;
    let expected = LocalEnrichment {
        name: "corner of mine".to_owned(),
        parameters: vec![("lambda".to_owned(), 0.6), ("m".to_owned(), 0.5 * angle)],
        region: Region::Near(0.3),
        ..LocalEnrichment::new(
            &["r^lambda*cos(m*theta)", "table(k, y)"],
            Site::Point { at: vec2(0.5, 0.25), angle },
        )
    };
    assert_eq!(*corner, expected);
    let expected = LocalEnrichment {
        name: "kink".to_owned(),
        degree: Some(2),
        declared: Declared {
            kinks: vec![[vec2(0.0, 0.0), vec2(1.0, 0.0)]],
            singular: vec![vec2(0.5, 0.0)],
        },
        ..LocalEnrichment::new(&["abs(y)"], Site::Along([vec2(-1.0, 0.5), vec2(1.0, 0.5)]))
    };
    assert_eq!(*kink, expected);
    let expected = LocalEnrichment {
        name: "westergaard".to_owned(),
        region: Region::Near(0.0),
        ..LocalEnrichment::new(&WESTERGAARD, Site::Tips)
    };
    assert_eq!(*tips, expected);
    assert_eq!((layer.site, layer.name.as_str()), (Site::World, ""));
    let Region::Where(holds) = &layer.region else { panic!("a condition") };
    assert_eq!([-0.6, -0.4].map(|x| holds.value(vec2(x, 0.0))), [1.0, 0.0]);
}

#[test]
fn defaults_and_parameters_of_the_library() {
    let corner = |parameters: &str| {
        let text = edited(
            FORMULAS,
            "\"westergaard\"\nat = \"tips\"\nradius = 0",
            &format!("\"corner\"\nat = [0, 0]{parameters}"),
        );
        good(&text).enrichments.remove(2)
    };
    let new = corner("");
    let Some(entry) = library::enrichment("corner") else { panic!("an entry") };
    assert_eq!(new.functions, entry.texts);
    assert_eq!(new.parameters, [("lambda".to_owned(), entry.parameters[0].1)]);
    assert_eq!((new.region, new.degree), (Region::Default, None));
    let new = corner("\nparameters = { lambda = \"1/4\" }");
    assert_eq!(new.parameters, [("lambda".to_owned(), 0.25)]);
}

#[test]
fn weights() {
    let weight = |text: &str| {
        let text = edited(FORMULAS, "exp(1 - 1/(1 - t^2))", text);
        good(&text).discretization.weight
    };
    assert_eq!(weight("quadratic"), WeightFunction::Quadratic);
    let bump = library::weight("bump").expect("an entry").texts[0];
    assert_eq!(weight("bump"), weight(bump));
    assert!(matches!(weight("(1 - t)*table(k, t)"), WeightFunction::Formula(_)));
}

#[test]
fn good_variants() {
    for (old, new) in [
        ("along = [[-1.0, 0.5], [1.0, 0.5]]", "along = [[-3, 0.5], [3, 0.6]]\nradius = 0.25"),
        ("at = [0.5, 0.25]", "at = [-1, 1]"),
        ("angle = \"pi/2\"", "angle = -1"),
        ("angle = \"pi/2\"\n", ""),
        ("radius = 0\n", "radius = 5\n"),
        ("radius = 0\n", ""),
        ("where = \"x < -0.5 and table(k, x) > 1\"", "degree = 1"),
        ("function = \"exp(-x/0.01)\"", "functions = [\"boundary-layer\", \"r + theta\", \"1\"]"),
        ("enrichment = \"jumps\"", "enrichment = \"none\""),
        ("unit = \"mm\"", "[[quantity]]\nname = \"more\"\nformula = \"2*slip_rate + young\""),
    ] {
        good(&edited(FORMULAS, old, new));
    }
}

#[test]
fn the_radius_of_the_zone_serves_own_functions() {
    let text = edited(FORMULAS, "radius = 0\n", "");
    good(&edited(&text, "\"jumps\"", "\"jumps\"\nenrichment_radius = 0.3"));
    let text = edited(FORMULAS, "\"jumps\"", "\"jumps\"\nenrichment_radius = 0.3");
    let found = mistakes(&text);
    assert!(found.len() == 1 && found[0].contains("has no meaning with enrichment = \"jumps\""));
}

#[test]
fn bad_tables() {
    // without what uses the tables, so that only the tables are wrong
    let text = r#"[domain]
min = [-1, -1]
max = [1, 1]
[equation]
kind = "poisson"
[source]
value = 1
[discretization]
level = 1
[[table]]
name = "k"
x = [-2.0, 0.0, 2.0]
values = [3.0, 1.0, 3.0]
"#;
    check_all(
        text,
        &[
            (
                "[-2.0, 0.0, 2.0]",
                "[-2.0, 3.0, 2.0]",
                12,
                17,
                "knot 2 in x, counted from 0, is 2 after 3",
            ),
            ("[-2.0, 0.0, 2.0]", "[-2.0]", 12, 5, "has 1 knots in x; at least two are needed"),
            ("[-2.0, 0.0, 2.0]", "[-2.0, 0.0]", 13, 10, "has 3 values, but 2 are needed"),
            ("[-2.0, 0.0, 2.0]", "[-2.0, \"0\", 2.0]", 12, 12, "must be a number"),
            ("[-2.0, 0.0, 2.0]", "2.0", 12, 5, "must be a list of numbers"),
            (
                "[3.0, 1.0, 3.0]",
                "[[3.0, 1.0, 3.0]]",
                13,
                11,
                "must be a number, found an array of 3",
            ),
            (
                "[3.0, 1.0, 3.0]",
                "[[3, 1, 3], [1, 1]]\ny = [0, 1]",
                13,
                22,
                "has a row of 2 numbers, but `x` has 3",
            ),
            (
                "[3.0, 1.0, 3.0]",
                "[[3, 1, 3]]\ny = [0, 1]",
                13,
                10,
                "has 3 values, but 6 are needed",
            ),
            (
                "[3.0, 1.0, 3.0]",
                "[[3, 1, 3], [3, 1, 3]]\ny = [0, 0]",
                14,
                9,
                "knot 1 in y, counted from 0, is 0 after 0",
            ),
            ("values = [3.0, 1.0, 3.0]", "", 10, 1, "`values` is missing in [[table]]"),
            (
                "x = [-2.0, 0.0, 2.0]",
                "file = \"k.csv\"",
                13,
                10,
                "contradicts `file`; give one of them",
            ),
            (
                "x = [-2.0, 0.0, 2.0]\nvalues = [3.0, 1.0, 3.0]",
                "",
                10,
                1,
                "has no data; add `x` and `values`, or `file`",
            ),
            ("x = [-2.0", "xs = [-2.0", 12, 1, "unknown key `xs` in [[table]]; did you mean `x`?"),
            ("\"k\"", "\"r\"", 11, 8, "the name `r` already has a meaning in formulas"),
            ("\"k\"", "\"t\"", 11, 8, "the name `t` already has a meaning in formulas"),
            ("\"k\"", "\"du_dx\"", 11, 8, "the name `du_dx` already has a meaning"),
            ("\"k\"", "\"a b\"", 11, 8, "`a b` is not a name"),
            ("name = \"k\"\n", "", 10, 1, "`name` is missing in [[table]]; add e.g."),
        ],
    );
}

#[test]
fn bad_weights() {
    const WEIGHT: &str = "exp(1 - 1/(1 - t^2))";
    check_all(
        FORMULAS,
        &[
            (WEIGHT, "1 - x", 52, 15, "`weight` in [discretization]: unknown name `x`"),
            (
                WEIGHT,
                "1 - t/2",
                52,
                10,
                "a weight must vanish where the patch ends, but `1 - t/2` is 0.5",
            ),
            (WEIGHT, "(1 - t)*(0.5 - t)", 52, 10, "a weight must be positive for 0 <= t < 1"),
            (WEIGHT, "bumb", 52, 10, "did you mean \"bump\"?"),
            (WEIGHT, "sqrt(1 - t)*(1 - t)/t", 52, 10, "finite"),
        ],
    );
}

#[test]
fn bad_functions_of_enrichments() {
    check_all(
        FORMULAS,
        &[
            (
                "\"exp(-x/0.01)\"",
                "\"exp(-x/eps)\"",
                43,
                20,
                "`function` in [[enrichment]]: unknown name `eps`",
            ),
            ("m*theta", "n*theta", 27, 28, "unknown name `n`"),
            ("\"table(k, y)\"]", "\"table(q, y)\"]", 27, 46, "no table `q`; tables are k, g"),
            ("m = \"pi/4\"", "m = \"pi/4\", x = 1", 28, 46, "the name `x` already has a meaning"),
            ("m = \"pi/4\"", "m = \"pi/4 + x\"", 28, 42, "unknown name `x`"),
            ("m = \"pi/4\"", "m = \"1/0\"", 28, 34, "is inf, but must be finite"),
            ("m = \"pi/4\" }", "m = 1, k = 1 }", 28, 41, "the name `k` already has a meaning"),
            (
                "{ lambda = 0.6, m = \"pi/4\" }",
                "0.6",
                28,
                14,
                "must be a table such as { lambda = 0.6 }",
            ),
            (
                "\"westergaard\"",
                "\"westergard\"",
                39,
                12,
                "is no formula; did you mean \"westergaard\"?",
            ),
            (
                "\"westergaard\"",
                "\"williams\"\nparameters = { m = 5 }",
                40,
                20,
                "is no parameter of the function; it has n",
            ),
            (
                "\"westergaard\"",
                "\"kink\"\nparameters = { width = 5 }",
                40,
                24,
                "is no parameter of the function; it has none",
            ),
            ("function = \"westergaard\"", "functions = []", 39, 13, "there is no function"),
            (
                "function = \"westergaard\"",
                "functions = \"r\"",
                39,
                13,
                "must be a list of formulas in quotes",
            ),
            ("function = \"westergaard\"", "function = 1", 39, 12, "must be a text in quotes"),
            ("function = \"westergaard\"", "", 38, 1, "[[enrichment]] has no function; add e.g."),
            (
                "function = \"westergaard\"",
                "function = \"1\"\nfunctions = [\"r\"]",
                40,
                13,
                "contradicts `function`",
            ),
            ("function = \"westergaard\"", "funtion = \"1\"", 39, 1, "did you mean `function`?"),
        ],
    );
}

#[test]
fn bad_places_of_enrichments() {
    check_all(
        FORMULAS,
        &[
            (
                "at = [0.5, 0.25]",
                "at = [0.5, 2.25]",
                29,
                6,
                "[0.5, 2.25] lies outside the domain; move it in",
            ),
            (
                "at = [0.5, 0.25]",
                "along = [[0, 0], [1, 1]]",
                30,
                9,
                "`angle` in [[enrichment]] has no meaning without a point",
            ),
            (
                "at = [0.5, 0.25]\nangle = \"pi/2\"",
                "",
                30,
                10,
                "`radius` has no meaning without `at` or `along`",
            ),
            ("at = [0.5, 0.25]\nangle = \"pi/2\"", "at = \"tip\"", 29, 6, "did you mean \"tips\"?"),
            ("at = [0.5, 0.25]", "at = [0.5]", 29, 6, "must be two numbers [x, y]"),
            (
                "radius = 0.3",
                "radius = -0.3",
                31,
                10,
                "`radius` is -0.3, but must be finite and not negative",
            ),
            ("radius = 0.3", "radius = 0.3\nwhere = \"x > 0\"", 32, 9, "contradicts `radius`"),
            (
                "along = [[-1.0, 0.5], [1.0, 0.5]]",
                "along = [[-1.0, 0.5], [-1.0, 0.5]]",
                34,
                9,
                "the two points are equal",
            ),
            (
                "along = [[-1.0, 0.5], [1.0, 0.5]]",
                "along = [[-1.0, 1.5], [1.0, 1.5]]",
                34,
                9,
                "the segment does not meet the domain",
            ),
            (
                "along = [[-1.0, 0.5], [1.0, 0.5]]",
                "along = [[0, 0], 1]",
                34,
                18,
                "two numbers [x, y], found ",
            ),
            ("degree = 2", "at = [0, 0]", 34, 9, "`along` in [[enrichment]] contradicts `at`"),
        ],
    );
}

#[test]
fn bad_regions_degrees_and_declarations() {
    check_all(
        FORMULAS,
        &[
            ("degree = 2", "degree = 9", 35, 10, "`degree` is 9, but must be 0 to 8"),
            ("degree = 2", "degree = 1.5", 35, 10, "must be a whole number"),
            (
                "[[[0.0, 0.0], [1.0, 0.0]]]",
                "[[[0, 0], [1, 0], [2, 0]]]",
                36,
                10,
                "must be two points [[x0, y0], [x1, y1]]",
            ),
            (
                "[[[0.0, 0.0], [1.0, 0.0]]]",
                "[[[0.0, 0.0], [0.0, 0.0]]]",
                36,
                9,
                "a segment without length",
            ),
            ("[[0.5, 0.0]]", "[[0.5]]", 37, 13, "two numbers [x, y], found "),
            (
                "radius = 0\n",
                "where = \"x > 0\"\n",
                41,
                9,
                "`where` cannot choose patches of all tips at once",
            ),
            ("\"x < -0.5 and table(k, x) > 1\"", "\"x\"", 44, 10, "a condition"),
            ("\"x < -0.5 and table(k, x) > 1\"", "\"x < z\"", 44, 14, "unknown name `z`"),
        ],
    );
}

#[test]
fn tips_that_are_missing_or_too_near() {
    let text = edited(FORMULAS, "radius = 0\n", "radius = 0.5\n");
    let text = edited(&text, "[[-1.0, 0.0], [0.0, 0.0]]", "[[-0.2, 0.0], [0.2, 0.0]]");
    assert_eq!(
        mistakes(&text),
        [
            "dir/plate.toml:41:10: `radius` is 0.5, but the tips of a crack are only 0.4 apart; give less \
          than half of that"
        ]
    );
    let text = edited(FORMULAS, "[[crack]]\npoints = [[-1.0, 0.0], [0.0, 0.0]]\n", "");
    let found = mistakes(&text);
    assert!(
        found.len() == 1 && found[0].contains("38:6: there is no tip; add a [[crack]]"),
        "{found:?}"
    );
}

#[test]
fn bad_quantities() {
    const FORMULA: &str = "\"sqrt(ux^2 + uy^2)*table(k, x)\"";
    check_all(
        FORMULAS,
        &[
            (FORMULA, "\"sqrt(u^2)\"", 47, 17, "`formula` in [[quantity]]: unknown name `u`"),
            (FORMULA, "1", 47, 11, "must be a text in quotes"),
            (
                "slip-rate",
                "von-mises",
                46,
                8,
                "`von-mises` is a built-in quantity; choose another name",
            ),
            ("slip-rate", "young", 46, 8, "the name `young` already has a meaning"),
            ("slip-rate", "g", 46, 8, "the name `g` already has a meaning"),
            (
                "slip-rate",
                "slip rate",
                46,
                8,
                "`slip rate` cannot name a quantity; names are letters",
            ),
            ("slip-rate", "phi:1", 46, 8, "cannot name a quantity"),
            (
                "unit = \"mm\"",
                "[[quantity]]\nname = \"slip_rate\"\nformula = \"1\"",
                49,
                8,
                "there is another quantity",
            ),
            ("unit = \"mm\"", "units = \"mm\"", 48, 1, "did you mean `unit`?"),
            ("name = \"slip-rate\"", "", 45, 1, "`name` is missing in [[quantity]]"),
        ],
    );
}

/// Lines of a file of a table are named.
#[test]
fn files_of_tables() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("plate.toml");
    let text =
        edited(FORMULAS, "x = [-2.0, 0.0, 2.0]\nvalues = [3.0, 1.0, 3.0]", "file = \"k.csv\"");
    std::fs::write(&file, text).expect("written");
    let read = || Problem::read(&file).map_err(|error| error.to_string());
    let wrong = |part: &str| {
        let error = read().expect_err("the table is wrong");
        assert!(error.contains(part), "{error}");
    };
    let data = |text: &str| std::fs::write(folder.path().join("k.csv"), text).expect("written");
    wrong("k.csv: cannot read the table: ");
    data("# x, value\n-2, 3\n0, 1\n2, 3\n");
    let expected = Table::curve("k", vec![-2.0, 0.0, 2.0], vec![3.0, 1.0, 3.0]).expect("a table");
    assert_eq!(read().map(|problem| Arc::clone(&problem.tables[0])), Ok(Arc::new(expected)));
    data("-2, 3\n0, one\n");
    wrong("k.csv:2:4: `one` is not a finite number");
    data("1, 3\n");
    wrong("plate.toml:18:8: table `k` has 1 knots in x; at least two are needed");
    data("");
    wrong("k.csv: there are no values");
}

/// Every line left out or given another value: what is refused is refused with a reason, and what is
/// accepted passes the checks.
#[test]
fn nothing_is_refused_without_a_reason() {
    const VALUES: [&str; 9] =
        ["1", "-1", "1e300", "true", "\"x\"", "\"\"", "[]", "[[1, 2], [3, 4]]", "{ a = 1 }"];
    let lines: Vec<_> = FORMULAS.lines().collect();
    for (place, line) in lines.iter().enumerate() {
        let with = |new: &str| {
            let text = [&lines[..place], &[new], &lines[place + 1..]].concat().join("\n");
            match parse(&text) {
                Ok(problem) => assert_eq!(problem.check(), Ok(()), "{text}"),
                Err(error) => assert!(!error.mistakes().is_empty(), "{text}"),
            }
        };
        with("");
        let Some((key, _)) = line.split_once(" = ") else { continue };
        VALUES.iter().for_each(|value| with(&format!("{key} = {value}")));
    }
}

#[test]
fn enrichments_built_in_code_are_checked_alike() {
    let mut problem = good(FORMULAS);
    problem.enrichments[0].functions[1] = "table(k, z)".to_owned();
    problem.enrichments[1].parameters = vec![("x".to_owned(), 1.0)];
    problem.quantities[0].text = "young*z".to_owned();
    problem.tables.push(Arc::clone(&problem.tables[1]));
    let error = problem.check().expect_err("much is wrong");
    let keys: Vec<_> = error.mistakes().iter().map(|mistake| mistake.to_string()).collect();
    for (key, part) in [
        ("table[2].name: ", "the name `g` already has a meaning"),
        ("quantity[0].formula: ", ""),
        ("enrichment[0].", ""),
        ("enrichment[1].parameters: ", ""),
    ] {
        assert!(keys.iter().any(|k| k.starts_with(key) && k.contains(part)), "{key} {keys:?}");
    }
}
