//! Texts that try to break the parser end in errors or NaN, never in a crash.

use std::sync::Arc;

use crate::{ErrorKind, Formula, FormulaError, FormulaJets, MAX_DEPTH, MAX_LENGTH, Scope, Table};

use super::{jet_at, jets, same, value};

/// Parses on a small stack, so that unbounded recursion would show.
fn parse_on_small_stack(text: String) -> Result<Formula, FormulaError> {
    std::thread::Builder::new()
        .stack_size(1 << 19)
        .spawn(move || Formula::parse(&text, &Scope::cartesian()))
        .expect("a thread")
        .join()
        .expect("no crash")
}

#[test]
fn deep_nesting_is_refused() {
    let cases = [
        ("(", "x", ")"),
        ("sin(", "x", ")"),
        ("-", "x", ""),
        ("2^", "x", ""),
        ("if(x < 1 and not y < 1 or x + y*", "(x)", ", 1, 0)"),
        ("1 + (", "x", ")"),
        ("if(not (", "x < 1", "), 1, 0)"),
        ("max(y, (", "x", "))"),
    ];
    for (open, core, close) in cases {
        let text = format!("{}{core}{}", open.repeat(3_000), close.repeat(3_000));
        let mistake = parse_on_small_stack(text).expect_err(open).mistake;
        assert!(matches!(mistake, ErrorKind::TooDeep | ErrorKind::TooLong), "{open}: {mistake:?}");
    }
    let text = format!("{}x{}", "(".repeat(10_000), ")".repeat(10_000));
    assert_eq!(parse_on_small_stack(text).expect_err("deep").mistake, ErrorKind::TooDeep);
}

#[test]
fn deepest_nesting_works_on_a_small_stack() {
    let open = "if(x < 1 and not 1 > 2 or 1 + 2*(y^";
    for (open, close) in [("(", ")"), ("sin(", ")"), ("-", ""), ("2^", "")] {
        let text = |n: usize| format!("{}x{}", open.repeat(n), close.repeat(n));
        assert!(parse_on_small_stack(text(MAX_DEPTH)).is_ok(), "{open}");
        let refused = parse_on_small_stack(text(MAX_DEPTH + 1)).expect_err(open);
        assert_eq!(refused.mistake, ErrorKind::TooDeep);
    }
    let text = format!("{}1", open.repeat(MAX_DEPTH));
    assert_eq!(parse_on_small_stack(text).expect_err("unclosed").mistake, ErrorKind::TooDeep);
}

/// The same of tables and sides, whose arguments are read by themselves.
#[test]
fn deep_nesting_in_tables_and_sides() {
    let knots = vec![0.0, 1.0];
    let table = Table::surface("k", knots.clone(), knots, vec![1.0; 4]).expect("valid");
    let scope = Scope::cartesian().with_sides(1).with_table(Arc::new(table)).expect("new");
    for (open, close) in [
        ("table(k, x, ", ")"),
        ("table(k, ", ", y)"),
        ("dtable(k, 1, 1, x, ", ")"),
        ("side(", ")"),
        ("dtable(k, ", ", 1, x, y)"),
    ] {
        for (n, refused) in [(MAX_DEPTH, false), (MAX_DEPTH + 1, true), (3_000, true)] {
            let (text, scope) = (format!("{}0{}", open.repeat(n), close.repeat(n)), scope.clone());
            let mistake = std::thread::Builder::new()
                .stack_size(1 << 19)
                .spawn(move || Formula::parse(&text, &scope).err().map(|error| error.mistake))
                .expect("a thread")
                .join()
                .expect("no crash");
            let deep = matches!(mistake, Some(ErrorKind::TooDeep | ErrorKind::TooLong));
            assert_eq!(deep, refused, "{open} {n} times: {mistake:?}");
        }
    }
}

/// As many different multiples of θ/2 as fit into a text, and tables of tables.
#[test]
fn half_angles_and_tables_do_not_blow_up() {
    let all: Vec<String> = (0..3000).map(|i| format!("tan({}*theta/2)*x", i % 64 + 1)).collect();
    let f = Formula::parse(&all.join("+"), &Scope::polar()).expect("valid");
    assert!(jets(&f).n_operations() < 40_000);
    let knots = vec![0.0, 1.0];
    let table = Table::surface("k", knots.clone(), knots, vec![1.0; 4]).expect("valid");
    let scope = Scope::polar().with_table(Arc::new(table)).expect("new");
    let mut text = "let a0 = cos(theta/2);".to_owned();
    for i in 0..300 {
        text += &format!("let a{} = table(k, a{i}*a{i}, sin(a{i}));", i + 1);
    }
    let f = Formula::parse(&format!("{text} a300"), &scope).expect("valid");
    assert!(jets(&f).n_operations() < 30_000);
}

#[test]
fn a_megabyte_is_refused() {
    for unit in ["x+", "(", "a", "#", "\n", "1", "é", "let a=1;"] {
        let text = unit.repeat((1 << 20) / unit.len());
        let error = Formula::parse(&text, &Scope::cartesian()).expect_err("too long");
        assert_eq!(error.mistake, ErrorKind::TooLong);
        assert!(error.to_string().len() < 500);
    }
}

#[test]
fn longest_texts_are_differentiated() {
    let sum = format!("{}x", "x*y+".repeat(MAX_LENGTH / 4 - 1));
    let product = format!("{}x", "y*".repeat(MAX_LENGTH / 2 - 1));
    for text in [sum, product] {
        let f = parse_on_small_stack(text).expect("within the limits");
        let jet = FormulaJets::new(&[&f], 2).expect("linear growth");
        let found = jet_at(&jet, &[2.0, 1.0]);
        assert_eq!(found[0], f.evaluate(&[2.0, 1.0]));
        assert!(found.iter().all(|v| v.is_finite()));
    }
}

/// Without shared subexpressions each of these would have 2^100 operations.
#[test]
fn repeated_squaring_stays_small() {
    let mut text = "let a0 = x + y;".to_owned();
    for i in 0..100 {
        text += &format!("let a{} = a{i}*a{i}/2 + sin(a{i});", i + 1);
    }
    let f = Formula::parse(&format!("{text} a100"), &Scope::cartesian()).expect("valid");
    assert!(jets(&f).n_operations() < 10_000);
}

#[test]
fn many_orders_end_in_an_error() {
    let mut f = Formula::parse("exp(sin(x)*cos(x*y))^x", &Scope::cartesian()).expect("valid");
    let refused = (0..200).find_map(|_| match f.derivative("x") {
        Ok(next) => {
            f = next;
            None
        }
        Err(error) => Some(error),
    });
    assert!(refused.is_some(), "growth must be bounded");
}

#[test]
fn nonsense_values_are_nan() {
    for text in ["0/0", "sqrt(-1)", "log(-x^2 - 1)", "asin(2 + x^2)", "(-2 - x^2)^0.3", "1/0 - 1/0"]
    {
        assert!(value(text, 0.5, 0.5).is_nan(), "{text}");
    }
    let jet = jets(&super::parse("sqrt(x - y)"));
    let found = jet_at(&jet, &[1.0, 1.0]);
    assert!(same(found[0], 0.0) && same(found[1], f64::INFINITY));
}
