//! Functions and weights replaced while looking.
//!
//! A dataset keeps its coefficients and gets another function: what would the field be with it? The
//! functions of a step are texts, so a field is compiled again in no time. [`Replacements`] are all
//! changes of one look: a part that is chosen, functions and the weight that are replaced.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::dataset::{Dataset, Step};
use crate::decompose::{FieldPart, PartError};
use crate::function::{Frame, Function, FunctionKind, NonsmoothPoints, Role, function_scope};
use crate::library::WEIGHTS;
use crate::text::hint;
use crate::weight::{WeightError, WeightFunction};
use ppum_formula::{Formula, FormulaError, Scope, ScopeError, Table};

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
    /// The text is neither a formula nor the name of a weight, but near to one.
    #[error("`{word}` is no weight of the library{hint} and no formula: {error}")]
    NoWeight {
        /// The text.
        word: String,
        /// The suggestion, see [`hint`].
        hint: String,
        /// The reason why it is no formula.
        #[source]
        error: Box<FormulaError>,
    },
    /// Patches that are elements have no weights.
    #[error("the patches are the elements of a mesh, which have no weights: leave the weight out")]
    Mesh,
    /// The dataset's tables or parameters have names that formulas cannot use.
    #[error(transparent)]
    Scope(#[from] ScopeError),
}

/// Changes of a dataset before anything is evaluated. Coefficients stay as they are. Parts are told
/// apart by the functions of the dataset, not by those that replace them.
///
/// ```
/// use ppum::decompose::FieldPart;
/// use ppum::replace::Replacements;
///
/// let what_if = Replacements {
///     part: Some(FieldPart::Smooth),
///     functions: vec![("westergaard 1".into(), "r".into())],
///     weight: Some("bump".into()),
/// };
/// # let _ = what_if;
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Replacements {
    /// The part of the step's first field that takes its place,
    /// see [`FieldData::part`](crate::dataset::FieldData::part). Given strains belong to the smooth
    /// part, so that the stresses of the parts of all kinds add up to those of the field.
    pub part: Option<FieldPart>,
    /// Functions by name or number, and formulas in their place, see [`Step::replace_function`].
    pub functions: Vec<(String, String)>,
    /// The weight, see [`Step::replace_weight`].
    pub weight: Option<String>,
}

