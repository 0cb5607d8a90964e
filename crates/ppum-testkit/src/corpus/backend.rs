//! Evaluators of formulas as the corpus sees them.

use ppum::formula::{Formula, FormulaJets};

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

/// Double precision at one point, all derivatives in one program: [`FormulaJets`].
#[derive(Debug, Default)]
pub struct Scalar {
    scratch: Vec<f64>,
}

impl Backend for Scalar {
    fn name(&self) -> &str {
        "scalar f64"
    }

    fn evaluate(&mut self, case: &Case) -> Outcome {
        let f = parse(case);
        let jets = jets(case, &f);
        let mut out = vec![0.0; jets.n_outputs()];
        jets.evaluate(&case.inputs, &mut self.scratch, &mut out);
        Outcome::Results(orders(case, &out))
    }
}

/// Value and derivatives in one program; of more than two variables the value.
pub(crate) fn jets(case: &Case, f: &Formula) -> FormulaJets {
    let order = if case.variables.len() > 2 { 0 } else { case.expected.len() - 1 };
    FormulaJets::new(&[f], order).unwrap_or_else(|error| panic!("{}: {error}", case.place))
}

/// The outputs of a [`FormulaJets`] order by order.
pub(crate) fn orders(case: &Case, mut out: &[f64]) -> Vec<Vec<f64>> {
    let n = case.variables.len();
    let counts = [1, n, n * (n + 1) / 2];
    let of_order = |count: usize| {
        let (now, later) = out.split_at_checked(count)?;
        out = later;
        Some(now.to_vec())
    };
    counts.into_iter().map_while(of_order).collect()
}

/// The formula of a case.
pub(crate) fn parse(case: &Case) -> Formula {
    Formula::parse(&case.formula, &case.scope)
        .unwrap_or_else(|error| panic!("{}: {}\n{error}", case.place, case.formula))
}
