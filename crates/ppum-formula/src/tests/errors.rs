//! Places and wording of errors.

use crate::{DerivativeError, ErrorKind, Formula, FormulaError, Scope};

use super::parse;

fn error(text: &str) -> FormulaError {
    Formula::parse(text, &Scope::polar()).expect_err(text)
}

fn unexpected(expected: &'static str) -> ErrorKind {
    ErrorKind::Unexpected { expected }
}

fn module(instead: &str) -> ErrorKind {
    ErrorKind::Module { instead: instead.to_owned() }
}

fn arguments(expected: usize, given: usize, suggestion: Option<&'static str>) -> ErrorKind {
    ErrorKind::ArgumentCount { expected, given, suggestion }
}

fn similar(name: &str) -> Option<String> {
    Some(name.to_owned())
}

#[test]
fn places_and_problems() {
    let cases: Vec<(&str, usize, usize, &str, ErrorKind)> = vec![
        ("", 1, 1, "", unexpected("a number, a name or `(`")),
        ("# only a comment", 1, 17, "", unexpected("a number, a name or `(`")),
        ("x +", 1, 4, "", unexpected("a number, a name or `(`")),
        ("x + * y", 1, 5, "*", unexpected("a number, a name or `(`")),
        ("(x + y", 1, 7, "", unexpected("an operator or `)`")),
        ("x + y)", 1, 6, ")", unexpected("an operator or the end")),
        ("2x", 1, 2, "x", unexpected("an operator or the end")),
        ("x y", 1, 3, "y", unexpected("an operator or the end")),
        ("x\n+ y\n+ $", 3, 3, "$", unexpected("a number, a name or an operator")),
        ("x**2", 1, 2, "**", unexpected("`^`")),
        ("sin(x", 1, 6, "", unexpected("an operator, `,` or `)`")),
        ("let = 2; x", 1, 5, "=", unexpected("a new name")),
        ("let a 2; x", 1, 7, "2", unexpected("`=`")),
        ("let a = 2 x", 1, 11, "x", unexpected("an operator or `;`")),
        ("let a = 2;", 1, 11, "", unexpected("a number, a name or `(`")),
        ("1 + let a = 2; a", 1, 5, "let", unexpected("a number, a name or `(`")),
        (
            "sqrt(r)*cos(thet/2)",
            1,
            13,
            "thet",
            ErrorKind::UnknownName { suggestion: similar("theta") },
        ),
        ("velocity", 1, 1, "velocity", ErrorKind::UnknownName { suggestion: None }),
        ("let size = 1; sze", 1, 15, "sze", ErrorKind::UnknownName { suggestion: similar("size") }),
        ("PI*x", 1, 1, "PI", ErrorKind::UnknownName { suggestion: similar("pi") }),
        ("(let a = 1; a) + a", 1, 18, "a", ErrorKind::UnknownName { suggestion: None }),
        ("1 + snh(x)", 1, 5, "snh", ErrorKind::UnknownFunction { suggestion: similar("sinh") }),
        ("ln(x)", 1, 1, "ln", ErrorKind::UnknownFunction { suggestion: similar("log") }),
        ("POW(x, 2)", 1, 1, "POW", ErrorKind::UnknownFunction { suggestion: similar("^") }),
        ("sitn(x)", 1, 1, "sitn", ErrorKind::UnknownFunction { suggestion: similar("sin") }),
        ("tehta/2", 1, 1, "tehta", ErrorKind::UnknownName { suggestion: similar("theta") }),
        ("x > 0 ? 1 : 2", 1, 7, "?", unexpected("`if(condition, a, b)`")),
        ("x² + 1", 1, 2, "²", unexpected("`^2`")),
        ("if(x ≤ y, 1, 2)", 1, 6, "≤", unexpected("`<=`")),
        ("x(y)", 1, 1, "x", ErrorKind::NotAFunction),
        ("pi(y)", 1, 1, "pi", ErrorKind::NotAFunction),
        ("sin + 1", 1, 1, "sin", ErrorKind::MissingArguments),
        ("x +\n  atan2(y)", 2, 3, "atan2", arguments(2, 1, Some("atan"))),
        ("sin()", 1, 1, "sin", arguments(1, 0, None)),
        ("atan(y, x)", 1, 1, "atan", arguments(1, 2, Some("atan2"))),
        ("max(x, y, r)", 1, 1, "max", arguments(2, 3, None)),
        ("clamp(x, y)", 1, 1, "clamp", arguments(3, 2, None)),
        ("a = 2; a*x", 1, 1, "a", ErrorKind::MissingLet),
        ("if(x = 1, 2, 3)", 1, 6, "=", unexpected("`==` to compare")),
        ("x = 1", 1, 3, "=", unexpected("`==` to compare")),
        ("let x = 1; x", 1, 5, "x", ErrorKind::NameTaken),
        ("let pi = 3; pi", 1, 5, "pi", ErrorKind::NameTaken),
        ("let a = 1; let a = 2; a", 1, 16, "a", ErrorKind::NameTaken),
        ("let a = a + 1; a", 1, 9, "a", ErrorKind::SelfReference),
        ("1 + np.sqrt(r)", 1, 5, "np.sqrt", module("sqrt")),
        ("numpy.arctan2(y, x)", 1, 1, "numpy.arctan2", module("atan2")),
        ("2*math.pi", 1, 3, "math.pi", module("pi")),
        ("1e + x", 1, 1, "1e", ErrorKind::InvalidNumber),
        ("x + 1e999", 1, 5, "1e999", ErrorKind::InvalidNumber),
        ("if(0 < x < 1, 1, 0)", 1, 10, "<", ErrorKind::ChainedComparison),
        ("x + (y < 1)", 1, 6, "y < 1", ErrorKind::ConditionForNumber),
        ("x < y", 1, 1, "x < y", ErrorKind::ConditionForNumber),
        ("if(x, 1, 0)", 1, 4, "x", ErrorKind::NumberForCondition),
        ("if(x > 0 and y, 1, 0)", 1, 14, "y", ErrorKind::NumberForCondition),
        ("not x", 1, 5, "x", ErrorKind::NumberForCondition),
        ("2*table(kc, x)", 1, 9, "kc", ErrorKind::NoTables),
        ("äö + x", 1, 1, "ä", unexpected("a number, a name or an operator")),
    ];
    for (text, line, column, found, mistake) in cases {
        let error = error(text);
        assert_eq!(error.mistake, mistake, "{text}");
        assert_eq!((error.line, error.column), (line, column), "{text}");
        assert_eq!(error.found, found, "{text}");
    }
}

