//! The names that a problem's formulas may use.

use std::sync::Arc;

use ppum::dataset::Equation;
use ppum::formula::{Scope, ScopeError, Table};
use ppum::function::function_scope;
use ppum::quantity::QuantityFormulaError;

use super::quantities;

/// Makes sure that all formulas of a problem may use these tables.
pub(crate) fn check(tables: &[Arc<Table>], equation: &Equation) -> Result<(), ScopeError> {
    function_scope(&[], 0, tables)?;
    weight(tables)?;
    match quantities::parse("0", equation, tables, &[]) {
        Err(QuantityFormulaError::Scope(error)) => Err(error),
        _ => Ok(()),
    }
}

/// Names of a formula of position, and the tables.
pub(crate) fn position(tables: &[Arc<Table>]) -> Result<Scope, ScopeError> {
    Scope::cartesian().with_tables(tables)
}

/// Names of a toughness: the position, and the direction of a new path.
pub(crate) fn toughness(tables: &[Arc<Table>]) -> Result<Scope, ScopeError> {
    Scope::new(&["x", "y", DIRECTION])?.with_tables(tables)
}

/// The angle of a new path from the x axis, in radians.
pub(crate) const DIRECTION: &str = "direction";

/// Names of a weight function.
pub(crate) fn weight(tables: &[Arc<Table>]) -> Result<Scope, ScopeError> {
    Scope::new(&["t"])?.with_tables(tables)
}
