//! Problem files: good ones mean what they say, bad ones are reported where they are wrong.

mod bad_files;
mod formulas;
mod holes;
mod large_files;

use std::path::Path;

use ppum::crack::{CrackEnd, End, TipId};
use ppum::dataset::{Equation, Material, StressState};
use ppum::vec2::{Rect, vec2};
use ppum::weight::WeightFunction;

use super::*;

/// A good file; the tests replace parts of it. Line numbers: 1 title, 2 domain, 5 material, 9 crack,
/// 11 and 14 boundary, 17 discretization.
const PLATE: &str = r#"title = "Centre crack"
[domain]
min = [-1.0, -1.0]
max = [1.0, 1.0]
[material]
young = 2.5
poisson = 0.3
state = "plane-strain"
[[crack]]
points = [[-0.5, 0.0], [0.5, 0.0]]
[[boundary]]
on = "bottom"
displacement = [0.0, "free"]
[[boundary]]
on = "top"
traction = [0.0, "1 + x^2"]
[discretization]
level = 4
"#;

/// The same for Poisson. Line numbers: 1 domain, 4 equation, 6 material, 8 and 11 boundary,
/// 14 source, 16 exact, 18 discretization.
const MEMBRANE: &str = r#"[domain]
min = [0, 0]
max = [2, 1]
[equation]
kind = "poisson"
[material]
conductivity = 2
[[boundary]]
on = "left"
value = "exact"
[[boundary]]
on = { edge = "top", from = 0.5 }
flux = "sin(x)"
[source]
value = "x*y"
[exact]
value = "x + y"
[discretization]
cells = [8, 4]
"#;

fn parse(text: &str) -> Result<Problem, ProblemError> {
    Problem::parse(text, "dir/plate.toml", Path::new("no/such/folder"))
}

fn edited(text: &str, old: &str, new: &str) -> String {
    assert_eq!(text.matches(old).count(), 1, "`{old}` must stand once in the file");
    text.replace(old, new)
}

