//! The variables a formula may use.

use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;

use crate::error::FormulaError;
use crate::language::ast::Ast;
use crate::library;
use crate::table::Table;

/// The variables of a dataset's formulas. No table may be called like one of them: it could not be
/// read where the variable is known.
pub const VARIABLES: [&str; 5] = ["x", "y", "r", "theta", "t"];

/// The names a formula may use besides functions and constants.
///
/// - *Independent variables* are inputs of an evaluation; derivatives are taken with respect
///   to them.
/// - *Dependent variables* are inputs too, because the caller knows them best, but functions of the
///   independent ones: each comes with its derivatives as formulas. The polar angle is the model:
///   which branch it is on depends on the crack, its derivatives do not.
/// - *Parameters* are constants with a name.
/// - *Tables* are data, used by `table(name, x)`.
///
/// The inputs of an evaluation are the independent, then the dependent variables, in the order in
/// which they were given.
///
/// ```
/// use ppum_formula::{Formula, Scope};
///
/// let scope = Scope::polar().with_parameter("lambda", 0.5).expect("a new name");
/// let f = Formula::parse("r^lambda * sin(lambda*theta)", &scope).expect("a formula");
/// let (x, y) = (0.0_f64, 4.0_f64);
/// let theta = y.atan2(x);
/// let value = f.evaluate(&[x, y, x.hypot(y), theta, (theta / 2.0).cos(), (theta / 2.0).sin()]);
/// assert!((value - 2.0_f64.sqrt()).abs() < 1e-15);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scope {
    pub(super) independent: Vec<String>,
    pub(super) dependent: Vec<Dependent>,
    pub(super) defined: Arc<[DefinedFunction]>,
    parameters: Vec<(String, f64)>,
    tables: Arc<[Arc<Table>]>,
    /// The dependent variables that are sides of cracks: they follow each other.
    pub(super) sides: Range<usize>,
}

/// A dependent variable.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Dependent {
    pub(super) name: String,
    /// Its derivative with respect to each independent variable.
    pub(super) rules: Arc<[Ast]>,
}

/// A function of the inputs whose derivatives have rules of their own, better than those of its
/// definition: fewer operations, no cancellation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct DefinedFunction {
    /// The text that stands for it.
    pub(super) name: &'static str,
    pub(super) definition: Ast,
    /// Its derivative with respect to each independent variable.
    pub(super) rules: Arc<[Ast]>,
}

pub(super) const COS_HALF: &str = "cos(theta/2)";
pub(super) const SIN_HALF: &str = "sin(theta/2)";

/// A name or a rule that a [`Scope`] cannot take.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ScopeError {
    /// Not a name.
    #[error("`{name}` is not a name; names are letters, digits and `_`, no digit first")]
    InvalidName {
        /// The text.
        name: String,
    },
    /// The scope or the language has the name already.
    #[error("the name `{name}` already has a meaning in formulas; choose another")]
    NameTaken {
        /// The name.
        name: String,
    },
    /// The number of rules differs from that of the independent variables.
    #[error(
        "`{name}` has {given} derivative rules, one for each of {expected} variables is needed"
    )]
    RuleCount {
        /// The dependent variable.
        name: String,
        /// Independent variables.
        expected: usize,
        /// Rules.
        given: usize,
    },
    /// A rule is no formula.
    #[error("in a derivative rule of `{name}`: {error}")]
    Rule {
        /// The dependent variable.
        name: String,
        /// The error.
        #[source]
        error: FormulaError,
    },
}

/// The meaning of a name of the scope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NameMeaning {
    /// A variable: its index among the inputs.
    Input(u32),
    /// A parameter.
    Value(f64),
    /// A table: its index.
    Table(u32),
}

impl Dependent {
    pub(super) fn without_rules(name: &str) -> Self {
        Self { name: name.to_owned(), rules: Arc::default() }
    }
}

impl Scope {
    /// A scope of independent variables.
    ///
    /// # Errors
    /// When a name is not one, or is taken.
    pub fn new(independent: &[&str]) -> Result<Self, ScopeError> {
        let mut scope = Self::default();
        for name in independent {
            scope.check_name(name)?;
            scope.independent.push((*name).to_owned());
        }
        Ok(scope)
    }

    /// Inputs x, y.
    #[must_use]
    pub fn cartesian() -> Self {
        Self::new(&["x", "y"]).expect("x and y are names")
    }

    /// Adds a named constant.
    ///
    /// # Errors
    /// When the name is not one, or is taken.
    pub fn with_parameter(mut self, name: &str, value: f64) -> Result<Self, ScopeError> {
        self.check_name(name)?;
        self.parameters.push((name.to_owned(), value));
        Ok(self)
    }

    /// Adds a table.
    ///
    /// # Errors
    /// When its name is not one, or is taken.
    pub fn with_table(self, table: Arc<Table>) -> Result<Self, ScopeError> {
        self.with_tables(&[table])
    }

    /// Adds tables.
    ///
    /// # Errors
    /// When the name of one is no name, or is taken.
    pub fn with_tables(mut self, tables: &[Arc<Table>]) -> Result<Self, ScopeError> {
        let mut names = BTreeSet::new();
        for table in tables {
            self.check_name(table.name())?;
            if !names.insert(table.name()) {
                return Err(ScopeError::NameTaken { name: table.name().to_owned() });
            }
        }
        self.tables = self.tables.iter().chain(tables).cloned().collect();
        Ok(self)
    }

