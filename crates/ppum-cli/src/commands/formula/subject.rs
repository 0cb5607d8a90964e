//! The formulas that are meant, and what they are formulas of.

use std::path::PathBuf;
use std::str::FromStr;
use std::sync::Arc;

use anyhow::{bail, ensure};
use ppum::equation::{Equation, Material, StressState};
use ppum::formula::{Formula, Scope, ScopeError, Table};
use ppum::function::function_scope;
use ppum::library::{self, ELASTICITY, ENRICHMENTS, Entry, POISSON, WEIGHTS};
use ppum::quantity::{Quantity, QuantityFormula, Vocabulary};
use ppum::text::hint;

use crate::dataset::{field, open_step};
use crate::formula_text::FormulaText;

/// The kinds of formulas.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Of {
    /// x, y, r, theta.
    Plane,
    /// t = |ξ|.
    Weight,
    /// Displacements and stresses.
    Elasticity,
    /// The unknown of Poisson's equation.
    Poisson,
    /// The quantities of a dataset.
    File(PathBuf),
}

impl FromStr for Of {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Ok(match text {
            "plane" => Self::Plane,
            "weight" => Self::Weight,
            "elasticity" => Self::Elasticity,
            "poisson" => Self::Poisson,
            file if file == "-" || file.contains(['.', '/']) => Self::File(file.into()),
            other => {
                let hint = hint(other, ["plane", "weight", "elasticity", "poisson"]);
                return Err(format!(
                    "write plane, weight, elasticity, poisson or a dataset FILE.h5{hint}"
                ));
            }
        })
    }
}

impl Of {
    /// The word, or the file.
    pub(super) fn name(&self) -> String {
        match self {
            Self::Plane => "plane".into(),
            Self::Weight => "weight".into(),
            Self::Elasticity => "elasticity".into(),
            Self::Poisson => "poisson".into(),
            Self::File(path) => path.display().to_string(),
        }
    }
}

/// A formula to be shown.
#[derive(Debug)]
pub(super) struct DisplayedFormula {
    /// The kind of formula.
    pub(super) of: Of,
    /// Its name, if it has one.
    pub(super) name: Option<String>,
    pub(super) formula: Formula,
    pub(super) parameters: Vec<(String, f64)>,
    /// The variables that derivatives are taken with respect to.
    pub(super) variables: Vec<String>,
}

impl DisplayedFormula {
    fn new(of: &Of, name: Option<String>, formula: Formula, parameters: &[(String, f64)]) -> Self {
        let variables: Vec<&str> = match of {
            Of::Plane => vec!["x", "y"],
            Of::Weight => vec!["t"],
            // the derivatives of a field's components are numbers here, not functions
            _ => Vec::new(),
        };
        let variables = variables.into_iter().map(str::to_owned).collect();
        let (of, parameters) = (of.clone(), parameters.to_vec());
        Self { of, name, formula, parameters, variables }
    }

    /// The highest order of derivatives.
    pub(super) fn order(&self) -> usize {
        if self.variables.is_empty() { 0 } else { 2 }
    }
}

/// The question.
pub(super) struct FormulaQuestion<'a> {
    pub(super) given: FormulaText,
    pub(super) parameters: &'a [(String, f64)],
    pub(super) tables: Vec<Arc<Table>>,
}