fn good(text: &str) -> Problem {
    parse(text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn findings(text: &str) -> Vec<String> {
    match parse(text) {
        Ok(_) => panic!("nothing was found wrong:\n{text}"),
        Err(error) => error.findings().iter().map(Finding::to_string).collect(),
    }
}

/// A rule: what is replaced in a good file, by what, and where and how that is found wrong.
type Bad = (&'static str, &'static str, usize, usize, &'static str);

/// Each edit must give one finding, no more, at the place and with the message expected.
fn check_all(text: &str, cases: &[Bad]) {
    let wrong = |&(old, new, line, column, part): &Bad| {
        let found = findings(&edited(text, old, new));
        let place = format!("dir/plate.toml:{line}:{column}: ");
        let good = found.len() == 1 && found[0].starts_with(&place) && found[0].contains(part);
        let message = || {
            let found = found.join("\n");
            format!("`{old}` → `{new}`: expected\n{place}… {part} …, found\n{found}\n\n")
        };
        (!good).then(message)
    };
    let wrong: String = cases.iter().filter_map(wrong).collect();
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn plate() {
    let problem = good(PLATE);
    let material = Material { young: 2.5, poisson: 0.3, state: StressState::PlaneStrain };
    let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
    let neumann = "1 + x^2".parse().map(Condition::Neumann).expect("a formula");
    let dirichlet = Condition::Dirichlet(0.0.into());
    let expected = Problem {
        title: "Centre crack".to_owned(),
        text: Some(PLATE.to_owned()),
        ..Problem::elasticity(domain, material, Discretization::new(Cells::Level(4)))
            .with_crack(&[[-0.5, 0.0], [0.5, 0.0]])
            .with_boundary(Edge::Bottom, vec![dirichlet, Condition::Free])
            .with_boundary(Edge::Top, vec![Condition::Neumann(0.0.into()), neumann])
    };
    assert_eq!(problem, expected);
    assert_eq!(expected.check(), Ok(()));
}

#[test]
fn membrane() {
    let problem = good(MEMBRANE);
    assert_eq!(problem.title, "plate", "the title is the file's name if none is given");
    assert_eq!(problem.equation, Equation::poisson(2.0));
    assert_eq!(problem.source[0].value(vec2(3.0, 4.0)), 12.0);
    assert_eq!(problem.exact[0].text(), "x + y");
    assert_eq!(problem.discretization.cells, Cells::Grid([8, 4]));
    let [left, top] = problem.boundary.as_slice() else { panic!("two conditions") };
    assert_eq!(left.on, BorderPart::Edge { edge: Edge::Left, from: 0.0, to: 1.0 });
    assert_eq!(left.components, [Condition::Dirichlet(problem.exact[0].clone())]);
    assert_eq!(top.on, BorderPart::Edge { edge: Edge::Top, from: 0.5, to: 2.0 });
    assert!(matches!(top.components.as_slice(), [Condition::Neumann(_)]));
}

#[test]
fn everything_said() {
    let text = edited(
        &edited(PLATE, "title = \"Centre crack\"\n", "[solver]\nkind = \"direct\"\n"),
        "level = 4",
        "cells = [3, 5]\nrefine = false\norder = \"if(x > 0, 2.4, 1.5)\"\noverlap = 1.5\nweight = \"cubic\"\n\
         enrichment = \"additive-only\"\nenrichment_radius = 0.2\ntip_degree = 0\ninterfaces = false",
    );
    let problem = good(&text);
    let discretization = &problem.discretization;
    assert_eq!(problem.solver, Solver { kind: SolverKind::Direct, kernels: true });
    assert_eq!(discretization.order.at(vec2(0.5, 0.0)), Ok(2));
    assert_eq!(discretization.order.at(vec2(-0.5, 0.0)), Ok(2));
    let expected = Discretization {
        cells: Cells::Grid([3, 5]),
        refine: false,
        order: discretization.order.clone(),
        overlap: 1.5,
        weight: WeightFunction::Cubic,
        enrichment: Enrichment::AdditiveOnly,
        interfaces: false,
        enrichment_radius: Some(0.2),
        tip_degree: 0,
    };
    assert_eq!(*discretization, expected);
}

#[test]
fn good_variants_of_the_plate() {
    for (old, new) in [
        ("young = 2.5", "young = 210_000"),
        ("\"plane-strain\"", "\"plane-stress\""),
        ("poisson = 0.3", "poisson = -0.5"),
        ("[[-0.5, 0.0], [0.5, 0.0]]", "[[-1.0, 0.0], [0.0, 0.1], [0.5, 0.0]]"),
        ("[[-0.5, 0.0], [0.5, 0.0]]", "[[0.5, 0.0], [1, 1]]"),
        ("[0.0, \"free\"]", "[\"free\", \"free\"]"),
        ("[0.0, \"1 + x^2\"]", "[\"free\", 1]\ndisplacement = [\"x\", \"free\"]"),
        ("on = \"top\"\ntraction = [0.0,", "on = \"bottom\"\ntraction = [\"free\","),
        ("level = 4", "level = 0\n[equation]\nkind = \"elasticity\""),
        ("level = 4", "level = 10\norder = 8\n[solver]"),
        ("level = 4", "level = 4\n[body_force]\nvalue = [0, \"-x\"]"),
        ("title = \"Centre crack\"", ""),
    ] {
        good(&edited(PLATE, old, new));
    }
}

#[test]
fn ends_of_cracks() {
    let text = edited(PLATE, "[[-0.5, 0.0], [0.5, 0.0]]", "[[-1.0, 0.0], [0.0, 0.1], [0.5, 0.0]]");
    assert_eq!(good(&text).cracks[0].ends, [CrackEnd::Mouth, CrackEnd::Tip]);
    assert_eq!(good(PLATE).cracks[0].ends, [CrackEnd::Tip, CrackEnd::Tip]);
}

#[test]
fn exact_data() {
    let text = edited(PLATE, "[0.0, \"free\"]", "\"exact\"")
        + "[exact]\ndisplacement = [\"x*y\", \"2*x\"]\n";
    let problem = good(&text);
    let exact: Vec<_> = problem.exact.iter().cloned().map(Condition::Dirichlet).collect();
    assert_eq!(problem.boundary[0].components, exact);
    let one = edited(&text, "\"exact\"", "[\"free\", \"exact\"]");
    assert_eq!(good(&one).boundary[0].components, [Condition::Free, exact[1].clone()]);
}

#[test]
fn bad_tables_and_keys() {
    check_all(
        PLATE,
        &[
            ("young", "yong", 6, 1, "unknown key `yong` in [material]; did you mean `young`?"),
            (
                "[domain]",
                "[domian]",
                2,
                2,
                "unknown key `domian` in the problem file; did you mean",
            ),
            ("title", "heading", 1, 1, "unknown key `heading`"),
            ("level = 4", "level = 4\nlevels = 5", 19, 1, "did you mean `level`?"),
            ("[[crack]]", "[crack]", 9, 1, "write [[crack]] for each"),
            ("[material]", "[[material]]", 5, 1, "`material` must be one table"),
            (
                "level = 4",
                "level = 4\n[growth]",
                19,
                2,
                "`growth` in the problem file is not supported yet",
            ),
            ("level = 4", "level = 4\n[[growth]]", 19, 3, "not supported yet in this version"),
            ("level = 4", "level = 4\n[adaptivity]", 19, 2, "not supported yet in this version"),
            ("level = 4", "level = 4\n[source]", 19, 2, "write `body_force` instead"),
            ("traction", "flux", 16, 1, "write `traction` instead"),
            (
                "max = [1.0, 1.0]",
                "",
                2,
                1,
                "`max` is missing in [domain]; add e.g. `max = [1.0, 1.0]`",
            ),
            ("state = \"plane-strain\"", "", 5, 1, "`state` is missing in [material]"),
            ("on = \"top\"", "", 14, 1, "`on` is missing in [[boundary]]"),
            ("traction = [0.0, \"1 + x^2\"]", "", 14, 1, "says nothing; add `displacement` or"),
            ("level = 4", "", 17, 1, "has no cells; add e.g. `level = 5`"),
        ],
    );
}

#[test]
fn bad_types_and_words() {
    check_all(
        PLATE,
        &[
            (
                "level = 4",
                "level = 4\noverlap = \"1.3\"",
                19,
                11,
                "must be a number, found a text; remove the quotes",
            ),
            ("2.5", "inf", 6, 9, "must be finite"),
            ("2.5", "1e999", 6, 9, "must be finite"),
            ("2.5", "true", 6, 9, "must be a number or a formula in quotes, found true or false"),
            ("2.5", "\"1/0\"", 6, 9, "`young` in [material] is inf, but must be finite"),
            ("\"Centre crack\"", "7", 1, 9, "`title` in the problem file must be a text in quotes"),
            (
                "max = [1.0, 1.0]",
                "max = [1.0, 1.0, 1.0]",
                4,
                7,
                "two numbers [x, y], found an array of 3",
            ),
            ("max = [1.0, 1.0]", "max = [1.0, {}]", 4, 13, "must be a number, found a table"),
            ("level = 4", "level = 4.5", 18, 9, "must be a whole number, found a number"),
            ("level = 4", "level = -1", 18, 9, "out of range"),
            ("level = 4", "level = 4\nrefine = 1", 19, 10, "must be true or false"),
            ("\"plane-strain\"", "\"plane-stain\"", 8, 9, "did you mean \"plane-strain\"?"),
            ("\"top\"", "\"upper\"", 15, 6, "\"left\", \"right\", \"bottom\", \"top\""),
            ("\"top\"", "3", 15, 6, "found a number"),
            (
                "level = 4",
                "level = 4\nweight = \"cubik\"",
                19,
                10,
                "cannot be \"cubik\", only linear, quadratic, cubic, bump, cosine, wendland, or a \
                 formula of t; did you mean \"cubic\"?",
            ),
            ("level = 4", "level = 4\nenrichment = \"zones\"", 19, 14, "did you mean \"zone\"?"),
            (
                "level = 4",
                "level = 4\n[solver]\nkind = \"multilevel\"",
                20,
                8,
                "only \"auto\", \"direct\"",
            ),
            ("level = 4", "level = 4\n[solver]\ntolerance = 1", 20, 1, "not supported yet"),
            (
                "level = 4",
                "level = 4\n[equation]\nkind = \"heat\"",
                20,
                8,
                "\"elasticity\", \"poisson\"",
            ),
            ("[0.0, \"free\"]", "0.0", 13, 16, "must be an array of two"),
            ("[0.0, \"free\"]", "[0.0, [1]]", 13, 22, "a number or a formula in quotes"),
            (
                "[0.0, \"free\"]",
                "\"exact\"",
                13,
                16,
                "there is no [exact]; add it with `displacement`",
            ),
            ("[0.0, \"1 + x^2\"]", "\"exact\"", 16, 12, "cannot be \"exact\"; write its formula"),
            ("\"top\"", "{ crack = 1 }", 15, 6, "the only [[crack]] has the number 0"),
            (
                "[[-0.5, 0.0], [0.5, 0.0]]",
                "[[-0.5, 0.0], 0.5]",
                10,
                24,
                "two numbers [x, y], found a number",
            ),
        ],
    );
}

#[test]
fn bad_formulas() {
    check_all(
        PLATE,
        &[
            ("1 + x^2", "1 + xx^2", 16, 23, "unknown name `xx`"),
            ("1 + x^2", "1 + ", 16, 23, "`traction` in [[boundary]]: the formula ends here"),
            ("1 + x^2", "r + 1", 16, 19, "unknown name `r`"),
            ("\"free\"", "\"fre\"", 13, 23, "unknown name `fre`"),
            (
                "level = 4",
                "level = 4\norder = \"10*x\"",
                19,
                9,
                "the order is -9.375 at [-0.9375, -0.9375]",
            ),
            ("\"1 + x^2\"", "'''\n1 + z'''", 17, 5, "unknown name `z`"),
            ("\"1 + x^2\"", "\"\"\"1 +\n  x*z\"\"\"", 17, 5, "unknown name `z`"),
            ("\"1 + x^2\"", "'1 + z'", 16, 23, "unknown name `z`"),
            ("\"1 + x^2\"", "\"\\u0031 + z\"", 16, 18, "unknown name `z`"),
            ("\"1 + x^2\"", "\"\"", 16, 19, "the formula ends here"),
            ("2.5", "\"1 + s\"", 6, 14, "unknown name `s`"),
        ],
    );
}

#[test]
fn bad_values() {
    check_all(
        PLATE,
        &[
            ("max = [1.0, 1.0]", "max = [1.0, -1.0]", 4, 7, "`max` must exceed `min` in y"),
            ("2.5", "0", 6, 9, "`young` is 0, but must be positive"),
            (
                "2.5",
                "\"if(y > 0, 10, x)\"",
                6,
                9,
                "`young` is -1, but must be positive and finite at [-1, -1]",
            ),
            ("0.3", "\"0.3 + y/2\"", 7, 11, "in plane strain at [-1, 0.40625]"),
            ("0.3", "0.5", 7, 11, "-1 < ν < 0.5 in plane strain"),
            ("0.3", "-1", 7, 11, "`poisson` is -1"),
            ("level = 4", "level = 11", 18, 9, "must be 0 to 10"),
            (
                "level = 4",
                "level = 4\ncells = [2, 2]",
                19,
                9,
                "give only one of `level`, `cells`, `points`",
            ),
            ("level = 4", "cells = [0, 2]", 18, 9, "at least 1 in each direction"),
            ("level = 4", "cells = [2048, 2048]", 18, 9, "2048 × 2048, but at most 1048576"),
            ("level = 4", "level = 4\norder = 9", 19, 9, "the order is 9"),
            ("max = [1.0, 1.0]", "max = [1e31, 1.0]", 4, 7, "choose another unit of length"),
            ("level = 4", "level = 4\nenrichment_radius = 1", 19, 21, "are only 1 apart"),
            ("level = 4", "level = 4\noverlap = 1", 19, 11, "1.01 to 1.99"),
            ("level = 4", "level = 4\noverlap = 2.0", 19, 11, "1.01 to 1.99"),
            ("level = 4", "level = 4\ntip_degree = 9", 19, 14, "must be 0 to 8"),
            ("level = 4", "level = 4\nenrichment_radius = 0", 19, 21, "must be positive"),
            (
                "level = 4",
                "level = 4\nenrichment = \"none\"\nenrichment_radius = 0.1",
                20,
                21,
                "has no meaning with enrichment = \"none\"",
            ),
            (
                "\"top\"",
                "{ edge = \"top\", from = 0.5, to = 0.5 }",
                15,
                6,
                "`to` must exceed `from`",
            ),
            (
                "\"top\"",
                "{ edge = \"top\", from = -2 }",
                15,
                6,
                "leaves the top edge, which runs from -1 to 1",
            ),
            (
                "\"top\"",
                "\"bottom\"",
                15,
                6,
                "the x component on the bottom edge between -1 and 1 is given twice",
            ),
            ("\"top\"", "\"bottom\"", 15, 6, "(the other is on line 12)"),
            (
                "traction = [0.0,",
                "displacement = [0.0, 0.0]\ntraction = [\"free\",",
                17,
                12,
                "gives a component that `displacement` gives as well",
            ),
        ],
    );
}

#[test]
fn bad_cracks() {
    const POINTS: &str = "[[-0.5, 0.0], [0.5, 0.0]]";
    let cases = [
        ("[[0.0, 0.0]]", 10, 10, "needs at least two points"),
        ("[]", 10, 10, "needs at least two points"),
        ("[[0.0, 0.0], [0.0, 0.0]]", 10, 23, "equals the one before it"),
        ("[[0.0, 0.0], [1.5, 0.0]]", 10, 23, "lies outside the domain"),
        ("[[0.0, 0.0], [0.9999999999999, 0.0]]", 10, 23, "misses the right edge by"),
        ("[[0.0, 0.0], [1.0000000000001, 0.0]]", 10, 23, "misses the right edge by"),
        ("[[-1.0, 0.5], [-1.0, 0.0]]", 10, 11, "runs along the left edge"),
        ("[[0.0, 0.0], [0.5, 1.0], [0.6, 0.0]]", 10, 23, "touches the top edge between its ends"),
        ("[[0, 0], [0.5, 0], [0.5, 0.5], [0.2, -0.5]]", 10, 29, "its segments 1 and 3 meet"),
        ("[[0, 0], [0.5, 0], [0.25, 0.0]]", 10, 19, "folds back on itself"),
        ("[[0, 0], [0.5, 0], [0.5, 0.5], [0, 0]]", 10, 29, "its segments 1 and 3 meet"),
        ("[[0, 0], [0.5, 0], [0.5, 0.5], [0.25, 0.25]]", 10, 11, "such hooks are not supported"),
        (
            "[[0, 0], [0.5, 0]]\n[[crack]]\npoints = [[0.2, 0.5], [0.2, -0.5]]",
            12,
            11,
            "(the other is on line 10)",
        ),
        (
            "[[0, 0], [0.5, 0]]\n[[crack]]\npoints = [[0.5, 0], [0.5, 0.5]]",
            12,
            11,
            "crosses or touches another",
        ),
        (
            "[[0, 0], [0.5, 0]]\n[[crack]]\npoints = [[0, 0.5], [0.1, 0.5], [0.2, 0]]",
            12,
            21,
            "not supported yet",
        ),
    ];
    check_all(
        PLATE,
        &cases.map(|(points, line, column, part)| (POINTS, points, line, column, part)),
    );
}

#[test]
fn bad_membranes() {
    check_all(
        MEMBRANE,
        &[
            ("conductivity = 2", "conductivity = -2", 7, 16, "`conductivity` is -2"),
            (
                "conductivity = 2",
                "young = 2",
                7,
                1,
                "does not fit the equation; write `conductivity`",
            ),
            (
                "value = \"exact\"",
                "displacement = 0",
                10,
                1,
                "does not fit the equation; write `value`",
            ),
            ("[source]", "[body_force]", 14, 2, "does not fit the equation; write `source`"),
            ("flux = \"sin(x)\"", "flux = [1, 2]", 13, 8, "a number or a formula in quotes"),
            ("from = 0.5 }", "from = 0.5, till = 1 }", 12, 34, "unknown key `till` in `on`"),
            (
                "flux = \"sin(x)\"",
                "flux = 1\nvalue = 1",
                13,
                8,
                "gives a component that `value` gives",
            ),
            (
                "edge = \"top\", from = 0.5",
                "edge = \"left\", to = 0.5",
                12,
                6,
                "the value or flux on the left edge",
            ),
        ],
    );
}

#[test]
fn what_is_missing_altogether() {
    let expected = [
        "nothing acts on the plate; add [[boundary]]",
        "the table [domain] is missing; add it with its keys `min`, `max`",
        "the table [discretization] is missing; add it with e.g. `level = 5`",
        "the table [material] is missing; add it with its keys `young`, `poisson`, `state`",
    ];
    assert_eq!(findings(""), expected.map(|message| format!("dir/plate.toml:1:1: {message}")));
}

#[test]
fn all_mistakes_at_once_in_the_order_of_the_file() {
    let text = edited(PLATE, "young = 2.5", "yong = 2.5");
    let text = edited(&text, "0.3", "0.7");
    let text = edited(&text, "[[-0.5, 0.0], [0.5, 0.0]]", "[[-0.5, 0.0], [5, 0.0]]");
    let text = edited(&text, "\"top\"", "\"bottom\"");
    let text = edited(&text, "level = 4", "level = 40\noverlap = \"1.3\"");
    let places: Vec<_> = findings(&text)
        .iter()
        .map(|found| found.split(": ").next().unwrap_or_default().to_owned())
        .collect();
    let expected = ["6:1", "7:11", "10:24", "15:6", "18:9", "19:11"];
    assert_eq!(places, expected.map(|place| format!("dir/plate.toml:{place}")));
}

#[test]
fn no_toml() {
    for (text, places) in [
        ("[domain\nmin = [1, 2]\n", vec!["1:8"]),
        ("x = 1.2.3\ny = abc\nz = 3 4\n", vec!["1:8", "2:5", "3:5"]),
        ("a = 1\na = 2\n", vec!["2:1"]),
    ] {
        let expected = |place| format!("dir/plate.toml:{place}: the file is no valid TOML here: ");
        let found = findings(text);
        assert_eq!(found.len(), places.len(), "{found:?}");
        for (found, place) in found.iter().zip(places) {
            assert!(found.starts_with(&expected(place)), "{found}");
        }
    }
}

#[test]
fn files_and_their_points() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("plate.toml");
    let text = edited(PLATE, "level = 4", "points = \"cloud.csv\"");
    std::fs::write(&file, text).expect("written");
    let read = || Problem::read(&file).map_err(|error| error.to_string());
    let wrong = |part: &str| {
        let error = read().expect_err("the points are wrong");
        assert!(error.contains(part), "{error}");
    };
    wrong("cloud.csv: cannot read the points: ");
    let cloud =
        |text: &str| std::fs::write(folder.path().join("cloud.csv"), text).expect("written");
    cloud("0.5, 0.25 # first\n-1,1\n");
    let points = vec![vec2(0.5, 0.25), vec2(-1.0, 1.0)];
    assert_eq!(read().map(|problem| problem.discretization.cells), Ok(Cells::Points(points)));
    cloud("0.5, 0.25\n1,y\n");
    wrong("cloud.csv:2:3: `y` is not a finite number");
    cloud("# none\n");
    wrong("cloud.csv: there are no points");
    cloud("0,0\n0,2\n");
    wrong("plate.toml:18:10: 1 of 2 points lie outside the domain, the first at [0, 2]");
}

/// Whoever writes a file can see that it is none of them.
#[test]
fn files_that_a_problem_names() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    std::fs::create_dir(at("data")).expect("a folder");
    std::fs::write(at("data/p.csv"), "0.5,0.25\n-0.5,-0.25\n").expect("written");
    std::fs::write(at("t.csv"), "-1,1\n1,2\n").expect("written");
    let table = "[[table]]\nname = \"k\"\nfile = \"./t.csv\"\n";
    let text = edited(PLATE, "level = 4", "points = \"data/p.csv\"") + table;
    let problem = Problem::parse(&text, "plate.toml", folder.path()).expect("it is right");
    assert_eq!(problem.files, [at("./t.csv"), at("data/p.csv")]);
    assert!(good(PLATE).files.is_empty());
}

/// No kind of file is read without an end, or from what is no file.
#[cfg(unix)]
#[test]
fn endless_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let [zero, long] = ["zero", "long"].map(|name| folder.path().join(name));
    std::os::unix::fs::symlink("/dev/zero", &zero).expect("a link");
    std::fs::File::create(&long).and_then(|file| file.set_len(1 << 40)).expect("a hole");
    let points = edited(PLATE, "level = 4", "points = \"FILE\"");
    let table = PLATE.to_owned() + "[[table]]\nname = \"k\"\nfile = \"FILE\"\n";
    let error = |result: Result<Problem, ProblemError>| result.expect_err("endless").to_string();
    for (file, limits, reason) in [
        (zero, ["", "", ""], "it is a device, not a regular file"),
        (long, ["16 MiB", "64 MiB", "64 MiB"], "it has more than"),
    ] {
        let name = file.file_name().and_then(|name| name.to_str()).expect("text");
        let parse = |text: &str| Problem::parse(&text.replace("FILE", name), "p", folder.path());
        let found = [Problem::read(&file), parse(&points), parse(&table)].map(error);
        for (found, limit) in found.iter().zip(limits) {
            assert!(found.contains(reason) && found.contains(limit), "{found}");
        }
    }
}

#[test]
fn a_file_that_cannot_be_read() {
    let error = Problem::read(Path::new("no/such/file.toml")).expect_err("there is none");
    assert!(error.to_string().starts_with("no/such/file.toml: cannot read the problem file: "));
}

#[test]
fn problems_built_in_code_are_checked_alike() {
    let domain = Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0));
    let problem = Problem::poisson(domain, 0.0, Discretization::new(Cells::Level(12)))
        .with_crack(&[[0.5, 0.5], [2.0, 0.5]])
        .with_boundary(Edge::Top, vec![Condition::Free; 2]);
    let error = problem.check().expect_err("much is wrong");
    let keys: Vec<_> = error.findings().iter().map(|finding| finding.place.to_string()).collect();
    let expected =
        ["material.conductivity", "boundary[0]", "discretization.level", "crack[0].points[1]"];
    assert_eq!(keys, expected);
}

