//! Numbers and formulas of a problem.

use std::str::FromStr;

use ppum::formula::{Formula, FormulaError, Scope};
use ppum::vec2::Vec2;

/// A scalar given by a number or a formula of x and y.
#[derive(Clone, Debug)]
pub struct Expression(Formula);

impl Expression {
    /// The expression of a formula's text.
    ///
    /// # Errors
    /// The text is no formula of x and y.
    pub fn parse(text: &str) -> Result<Self, FormulaError> {
        Formula::parse(text, &Scope::cartesian()).map(Self)
    }

    /// A finite number.
    ///
    /// # Panics
    /// The number is not finite.
    #[must_use]
    pub fn constant(value: f64) -> Self {
        assert!(value.is_finite(), "a constant expression is finite, not {value}");
        // `{:?}` is the shortest text that reads back as the same number
        Self::parse(&format!("{value:?}")).expect("a finite number is a formula")
    }

    /// The formula's text; reads back as the same expression.
    #[must_use]
    pub fn text(&self) -> &str {
        self.0.text()
    }

    /// The value at a point; not finite where the formula has none.
    #[must_use]
    pub fn value(&self, p: Vec2) -> f64 {
        self.0.evaluate(&[p.x, p.y])
    }

    /// The formula, for derivatives.
    #[must_use]
    pub fn formula(&self) -> &Formula {
        &self.0
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
        Self::constant(value)
    }
}

impl FromStr for Expression {
    type Err = FormulaError;

    fn from_str(text: &str) -> Result<Self, FormulaError> {
        Self::parse(text)
    }
}

/// What is wrong with a formula, without the place.
pub(super) fn message(error: &FormulaError) -> String {
    let text = error.to_string();
    let first = text.lines().next().unwrap_or_default();
    let place = format!("line {}, column {}: ", error.line, error.column);
    first.strip_prefix(&place).unwrap_or(first).to_owned()
}

#[cfg(test)]
mod tests {
    use ppum::vec2::vec2;

    use super::*;

    #[test]
    fn constants_keep_every_bit() {
        for value in [0.0, -0.0, 0.1, -1e-300, 1e300, f64::MIN_POSITIVE, std::f64::consts::PI] {
            let expression = Expression::constant(value);
            assert_eq!(expression.value(vec2(3.0, 4.0)), value);
            assert_eq!(Expression::parse(expression.text()), Ok(expression.clone()));
        }
    }

    #[test]
    fn formulas_of_position() {
        let expression: Expression = "x^2 - 3*y".parse().expect("a formula");
        assert_eq!(expression.value(vec2(3.0, 0.5)), 7.5);
        assert!(Expression::parse("r + 1").is_err());
    }

    #[test]
    fn messages_have_no_place() {
        let error = Expression::parse("1 + foo").expect_err("foo is unknown");
        assert!(error.to_string().contains("column 5"), "{error}");
        assert!(message(&error).starts_with("unknown name `foo`"), "{}", message(&error));
    }
}
