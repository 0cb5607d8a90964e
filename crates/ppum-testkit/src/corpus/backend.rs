//! Evaluators of formulas as the corpus sees them.

use ppum::formula::{BlockScratch, Formula, FormulaJets};
use ppum::real::LaneNumber as Number;

use super::cases::FormulaCase;

/// Value, gradient, Hessian of a case as in [`FormulaCase::expected`], where orders may be missing
/// at the end; or why its evaluator cannot be asked.
pub type CaseResult = Result<Vec<Vec<f64>>, String>;

/// Double precision at one point, each derivative made by [`Formula::derivative`] as a formula of
/// its own.
///
/// # Panics
/// When a derivative cannot be made.
pub fn derivative_formulas() -> impl FnMut(&FormulaCase) -> CaseResult {
    let mut scratch = Vec::new();
    move |case| {
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
            formulas.iter().map(|f| f.evaluate_with(&case.inputs, &mut scratch)).collect()
        };
        Ok(vec![all(&[f]), all(&first), all(&second)])
    }
}

/// Double precision at one point, all derivatives in one program: [`FormulaJets`].
pub fn scalar_jets() -> impl FnMut(&FormulaCase) -> CaseResult {
    let mut scratch = Vec::new();
    move |case| {
        let jets = jets(case, &parse(case));
        let mut out = vec![0.0; jets.n_outputs()];
        jets.evaluate(&case.inputs, &mut scratch, &mut out);
        Ok(orders(case, &out))
    }
}

/// The places of the case's point: first, last, and between, in different lanes of vectors of up
/// to 16.
const PLACES: [usize; 5] = [0, 7, 16, 31, 63];

/// Blocks of points on lanes, in the precision of `T`.
///
/// The case's point stands at several places of a block, other numbers and NaN between them: its
/// results must not depend on where it stands.
///
/// # Panics
/// When they do.
pub fn lane_blocks<T: Number>() -> impl FnMut(&FormulaCase) -> CaseResult {
    let mut scratch = BlockScratch::default();
    move |case| {
        let jets = jets(case, &parse(case));
        let mut block = jets.block::<T>(&mut scratch);
        for (index, &input) in case.inputs.iter().enumerate() {
            fill(block.input(index), input);
        }
        block.run();
        let at = |place: usize| -> Vec<f64> {
            (0..jets.n_outputs()).map(|k| block.output(k)[place].to_f64()).collect()
        };
        let first = at(PLACES[0]);
        for place in PLACES {
            let here = at(place);
            let equal = here.iter().zip(&first).all(|(&a, &b)| same(a, b));
            assert!(equal, "{}: {here:?} at {place}, not {first:?}", case.place);
        }
        Ok(orders(case, &first))
    }
}

/// Writes a number to [`PLACES`], and others between them.
fn fill<T: Number>(to: &mut [T], input: f64) {
    for (k, to) in to.iter_mut().enumerate() {
        let other = if k % 3 == 0 { f64::NAN } else { input * 1.25 + k as f64 };
        *to = T::from_f64(if PLACES.contains(&k) { input } else { other });
    }
}

/// Tests whether two numbers agree to the last bit, or are both NaN.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// Value and derivatives in one program; of more than two variables the value.
///
/// # Panics
/// When it cannot be compiled.
#[must_use]
pub fn jets(case: &FormulaCase, f: &Formula) -> FormulaJets {
    let order = if case.variables.len() > 2 { 0 } else { case.expected.len() - 1 };
    FormulaJets::new(&[f], order).unwrap_or_else(|error| panic!("{}: {error}", case.place))
}

/// The outputs of a [`FormulaJets`] order by order.
#[must_use]
pub fn orders(case: &FormulaCase, mut out: &[f64]) -> Vec<Vec<f64>> {
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
///
/// # Panics
/// When it does not parse.
#[must_use]
pub fn parse(case: &FormulaCase) -> Formula {
    Formula::parse(&case.formula, &case.scope)
        .unwrap_or_else(|error| panic!("{}: {}\n{error}", case.place, case.formula))
}
