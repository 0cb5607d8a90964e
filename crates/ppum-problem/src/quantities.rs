//! Quantities that a problem names.

use std::sync::Arc;

use ppum::dataset::{Equation, NamedQuantity};
use ppum::formula::Table;
use ppum::quantity::{QuantityFormula, QuantityFormulaError, Vocabulary, names};

use super::expression;
use super::key::{InvalidValue, Key};
use super::model::ProblemData;

/// Name of the field of an equation, and names of its components.
pub fn field_names(equation: &Equation) -> (&'static str, &'static [&'static str]) {
    let name = match equation {
        Equation::Elasticity(_) => "displacement",
        Equation::Poisson { .. } => "potential",
        Equation::None => "field",
    };
    (name, equation.component_names())
}

fn components(equation: &Equation) -> Vec<String> {
    field_names(equation).1.iter().map(|&name| name.to_owned()).collect()
}

/// The quantity of a formula, which may use the `named` ones.
pub(super) fn parse(
    text: &str,
    equation: &Equation,
    tables: &[Arc<Table>],
    named: &[NamedQuantity],
) -> Result<QuantityFormula, QuantityFormulaError> {
    let components = components(equation);
    QuantityFormula::new(text, &Vocabulary { equation, components: &components, tables, named })
}

/// All rules broken by the quantities.
pub(super) fn check_quantities(problem: &ProblemData) -> Vec<InvalidValue> {
    let rule = |index| {
        let key = Key::new("quantity").index(index);
        let (name, message) = broken(problem, index)?;
        Some(key.name(name).mistake(message))
    };
    (0..problem.quantities.len()).filter_map(rule).collect()
}

/// The key of a quantity that is wrong, and why.
fn broken(problem: &ProblemData, index: usize) -> Option<(&'static str, String)> {
    let (ProblemData { tables, quantities, .. }, equation) = (problem, problem.dataset_equation());
    let equation = &*equation;
    let (earlier, quantity) = (&quantities[..index], &quantities[index]);
    if let Some(message) = bad_name(&quantity.name, equation, earlier) {
        return Some(("name", message));
    }
    if let Err(error) = parse(&quantity.text, equation, tables, earlier) {
        return Some(("formula", message(&error)));
    }
    let error = parse("0", equation, tables, &quantities[..=index]).err()?;
    Some(("name", message(&error)))
}

fn message(error: &QuantityFormulaError) -> String {
    match error {
        QuantityFormulaError::Formula(error) => expression::message(error),
        error => error.to_string(),
    }
}

fn bad_name(name: &str, equation: &Equation, earlier: &[NamedQuantity]) -> Option<String> {
    let word = |c: char| c.is_ascii_alphanumeric() || "_-".contains(c);
    let is_word = name.starts_with(|c: char| c.is_ascii_alphabetic()) && name.chars().all(word);
    if !is_word {
        let rule = "names are letters, digits, `-` and `_`, a letter first";
        return Some(format!("`{name}` cannot name a quantity; {rule}"));
    }
    let same = |other: &str| other.replace('-', "_") == name.replace('-', "_");
    if earlier.iter().any(|quantity| same(&quantity.name)) {
        return Some(format!("there is another quantity `{name}`; give each its own name"));
    }
    let built_in = names(equation, &components(equation));
    let taken = built_in.iter().any(|(known, _)| same(known));
    taken.then(|| format!("`{name}` is a built-in quantity; choose another name"))
}
