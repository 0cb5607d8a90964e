//! The variables a formula may use.

use std::sync::Arc;

use super::Table;
use super::ast::Ast;
use super::error::FormulaError;
use super::{library, lower};

/// The names a formula may use besides functions and constants.
///
/// - *Independent variables* are inputs of an evaluation; derivatives are taken with respect to them.
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
/// use ppum::formula::{Formula, Scope};
///
/// let scope = Scope::polar().with_parameter("lambda", 0.5).expect("a new name");
/// let f = Formula::parse("r^lambda * sin(lambda*theta)", &scope).expect("a formula");
/// let (x, y) = (0.0_f64, 4.0_f64);
/// let value = f.evaluate(&[x, y, x.hypot(y), y.atan2(x)]);
/// assert!((value - 2.0_f64.sqrt()).abs() < 1e-15);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Scope {
    independent: Vec<String>,
    dependent: Vec<Dependent>,
    parameters: Vec<(String, f64)>,
    tables: Arc<[Arc<Table>]>,
}

/// A dependent variable.
#[derive(Clone, Debug, PartialEq)]
struct Dependent {
    name: String,
    /// Its derivative with respect to each independent variable.
    rules: Vec<Ast>,
}

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
        /// What is wrong.
        #[source]
        error: FormulaError,
    },
}

/// What a name of the scope stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Meaning {
    /// A variable: its index among the inputs.
    Input(u32),
    /// A parameter.
    Value(f64),
    /// A table: its index.
    Table(u32),
}

impl Scope {
    /// A scope of independent variables.
    ///
    /// # Errors
    /// When a name is not one, or is taken.
    pub fn new(independent: &[&str]) -> Result<Self, ScopeError> {
        let empty = Self {
            independent: vec![],
            dependent: vec![],
            parameters: vec![],
            tables: Arc::default(),
        };
        independent.iter().try_fold(empty, |mut scope, name| {
            scope.check_name(name)?;
            scope.independent.push((*name).to_owned());
            Ok(scope)
        })
    }

    /// Inputs x, y.
    #[must_use]
    pub fn cartesian() -> Self {
        Self::new(&["x", "y"]).expect("x and y are names")
    }

    /// Inputs x, y, r, theta, where r = √(x² + y²) and θ is the polar angle on the branch that the
    /// caller chooses: ∂r = (x, y)/r, ∂θ = (−y, x)/r².
    #[must_use]
    pub fn polar() -> Self {
        // divided twice by r, since r² would underflow where r does not
        Self::cartesian()
            .with_dependent("r", &["x/r", "y/r"])
            .and_then(|scope| scope.with_dependent("theta", &["-(y/r)/r", "(x/r)/r"]))
            .expect("the rules are formulas")
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
    pub fn with_table(mut self, table: Arc<Table>) -> Result<Self, ScopeError> {
        self.check_name(table.name())?;
        self.tables = self.tables.iter().cloned().chain([table]).collect();
        Ok(self)
    }

    /// Adds an input that is a function of the independent variables. `rules` are its derivatives
    /// with respect to each of them, in their order, as formulas of this scope and of itself.
    ///
    /// # Errors
    /// When the name is not one or is taken, or a rule is missing or is no formula.
    pub fn with_dependent(mut self, name: &str, rules: &[&str]) -> Result<Self, ScopeError> {
        self.check_name(name)?;
        let (expected, given) = (self.independent.len(), rules.len());
        let name = name.to_owned();
        if given != expected {
            return Err(ScopeError::RuleCount { name, expected, given });
        }
        self.dependent.push(Dependent { name: name.clone(), rules: Vec::new() });
        let parsed: Result<Vec<Ast>, FormulaError> =
            rules.iter().map(|rule| lower::checked(rule, &self)).collect();
        match parsed {
            Ok(rules) => {
                let last = self.dependent.len() - 1;
                self.dependent[last].rules = rules;
                Ok(self)
            }
            Err(error) => Err(ScopeError::Rule { name, error }),
        }
    }

    /// Names of the inputs of an evaluation, in order.
    pub fn inputs(&self) -> impl Iterator<Item = &str> {
        let dependent = self.dependent.iter().map(|d| d.name.as_str());
        self.independent.iter().map(String::as_str).chain(dependent)
    }

    /// Names of the independent variables, in order.
    pub(super) fn independent(&self) -> &[String] {
        &self.independent
    }

    /// Number of inputs.
    pub(super) fn n_inputs(&self) -> usize {
        self.independent.len() + self.dependent.len()
    }

    /// The rules of an input's derivatives; `None` for an independent variable.
    pub(super) fn rules(&self, input: usize) -> Option<&[Ast]> {
        let dependent = input.checked_sub(self.independent.len())?;
        Some(&self.dependent[dependent].rules)
    }

    /// True if it differs from the other scope in its parameters at most.
    pub(super) fn has_variables_of(&self, other: &Self) -> bool {
        self.independent == other.independent
            && self.dependent == other.dependent
            && self.tables == other.tables
    }

    /// All names of values: inputs and parameters.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.inputs().chain(self.parameters.iter().map(|(name, _)| name.as_str()))
    }

    /// The tables, in the order in which they were given: formulas refer to them by index.
    pub(super) fn tables(&self) -> Arc<[Arc<Table>]> {
        Arc::clone(&self.tables)
    }

    /// Names of the tables, in order.
    pub(super) fn table_names(&self) -> impl Iterator<Item = &str> {
        self.tables.iter().map(|table| table.name())
    }

    /// What a name stands for.
    pub(super) fn meaning(&self, name: &str) -> Option<Meaning> {
        let input = (0..).zip(self.inputs()).find(|(_, known)| *known == name);
        if let Some((index, _)) = input {
            return Some(Meaning::Input(index));
        }
        if let Some((_, value)) = self.parameters.iter().find(|(known, _)| known == name) {
            return Some(Meaning::Value(*value));
        }
        (0..)
            .zip(self.table_names())
            .find(|(_, known)| *known == name)
            .map(|(i, _)| Meaning::Table(i))
    }

    fn check_name(&self, name: &str) -> Result<(), ScopeError> {
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
        assert_eq!(scope.inputs().collect::<Vec<_>>(), ["x", "y", "r", "theta"]);
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
