//! Tables that formulas may read.

use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum::formula::Table;

use crate::content::{Array, ArrayValues, ObjectKind};
use crate::error::WriteError;
use crate::limits::MAX_TABLE_VALUES;
use crate::member::{GroupShape, Member};
use crate::reader::{Extent, GroupReader, numbered};
use crate::writer::{EncodeResult, GroupWriter};

pub(super) const TABLES: Member<Dataset> = Member::<Dataset>::group(
    "tables",
    (GroupShape::Numbered, Vec::new),
    |dataset, group, name| {
        let mut tables = dataset.tables.iter().enumerate();
        tables
            .try_for_each(|(k, table)| put(table, &mut group.group(&format!("{name}/{k:04}"))))?;
        let total: usize = dataset.tables.iter().map(|table| table.values().len()).sum();
        if total > MAX_TABLE_VALUES {
            let message =
                format!("have {total} values together; at most {MAX_TABLE_VALUES} may be");
            return Err(WriteError::object(name, message));
        }
        Ok(())
    },
    |dataset, group, name, _| {
        let mut left = MAX_TABLE_VALUES;
        let tables = numbered(group, name, |group| take(group, &mut left).map(Arc::new));
        dataset.tables = tables.into_iter().flatten().collect();
    },
);

fn put(table: &Table, group: &mut GroupWriter) -> EncodeResult {
    let (x, y, values) = (table.x(), table.y(), table.values());
    group.attribute("name", &table.name().to_owned())?;
    group.values("x", x)?;
    if y.is_empty() {
        return group.values("values", values);
    }
    let shape = vec![y.len() as u64, x.len() as u64];
    group.array("values", Array { shape, values: ArrayValues::F64(values.to_vec()) });
    group.values("y", y)
}

/// A table, if there is nothing wrong with it.
fn take(group: &GroupReader, left: &mut usize) -> Option<Table> {
    let name: String = group.attribute("name");
    let knots = |name| group.array::<f64>(name, &[Extent::Any]);
    let (x, y) = (knots("x"), group.holds("y", ObjectKind::Dataset).then(|| knots("y")));
    let extent = |knots: &Option<Vec<f64>>| {
        knots.as_ref().map_or(Extent::Any, |knots| Extent::Is(knots.len() as u64))
    };
    let shape: Vec<Extent> = y.iter().chain([&x]).map(extent).collect();
    let values = group.array::<f64>("values", &shape)?;
    let Some(rest) = left.checked_sub(values.len()) else {
        let message = format!("the tables have more than {MAX_TABLE_VALUES} values together");
        group.error("values", message);
        return None;
    };
    *left = rest;
    let table = match y {
        Some(y) => Table::surface(&name, x?, y?, values),
        None => Table::curve(&name, x?, values),
    };
    table.map_err(|error| group.error(error.list, error.to_string())).ok()
}
