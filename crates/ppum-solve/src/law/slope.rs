//! The derivative of the energy W(x, ∇u) by x, as the J-integral needs it.

use super::stress::Law;
use ppum::dataset::{Eigenstrain, Elasticity, StressState};
use ppum::expression::Expression;
use ppum::formula::FormulaJets;
use ppum::vec2::{Vec2, vec2};
use ppum_problem::geometry::{interface_distance, jumps_within};

/// A law that varies without jumps.
pub struct EnergySlope<'a> {
    law: Law<'a>,
    body: &'a Elasticity,
    /// E and ν with their first derivatives; none of a constant.
    constants: [Option<FormulaJets>; 2],
    /// The given strains with their first derivatives.
    eigenstrain: Option<[Option<FormulaJets>; 4]>,
}

impl<'a> EnergySlope<'a> {
    /// The variation in a disc. None if the material, a given strain or the coefficient of
    /// expansion by a temperature jumps there: the energy that crosses an interface is no integral
    /// over the disc. None if formulas are too large to be differentiated.
    pub fn new(law: Law<'a>, center: Vec2, radius: f64) -> Option<Self> {
        let body = law.equation.elastic()?;
        let (_, expansion) = law.constants();
        let given = body.eigenstrain.as_deref().map(|given| given.strains.each_ref());
        let [xx, yy, xy, zz] = given.map_or([None; 4], |given| given.map(Some));
        let strains = |x: Vec2| [xx, yy, xy, zz, expansion].map(|e| e.map_or(0.0, |e| e.value(x)));
        if interface_distance(body, center, radius).is_some()
            || jumps_within(&strains, center, radius)
        {
            return None;
        }
        let jets = |expression: &Expression| match expression.constant() {
            Some(_) => Some(None),
            None => FormulaJets::new(&[expression.formula()], 1).ok().map(Some),
        };
        let eigenstrain = match body.eigenstrain.as_deref() {
            None => None,
            Some(Eigenstrain { strains: [xx, yy, xy, zz], .. }) => {
                Some([jets(xx)?, jets(yy)?, jets(xy)?, jets(zz)?])
            }
        };
        let constants = [jets(&body.young)?, jets(&body.poisson)?];
        Some(Self { law, body, constants, eigenstrain })
    }

    /// ½ e:C,_1:e − σ:ε⁰,_1 with the elastic strain e, the derivative along `axis` at a point where
    /// u has the gradient `g`.
    pub fn at(&self, x: Vec2, axis: Vec2, g: &[Vec2; 2]) -> f64 {
        if !self.law.has_initial_stress() {
            return self.of_moduli(x, axis, g);
        }
        let law = self.law.at(x);
        let heated =
            self.law.temperature.as_ref().map_or([Vec2::ZERO; 2], |t| t.strain_slope(x, axis));
        let given = self.eigenstrain(x, axis).unwrap_or_default();
        let work = |(stress, k): ([f64; 2], usize)| (heated[k] + given[k]).dot(stress.into());
        let strained: f64 = law.stress(g).into_iter().zip(0..).map(work).sum();
        self.of_moduli(x, axis, &law.elastic(g)) - strained
    }

    /// ½ e:C,_1:e = ½ λ,_1 (tr e)² + μ,_1 e:e
    fn of_moduli(&self, at: Vec2, axis: Vec2, [a, b]: &[Vec2; 2]) -> f64 {
        let [young, poisson] = [0, 1].map(|k| along(self.constants[k].as_ref(), at, axis));
        if young == 0.0 && poisson == 0.0 {
            return 0.0;
        }
        let [lambda, mu] = self.moduli(at, young, poisson);
        let (trace, shear) = (a.x + b.y, 0.5 * (a.y + b.x));
        let square = a.x * a.x + b.y * b.y + 2.0 * shear * shear;
        0.5 * lambda * trace * trace + mu * square
    }

