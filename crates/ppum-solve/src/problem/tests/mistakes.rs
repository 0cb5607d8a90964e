//! Mistakes in problem files, kind by kind.

use super::*;

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
    assert_eq!(mistakes(""), expected.map(|message| format!("dir/plate.toml:1:1: {message}")));
}

#[test]
fn all_mistakes_at_once_in_the_order_of_the_file() {
    let text = edited(PLATE, "young = 2.5", "yong = 2.5");
    let text = edited(&text, "0.3", "0.7");
    let text = edited(&text, "[[-0.5, 0.0], [0.5, 0.0]]", "[[-0.5, 0.0], [5, 0.0]]");
    let text = edited(&text, "\"top\"", "\"bottom\"");
    let text = edited(&text, "level = 4", "level = 40\noverlap = \"1.3\"");
    let places: Vec<_> = mistakes(&text)
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
        let found = mistakes(text);
        assert_eq!(found.len(), places.len(), "{found:?}");
        for (found, place) in found.iter().zip(places) {
            assert!(found.starts_with(&expected(place)), "{found}");
        }
    }
}
