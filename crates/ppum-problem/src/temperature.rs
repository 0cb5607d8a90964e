//! Temperatures that another problem gives.

use std::borrow::Cow;

use ppum::dataset::{Eigenstrain, Elasticity, Equation};
use ppum::expression::Expression;

use super::model::{Problem, SolvedTemperature};

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
    pub fn dataset_equation(&self) -> Cow<'_, Equation> {
        match &self.temperature {
            Some(heat) => Cow::Owned(with_expansion(&self.equation, &heat.expansion)),
            None => Cow::Borrowed(&self.equation),
        }
    }

    /// The equation, and the coefficient of expansion by a temperature that is solved for.
    pub fn constants(&self) -> (&Equation, Option<&Expression>) {
        (&self.equation, self.temperature.as_ref().map(|heat| &heat.expansion))
    }

    /// The problem of the temperature in the body as it is now, discretised as this one.
    pub fn heat(&self) -> Option<Self> {
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

/// The equation of a body whose field has a temperature that strains it by a coefficient.
fn with_expansion(equation: &Equation, expansion: &Expression) -> Equation {
    let mut equation = equation.clone();
    if let Equation::Elasticity(Elasticity { eigenstrain, .. }) = &mut equation {
        let zeros = || Box::new(Eigenstrain::from([0.0; 4].map(Expression::number)));
        eigenstrain.get_or_insert_with(zeros).expansion = Some(expansion.clone());
    }
    equation
}

/// The same equation without the temperature.
pub fn without_expansion(mut equation: Equation) -> Equation {
    if equation.expansion().is_none() {
        return equation;
    }
    if let Equation::Elasticity(Elasticity { eigenstrain, .. }) = &mut equation {
        let is_given =
            |given: &Eigenstrain| given.strains.iter().any(|e| e.constant() != Some(0.0));
        *eigenstrain = eigenstrain.take().filter(|given| is_given(given));
        eigenstrain.iter_mut().for_each(|given| given.expansion = None);
    }
    equation
}
