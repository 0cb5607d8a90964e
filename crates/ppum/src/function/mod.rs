//! The function table: the f_b of function × polynomial.

mod anchored;
mod formulas;
mod indicator;
mod kinds;
mod table;
mod westergaard;

pub use crate::library::WESTERGAARD;
pub use formulas::GROUP;
pub use indicator::{Cut, CutBranch};
pub use kinds::{Frame, Function, FunctionKind, NonsmoothPoints, Role};
pub(crate) use table::LevelUse;
pub use table::{
    CompileError, FunctionError, FunctionTable, LocalFunctions, Slot, at_tip, function_scope,
    native,
};
pub use westergaard::westergaard;