impl FormulaQuestion<'_> {
    /// The formulas that are meant: one, or those of a name of the library.
    pub(super) fn subjects(&self, of: Option<&Of>) -> anyhow::Result<Vec<DisplayedFormula>> {
        let of = of.cloned().unwrap_or_else(|| self.kind());
        match &of {
            Of::Plane => self.functions(&of, library::enrichment),
            Of::Weight => self.functions(&of, library::weight),
            Of::Elasticity => {
                let (young, poisson, state) = (1.0, 0.3, StressState::PlaneStrain);
                let equation = Equation::elasticity(Material { young, poisson, state });
                self.built_in(&of, &equation, &["ux", "uy"])
            }
            Of::Poisson => self.built_in(&of, &Equation::poisson(1.0), &["u"]),
            Of::File(path) => {
                let dataset = open_step(path, None)?;
                self.quantity(&of, &Vocabulary::of(&field(&dataset, None)?))
            }
        }
    }

    /// The kind of a formula if nobody says so: a name of the library is what it is, other formulas
    /// are of the first kind that has their names.
    fn kind(&self) -> Of {
        let name = self.given.name().unwrap_or_default();
        match name.replace('-', "_").as_str() {
            _ if library::weight(name).is_some() => Of::Weight,
            _ if library::enrichment(name).is_some() => Of::Plane,
            name if ELASTICITY.iter().any(|(known, _)| *known == name) => Of::Elasticity,
            name if POISSON.iter().any(|(known, _)| *known == name) => Of::Poisson,
            // names that clash are to be told
            _ if function_scope(self.parameters, 0, &self.tables).is_err() => Of::Plane,
            _ => {
                let kinds = [Of::Plane, Of::Weight, Of::Elasticity, Of::Poisson];
                let fits = |of: &Of| self.subjects(Some(of)).is_ok();
                kinds.into_iter().find(fits).unwrap_or(Of::Plane)
            }
        }
    }

    /// A formula of the plane or of t, or those of a name.
    fn functions(
        &self,
        of: &Of,
        known: impl Fn(&str) -> Option<&'static Entry>,
    ) -> anyhow::Result<Vec<DisplayedFormula>> {
        let Some(entry) = self.given.name().and_then(known) else {
            let scope = self.scope(of, self.parameters)?;
            let formula = self
                .given
                .explain(Formula::parse(&self.given.text, &scope))
                .map_err(|error| self.or_entry(error))?;
            return Ok(vec![DisplayedFormula::new(of, None, formula, self.parameters)]);
        };
        let parameters = self.parameters_of(entry)?;
        let scope = self.scope(of, &parameters)?;
        let subject = |(k, text): (usize, &&str)| {
            let name = match entry.texts.len() {
                1 => entry.name.to_owned(),
                _ => format!("{} {}", entry.name, k + 1),
            };
            Ok(DisplayedFormula::new(of, Some(name), Formula::parse(text, &scope)?, &parameters))
        };
        entry.texts.iter().enumerate().map(subject).collect()
    }

    /// The error, with a name of the library that may have been meant.
    fn or_entry(&self, error: anyhow::Error) -> anyhow::Error {
        let name = self.given.name().unwrap_or_default();
        let hint = hint(name, ENRICHMENTS.iter().chain(&WEIGHTS).map(|entry| entry.name));
        if hint.is_empty() {
            return error;
        }
        error.context(format!("`{name}` is no name of the library{hint} and no formula"))
    }

    /// The names of a formula of the plane or of t.
    fn scope(&self, of: &Of, parameters: &[(String, f64)]) -> Result<Scope, ScopeError> {
        match of {
            Of::Weight => weight_scope(parameters, &self.tables),
            _ => function_scope(parameters, 0, &self.tables),
        }
    }

    /// The parameters of an entry, those that were given with their new values.
    fn parameters_of(&self, entry: &Entry) -> anyhow::Result<Vec<(String, f64)>> {
        let mut all: Vec<_> =
            entry.parameters.iter().map(|&(name, value)| (name.to_owned(), value)).collect();
        for (name, value) in self.parameters {
            match all.iter_mut().find(|(known, _)| known == name) {
                Some((_, default)) => *default = *value,
                None => bail!("--parameter {name}: `{}` has no such parameter", entry.name),
            }
        }
        Ok(all)
    }

    /// A quantity of the library.
    fn built_in(
        &self,
        of: &Of,
        equation: &Equation,
        components: &[&str],
    ) -> anyhow::Result<Vec<DisplayedFormula>> {
        let components: Vec<_> = components.iter().map(|&name| name.to_owned()).collect();
        let (tables, named) = (&[], &[]);
        self.quantity(of, &Vocabulary { equation, components: &components, tables, named })
    }

    /// A formula of quantities, or that of one.
    fn quantity(
        &self,
        of: &Of,
        vocabulary: &Vocabulary<'_>,
    ) -> anyhow::Result<Vec<DisplayedFormula>> {
        ensure!(
            self.parameters.is_empty(),
            "--parameter: formulas of quantities have none; write `let NAME = VALUE;` in the formula"
        );
        let tables: Vec<_> = vocabulary.tables.iter().chain(&self.tables).cloned().collect();
        let vocabulary = Vocabulary { tables: &tables, ..*vocabulary };
        let name = self.given.name().unwrap_or_default();
        let definition = vocabulary.definition(name);
        let text = definition.as_deref().unwrap_or(&self.given.text);
        let quantity = match QuantityFormula::new(text, &vocabulary) {
            Err(_)
                if Quantity::from_name(name, vocabulary.equation, vocabulary.components)
                    .is_ok() =>
            {
                bail!(
                    "`{name}` is made of more than the field's values and slopes; it has no formula"
                )
            }
            result => self.given.explain(result)?,
        };
        let name = definition.map(|_| name.to_owned());
        Ok(vec![DisplayedFormula::new(of, name, quantity.formula().clone(), &[])])
    }
}

/// The names that a weight may use.
fn weight_scope(parameters: &[(String, f64)], tables: &[Arc<Table>]) -> Result<Scope, ScopeError> {
    let scope = Scope::new(&["t"])?.with_tables(tables)?;
    let mut parameters = parameters.iter();
    parameters.try_fold(scope, |scope, (name, value)| scope.with_parameter(name, *value))
}
