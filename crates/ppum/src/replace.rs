//! Functions and weights replaced while looking.
//!
//! A dataset keeps its coefficients and gets another function: what would the field be with it? The
//! functions of a step are texts, so a field is compiled anew in no time.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::dataset::Step;
use crate::formula::{Formula, FormulaError, Scope, ScopeError, Table};
use crate::function::{Declared, Frame, Function, FunctionKind, function_scope};
use crate::text::hint;
use crate::weight::{WeightError, WeightFunction};

/// A text that cannot take the place of a function or of the weight.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReplaceError {
    /// No such function.
    #[error("there is no function `{which}`{hint}; there are {known}, or their numbers from 0")]
    Unknown {
        /// The name or number asked for.
        which: String,
        /// A suggestion, if a known name is similar, see [`hint`].
        hint: String,
        /// Names of all functions.
        known: String,
    },
    /// The text is no formula of the function's frame.
    #[error("{0}")]
    Formula(#[from] FormulaError),
    /// The text is no weight.
    #[error("{0}")]
    Weight(#[from] WeightError),
    /// The dataset's tables or parameters have names that formulas cannot use.
    #[error(transparent)]
    Scope(#[from] ScopeError),
}

impl Step {
    /// Indices of the functions that `which` calls: the one with this number, that with this name, or
    /// those with this name at all their places, `westergaard 1` standing for
    /// `westergaard 1 of crack 0 end` and its like.
    #[must_use]
    pub fn functions_called(&self, which: &str) -> Vec<usize> {
        let all = || self.functions.iter().enumerate();
        if let Ok(number) = which.parse() {
            return all().map(|(index, _)| index).filter(|&index| index == number).collect();
        }
        let called = |name: &dyn Fn(&Function) -> bool| -> Vec<usize> {
            all().filter(|(_, function)| name(function)).map(|(index, _)| index).collect()
        };
        match called(&|function| function.name == which) {
            none if none.is_empty() => called(&|function| function.stem() == which),
            exact => exact,
        }
    }

    /// Gives another formula to the functions that `which` [calls](Self::functions_called). Each keeps
    /// its frame and its parameters; a function that was no formula gets one of world coordinates.
    /// Returns the indices of the functions. The step's coefficients stay as they are.
    ///
    /// # Errors
    /// No such function; a text that is no formula of the frame, the parameters, the sides of the
    /// step's cracks and the tables. Nothing has changed then.
    pub fn replace_function(
        &mut self,
        which: &str,
        text: &str,
        tables: &[Arc<Table>],
    ) -> Result<Vec<usize>, ReplaceError> {
        let indices = self.functions_called(which);
        if indices.is_empty() {
            let stems: BTreeSet<_> = self.functions.iter().map(Function::stem).collect();
            let (which, hint) = (which.to_owned(), hint(which, stems.iter().copied()));
            let known = stems.into_iter().map(|stem| format!("`{stem}`")).collect::<Vec<_>>();
            let known = known.join(", ");
            return Err(ReplaceError::Unknown { which, hint, known });
        }
        for &index in &indices {
            let parameters = self.functions[index].kind.parameters();
            let scope = function_scope(parameters, self.cracks.len(), tables)?;
            Formula::parse(text, &scope)?;
        }
        for &index in &indices {
            self.functions[index].kind.set_formula(text);
        }
        Ok(indices)
    }

    /// Gives another weight to the partition of unity, so other φ_i: one of the
    /// [library](crate::library::WEIGHTS), or a formula of t. Coefficients stay as they are.
    ///
    /// # Errors
    /// A text that is neither; nothing has changed then.
    pub fn replace_weight(
        &mut self,
        text: &str,
        tables: &[Arc<Table>],
    ) -> Result<(), ReplaceError> {
        self.partition.weight = match WeightFunction::from_library(text.trim()) {
            Some(weight) => weight,
            None => WeightFunction::formula(text, &Scope::new(&["t"])?.with_tables(tables)?)?,
        };
        Ok(())
    }
}

/// The mark in a function's name before its place.
const PLACES: [&str; 3] = [" of crack ", " at [", " along ["];

impl Function {
    /// The name without the place: `westergaard 1` of `westergaard 1 of crack 0 end`. Functions that
    /// differ in their places only have the same stem.
    #[must_use]
    pub fn stem(&self) -> &str {
        let ends = PLACES.iter().filter_map(|place| self.name.find(place));
        &self.name[..ends.min().unwrap_or(self.name.len())]
    }
}

impl FunctionKind {
    /// The parameters of a formula.
    fn parameters(&self) -> &[(String, f64)] {
        match self {
            Self::Formula { parameters, .. } => parameters,
            Self::One | Self::Side { .. } => &[],
        }
    }

    /// Changes the text of a formula. What was declared of the old one holds no more.
    fn set_formula(&mut self, new: &str) {
        match self {
            Self::Formula { text, declared, .. } => {
                new.clone_into(text);
                *declared = Declared::default();
            }
            Self::One | Self::Side { .. } => *self = Self::formula(new, Frame::World),
        }
    }
}
