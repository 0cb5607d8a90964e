//! Lines and curves between which a formula is smooth.

use crate::quadrature::zero;
use ppum::formula::{Formula, Kink};
use std::f64::consts::PI;

/// Highest degree of a piecewise polynomial that is seen to be one.
const POLYNOMIAL: usize = 3;

/// Most lines and curves between which a function is taken for a polynomial on every piece; one
/// with more, a spline of many knots, is probed.
const MOST_SETS: usize = 64;

/// Angles among which zeros of functions of θ are looked for.
const ANGLES: usize = 720;

/// A formula as quadrature sees it.
pub(super) struct SmoothPieces {
    /// Lines and curves between which it is smooth.
    pub(super) sets: Vec<Kink>,
    /// Its degree, if it is a polynomial of x and y on every piece between them.
    pub(super) degree: Option<usize>,
}

impl SmoothPieces {
    pub(super) fn new(formula: &Formula) -> Self {
        // The origin of a polar frame is no curve.
        let singular = formula.singularities().into_iter().filter(|set| set.value.text() != "r");
        let mut sets: Vec<_> = formula.kinks().into_iter().chain(singular).collect();
        let Some(polynomial) = PiecewisePolynomial::new(formula) else {
            return Self { sets, degree: None };
        };
        // The value of a spline is smooth at the knots, but no polynomial across them.
        for derivative in &polynomial.derivatives {
            for set in derivative.kinks() {
                if sets.iter().all(|known| known.value.text() != set.value.text()) {
                    sets.push(set);
                }
            }
        }
        let few = sets.len() <= MOST_SETS;
        if !few {
            sets.truncate(formula.kinks().len());
        }
        Self { sets, degree: few.then_some(polynomial.degree) }
    }
}

/// A formula that is a polynomial of x and y on every piece between some lines and curves.
struct PiecewisePolynomial {
    degree: usize,
    /// All its derivatives of this order, which are constants on every piece.
    derivatives: Vec<Formula>,
}

impl PiecewisePolynomial {
    fn new(formula: &Formula) -> Option<Self> {
        let mut derivatives = vec![formula.clone()];
        for degree in 0..=POLYNOMIAL {
            let along_x = derivatives.iter().map(|f| f.derivative("x"));
            let along_y = derivatives.last().map(|f| f.derivative("y"));
            let next: Vec<_> = along_x.chain(along_y).collect::<Result<_, _>>().ok()?;
            if next.iter().all(|f| f.constant() == Some(0.0)) {
                return Some(Self { degree, derivatives });
            }
            derivatives = next;
        }
        None
    }
}

/// The angles in (−π, π) of the rays on which a formula vanishes that depends on θ alone.
pub(super) fn rays(formula: &Formula) -> Option<Vec<f64>> {
    let is_angle = |name: &str| name.contains("theta");
    let scope = formula.scope();
    if scope.inputs().any(|name| !is_angle(name) && formula.uses(name)) {
        return None;
    }
    let value = |theta: f64| {
        let inputs = scope.inputs().map(|name| match name {
            "theta" => theta,
            "cos(theta/2)" => (0.5 * theta).cos(),
            "sin(theta/2)" => (0.5 * theta).sin(),
            _ => f64::NAN,
        });
        formula.evaluate(&inputs.collect::<Vec<_>>())
    };
    let at = |k: usize| PI * (2.0 * k as f64 / ANGLES as f64 - 1.0);
    let inside = (1..ANGLES).filter(|&k| value(at(k)) == 0.0).map(at);
    let changes = (0..ANGLES).filter(|&k| value(at(k)) * value(at(k + 1)) < 0.0);
    let zeros = changes.map(|k| {
        let [low, high] = [k, k + 1].map(|k| [at(k), value(at(k))]);
        zero(&value, low, high)
    });
    Some(inside.chain(zeros).collect())
}
