//! Tables in formulas.

use std::sync::Arc;

use crate::{ErrorKind, Formula, FormulaError, Scope, ScopeError, Table};

use super::{assert_near, jet_at, jets};

fn cube(x: f64) -> f64 {
    x * x * x - 2.0 * x
}

/// x, y; `k(x)` = x³ − 2x; `g(x, y)` = (x³ − 2x) y²; both on [−2, 3].
fn scope() -> Scope {
    let knots: Vec<f64> = [-2.0, -1.0, 0.5, 1.0, 3.0].to_vec();
    let curve = knots.iter().map(|&x| cube(x)).collect();
    let surface = knots.iter().flat_map(|&y| knots.iter().map(move |&x| cube(x) * y * y)).collect();
    let k = Table::curve("k", knots.clone(), curve).expect("valid");
    let g = Table::surface("g", knots.clone(), knots, surface).expect("valid");
    Scope::cartesian()
        .with_table(Arc::new(k))
        .and_then(|scope| scope.with_table(Arc::new(g)))
        .expect("new names")
}

fn parse(text: &str) -> Formula {
    Formula::parse(text, &scope()).unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// Inside the range the tables are the polynomials they are made of; so are their compositions.
#[test]
fn jets_are_those_of_the_polynomials() {
    for (text, closed) in [
        ("table(k, x)", "x^3 - 2*x"),
        ("table(k, x*y) + 1", "(x*y)^3 - 2*x*y + 1"),
        ("table(g, x, y)", "(x^3 - 2*x)*y^2"),
        ("table(g, x - y, x*y)*y", "((x - y)^3 - 2*(x - y))*(x*y)^2*y"),
        ("dtable(k, 1, x)", "3*x^2 - 2"),
        ("dtable(g, 1, 2, y, x)", "2*(3*y^2 - 2)"),
        ("table(g, let s = x; s + 0.25, sin(y))", "((x + 0.25)^3 - 2*(x + 0.25))*sin(y)^2"),
    ] {
        let (table, polynomial) = (jets(&parse(text)), jets(&parse(closed)));
        for point in [[0.3, 0.7], [-0.6, 0.9], [1.1, -0.4], [-1.2, -1.5]] {
            let found = jet_at(&table, &point);
            let expected = jet_at(&polynomial, &point);
            for i in 0..6 {
                let what = format!("{text}, component {i} at {point:?}");
                assert_near(found[i], expected[i], 1e-12, 10.0, &what);
            }
        }
    }
}

#[test]
fn constants_fold() {
    let value = parse("table(k, 2)*dtable(g, 1, 0, 1, 2)").constant().expect("a constant");
    assert_near(value, 4.0 * 4.0, 1e-14, 16.0, "4 · (3 − 2) · 4");
    assert_eq!(parse("dtable(k, 4, x)").constant(), Some(0.0));
}

/// Outside the range a table is constant.
#[test]
fn flat_outside() {
    let found = jet_at(&jets(&parse("table(g, x, y)")), &[5.0, 1.0]);
    for (found, expected) in found.into_iter().zip([21.0, 0.0, 42.0, 0.0, 0.0, 42.0]) {
        assert_near(found, expected, 1e-13, 42.0, "at (5, 1)");
    }
}

#[test]
fn derivatives_print_and_parse_again() {
    for text in ["table(k, x^2)*y", "table(g, x*y, x - y)", "sin(dtable(g, 1, 1, x, y))"] {
        let f = parse(text).derivative("x").expect("small");
        let again = parse(f.text());
        assert_eq!(f.evaluate(&[0.7, 0.4]), again.evaluate(&[0.7, 0.4]), "{}", f.text());
    }
    assert_eq!(
        parse("table(k, 3*x)").derivative("x").expect("small").text(),
        "3*dtable(k, 1, 3*x)"
    );
}

#[test]
fn names_of_tables_are_taken() {
    let table = Table::curve("x", vec![0.0, 1.0], vec![0.0, 1.0]).expect("valid");
    let taken = ScopeError::NameTaken { name: "x".to_owned() };
    assert_eq!(Scope::cartesian().with_table(Arc::new(table)), Err(taken));
    let taken = ScopeError::NameTaken { name: "k".to_owned() };
    assert_eq!(scope().with_parameter("k", 1.0), Err(taken));
    let table = Table::curve("1st", vec![0.0, 1.0], vec![0.0, 1.0]).expect("valid");
    assert!(matches!(scope().with_table(Arc::new(table)), Err(ScopeError::InvalidName { .. })));
}

fn error(text: &str) -> FormulaError {
    Formula::parse(text, &scope()).expect_err(text)
}

#[test]
fn errors_point_at_the_place() {
    let unknown = |suggestion: Option<&str>| ErrorKind::UnknownTable {
        suggestion: suggestion.map(Into::into),
        known: "k, g".into(),
    };
    let arguments = |form: &str, given| ErrorKind::TableArguments { form: form.into(), given };
    for (text, column, found, mistake) in [
        ("1 + k", 5, "k", ErrorKind::TableForNumber),
        ("let k = 1; k", 5, "k", ErrorKind::NameTaken),
        ("k(x)", 1, "k", ErrorKind::TableForNumber),
        ("table(x, y)", 7, "x", unknown(None)),
        ("table(K, y)", 7, "K", unknown(Some("k"))),
        ("table(k, x, y)", 1, "table", arguments("table(k, x)", 3)),
        ("table(g, x)", 1, "table", arguments("table(g, x, y)", 2)),
        ("table(k)", 1, "table", arguments("table(k, x)", 1)),
        ("dtable(k, x)", 1, "dtable", arguments("dtable(k, m, x)", 2)),
        ("dtable(g, 1, x, y)", 1, "dtable", arguments("dtable(g, m, n, x, y)", 4)),
        ("dtable(k, x, 1)", 11, "x", ErrorKind::InvalidOrder),
        ("dtable(k, 0.5, x)", 11, "0.5", ErrorKind::InvalidOrder),
        ("table()", 7, ")", ErrorKind::Unexpected { expected: "the name of a table" }),
        ("table(2, x)", 7, "2", ErrorKind::Unexpected { expected: "the name of a table" }),
        ("table + 1", 1, "table", ErrorKind::MissingArguments),
        ("table(k, x < y)", 10, "x < y", ErrorKind::ConditionForNumber),
        (
            "tabel(k, x)",
            1,
            "tabel",
            ErrorKind::UnknownFunction { suggestion: Some("table".into()) },
        ),
        ("2*K", 3, "K", ErrorKind::UnknownName { suggestion: Some("table(k, …)".into()) }),
        ("table(k, x", 11, "", ErrorKind::Unexpected { expected: "an operator, `,` or `)`" }),
    ] {
        let error = error(text);
        assert_eq!(error.mistake, mistake, "{text}");
        assert_eq!((error.line, error.column, error.found.as_str()), (1, column, found), "{text}");
    }
    assert!(error("table(q, x)").to_string().contains("no table `q`; tables are k, g"));
    assert!(error("k + 1").to_string().contains("`k` is a table; write `table(k, …)`"));
}
