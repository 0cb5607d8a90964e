//! Temperatures that another problem gives.

use std::borrow::Cow;

use ppum::dataset::Equation;
use ppum::expression::Expression;

use super::model::{Problem, SolvedTemperature};
use crate::heat::with_expansion;

impl Problem {
    /// The problem of elasticity in a body that the solution of another problem strains as its
    /// change of temperature, by a coefficient α of thermal expansion.
    #[must_use]
    pub fn with_temperature(mut self, heat: Self, expansion: impl Into<Expression>) -> Self {
        let (problem, expansion) = (Box::new(heat), expansion.into());
        self.temperature = Some(SolvedTemperature { problem, expansion });
        self
    }

    /// The equation as datasets have it: with the coefficient of expansion of a temperature that is
    /// a component of the field.
    pub(crate) fn dataset_equation(&self) -> Cow<'_, Equation> {
        match &self.temperature {
            Some(heat) => Cow::Owned(with_expansion(&self.equation, &heat.expansion)),
            None => Cow::Borrowed(&self.equation),
        }
    }

    /// The equation, and the coefficient of expansion by a temperature that is solved for.
    pub(crate) fn constants(&self) -> (&Equation, Option<&Expression>) {
        (&self.equation, self.temperature.as_ref().map(|heat| &heat.expansion))
    }

    /// The problem of the temperature in the body as it is now, discretised as this one.
    pub(crate) fn heat(&self) -> Option<Self> {
        let heat = (*self.temperature.as_ref()?.problem).clone();
        let body = self.clone();
        let heat = Self {
            domain: body.domain,
            cracks: body.cracks,
            discretization: body.discretization,
            refinements: body.refinements,
            solver: body.solver,
            adaptivity: None,
            growth: None,
            ..heat
        };
        Some(heat.with_free_faces())
    }
}