#[test]
fn messages_show_the_place() {
    assert_eq!(
        error("let d = 2;\nsqrt(r)*cos(thet/2)").to_string(),
        "line 2, column 13: unknown name `thet`; did you mean `theta`?\n  \
         sqrt(r)*cos(thet/2)\n              ^^^^"
    );
    assert_eq!(
        error("x +").to_string(),
        "line 1, column 4: the formula ends here; expected a number, a name or `(`\n  x +\n     ^"
    );
    // columns are characters, not bytes, and a tab is as wide as any other
    let error = error("x\t· ¬y");
    assert_eq!((error.column, error.found.as_str()), (5, "¬"));
    assert!(error.excerpt.ends_with("\n      ^"), "{error}");
    // and so is what is not shown as it is
    let error = self::error("x\u{1b}[31m\u{202e} + ¬y");
    assert_eq!(error.excerpt.as_ref(), "  x\u{fffd}[31m\u{fffd} + ¬y\n   ^");
    assert_eq!(error.found, "\u{fffd}");
}

#[test]
fn derivatives_are_of_independent_variables() {
    let f = parse("x*y");
    let not = |name: &str| DerivativeError::NotIndependent {
        name: name.to_owned(),
        known: "x, y".to_owned(),
    };
    assert_eq!(f.derivative("t").expect_err("no such variable"), not("t"));
    let polar = Formula::parse("r", &Scope::polar()).expect("valid");
    assert_eq!(polar.derivative("r").expect_err("dependent"), not("r"));
    let weight = Formula::parse("1 - t", &Scope::new(&["t"]).expect("a name")).expect("valid");
    assert_eq!(weight.derivative("t").expect("a variable").evaluate(&[0.5]), -1.0);
}
