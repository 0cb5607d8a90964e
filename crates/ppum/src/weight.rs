//! Weight functions w(t), t = |ξ|: the generators of the partition of unity.

use std::sync::Arc;

use crate::jet::Jet;
use crate::library;
use ppum_formula::real::Real;
use ppum_formula::{
    Block, BlockScratch, DerivativeError, Formula, FormulaError, FormulaJets, Scope,
};

/// A one-dimensional even function with support \[−1, 1\]. Its scale cancels in φ_i = W_i / Σ W.
/// The B-splines have w(0) = 1.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum WeightFunction {
    /// Degree 1: w = 1 − t.
    #[default]
    Linear,
    /// Degree 2, knots at ±1/3, ±1: w = 1 − 3t² for t ≤ 1/3, else 3/2 (1 − t)².
    Quadratic,
    /// Degree 3, knots at 0, ±1/2, ±1: w = 1 − 6t² + 6t³ for t ≤ 1/2, else 2 (1 − t)³.
    Cubic,
    /// A formula of t for 0 ≤ t < 1.
    Formula(Arc<WeightFormula>),
}

impl WeightFunction {
    /// The B-splines.
    pub const ALL: [Self; 3] = [Self::Linear, Self::Quadratic, Self::Cubic];

    /// The name in problem files and datasets; `formula` for a formula.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Quadratic => "quadratic",
            Self::Cubic => "cubic",
            Self::Formula(_) => "formula",
        }
    }

    /// The B-spline of a name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|w| w.name() == name)
    }

    /// The weight function of the [library](crate::library::WEIGHTS) with this name.
    #[must_use]
    pub fn from_library(name: &str) -> Option<Self> {
        let scope = Scope::new(&["t"]).expect("t is a name");
        let formula =
            |text| Self::formula(text, &scope).expect("the library's weights are weights");
        Self::from_name(name).or_else(|| library::weight(name).map(|w| formula(w.texts[0])))
    }

    /// The weight function of a formula of t in a scope with the one input `t`.
    ///
    /// # Errors
    /// See [`WeightError`].
    pub fn formula(text: &str, scope: &Scope) -> Result<Self, WeightError> {
        Self::formula_with_breakpoints(text, scope, &[])
    }

    /// Like [`formula`](Self::formula), with breakpoints in addition to those found automatically.
    ///
    /// # Errors
    /// See [`WeightError`].
    pub fn formula_with_breakpoints(
        text: &str,
        scope: &Scope,
        breakpoints: &[f64],
    ) -> Result<Self, WeightError> {
        let formula = WeightFormula::parse(text, scope, breakpoints)?;
        Ok(Self::Formula(Arc::new(formula)))
    }

    /// Places t = |ξ| in \[0, 1) where a derivative of w(|ξ|) jumps; quadrature splits there.
    #[must_use]
    pub fn breakpoints(&self) -> &[f64] {
        match self {
            Self::Linear => &[0.0],
            Self::Quadratic => &[1.0 / 3.0],
            Self::Cubic => &[0.0, 0.5],
            Self::Formula(formula) => &formula.breakpoints,
        }
    }

    /// w, dw/dξ, d²w/dξ² at ξ, zero outside \[−1, 1).
    ///
    /// Where a derivative jumps, this is the one from the right, so that a boundary belongs to the
    /// patch on its right or upper side.
    #[inline(always)]
    pub fn spline<R: Real>(&self, xi: R) -> [R; 3] {
        let (zero, one) = (xi.broadcast(0.0), xi.broadcast(1.0));
        let t = xi.abs();
        let jet = match self {
            Self::Linear => [one - t, -one, zero],
            Self::Quadratic => quadratic(xi, t),
            Self::Cubic => cubic(t),
            Self::Formula(formula) => {
                let [w, slope, curvature] = formula.evaluate(t);
                [inside(xi, w), slope, curvature]
            }
        };
        even(xi, jet)
    }

    /// w and dw/dξ at many places, those of [`spline`](Self::spline): formulas are evaluated in
    /// blocks.
    #[must_use]
    pub fn at_many(&self, xis: &[f64]) -> Vec<[f64; 2]> {
        let first = |[w, slope, _]: [f64; 3]| [w, slope];
        match self {
            Self::Formula(formula) => {
                let jets = xis.iter().zip(formula.evaluate_many(xis));
                jets.map(|(&xi, [w, d, dd])| first(even(xi, [inside(xi, w), d, dd]))).collect()
            }
            _ => xis.iter().map(|&xi| first(self.spline(xi))).collect(),
        }
    }

    /// W = w(ξ) w(η) with its derivatives in the world; `inverse` holds the reciprocal
    /// half-extents.
    #[inline(always)]
    pub fn tensor<R: Real, const D: usize>(&self, xi: [R; 2], inverse: [f64; 2]) -> Jet<R> {
        let [a, ax, axx] = self.spline(xi[0]);
        let [b, by, byy] = self.spline(xi[1]);
        let (ix, iy) = (a.broadcast(inverse[0]), a.broadcast(inverse[1]));
        let mut w = Jet::constant(a * b);
        if D >= 1 {
            w.x = ax * ix * b;
            w.y = a * (by * iy);
        }
        if D >= 2 {
            w.xx = axx * (ix * ix) * b;
            w.xy = ax * ix * (by * iy);
            w.yy = a * (byy * (iy * iy));
        }
        w
    }
}

