//! Evaluators of formulas as the corpus sees them.

use ppum::formula::Formula;

use super::Case;

/// What an evaluator made of a case.
#[derive(Clone, Debug)]
pub enum Outcome {
    /// Value, gradient, Hessian, as in [`Case::expected`]; orders may be missing at the end.
    Results(Vec<Vec<f64>>),
    /// It cannot be asked, for this reason.
    Skipped(String),
}

/// An evaluator.
pub trait Backend {
    /// For messages.
    fn name(&self) -> &str;

    /// Evaluates a case, derivatives included.
    fn evaluate(&mut self, case: &Case) -> Outcome;
}

/// Double precision at one point, each derivative made by [`Formula::derivative`] as a formula of its own.
#[derive(Debug, Default)]
pub struct Derivatives {
    scratch: Vec<f64>,
}

impl Backend for Derivatives {
    fn name(&self) -> &str {
        "scalar, derivative by derivative"
    }

    fn evaluate(&mut self, case: &Case) -> Outcome {
        let f = parse(case);
        let by = |f: &Formula, variable: &String| {
            f.derivative(variable).unwrap_or_else(|error| panic!("{}: {error}", case.place))
        };
        let first: Vec<Formula> = case.variables.iter().map(|v| by(&f, v)).collect();
        let pairs = first
            .iter()
            .zip(0..)
            .flat_map(|(d, i)| case.variables[i..].iter().map(move |v| (d, v)));
        let second: Vec<Formula> = pairs.map(|(d, v)| by(d, v)).collect();
        let mut all = |formulas: &[Formula]| -> Vec<f64> {
            formulas.iter().map(|f| f.evaluate_with(&case.inputs, &mut self.scratch)).collect()
        };
        Outcome::Results(vec![all(&[f]), all(&first), all(&second)])
    }
}

/// The formula of a case.
pub(super) fn parse(case: &Case) -> Formula {
    Formula::parse(&case.formula, &case.scope)
        .unwrap_or_else(|error| panic!("{}: {}\n{error}", case.place, case.formula))
}