    /// Names of the inputs of an evaluation, in order.
    pub fn inputs(&self) -> impl Iterator<Item = &str> {
        let dependent = self.dependent.iter().map(|d| d.name.as_str());
        self.independent.iter().map(String::as_str).chain(dependent)
    }

    /// Names of the independent variables, in order.
    pub(crate) fn independent(&self) -> &[String] {
        &self.independent
    }

    /// Number of inputs.
    pub(crate) fn n_inputs(&self) -> usize {
        self.independent.len() + self.dependent.len()
    }

    /// The rules of an input's derivatives; `None` for an independent variable.
    pub(crate) fn rules(&self, input: usize) -> Option<&[Ast]> {
        let dependent = input.checked_sub(self.independent.len())?;
        Some(&self.dependent[dependent].rules)
    }

    /// Number of cracks whose sides are inputs.
    pub(crate) fn n_sides(&self) -> usize {
        self.sides.len()
    }

    /// Indices of the inputs cos(θ/2) and sin(θ/2), if there are any.
    pub(crate) fn half_angles(&self) -> Option<[u32; 2]> {
        Some([self.input(COS_HALF)?, self.input(SIN_HALF)?])
    }

    /// Index of an input.
    pub(crate) fn input(&self, name: &str) -> Option<u32> {
        let first = self.independent.len() + self.sides.start;
        // there may be many sides, and each name in a formula is looked up
        let (before, after) = (first, first + self.sides.len());
        let at = |index: &usize| self.input_name(*index) == name;
        let mut others = (0..before).chain(after..self.n_inputs());
        let found = match side_number(name) {
            Some(k) => (first..after).nth(k).filter(at),
            None => others.find(at),
        };
        found.map(|index| index as u32)
    }

    /// Name of an input by its index.
    fn input_name(&self, index: usize) -> &str {
        match index.checked_sub(self.independent.len()) {
            Some(dependent) => &self.dependent[dependent].name,
            None => &self.independent[index],
        }
    }

    /// The text that stands for a function of [`Scope::definitions`].
    pub(crate) fn defined_name(&self, index: usize) -> &'static str {
        self.defined[index].name
    }

    /// The rules of the derivatives of a function of [`Scope::definitions`].
    pub(crate) fn defined_rules(&self, index: usize) -> &[Ast] {
        &self.defined[index].rules
    }

    /// True if it differs from the other scope in its parameters at most.
    pub(crate) fn has_variables_of(&self, other: &Self) -> bool {
        self.independent == other.independent
            && self.dependent == other.dependent
            && self.tables == other.tables
    }

    /// All names of values: inputs and parameters.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.inputs().chain(self.parameters.iter().map(|(name, _)| name.as_str()))
    }

    /// The tables, in the order in which they were given: formulas refer to them by index.
    pub(crate) fn tables(&self) -> Arc<[Arc<Table>]> {
        Arc::clone(&self.tables)
    }

    /// Names of the tables, in order.
    pub(crate) fn table_names(&self) -> impl Iterator<Item = &str> {
        self.tables.iter().map(|table| table.name())
    }

    /// The meaning of a name.
    pub(crate) fn meaning(&self, name: &str) -> Option<NameMeaning> {
        if let Some(index) = self.input(name) {
            return Some(NameMeaning::Input(index));
        }
        if let Some((_, value)) = self.parameters.iter().find(|(known, _)| known == name) {
            return Some(NameMeaning::Value(*value));
        }
        (0..)
            .zip(self.table_names())
            .find(|(_, known)| *known == name)
            .map(|(i, _)| NameMeaning::Table(i))
    }

    pub(super) fn check_name(&self, name: &str) -> Result<(), ScopeError> {
        let letter = |c: char| c.is_ascii_alphabetic() || c == '_';
        let named =
            name.starts_with(letter) && name.chars().all(|c| letter(c) || c.is_ascii_digit());
        if !named {
            return Err(ScopeError::InvalidName { name: name.to_owned() });
        }
        if library::is_reserved(name) || self.meaning(name).is_some() {
            return Err(ScopeError::NameTaken { name: name.to_owned() });
        }
        Ok(())
    }
}

/// k of `side(k)`.
fn side_number(name: &str) -> Option<usize> {
    name.strip_prefix("side(")?.strip_suffix(')')?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_must_be_new_and_names() {
        let taken = |name: &str| ScopeError::NameTaken { name: name.to_owned() };
        for name in ["x", "theta", "pi", "e", "sin", "let", "if"] {
            assert_eq!(Scope::polar().with_parameter(name, 1.0), Err(taken(name)));
        }
        for name in ["", "1a", "a b", "ä", "a-b"] {
            let invalid = ScopeError::InvalidName { name: name.to_owned() };
            assert_eq!(Scope::polar().with_parameter(name, 1.0), Err(invalid));
        }
        assert_eq!(Scope::new(&["t", "t"]), Err(taken("t")));
    }

    #[test]
    fn inputs_in_order() {
        let scope = Scope::polar().with_parameter("a", 2.0).expect("new");
        assert_eq!(
            scope.inputs().collect::<Vec<_>>(),
            ["x", "y", "r", "theta", "cos(theta/2)", "sin(theta/2)"]
        );
    }

    #[test]
    fn rules_are_checked() {
        let missing = Scope::cartesian().with_dependent("d", &["1"]);
        let name = "d".to_owned();
        assert_eq!(missing, Err(ScopeError::RuleCount { name, expected: 2, given: 1 }));
        let faulty = Scope::cartesian().with_dependent("d", &["1", "x < y"]);
        assert!(matches!(faulty, Err(ScopeError::Rule { .. })));
    }
}