/// A weight function given by a formula of t = |ξ| on 0 ≤ t < 1; it is 0 beyond.
#[derive(Clone, Debug)]
pub struct WeightFormula {
    formula: Formula,
    /// w, dw/dt, d²w/dt²
    jets: FormulaJets,
    breakpoints: Vec<f64>,
}

/// Weights are equal when their formulas are.
impl PartialEq for WeightFormula {
    fn eq(&self, other: &Self) -> bool {
        self.formula == other.formula
    }
}

/// A formula that is no weight function.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WeightError {
    /// The text is not a formula of t.
    #[error(transparent)]
    Formula(#[from] FormulaError),
    /// The formula cannot be differentiated.
    #[error(transparent)]
    Derivative(#[from] DerivativeError),
    /// A breakpoint outside the support.
    #[error("the breakpoint {0} of the weight must be in 0 <= t < 1")]
    Breakpoint(f64),
    /// w(1) ≠ 0: the patch would end in a jump.
    #[error(
        "a weight must vanish where the patch ends, but `{text}` is {value} at t = 1; \
         multiply it by e.g. (1 - t)"
    )]
    Support {
        /// The formula.
        text: String,
        /// Its value at 1.
        value: f64,
    },
    /// The value or slope at some t is not that of a weight.
    #[error(
        "a weight must be positive for 0 <= t < 1 and finite, with a finite slope, \
         but `{text}` is {value} with slope {slope} at t = {t}"
    )]
    Sign {
        /// The formula.
        text: String,
        /// The argument t.
        t: f64,
        /// The value there.
        value: f64,
        /// The slope there.
        slope: f64,
    },
}

/// Number of t at which a weight is checked, between its breakpoints and near the ends.
const LOOKS: u32 = 4096;

/// Breakpoints nearer to each other than this are the same one, found twice.
const ROUNDING: f64 = 1e-12;

/// Largest w(1) in parts of the largest value that counts as rounding.
const VANISHING: f64 = 1e-12;

impl WeightFormula {
    /// Parses a formula of `t` and checks that it can be a weight: positive where t < 1, zero at
    /// t = 1, with finite slopes. Positivity is checked at some thousand t.
    fn parse(text: &str, scope: &Scope, declared: &[f64]) -> Result<Self, WeightError> {
        let w = Formula::parse(text, scope)?;
        let slope = w.derivative("t")?;
        let curvature = slope.derivative("t")?;
        if let Some(&outside) = declared.iter().find(|&t| !(0.0..1.0).contains(t)) {
            return Err(WeightError::Breakpoint(outside));
        }
        let mut breakpoints = w.breakpoints(0.0, 1.0);
        breakpoints.retain(|&t| t > 0.0 && t < 1.0);
        breakpoints.extend_from_slice(declared);
        // w(|ξ|) is smooth at 0 if odd derivatives of w vanish there.
        let odd = [&slope, &curvature.derivative("t")?];
        if odd.iter().any(|derivative| derivative.evaluate(&[0.0]) != 0.0) {
            breakpoints.push(0.0);
        }
        breakpoints.sort_by(f64::total_cmp);
        breakpoints.dedup_by(|b, a| *b - *a < ROUNDING);
        let jets = FormulaJets::new(&[&w], 2)?;
        let formula = Self { formula: w, jets, breakpoints };
        formula.check()?;
        Ok(formula)
    }

    fn check(&self) -> Result<(), WeightError> {
        let text = || self.text().to_owned();
        let mut largest = 0.0f64;
        for k in 0..LOOKS {
            let t = f64::from(k) / f64::from(LOOKS);
            let [value, slope, _] = self.evaluate(t);
            // A smooth weight may underflow near t = 1.
            let possible = value > 0.0 || (value == 0.0 && t > 0.9);
            if !(possible && value.is_finite() && slope.is_finite()) {
                return Err(WeightError::Sign { text: text(), t, value, slope });
            }
            largest = largest.max(value);
        }
        let value = self.formula.evaluate(&[1.0]);
        // A bump has a limit at 1, but no value.
        let before = self.formula.evaluate(&[1.0 - f64::EPSILON]);
        let end = if value.is_nan() { before } else { value };
        if end.abs() <= VANISHING * largest {
            Ok(())
        } else {
            Err(WeightError::Support { text: text(), value: end })
        }
    }

