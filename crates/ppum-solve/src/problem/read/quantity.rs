//! The tables `[[quantity]]`.

use std::sync::Arc;

use ppum::dataset::NamedQuantity;
use ppum::equation::Equation;
use ppum::formula::Table;
use ppum::quantity::QuantityFormulaError;

use super::super::document::{Section, Value};
use super::super::quantities::parse;

/// The quantities that can be read, each of which may use those before it.
pub(super) fn quantities(
    root: &Section<'_>,
    equation: &Equation,
    tables: &[Arc<Table>],
) -> Vec<NamedQuantity> {
    let mut found = Vec::new();
    for section in root.sections("quantity") {
        found.extend(quantity(&section.only(&["name", "formula", "unit"], &[]), |text| {
            parse(text, equation, tables, &found).map(|_| ())
        }));
    }
    found
}

fn quantity(
    section: &Section<'_>,
    parse: impl Fn(&str) -> Result<(), QuantityFormulaError>,
) -> Option<NamedQuantity> {
    let name = section.require("name", "name = \"slip\"").and_then(|name| name.text());
    let formula = section.require("formula", "formula = \"sqrt(ux^2 + uy^2)\"");
    let unit = section.get("unit").map_or(Some(""), |unit| unit.text());
    let formula = formula.and_then(|value| checked(&value, parse));
    let (name, text, unit) = (name?.to_owned(), formula?.to_owned(), unit?.to_owned());
    Some(NamedQuantity { name, text, unit })
}

/// The text of a formula that can be parsed.
fn checked<'a>(
    value: &Value<'a>,
    parse: impl Fn(&str) -> Result<(), QuantityFormulaError>,
) -> Option<&'a str> {
    let text = value.text()?;
    match parse(text) {
        Ok(()) => Some(text),
        Err(QuantityFormulaError::Formula(error)) => value.inside(text, Err(error)),
        Err(error) => value.error(&format!("cannot be used: {error}")),
    }
}
