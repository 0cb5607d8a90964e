//! Elementary functions of the texts over ranges of their argument.

use ppum::formula::{Formula, FormulaJets, Scope};

use crate::random::Random;

/// A function of `a` over a range.
#[derive(Clone, Copy, Debug)]
pub struct Elementary {
    /// Its formula.
    pub text: &'static str,
    low: f64,
    high: f64,
    /// The error that is allowed where the function is small.
    absolute: f64,
}

const fn over(text: &'static str, [low, high]: [f64; 2], absolute: f64) -> Elementary {
    Elementary { text, low, high, absolute }
}

/// Functions wherever they are finite. Far angles are reduced to 3e-9 of a quarter turn, near ones
/// to a rounding of the third part of their π/2.
pub const ELEMENTARY: [Elementary; 21] = [
    over("exp(a)", [-87.3, 88.7], 0.0),
    over("exp(a)", [-1.0, 1.0], 0.0),
    over("sinh(a)", [-89.4, 89.4], 0.0),
    over("sinh(a)", [-2.0, 2.0], 0.0),
    over("cosh(a)", [-89.4, 89.4], 0.0),
    over("tanh(a)", [-12.0, 12.0], 0.0),
    over("tanh(a)", [-1.0, 1.0], 0.0),
    over("asin(a)", [-1.0, 1.0], 0.0),
    over("acos(a)", [-1.0, 1.0], 0.0),
    over("atan(a)", [-5.0, 5.0], 0.0),
    over("atan(a)", [-1e6, 1e6], 0.0),
    over("log(a)", [0.5, 2.0], 0.0),
    over("log(a)", [1e-30, 3e38], 0.0),
    over("log10(a)", [0.9, 1.1], 0.0),
    over("cbrt(a)", [-20.0, 20.0], 0.0),
    over("sin(a)", [-7.0, 7.0], 1e-9),
    over("cos(a)", [-7.0, 7.0], 1e-9),
    over("sin(a)", [-9000.0, 9000.0], 5e-9),
    over("cos(a)", [-1e6, 1e6], 5e-9),
    over("sin(a)", [-1e12, 1e12], 5e-9),
    over("cos(a)", [-3e38, 3e38], 5e-9),
];

impl Elementary {
    /// The function and its derivatives up to an order.
    ///
    /// # Panics
    /// When the text is not a formula.
    #[must_use]
    pub fn jets(&self, order: usize) -> FormulaJets {
        let scope = Scope::new(&["a"]).expect("a name");
        let formula = Formula::parse(self.text, &scope).expect("a formula");
        FormulaJets::new(&[&formula], order).expect("one variable")
    }

    /// Random arguments.
    #[must_use]
    pub fn arguments(&self, n: usize) -> Vec<f32> {
        let mut random = Random(11);
        (0..n).map(|_| random.between(self.low, self.high) as f32).collect()
    }

    /// Checks a value: right to four units of the last place.
    ///
    /// # Panics
    /// When it is not.
    #[track_caller]
    pub fn check(&self, a: f32, found: f32) {
        let mut exact = [0.0];
        self.jets(0).evaluate(&[f64::from(a)], &mut Vec::new(), &mut exact);
        let limit = 4.0 * f64::from(f32::EPSILON) * exact[0].abs() + self.absolute;
        let error = (f64::from(found) - exact[0]).abs();
        assert!(error <= limit, "{} at {a:e}: {found:e}, not {:e}", self.text, exact[0]);
    }
}
