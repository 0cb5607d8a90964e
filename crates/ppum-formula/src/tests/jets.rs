//! Several formulas at once.

use super::{Formula, FormulaJets, Scope, assert_near, jet_at, jets, same};
use crate::DerivativeError;

fn formulas(texts: &[&str], scope: &Scope) -> Vec<Formula> {
    texts.iter().map(|text| Formula::parse(text, scope).expect("valid")).collect()
}

fn compile(formulas: &[Formula], order: usize) -> Result<FormulaJets, DerivativeError> {
    FormulaJets::new(&formulas.iter().collect::<Vec<_>>(), order)
}

fn evaluate(jets: &FormulaJets, inputs: &[f64]) -> Vec<f64> {
    let mut out = vec![f64::NAN; jets.n_outputs()];
    jets.evaluate(inputs, &mut Vec::new(), &mut out);
    out
}

/// Each value is that of the formula alone, to the last bit; derivatives are those of the formula
/// alone but for the rounding of reciprocals.
#[test]
fn together_as_alone() {
    let texts = ["exp(x*y)*sin(x)", "x", "sin(x)*(y*x)", "7", "x", "exp(y*x)/(1 + y^2)"];
    let all = formulas(&texts, &Scope::cartesian());
    for order in 0..=2 {
        let jets_of_all = compile(&all, order).expect("small");
        let each = [1, 3, 6][order];
        assert_eq!(jets_of_all.n_outputs(), each * texts.len());
        let found = evaluate(&jets_of_all, &[0.7, -1.1]);
        for (k, f) in all.iter().enumerate() {
            let alone = jet_at(&jets(f), &[0.7, -1.1]);
            for (a, b) in found[each * k..].iter().zip(&alone[..each]) {
                assert_near(*a, *b, 1e-15, b.abs(), f.text());
            }
            assert!(same(found[each * k], f.evaluate(&[0.7, -1.1])), "{}", f.text());
        }
    }
}

/// Common parts are computed once, also where the formulas name them in another order.
#[test]
fn common_parts_are_shared() {
    let one = formulas(&["exp(x*y)*sin(x)"], &Scope::cartesian());
    let two = formulas(&["exp(x*y)*sin(x)", "sin(x)*exp(y*x)"], &Scope::cartesian());
    let count = |formulas: &[Formula]| compile(formulas, 2).expect("small").n_operations();
    assert_eq!(count(&one), count(&two));
}

#[test]
fn one_variable() {
    let scope = Scope::new(&["t"]).expect("a name");
    let all = formulas(&["t^3", "max(1 - t, 0)"], &scope);
    let found = evaluate(&compile(&all, 2).expect("small"), &[0.5]);
    assert_eq!(found, [0.125, 0.75, 3.0, 0.5, -1.0, 0.0]);
    assert_eq!(evaluate(&compile(&all, 1).expect("small"), &[0.5]), [0.125, 0.75, 0.5, -1.0]);
}

/// Values take any number of variables, derivatives one or two.
#[test]
fn many_variables() {
    let scope = Scope::new(&["a", "b", "c"]).expect("names");
    let all = formulas(&["a + c", "a*b"], &scope);
    let values = compile(&all, 0).expect("small");
    assert_eq!(evaluate(&values, &[1.0, 2.0, 3.0]), [4.0, 2.0]);
    assert_eq!(compile(&all, 1).err(), Some(DerivativeError::Variables { variables: 3 }));
    let none = formulas(&["2"], &Scope::new(&[]).expect("names"));
    assert_eq!(evaluate(&compile(&none, 0).expect("small"), &[]), [2.0]);
    assert_eq!(compile(&none, 1).err(), Some(DerivativeError::Variables { variables: 0 }));
}

#[test]
fn inputs_that_matter() {
    let all = formulas(&["sqrt(r)*x", "r^2"], &Scope::polar());
    let used = |order| {
        let jets = compile(&all, order).expect("small");
        (0..4).map(|input| jets.uses(input)).collect::<Vec<_>>()
    };
    assert_eq!(used(0), [true, false, true, false]);
    assert_eq!(used(1), [true, true, true, false]);
}

/// Formulas of one frame may have parameters of their own.
#[test]
fn parameters_may_differ() {
    let scope = |value| Scope::polar().with_parameter("a", value).expect("new");
    let (f, g) = (
        Formula::parse("r^a", &scope(2.0)).expect("valid"),
        Formula::parse("a*x", &scope(3.0)).expect("valid"),
    );
    let jets = FormulaJets::new(&[&f, &g], 0).expect("small");
    assert_eq!(evaluate(&jets, &[1.0, 0.0, 4.0, 0.0, 1.0, 0.0]), [16.0, 3.0]);
}

#[test]
#[should_panic(expected = "variables and tables in common")]
fn variables_may_not() {
    let f = Formula::parse("x", &Scope::cartesian()).expect("valid");
    let g = Formula::parse("x", &Scope::polar()).expect("valid");
    let _ = FormulaJets::new(&[&f, &g], 0);
}

/// Derivatives with respect to any of many variables, in the order asked for, are those of the
/// formula by each.
#[test]
fn partials_of_many_variables() {
    let scope = Scope::new(&["a", "b", "c", "d"]).expect("names");
    let formula = Formula::parse("hypot(a, b*c)/d + max(a, d)*exp(-b)", &scope).expect("a formula");
    let names = ["d", "a", "c", "b"];
    let jets = FormulaJets::partials(&formula, &names).expect("derivatives");
    for inputs in [[0.3, -0.7, 1.2, 2.0], [3.0, 0.1, -0.4, -1.5], [1.0, 2.0, 3.0, 1.0]] {
        let mut out = [0.0; 5];
        jets.evaluate(&inputs, &mut Vec::new(), &mut out);
        assert_eq!(out[0], formula.evaluate(&inputs));
        for (name, found) in names.iter().zip(&out[1..]) {
            let expected = formula.derivative(name).expect("a derivative").evaluate(&inputs);
            // quotients by the same number are products with its reciprocal
            assert!((found - expected).abs() <= 4.0 * f64::EPSILON * expected.abs(), "{name}");
        }
    }
    let error = FormulaJets::partials(&formula, &["e"]).expect_err("no such variable");
    assert!(matches!(error, DerivativeError::NotIndependent { .. }), "{error}");
}
