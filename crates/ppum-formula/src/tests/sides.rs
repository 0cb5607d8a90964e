//! Sides of cracks in formulas.

use crate::{ErrorKind, Formula, FormulaError, Scope};

use super::{jet_at, jets};

fn scope() -> Scope {
    Scope::cartesian().with_sides(2)
}

fn error(text: &str, scope: &Scope) -> FormulaError {
    Formula::parse(text, scope).expect_err(text)
}

#[test]
fn sides_are_inputs_after_the_others() {
    assert_eq!(scope().inputs().collect::<Vec<_>>(), ["x", "y", "side(0)", "side(1)"]);
    assert_eq!(Scope::polar().with_sides(1).inputs().last(), Some("side(0)"));
    assert_eq!(scope().with_sides(1).inputs().last(), Some("side(2)"));
    let f = Formula::parse("side( 1 )*x + side(0)", &scope()).expect("valid");
    assert_eq!(f.evaluate(&[3.0, 0.0, 1.0, -1.0]), -2.0);
    assert!(f.uses("side(0)") && f.uses("side(1)") && !f.uses("y"));
}

/// A side is constant but on the crack, where it has no derivative.
#[test]
fn derivatives_are_zero() {
    let f = Formula::parse("side(1)*x*y + side(0)", &scope()).expect("valid");
    let found = jet_at(&jets(&f), &[3.0, 2.0, 1.0, -1.0]);
    assert_eq!(found, [-5.0, -2.0, -3.0, 0.0, -1.0, 0.0]);
    let dx = f.derivative("x").expect("small");
    assert_eq!(dx.text(), "side(1)*y");
    assert_eq!(Formula::parse(dx.text(), &scope()).expect("valid").text(), dx.text());
}

#[test]
fn errors_say_how_many_cracks_there_are() {
    let unknown = |cracks| ErrorKind::UnknownCrack { cracks };
    for (text, column, found, mistake) in [
        ("1 + side(2)", 10, "2", unknown(2)),
        ("side(0.5)", 6, "0.5", unknown(2)),
        ("side(-1)", 6, "-1", unknown(2)),
        ("side(x)", 6, "x", unknown(2)),
        ("side(1e10)", 6, "1e10", unknown(2)),
        ("side()", 6, ")", ErrorKind::Unexpected { expected: "the number of a crack" }),
        ("side(0, 1)", 7, ",", ErrorKind::Unexpected { expected: "an operator or `)`" }),
        ("side", 1, "side", ErrorKind::MissingArguments),
        ("let side = 1; side", 5, "side", ErrorKind::NameTaken),
        ("side(0", 7, "", ErrorKind::Unexpected { expected: "an operator or `)`" }),
    ] {
        let error = error(text, &scope());
        assert_eq!(error.mistake, mistake, "{text}");
        assert_eq!((error.column, error.found.as_str()), (column, found), "{text}");
    }
    let message = |cracks: usize| error("side(9)", &Scope::polar().with_sides(cracks)).to_string();
    assert!(message(0).contains("column 1: `side` needs a crack, but there is none here"));
    assert!(message(1).contains("column 6: `9` is no crack; there is one, write `side(0)`"));
    assert!(message(3).contains("`9` is no crack; there are 3, from `side(0)` to `side(2)`"));
}
