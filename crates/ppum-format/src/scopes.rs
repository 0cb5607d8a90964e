//! The scopes of formulas that are read before the dataset is complete.

use std::sync::Arc;

use ppum::formula::{Scope, ScopeError, Table, VARIABLES};

use crate::error::ReadError;

/// The scopes in which formulas are read before the dataset is complete.
pub(crate) struct Scopes {
    /// x and y.
    pub(crate) plane: Scope,
    /// t, of weights.
    pub(crate) weight: Scope,
}

impl Scopes {
    pub(crate) fn new(tables: &[Arc<Table>]) -> Result<Self, ReadError> {
        let scope = |variables: &[&str]| Scope::new(variables)?.with_tables(tables);
        Self::of(scope).map_err(|error| ReadError::object("tables", error.to_string()))
    }

    fn of(scope: impl Fn(&[&str]) -> Result<Scope, ScopeError>) -> Result<Self, ScopeError> {
        scope(&VARIABLES)?;
        Ok(Self { plane: scope(&["x", "y"])?, weight: scope(&["t"])? })
    }
}
