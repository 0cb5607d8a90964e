//! Rules for the quantities that a problem names.

use ppum::dataset::{Equation, NamedQuantity};
use ppum::quantity::{QuantityFormulaError, names};

use crate::data::quantities::{components, parse};
use crate::data::{ProblemData, expression};
use crate::file::{Key, KeyError};

/// All rules broken by the quantities.
pub(crate) fn check_quantities(problem: &ProblemData) -> Vec<KeyError> {
    let rule = |index| {
        let key = Key::new("quantity").index(index);
        let (name, message) = broken(problem, index)?;
        Some(key.name(name).error(message))
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
