//! A number, or a formula of position: boundary data, material constants, exact solutions.

use std::str::FromStr;

use crate::vec2::{Vec2, vec2};
use ppum_formula::real::Real;
use ppum_formula::{Formula, FormulaError, Scope};

/// A scalar given by a number or a formula of x and y.
#[derive(Clone, Debug)]
pub struct Expression {
    formula: Formula,
    /// The value, if it is the same everywhere.
    constant: Option<f64>,
}

impl Expression {
    /// The expression of a formula's text.
    ///
    /// # Errors
    /// The text is no formula of x and y.
    pub fn parse(text: &str) -> Result<Self, FormulaError> {
        Self::parse_in(text, &Scope::cartesian())
    }

    /// The expression of a formula's text in a scope of x and y that may have parameters
    /// and tables.
    ///
    /// # Errors
    /// The text is no formula of the scope.
    pub fn parse_in(text: &str, scope: &Scope) -> Result<Self, FormulaError> {
        let formula = Formula::parse(text, scope)?;
        Ok(Self { constant: formula.constant(), formula })
    }

    /// The expression that is 1 where a condition holds and 0 elsewhere.
    ///
    /// # Errors
    /// The text is no condition of the scope, e.g. `x > 0 and y > 0`.
    pub fn condition(text: &str, scope: &Scope) -> Result<Self, FormulaError> {
        let formula = Formula::parse_condition(text, scope)?;
        Ok(Self { constant: formula.constant(), formula })
    }

    /// A number. Formulas have no literals for infinities, which are written as quotients by 0.
    #[must_use]
    pub fn number(value: f64) -> Self {
        let text = match value {
            v if v.is_nan() => "0/0".to_owned(),
            f64::INFINITY => "1/0".to_owned(),
            f64::NEG_INFINITY => "-1/0".to_owned(),
            // `{:?}` is the shortest text that reads back as the same number
            v => format!("{v:?}"),
        };
        Self::parse(&text).expect("a number is a formula")
    }

    /// The formula's text; reads back as the same expression.
    #[must_use]
    pub fn text(&self) -> &str {
        self.formula.text()
    }

    /// The value, if it is the same everywhere.
    #[must_use]
    pub fn constant(&self) -> Option<f64> {
        self.constant
    }

    /// The value at a point; not finite where the formula has none.
    #[must_use]
    pub fn value(&self, p: Vec2) -> f64 {
        self.constant.unwrap_or_else(|| self.formula.evaluate(&[p.x, p.y]))
    }

    /// The values at the points `anchor + offset` of some lanes. A formula is evaluated in f64,
    /// lane by lane.
    #[inline(always)]
    pub fn values<R: Real>(&self, anchor: Vec2, offset: [R; 2]) -> R {
        match self.constant {
            Some(value) => offset[0].broadcast(value),
            None => self.formula_values(anchor, offset),
        }
    }

    fn formula_values<R: Real>(&self, anchor: Vec2, offset: [R; 2]) -> R {
        let [xs, ys] = offset.map(Real::lanes);
        offset[0].with_lanes(|lane| self.value(anchor + vec2(xs[lane], ys[lane])))
    }

    /// The formula, for derivatives.
    #[must_use]
    pub fn formula(&self) -> &Formula {
        &self.formula
    }
}

/// Expressions are equal when their texts are.
impl PartialEq for Expression {
    fn eq(&self, other: &Self) -> bool {
        self.text() == other.text()
    }
}

impl From<f64> for Expression {
    fn from(value: f64) -> Self {
        Self::number(value)
    }
}

impl FromStr for Expression {
    type Err = FormulaError;

    fn from_str(text: &str) -> Result<Self, FormulaError> {
        Self::parse(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_keep_every_bit() {
        for value in [0.0, -0.0, 0.1, -1e-300, 1e300, f64::MIN_POSITIVE, std::f64::consts::PI] {
            let expression = Expression::number(value);
            assert_eq!(expression.value(vec2(3.0, 4.0)), value);
            assert_eq!(Expression::parse(expression.text()), Ok(expression.clone()));
        }
    }

    #[test]
    fn numbers_that_are_not_finite() {
        for value in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            let found = Expression::number(value).constant().expect("a constant");
            assert!(found == value || found.is_nan() && value.is_nan());
        }
    }

    #[test]
    fn formulas_of_position() {
        let expression: Expression = "x^2 - 3*y".parse().expect("a formula");
        assert_eq!(expression.value(vec2(3.0, 0.5)), 7.5);
        assert_eq!(expression.values(vec2(2.0, 0.25), [1.0, 0.25]), 7.5);
        assert_eq!(expression.constant(), None);
        assert!(Expression::parse("r + 1").is_err());
    }

    #[test]
    fn conditions() {
        let condition = |text| Expression::condition(text, &Scope::cartesian());
        let right = condition("let a = 0.5; x > a and not y > 1").expect("a condition");
        for (x, y, expected) in [(0.6, 0.0, 1.0), (0.5, 0.0, 0.0), (1.0, 2.0, 0.0), (1.0, 1.0, 1.0)]
        {
            assert_eq!(right.value(vec2(x, y)), expected, "{x} {y}");
        }
        let again = Expression::parse(right.text()).expect("its text is a formula");
        assert_eq!(again.value(vec2(0.6, 0.0)), 1.0);
        assert_eq!(condition("1 < 2").expect("a condition").constant(), Some(1.0));
        assert!(condition("x + 1").is_err());
    }
}