/// A change that cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReplacementsError {
    /// The part.
    #[error("part: {0}")]
    Part(#[source] PartError),
    /// A function.
    #[error("function {which}: {error}")]
    Function {
        /// Index in [`Replacements::functions`].
        index: usize,
        /// The name or number asked for.
        which: String,
        /// The reason.
        #[source]
        error: Box<ReplaceError>,
    },
    /// The weight.
    #[error("weight: {0}")]
    Weight(#[source] ReplaceError),
}

impl Replacements {
    /// Makes all changes in a step of the dataset; none where there is no such step.
    ///
    /// # Errors
    /// The first change that cannot be made; those before it are made.
    pub fn apply(&self, dataset: &mut Dataset, step: usize) -> Result<(), ReplacementsError> {
        let Dataset { steps, tables, equation, .. } = dataset;
        let Some(step) = steps.get_mut(step) else { return Ok(()) };
        if let (Some(part), Some(field)) = (self.part, step.fields.first_mut()) {
            *field = field.part(part, &step.functions).map_err(ReplacementsError::Part)?;
            // σ = C ε − C ε⁰, and the constant must occur once in the sum of the parts
            if part != FieldPart::Smooth {
                equation.clear_eigenstrains();
            }
        }
        for (index, (which, text)) in self.functions.iter().enumerate() {
            step.replace_function(which, text, tables).map_err(|error| {
                let error = Box::new(error);
                ReplacementsError::Function { index, which: which.clone(), error }
            })?;
        }
        if let Some(text) = &self.weight {
            step.replace_weight(text, tables).map_err(ReplacementsError::Weight)?;
        }
        Ok(())
    }
}

impl Step {
    /// Indices of the functions that `which` calls: the one with this number, that with this name,
    /// or those with this name at all their places, `westergaard 1` standing for
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

    /// Gives another formula to the functions that `which` [calls](Self::functions_called). Each
    /// keeps its frame and its parameters; a function that was no formula gets one of world
    /// coordinates. Returns the indices of the functions. The step's coefficients stay as they are.
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
        let indices = self.check_function(which, text, tables)?;
        for &index in &indices {
            self.functions[index].kind.set_formula(text);
        }
        Ok(indices)
    }

    /// The functions that a text could replace, which stay as they are.
    ///
    /// # Errors
    /// As [`replace_function`](Self::replace_function).
    pub fn check_function(
        &self,
        which: &str,
        text: &str,
        tables: &[Arc<Table>],
    ) -> Result<Vec<usize>, ReplaceError> {
        let indices = self.functions_called(which);
        if indices.is_empty() {
            let stems: BTreeSet<_> = self.functions.iter().map(Function::stem).collect();
            let (which, hint) = (which.to_owned(), hint(which, stems.iter().copied()));
            let names: Vec<_> = stems.into_iter().map(|stem| format!("`{stem}`")).collect();
            return Err(ReplaceError::Unknown { which, hint, known: names.join(", ") });
        }
        for &index in &indices {
            let parameters = self.functions[index].kind.parameters();
            let scope = function_scope(parameters, self.cracks.len(), tables)?;
            Formula::parse(text, &scope)?;
        }
        Ok(indices)
    }

    /// Gives another weight to the partition of unity, so other φ_i: one of the
    /// [library](crate::library::WEIGHTS), or a formula of t. Coefficients stay as they are.
    ///
    /// # Errors
    /// A text that is neither, or a mesh; nothing has changed then.
    pub fn replace_weight(
        &mut self,
        text: &str,
        tables: &[Arc<Table>],
    ) -> Result<(), ReplaceError> {
        let weight = weight_of(text, tables)?;
        self.partition.boxes_mut().ok_or(ReplaceError::Mesh)?.weight = weight;
        Ok(())
    }
}

/// The weight that a text means: one of the [library](crate::library::WEIGHTS), or a formula of t.
///
/// # Errors
/// A text that is neither.
pub fn weight_of(text: &str, tables: &[Arc<Table>]) -> Result<WeightFunction, ReplaceError> {
    match WeightFunction::from_library(text.trim()) {
        Some(weight) => Ok(weight),
        None => WeightFunction::formula(text, &Scope::new(&["t"])?.with_tables(tables)?)
            .map_err(|error| no_weight(text.trim(), error)),
    }
}

/// The error of a text that is no weight, with the weight of the library that may have been meant.
fn no_weight(text: &str, error: WeightError) -> ReplaceError {
    let hint = hint(text, WEIGHTS.iter().map(|entry| entry.name));
    match error {
        WeightError::Formula(error) if !hint.is_empty() => {
            ReplaceError::NoWeight { word: text.to_owned(), hint, error: Box::new(error) }
        }
        error => error.into(),
    }
}

/// The mark in a function's name before its place.
const PLACES: [&str; 4] = [" of crack ", " of patch ", " at [", " along ["];

impl Function {
    /// The name without the place: `westergaard 1` of `westergaard 1 of crack 0 end`. Functions
    /// that differ in their places only have the same stem.
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
            _ => &[],
        }
    }

    /// Changes the text of a formula, and drops the role and the declarations of the old one.
    fn set_formula(&mut self, new: &str) {
        match self {
            Self::Formula { text, declared, role, .. } => {
                new.clone_into(text);
                (*declared, *role) = (NonsmoothPoints::default(), Role::User);
            }
            _ => {
                *self = Self::formula(new, Frame::World);
            }
        }
    }
}
