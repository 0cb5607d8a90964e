//! Temperatures that another problem gives.

use std::borrow::Cow;

use ppum::dataset::Equation;
use ppum::expression::Expression;

use super::ProblemData;

impl ProblemData {
    /// The equation as datasets have it: with the coefficient of expansion of a temperature that is
    /// a component of the field.
    pub fn dataset_equation(&self) -> Cow<'_, Equation> {
        match &self.temperature {
            Some(heat) => Cow::Owned(self.equation.with_expansion(&heat.expansion)),
            None => Cow::Borrowed(&self.equation),
        }
    }

    /// The equation, and the coefficient of expansion by a temperature that is solved for.
    pub fn constants(&self) -> (&Equation, Option<&Expression>) {
        (&self.equation, self.temperature.as_ref().map(|heat| &heat.expansion))
    }
}
