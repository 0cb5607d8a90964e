//! Errors are data that any program can carry from thread to thread.

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

ppum_testkit::errors_cross_threads!(
    Cancelled,
    CheckError,
    CoverError,
    DerivativeError,
    FieldError,
    FormulaError,
    FunctionError,
    PartError,
    QuantityError,
    QuantityFormulaError,
    ReplaceError,
    ScopeError,
    TableError,
    WeightError,
    WgslError,
);
