//! Errors are data that any program can carry from thread to thread.

use std::error::Error;

use ppum::check::CheckError;
use ppum::cover::CoverError;
use ppum::decompose::PartError;
use ppum::field::FieldError;
use ppum::formula::{DerivativeError, FormulaError, ScopeError, TableError, WgslError};
use ppum::function::FunctionError;
use ppum::progress::Cancelled;
use ppum::quantity::{QuantityError, QuantityFormulaError};
use ppum::replace::ReplaceError;
use ppum::weight::WeightError;

#[test]
fn errors_cross_threads() {
    fn check<E: Error + Send + Sync + 'static>() {}
    check::<Cancelled>();
    check::<CheckError>();
    check::<CoverError>();
    check::<DerivativeError>();
    check::<FieldError>();
    check::<FormulaError>();
    check::<FunctionError>();
    check::<PartError>();
    check::<QuantityError>();
    check::<QuantityFormulaError>();
    check::<ReplaceError>();
    check::<ScopeError>();
    check::<TableError>();
    check::<WeightError>();
    check::<WgslError>();
}