    /// The formula of w.
    #[must_use]
    pub fn text(&self) -> &str {
        self.formula.text()
    }

    /// w, dw/dt, d²w/dt² as formulas.
    #[must_use]
    pub fn jets(&self) -> &FormulaJets {
        &self.jets
    }

    /// w, dw/dt, d²w/dt² at t, lane by lane.
    fn evaluate<R: Real>(&self, t: R) -> [R; 3] {
        let mut scratch = Vec::new();
        t.map_to(|t| {
            let t = t.min(1.0);
            let mut jet = [0.0; 3];
            self.jets.evaluate(&[t], &mut scratch, &mut jet);
            limited(t, jet)
        })
    }

    /// Evaluates w and its derivatives at t = |ξ| for many ξ, in blocks.
    fn evaluate_many(&self, xis: &[f64]) -> Vec<[f64; 3]> {
        let (mut scratch, mut jets) = (BlockScratch::default(), Vec::with_capacity(xis.len()));
        let mut block = self.jets.block(&mut scratch);
        for xis in xis.chunks(Block::<f64>::POINTS) {
            let ts = || xis.iter().map(|xi| xi.abs().min(1.0));
            block.input(0).iter_mut().zip(ts()).for_each(|(input, t)| *input = t);
            block.run();
            let rows = [0, 1, 2].map(|order| block.output(order));
            jets.extend(ts().enumerate().map(|(k, t)| limited(t, rows.map(|row| row[k]))));
        }
        jets
    }
}

/// Values and derivatives at t ≤ 1: at the end of the support a formula may have only a limit.
fn limited(t: f64, jet: [f64; 3]) -> [f64; 3] {
    jet.map(|value| if t < 1.0 || value.is_finite() { value } else { 0.0 })
}

/// w, dw/dξ, d²w/dξ² from those by t = |ξ|, zero outside \[−1, 1).
#[inline(always)]
fn even<R: Real>(xi: R, [w, slope, curvature]: [R; 3]) -> [R; 3] {
    let (zero, one) = (xi.broadcast(0.0), xi.broadcast(1.0));
    let s = R::sign(xi.ge(zero), one);
    [w.max(zero), inside(xi, s * slope), inside(xi, curvature)]
}

/// `v` for ξ in \[−1, 1), else zero.
#[inline(always)]
fn inside<R: Real>(xi: R, v: R) -> R {
    let (zero, one) = (xi.broadcast(0.0), xi.broadcast(1.0));
    R::select(one.gt(xi), R::select(xi.ge(-one), v, zero), zero)
}

/// Quadratic spline and its derivatives by t; the knots ±1/3 belong to the piece on their right.
#[inline(always)]
fn quadratic<R: Real>(xi: R, t: R) -> [R; 3] {
    let (one, third) = (t.broadcast(1.0), t.broadcast(1.0 / 3.0));
    let u = (one - t).max(t.broadcast(0.0));
    let (right, left) = (xi.ge(-third), third.gt(xi));
    let core = [one - t.broadcast(3.0) * t * t, t.broadcast(-6.0) * t, t.broadcast(-6.0)];
    let flank = [t.broadcast(1.5) * u * u, t.broadcast(-3.0) * u, t.broadcast(3.0)];
    let mut out = flank;
    let mut k = 0;
    while k < 3 {
        out[k] = R::select(right, R::select(left, core[k], flank[k]), flank[k]);
        k += 1;
    }
    out
}

