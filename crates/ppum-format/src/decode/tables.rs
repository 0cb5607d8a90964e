//! Tables, and the scopes of formulas that may read them.

use std::sync::Arc;

use ppum::formula::{Scope, ScopeError, Table, TableError, VARIABLES};

use crate::content::ObjectKind;
use crate::error::ReadError;
use crate::limits::MAX_TABLE_VALUES;
use crate::reader::{Extent, GroupReader, numbered};

/// The scopes in which formulas are read before the dataset is complete.
pub(super) struct Scopes {
    /// x and y.
    pub(super) plane: Scope,
    /// t, of weights.
    pub(super) weight: Scope,
}

impl Scopes {
    pub(super) fn new(tables: &[Arc<Table>]) -> Result<Self, ReadError> {
        let scope = |variables: &[&str]| Scope::new(variables)?.with_tables(tables);
        Self::of(scope).map_err(|error| ReadError::object("tables", error.to_string()))
    }

    fn of(scope: impl Fn(&[&str]) -> Result<Scope, ScopeError>) -> Result<Self, ScopeError> {
        scope(&VARIABLES)?;
        Ok(Self { plane: scope(&["x", "y"])?, weight: scope(&["t"])? })
    }
}

pub(super) fn tables(root: &GroupReader) -> Vec<Arc<Table>> {
    let mut left = MAX_TABLE_VALUES;
    let tables = numbered(root, "tables", |group| table(group, &mut left).map(Arc::new));
    tables.into_iter().flatten().collect()
}

/// A table, if there is nothing wrong with it.
fn table(group: &GroupReader, left: &mut usize) -> Option<Table> {
    let name: String = group.attribute("name");
    let knots = |name| group.array::<f64>(name, &[Extent::Any]);
    let (x, y) = (knots("x"), group.holds("y", ObjectKind::Dataset).then(|| knots("y")));
    let extent = |knots: &Option<Vec<f64>>| {
        knots.as_ref().map_or(Extent::Any, |knots| Extent::Is(knots.len() as u64))
    };
    let shape: Vec<Extent> = y.iter().chain([&x]).map(extent).collect();
    let values = group.array::<f64>("values", &shape)?;
    let Some(rest) = left.checked_sub(values.len()) else {
        let mistake = format!("the tables have more than {MAX_TABLE_VALUES} values together");
        group.error("values", mistake);
        return None;
    };
    *left = rest;
    let table = match y {
        Some(y) => Table::surface(&name, x?, y?, values),
        None => Table::curve(&name, x?, values),
    };
    table.map_err(|error| group.error(at_fault(&error), error.to_string())).ok()
}

/// The array that an error is about.
fn at_fault(error: &TableError) -> &'static str {
    match error {
        TableError::TooFewKnots { axis, .. }
        | TableError::KnotNotFinite { axis, .. }
        | TableError::NotIncreasing { axis, .. } => {
            if *axis == 'x' {
                "x"
            } else {
                "y"
            }
        }
        _ => "values",
    }
}
