//! The tables `[[quantity]]`.

use std::sync::Arc;

use ppum::dataset::{MAX_QUANTITIES, MAX_QUANTITY_TEXT, NamedQuantity};
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
    let sections = root.sections_at_most(MAX_QUANTITIES, "quantity");
    if is_too_long(&sections) {
        return found;
    }
    for section in sections {
        found.extend(quantity(&section.only(&["name", "formula", "unit"], &[]), |text| {
            parse(text, equation, tables, &found).map(|_| ())
        }));
    }
    found
}

/// Reports formulas that are longer together than a dataset can hold: each is read with all
/// before it.
fn is_too_long(sections: &[Section<'_>]) -> bool {
    let mut sum = 0;
    let too_long = sections.iter().find(|section| {
        let formula = section.get("formula");
        sum += formula.and_then(|value| value.as_text()).map_or(0, str::len);
        sum > MAX_QUANTITY_TEXT
    });
    let message = format!(
        "the formulas of the quantities are longer than {MAX_QUANTITY_TEXT} bytes together; leave some out"
    );
    too_long.inspect(|section| section.error(message)).is_some()
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
