//! The report of `ppum formula`, in the shape of its JSON.

use ppum::formula::{DerivativeError, Formula, FormulaJets, Kink, wgsl_prelude};
use ppum::weight::WeightFunction;
use serde::Serialize;

use super::point::FormulaPoint;
use super::subject::{DisplayedFormula, Of};
use crate::number::JsonNumber;

/// All formulas.
#[derive(Debug, Serialize)]
pub(super) struct FormulaReport {
    pub(super) formulas: Vec<FormulaFacts>,
    /// The functions that those of WGSL call.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) wgsl_prelude: Option<&'static str>,
}

/// A formula and what is known of it.
#[derive(Debug, Serialize)]
pub(super) struct FormulaFacts {
    pub(super) of: String,
    pub(super) name: Option<String>,
    pub(super) text: String,
    pub(super) parameters: Vec<FormulaParameter>,
    /// The variables its value depends on.
    pub(super) uses: Vec<String>,
    /// The value first, then its derivatives.
    pub(super) derivatives: Vec<Derivative>,
    /// Operations of the value; with first, with second derivatives.
    pub(super) operations: Vec<usize>,
    pub(super) kinks: Vec<ZeroSet>,
    pub(super) singularities: Vec<ZeroSet>,
    /// True if the origin of r and theta may be a singular point.
    pub(super) singular_at_origin: bool,
    /// True if it may jump where theta does.
    pub(super) jumps_with_theta: bool,
    /// For a formula of t: where in \[0, 1\] it is not smooth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) breakpoints: Option<Vec<f64>>,
    /// For a formula of t: why it is no weight function.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) not_a_weight: Option<String>,
    /// The function of WGSL.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) wgsl: Option<String>,
    /// The point of the values.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) at: Option<FormulaPoint>,
}

#[derive(Debug, Serialize)]
pub(super) struct FormulaParameter {
    pub(super) name: String,
    pub(super) value: JsonNumber,
}

/// A derivative as a formula.
#[derive(Debug, Serialize)]
pub(super) struct Derivative {
    /// The variables it is taken by; none for the value.
    pub(super) by: Vec<String>,
    pub(super) text: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) value: Option<JsonNumber>,
}

/// The points at which a formula is 0.
#[derive(Debug, Serialize)]
pub(super) struct ZeroSet {
    pub(super) zeros_of: String,
    /// \[a, b, c\] of a line a x + b y + c = 0.
    pub(super) line: Option<[f64; 3]>,
}

pub(super) fn parameters<'p>(
    parameters: impl Iterator<Item = (&'p str, f64)>,
) -> Vec<FormulaParameter> {
    parameters
        .map(|(name, value)| FormulaParameter { name: name.to_owned(), value: JsonNumber(value) })
        .collect()
}

impl FormulaReport {
    /// Everything about some formulas, with values if a point is given, and with WGSL if that
    /// is wanted.
    pub(super) fn new(
        subjects: &[DisplayedFormula],
        at: &[(String, f64)],
        wgsl: bool,
    ) -> anyhow::Result<Self> {
        let row = |subject: &DisplayedFormula| {
            let wgsl = wgsl.then(|| self::wgsl(subject)).transpose()?;
            Ok(FormulaFacts { wgsl, ..FormulaFacts::new(subject, at)? })
        };
        let formulas: anyhow::Result<_> = subjects.iter().map(row).collect();
        Ok(Self { formulas: formulas?, wgsl_prelude: wgsl.then(wgsl_prelude) })
    }
}

/// The function with all derivatives that are shown.
fn wgsl(subject: &DisplayedFormula) -> Result<String, DerivativeError> {
    let name = subject.name.as_deref().map_or(String::new(), |name| format!("_{name}"));
    let name: String = name.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
    let jets = FormulaJets::new(&[&subject.formula], subject.order())?;
    Ok(jets.wgsl(&format!("formula{name}")))
}

impl FormulaFacts {
    fn new(subject: &DisplayedFormula, at: &[(String, f64)]) -> anyhow::Result<Self> {
        let DisplayedFormula { of, name, formula, variables, .. } = subject;
        let derivatives = derivatives(formula, variables)?;
        let at = (!at.is_empty()).then(|| FormulaPoint::new(subject, at)).transpose()?;
        let shown = |(by, derivative): &(Vec<String>, Formula)| Derivative {
            by: by.clone(),
            text: derivative.normal_form(),
            value: at.as_ref().map(|at| JsonNumber(derivative.evaluate(&at.inputs))),
        };
        let is_weight = *of == Of::Weight;
        Ok(Self {
            of: of.name(),
            name: name.clone(),
            text: formula.text().to_owned(),
            parameters: parameters(
                subject.parameters.iter().map(|(n, value)| (n.as_str(), *value)),
            ),
            uses: uses(formula),
            derivatives: derivatives.iter().map(shown).collect(),
            operations: operations(formula, subject.order()),
            kinks: sets(formula.kinks()),
            singularities: sets(formula.singularities()),
            singular_at_origin: formula.singular_at_origin(),
            jumps_with_theta: formula.uses_branch(),
            breakpoints: is_weight.then(|| formula.breakpoints(0.0, 1.0)),
            not_a_weight: not_a_weight(formula).filter(|_| is_weight),
            wgsl: None,
            at,
        })
    }
}

/// The value, its gradient and its Hessian.
fn derivatives(
    formula: &Formula,
    variables: &[String],
) -> Result<Vec<(Vec<String>, Formula)>, DerivativeError> {
    let mut all = vec![(Vec::new(), formula.clone())];
    for variable in variables {
        all.push((vec![variable.clone()], formula.derivative(variable)?));
    }
    for (k, first) in variables.iter().enumerate() {
        for second in &variables[k..] {
            let derivative = all[1 + k].1.derivative(second)?;
            all.push((vec![first.clone(), second.clone()], derivative));
        }
    }
    Ok(all)
}

/// Operations of one evaluation, with no, with first and with second derivatives, up to an order.
fn operations(formula: &Formula, last: usize) -> Vec<usize> {
    let jets = (0..=last).map(|order| FormulaJets::new(&[formula], order));
    jets.map_while(Result::ok).map(|jets| jets.n_operations()).collect()
}

/// The names of the variables as one writes them.
fn uses(formula: &Formula) -> Vec<String> {
    let used = formula.scope().inputs().filter(|name| formula.uses(name));
    let mut names: Vec<_> = used
        .map(|name| if name.ends_with("(theta/2)") { "theta" } else { name }.to_owned())
        .collect();
    names.dedup();
    names
}

fn sets(kinks: Vec<Kink>) -> Vec<ZeroSet> {
    let set = |kink: &Kink| ZeroSet { zeros_of: kink.value.normal_form(), line: kink.line() };
    kinks.iter().map(set).collect()
}

fn not_a_weight(formula: &Formula) -> Option<String> {
    WeightFunction::formula(formula.text(), formula.scope()).err().map(|error| error.to_string())
}
