//! The variation of a material along the crack, as the J-integral needs it.

use super::auxiliary::Gradients;
use ppum::dataset::{Eigenstrain, Elasticity, StressState};
use ppum::expression::Expression;
use ppum::formula::FormulaJets;
use ppum::vec2::{Vec2, vec2};
use ppum_problem::geometry::{eigenstrain_jumps, interface_distance};

/// A material that varies without jumps, as given strains do.
pub(super) struct Slope<'a> {
    body: &'a Elasticity,
    /// E and ν with their first derivatives; none of a constant.
    constants: [Option<FormulaJets>; 2],
    /// The given strains with their first derivatives.
    eigenstrain: Option<[Option<FormulaJets>; 4]>,
}

impl<'a> Slope<'a> {
    /// The variation in a disc. None if the material, a given strain or the coefficient of
    /// expansion by a temperature jumps there: the energy that crosses an interface is no integral
    /// over the disc. None if formulas are too large to be differentiated.
    pub(super) fn new(
        body: &'a Elasticity,
        expansion: Option<&Expression>,
        center: Vec2,
        radius: f64,
    ) -> Option<Self> {
        if interface_distance(body, center, radius).is_some()
            || eigenstrain_jumps(body, expansion, center, radius)
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
        Some(Self { body, constants: [jets(&body.young)?, jets(&body.poisson)?], eigenstrain })
    }

    /// ½ ε:C,_1:ε = ½ λ,_1 (tr ε)² + μ,_1 ε:ε, the derivative along `axis` at a point where u has
    /// the gradient `u` in the frame of that axis.
    pub(super) fn energy(&self, at: Vec2, axis: Vec2, u: &Gradients) -> f64 {
        let [young, poisson] = [0, 1].map(|k| along(self.constants[k].as_ref(), at, axis));
        if young == 0.0 && poisson == 0.0 {
            return 0.0;
        }
        let [lambda, mu] = self.moduli(at, young, poisson);
        let (trace, shear) = (u[0][0] + u[1][1], 0.5 * (u[0][1] + u[1][0]));
        let square = u[0][0] * u[0][0] + u[1][1] * u[1][1] + 2.0 * shear * shear;
        0.5 * lambda * trace * trace + mu * square
    }

    /// The derivative of the plane's given strains along `axis`, as a gradient; none if there are
    /// no strains.
    pub(super) fn eigenstrain(&self, at: Vec2, axis: Vec2) -> Option<[Vec2; 2]> {
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

    /// The energy of one strain at two places nearby.
    #[test]
    fn derivatives_by_differences() {
        for state in [StressState::PlaneStrain, StressState::PlaneStress] {
            let [young, poisson] = ["2 + x*y", "0.25 + 0.05*sin(x + 2*y)"]
                .map(|text| text.parse().expect("a formula"));
            let body = Elasticity { young, poisson, state, eigenstrain: None };
            let (at, axis) = (vec2(0.3, 0.2), vec2(0.6, 0.8));
            let slope = Slope::new(&body, None, at, 0.1).expect("no jump");
            let u = [[0.3, -0.2], [0.5, 0.7]];
            let energy = |p: Vec2| {
                let material = body.at(p);
                let (trace, shear) = (u[0][0] + u[1][1], 0.5 * (u[0][1] + u[1][0]));
                let square = f64::powi(u[0][0], 2) + f64::powi(u[1][1], 2) + 2.0 * shear * shear;
                0.5 * material.lambda() * trace * trace + material.mu() * square
            };
            let h = 1e-5;
            let difference = (energy(at + axis * h) - energy(at - axis * h)) / (2.0 * h);
            let found = slope.energy(at, axis, &u);
            assert!((found - difference).abs() < 1e-8, "{found} {difference}");
        }
    }

    #[test]
    fn jumps_have_no_slope() {
        let [young, poisson] = ["if(y > 0.3, 2, 1)", "0.3"].map(|t| t.parse().expect("a formula"));
        let state = StressState::PlaneStrain;
        let body = Elasticity { young, poisson, state, eigenstrain: None };
        assert!(Slope::new(&body, None, vec2(0.0, 0.0), 0.2).is_some());
        assert!(Slope::new(&body, None, vec2(0.0, 0.0), 0.4).is_none());
    }
}
