//! Messages about formulas in a problem file.

use ppum::formula::FormulaError;

/// The error of a formula, without the place.
pub(crate) fn message(error: &FormulaError) -> String {
    let text = error.to_string();
    let first = text.lines().next().unwrap_or_default();
    let place = format!("line {}, column {}: ", error.line, error.column);
    first.strip_prefix(&place).unwrap_or(first).to_owned()
}

#[cfg(test)]
mod tests {
    use ppum::expression::Expression;

    use super::*;

    #[test]
    fn messages_have_no_place() {
        let error = Expression::parse("1 + foo").expect_err("foo is unknown");
        assert!(error.to_string().contains("column 5"), "{error}");
        assert!(message(&error).starts_with("unknown name `foo`"), "{}", message(&error));
    }
}
