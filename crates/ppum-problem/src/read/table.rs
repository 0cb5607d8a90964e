//! The tables `[[table]]`.

use std::sync::Arc;

use ppum::dataset::{Equation, MAX_TABLES};
use ppum::formula::{Table, TableError};

use crate::data::scopes;
use crate::file::table_file::{self, TableData};
use crate::file::{DocumentValue, FileSource, FromValue as _, Section, all};

/// The tables. For one that is wrong in all but its name another one stands in, so that formulas
/// that read it are not found wrong as well.
pub(super) fn tables(root: &Section<'_>, equation: &Equation) -> Vec<Arc<Table>> {
    if let FileSource::Stored(dataset) = root.document.source {
        return dataset.tables.clone();
    }
    let mut found = Vec::new();
    for section in root.sections_at_most(MAX_TABLES, "table") {
        let name = section.required("name");
        let data = data(&section);
        let Some((value, name)) = name.and_then(|value| Some((value.clone(), value.text()?)))
        else {
            continue;
        };
        let table = data.and_then(|data| {
            data.table(name).map(Arc::new).map_err(|error| report(&section, &error)).ok()
        });
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
    let y = if is_surface { knots.clone() } else { Vec::new() };
    let values = vec![1.0; if is_surface { 4 } else { 2 }];
    TableData { x: knots, y, values }.table(name).ok().map(Arc::new)
}

/// Keys of data that stand in the problem file.
const INLINE: [&str; 3] = ["x", "y", "values"];

fn data(section: &Section<'_>) -> Option<TableData> {
    match (section.value("file"), section.given(&INLINE).first()) {
        (Some(_), Some((_, own))) => own.error("contradicts `file`; give one of them"),
        (Some(file), None) => {
            let FileSource::Folder(folder) = section.document.source else { return None };
            table_file::read(&file.file(folder)?).map_err(|errors| file.add(errors)).ok()
        }
        (None, Some(_)) => inline(section),
        (None, None) if section.mentions("file") || section.mentions_any(&INLINE) => None,
        _ => section.error("[[table]] has no data; add `x` and `values`, or `file`"),
    }
}

fn inline(section: &Section<'_>) -> Option<TableData> {
    let x: Option<Vec<f64>> = section.require("x");
    let y: Option<Vec<f64>> = section.or("y", Vec::new());
    let values = section.required("values");
    let (x, y, values) = (x?, y?, values?);
    let rows = |row: &DocumentValue<'_>| row_of(row, x.len());
    let values = match y.is_empty() {
        true => Vec::read(&values)?,
        false => all(values.list()?.iter().map(rows))?.concat(),
    };
    Some(TableData { x, y, values })
}

/// A row of so many numbers.
fn row_of(row: &DocumentValue<'_>, length: usize) -> Option<Vec<f64>> {
    let found = Vec::read(row)?;
    let given = found.len();
    if given != length {
        return row.error(&format!("has a row of {given} numbers, but `x` has {length}"));
    }
    Some(found)
}

/// Reports what is wrong with the data, at the list or the number.
fn report(section: &Section<'_>, error: &TableError) {
    let list = section.value(error.list).or_else(|| section.value("file"));
    let number = list.as_ref().and_then(|list| list.element(error.index?));
    match number.or(list) {
        Some(value) => value.report(&error.to_string()),
        None => _ = section.error::<()>(error.to_string()),
    }
}