/// Cubic spline and its derivatives by t; its second derivative is continuous.
#[inline(always)]
fn cubic<R: Real>(t: R) -> [R; 3] {
    let (one, six) = (t.broadcast(1.0), t.broadcast(6.0));
    let u = (one - t).max(t.broadcast(0.0));
    let near = t.broadcast(0.5).gt(t);
    [
        R::select(near, one - six * t * t * u, t.broadcast(2.0) * u * u * u),
        R::select(near, t * (t.broadcast(18.0) * t - t.broadcast(12.0)), -six * u * u),
        R::select(near, t.broadcast(36.0) * t - t.broadcast(12.0), t.broadcast(12.0) * u),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cox–de Boor recursion over the weight's own knots: an independent evaluation.
    fn b_spline(knots: &[f64], x: f64) -> f64 {
        if knots.len() == 2 {
            return f64::from(x >= knots[0] && x < knots[1]);
        }
        let n = knots.len() - 1;
        let left = (x - knots[0]) / (knots[n - 1] - knots[0]) * b_spline(&knots[..n], x);
        let right = (knots[n] - x) / (knots[n] - knots[1]) * b_spline(&knots[1..], x);
        left + right
    }

    fn knots(weight: &WeightFunction) -> Vec<f64> {
        let n = match weight {
            WeightFunction::Linear => 2,
            WeightFunction::Quadratic => 3,
            _ => 4,
        };
        (0..=n).map(|k| -1.0 + 2.0 * f64::from(k) / f64::from(n)).collect()
    }

    #[test]
    fn proportional_to_the_b_spline() {
        for weight in WeightFunction::ALL {
            let knots = knots(&weight);
            let scale = b_spline(&knots, 0.0);
            for k in -120..=120 {
                let xi = f64::from(k) / 100.0;
                let expected = b_spline(&knots, xi) / scale;
                assert!((weight.spline(xi)[0] - expected).abs() < 1e-15, "{weight:?} {xi}");
            }
        }
    }

    #[test]
    fn derivatives_against_differences() {
        for weight in WeightFunction::ALL {
            for k in -110..110 {
                let (xi, h) = (f64::from(k) / 100.0 + 0.0037, 1e-5);
                let [_, d, dd] = weight.spline(xi);
                let ([p, dp, _], [m, dm, _]) = (weight.spline(xi + h), weight.spline(xi - h));
                assert!((d - (p - m) / (2.0 * h)).abs() < 1e-8, "{weight:?} {xi}");
                assert!((dd - (dp - dm) / (2.0 * h)).abs() < 1e-7, "{weight:?} {xi}");
            }
        }
    }

    #[test]
    fn breakpoints_of_formulas_are_found_and_declared() {
        let scope = Scope::new(&["t"]).expect("a name");
        let breakpoints = |text, declared: &[f64]| {
            WeightFunction::formula_with_breakpoints(text, &scope, declared)
                .map(|weight| weight.breakpoints().to_vec())
        };
        let roof = "min(1 - t, 0.75 - 0.5*t)";
        assert_eq!(breakpoints(roof, &[]), Ok(vec![0.0, 0.5]));
        assert_eq!(breakpoints(roof, &[0.7, 0.0, 0.5 + 1e-15]), Ok(vec![0.0, 0.5, 0.7]));
        assert_eq!(breakpoints("(1 - t^2)^2", &[0.25]), Ok(vec![0.25]));
        for outside in [-0.1, 1.0, f64::INFINITY] {
            let error = breakpoints(roof, &[outside]);
            assert_eq!(error, Err(WeightError::Breakpoint(outside)));
        }
        assert!(breakpoints(roof, &[f64::NAN]).is_err());
    }

    #[test]
    fn a_bump_vanishes_with_its_derivatives_at_the_ends() {
        let scope = Scope::new(&["t"]).expect("a name");
        let bump = WeightFunction::formula("exp(1 - 1/((1 - t)*(1 + t)))", &scope);
        let bump = bump.expect("a weight");
        assert_eq!(bump.spline(0.0), [1.0, 0.0, -2.0]);
        for xi in [-1.0, 1.0, -7.0, 2.0] {
            assert_eq!(bump.spline(xi), [0.0; 3], "{xi}");
        }
    }

    /// Blocks of places give what single places do, whatever their number.
    #[test]
    fn many_places_at_once() {
        let scope = Scope::new(&["t"]).expect("a name");
        let bump = WeightFunction::formula("exp(1 - 1/((1 - t)*(1 + t)))", &scope);
        for weight in WeightFunction::ALL.into_iter().chain([bump.expect("a weight")]) {
            for n in [0, 1, 63, 64, 65, 300] {
                let xis: Vec<f64> = (0..n).map(|k| f64::from(k) * 0.011 - 1.5).collect();
                let each = xis.iter().map(|&xi| weight.spline(xi)).map(|[w, slope, _]| [w, slope]);
                assert_eq!(weight.at_many(&xis), each.collect::<Vec<_>>(), "{weight:?}");
            }
        }
    }

    #[test]
    fn borders_belong_to_the_right() {
        for (weight, slope) in [(WeightFunction::Linear, 1.0), (WeightFunction::Quadratic, 0.0)] {
            assert_eq!(weight.spline(-1.0)[1], slope);
            assert_eq!(weight.spline(1.0)[1], 0.0);
        }
        assert_eq!(WeightFunction::Linear.spline(0.0)[1], -1.0);
        assert_eq!(WeightFunction::Quadratic.spline(1.0 / 3.0)[2], 3.0);
        assert_eq!(WeightFunction::Quadratic.spline(-1.0 / 3.0)[2], -6.0);
    }
}