    /// The derivative of the plane's given strains along `axis`, as a gradient; none if there are
    /// no strains.
    fn eigenstrain(&self, at: Vec2, axis: Vec2) -> Option<[Vec2; 2]> {
        let (jets, given) = (self.eigenstrain.as_ref()?, self.body.eigenstrain.as_deref()?);
        let [xx, yy, xy, zz] = jets.each_ref().map(|jets| along(jets.as_ref(), at, axis));
        let through = match self.body.state {
            StressState::PlaneStress => 0.0,
            StressState::PlaneStrain => {
                let slope = along(self.constants[1].as_ref(), at, axis);
                self.body.poisson.value(at) * zz + slope * given.strains[3].value(at)
            }
        };
        Some([vec2(xx + through, xy), vec2(xy, yy + through)])
    }

    /// The derivatives of λ and μ from those of E and ν.
    fn moduli(&self, at: Vec2, young: f64, poisson: f64) -> [f64; 2] {
        let material = self.body.at(at);
        let (e, nu) = (material.young, material.poisson);
        let by_poisson = match material.state {
            StressState::PlaneStrain => {
                e * (1.0 + 2.0 * nu * nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)).powi(2)
            }
            StressState::PlaneStress => e * (1.0 + nu * nu) / (1.0 - nu * nu).powi(2),
        };
        [
            material.lambda() / e * young + by_poisson * poisson,
            material.mu() * (young / e - poisson / (1.0 + nu)),
        ]
    }
}

/// The derivative of a formula along an axis; zero of a constant.
fn along(jets: Option<&FormulaJets>, at: Vec2, axis: Vec2) -> f64 {
    let Some(jets) = jets else { return 0.0 };
    let mut out = [0.0; 3];
    jets.evaluate(&[at.x, at.y], &mut Vec::new(), &mut out);
    vec2(out[1], out[2]).dot(axis)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::dataset::Equation;

    /// The energy of one gradient at two places nearby, also in a body that is strained.
    #[test]
    fn derivatives_by_differences() {
        let strains = ["x*y", "0.1 - x^2", "sin(y)", "0.2*x"].map(|text| text.parse().expect("ok"));
        let given = Eigenstrain::from(strains);
        for state in [StressState::PlaneStrain, StressState::PlaneStress] {
            for eigenstrain in [None, Some(Box::new(given.clone()))] {
                let [young, poisson] = ["2 + x*y", "0.25 + 0.05*sin(x + 2*y)"]
                    .map(|text| text.parse().expect("a formula"));
                let equation =
                    Equation::Elasticity(Elasticity { young, poisson, state, eigenstrain });
                let law = Law::new(&equation);
                let (at, axis) = (vec2(0.3, 0.2), vec2(0.6, 0.8));
                let slope = EnergySlope::new(law.clone(), at, 0.1).expect("no jump");
                let u = [vec2(0.3, -0.2), vec2(0.5, 0.7)];
                let energy = |p: Vec2| {
                    let (s, e) = (law.at(p).stress(&u), law.at(p).elastic(&u));
                    0.5 * (e[0].dot(s[0].into()) + e[1].dot(s[1].into()))
                };
                let h = 1e-5;
                let difference = (energy(at + axis * h) - energy(at - axis * h)) / (2.0 * h);
                let found = slope.at(at, axis, &u);
                assert!((found - difference).abs() < 1e-8, "{found} {difference}");
            }
        }
    }

    #[test]
    fn jumps_have_no_slope() {
        let [young, poisson] = ["if(y > 0.3, 2, 1)", "0.3"].map(|t| t.parse().expect("a formula"));
        let state = StressState::PlaneStrain;
        let equation =
            Equation::Elasticity(Elasticity { young, poisson, state, eigenstrain: None });
        let slope = |radius| EnergySlope::new(Law::new(&equation), vec2(0.0, 0.0), radius);
        assert!(slope(0.2).is_some() && slope(0.4).is_none());
    }
}