#[test]
fn default_enrichment_radius() {
    let tip = |crack, end| TipId { crack, end };
    let problem = good(PLATE);
    assert_eq!(problem.enrichment_radius(tip(0, End::Start)), 0.25);
    let near = problem.clone().with_crack(&[[1.0, 0.3], [0.5, 0.4]]);
    assert!((near.enrichment_radius(tip(0, End::Last)) - 0.1).abs() < 1e-15);
    assert!((near.enrichment_radius(tip(1, End::Last)) - 0.1).abs() < 1e-15);
    assert_eq!(near.enrichment_radius(tip(0, End::Start)), 0.25);
    let mut given = problem;
    given.discretization.enrichment_radius = Some(0.7);
    assert_eq!(given.enrichment_radius(tip(0, End::Last)), 0.7);
}

#[test]
fn the_example_of_the_documentation() {
    let page = include_str!("../../../../../docs/problem-file.md");
    let mut blocks = page.split("```");
    let example = blocks.nth(1).and_then(|block| block.strip_prefix("toml\n"));
    let problem = good(example.expect("the page's first block is the example"));
    assert_eq!(problem.discretization, Discretization::new(Cells::Level(4)));
    assert_eq!(problem.boundary.len(), 2);
}

/// Every line left out, cut short, or given another value: what is refused is refused with a reason,
/// and what is accepted passes the checks.
#[test]
fn nothing_is_refused_without_a_reason() {
    const VALUES: [&str; 15] = [
        "1",
        "-1",
        "1e300",
        "nan",
        "true",
        "\"x\"",
        "\"\"",
        "\"free\"",
        "\"exact\"",
        "[]",
        "[1]",
        "[1, 2]",
        "[[1, 2]]",
        "{}",
        "1979-05-27",
    ];
    let check = |lines: &[&str]| match parse(&lines.join("\n")) {
        Ok(problem) => assert_eq!(problem.check(), Ok(()), "{}", lines.join("\n")),
        Err(error) => assert!(!error.findings().is_empty(), "{}", lines.join("\n")),
    };
    for text in [PLATE, MEMBRANE] {
        let lines: Vec<_> = text.lines().collect();
        for (place, line) in lines.iter().enumerate() {
            let with = |new: &str| check(&[&lines[..place], &[new], &lines[place + 1..]].concat());
            (0..line.len()).for_each(|length| with(&line[..length]));
            let Some((key, _)) = line.split_once(" = ") else { continue };
            VALUES.iter().for_each(|value| with(&format!("{key} = {value}")));
        }
    }
}

#[test]
fn the_mistakes_of_the_documentation() {
    let page = include_str!("../../../../../docs/problem-file.md");
    let blocks: Vec<_> = page.split("```").collect();
    let text = edited(blocks[1].trim_start_matches("toml\n"), "young", "yong");
    let text = edited(&text, "[0.5, 0.0]", "[5.0, 0.0]");
    let text = edited(&text, "[0.0, 1.0]", "[0.0, \"1 + z\"]");
    let error = Problem::parse(&text, "plate.toml", Path::new("")).expect_err("three mistakes");
    assert_eq!(blocks[3].trim_start_matches("text\n").trim_end(), error.to_string());
}
