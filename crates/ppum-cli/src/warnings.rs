//! Warnings of the solver as the commands show them.

use ppum::dataset::Warning;
use serde::Serialize;

use crate::number::Number;
use crate::output::tell;

/// A warning about a step.
#[derive(Debug, Serialize)]
pub(crate) struct WarningRow {
    step: usize,
    pub(crate) kind: String,
    at: Option<[f64; 2]>,
    value: Number,
    limit: Number,
    message: String,
}

/// The warnings about step number `step`.
pub(crate) fn rows(step: usize, warnings: &[Warning]) -> Vec<WarningRow> {
    let row = |warning: &Warning| {
        let Warning { kind, at, value, limit, message } = warning.clone();
        let (at, value, limit) = (at.map(Into::into), Number(value), Number(limit));
        WarningRow { step, kind, at, value, limit, message }
    };
    warnings.iter().map(row).collect()
}

/// Writes warnings to standard error.
pub(crate) fn warn(warnings: &[WarningRow]) {
    for warning in warnings {
        tell(&format!("warning: {}", warning.message));
    }
}

/// The same of several steps of a series, which are named.
pub(crate) fn warn_of_steps(warnings: &[WarningRow]) {
    for warning in warnings {
        tell(&format!("warning: step {}: {}", warning.step, warning.message));
    }
}

impl WarningRow {
    /// The finding and its remedy.
    pub(crate) fn message(&self) -> &str {
        &self.message
    }
}
