//! Quantities that a problem names.

use std::sync::Arc;

use ppum::dataset::{Equation, NamedQuantity};
use ppum::formula::Table;
use ppum::quantity::{QuantityFormula, QuantityFormulaError, Vocabulary};

/// Name of the field of an equation, and names of its components.
pub fn field_names(equation: &Equation) -> (&'static str, &'static [&'static str]) {
    let name = match equation {
        Equation::Elasticity(_) => "displacement",
        Equation::Poisson { .. } => "potential",
        Equation::None => "field",
    };
    (name, equation.component_names())
}

pub(crate) fn components(equation: &Equation) -> Vec<String> {
    field_names(equation).1.iter().map(|&name| name.to_owned()).collect()
}

/// The quantity of a formula, which may use the `named` ones.
pub(crate) fn parse(
    text: &str,
    equation: &Equation,
    tables: &[Arc<Table>],
    named: &[NamedQuantity],
) -> Result<QuantityFormula, QuantityFormulaError> {
    let components = components(equation);
    QuantityFormula::new(text, &Vocabulary { equation, components: &components, tables, named })
}
