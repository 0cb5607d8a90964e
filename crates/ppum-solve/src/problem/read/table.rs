//! The tables `[[table]]`.

use std::path::Path;
use std::sync::Arc;

use ppum::dataset::{Equation, MAX_TABLES};
use ppum::formula::{Table, TableError};

use super::super::document::{Section, Value};
use super::super::scopes;
use super::super::table_file::{self, TableData};
use super::Files;

/// The tables. For one that is wrong in all but its name another one stands in, so that formulas
/// that read it are not found wrong as well.
pub(super) fn tables(root: &Section<'_>, files: Files<'_>, equation: &Equation) -> Vec<Arc<Table>> {
    let folder = match files {
        Files::In(folder) => folder,
        Files::Stored(dataset) => return dataset.tables.clone(),
    };
    let mut found = Vec::new();
    for section in root.sections_at_most(MAX_TABLES, "table") {
        let section = section.only(&["name", "x", "y", "values", "file"], &[]);
        let name = section.require("name", "name = \"stiffness\"");
        let data = data(&section, folder);
        let Some((value, name)) = name.and_then(|value| Some((value.clone(), value.text()?)))
        else {
            continue;
        };
        let table = data.and_then(|data| table(&section, name, data));
        found.extend(table.or_else(|| stand_in(name, section.mentions("y"))));
        if let Err(error) = scopes::check(&found, equation) {
            found.pop();
            value.report(&error.to_string());
        }
    }
    found
}

/// A table with the value 1.
fn stand_in(name: &str, is_surface: bool) -> Option<Arc<Table>> {
    let knots = vec![0.0, 1.0];
    let table = match is_surface {
        true => Table::surface(name, knots.clone(), knots, vec![1.0; 4]),
        false => Table::curve(name, knots, vec![1.0; 2]),
    };
    table.ok().map(Arc::new)
}

fn data(section: &Section<'_>, folder: &Path) -> Option<TableData> {
    match (section.get("file"), ["x", "y", "values"].iter().find_map(|key| section.get(key))) {
        (Some(_), Some(own)) => own.error("contradicts `file`; give one of them"),
        (Some(file), None) => {
            let found = table_file::read(&file.file(folder)?);
            found.map_err(|mistakes| mistakes.into_iter().for_each(|new| file.add(new))).ok()
        }
        (None, Some(_)) => inline(section),
        (None, None) => {
            if !["file", "x", "y", "values"].iter().any(|key| section.mentions(key)) {
                section.error("[[table]] has no data; add `x` and `values`, or `file`");
            }
            None
        }
    }
}

fn inline(section: &Section<'_>) -> Option<TableData> {
    let x = section.require("x", "x = [0.0, 0.5, 1.0]").and_then(|value| numbers(&value));
    let y = section.get("y").map_or(Some(Vec::new()), |value| numbers(&value));
    let values = section.require("values", "values = [1.0, 2.0, 4.0]");
    let (x, y, values) = (x?, y?, values?);
    let values = if y.is_empty() { numbers(&values)? } else { rows(&values, x.len())? };
    Some(TableData { x, y, values })
}

fn numbers(value: &Value<'_>) -> Option<Vec<f64>> {
    super::all(value.list("a list of numbers")?.iter().map(Value::number))
}

fn rows(values: &Value<'_>, length: usize) -> Option<Vec<f64>> {
    let row = |row: &Value<'_>| {
        let found = row.list("a row of numbers for each knot in y")?;
        let given = found.len();
        if given != length {
            let needed = format!("has a row of {given} numbers, but `x` has {length}");
            return row.error(&needed);
        }
        super::all(found.iter().map(Value::number))
    };
    Some(super::all(values.list("a list of rows")?.iter().map(row))?.concat())
}

fn table(section: &Section<'_>, name: &str, data: TableData) -> Option<Arc<Table>> {
    data.table(name).map(Arc::new).map_err(|error| report(section, &error)).ok()
}

/// Reports what is wrong with the data, at the list or the number.
fn report(section: &Section<'_>, error: &TableError) {
    let (key, index) = match error {
        TableError::TooFewKnots { axis, .. } => (axis.to_string(), None),
        TableError::NotIncreasing { axis, index, .. } => (axis.to_string(), Some(*index)),
        _ => ("values".to_owned(), None),
    };
    let list = section.get(&key).or_else(|| section.get("file"));
    let number = list.as_ref().and_then(|list| list.element(index?));
    match number.or(list) {
        Some(value) => value.report(&error.to_string()),
        None => section.error(error.to_string()),
    }
}
