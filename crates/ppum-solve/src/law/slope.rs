//! The derivative of the energy W(x, D u) by x, as the J-integral needs it.

use super::strain::Strain;
use super::stress::Law;
use ppum::jet::Jet;
use ppum::quantity::MaterialGradient;
use ppum::vec2::Vec2;
use ppum_problem::geometry::{interface_distance, jumps_within};

/// A law that varies without jumps.
pub struct EnergySlope<'a> {
    law: Law<'a>,
    /// The gradients of moduli and given strains; none if all are constants.
    material: Option<MaterialGradient>,
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
        let material = MaterialGradient::new(law.equation).ok()?;
        Some(Self { law, material })
    }

    /// ½ e:C,_1:e − σ:ε⁰,_1 with the elastic strain e, the derivative along `axis` at a point where
    /// the jets of the field are `u`.
    pub fn at(&self, x: Vec2, axis: Vec2, u: &[Jet<f64>]) -> f64 {
        let law = self.law.at(x);
        let strain = law.strain(u);
        let elastic = law.elastic(&strain);
        let material = self.material.as_ref();
        let slopes = material.map(|material| self.law.coefficient_slopes(x, axis, material));
        let terms = self.law.terms.iter().zip(slopes.unwrap_or_default());
        let terms = terms.filter(|(_, slope)| *slope != 0.0);
        let by_material =
            terms.map(|(term, slope)| slope * term.linear_stress(&elastic).work(&elastic));
        let by_material = 0.5 * by_material.sum::<f64>();
        if !self.law.has_initial_stress() {
            return by_material;
        }
        let heated = self.law.temperature.as_ref().map(|t| t.strain_slope(x, axis));
        let given = material.map(|material| self.eigenstrain(x, axis, material));
        let slope = heated.unwrap_or_default().plus(1.0, &given.unwrap_or_default());
        by_material - law.stress(&strain).work(&slope)
    }

    /// The derivative of the plane's given strains along an axis, those through the plane among
    /// them as [`plane_eigenstrain`](ppum::equation::Moduli::plane_eigenstrain) has them.
    fn eigenstrain(&self, x: Vec2, axis: Vec2, material: &MaterialGradient) -> Strain {
        let moduli = self.law.equation.moduli(x, [0.0; 2]);
        if let Some(strain) = material.anisotropic_eigenstrain(x, &moduli) {
            return Strain::symmetric(strain.map(|gradient| gradient.dot(axis)));
        }
        let [xx, yy, xy, zz] = material.eigenstrain(x).map(|gradient| gradient.dot(axis));
        if self.law.has_hoop_strain() {
            return Strain::symmetric([xx, yy, xy]).with_hoop(zz);
        }
        let out_of_plane = material.at(x, &moduli).out_of_plane.dot(axis);
        let through = moduli.out_of_plane * zz + out_of_plane * moduli.eigenstrain[3];
        Strain::symmetric([xx + through, yy + through, xy])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::dataset::{Eigenstrain, Elasticity, Equation, StressState};
    use ppum::vec2::vec2;

    /// The energy of one gradient at two places nearby, also in a body that is strained.
    #[test]
    fn derivatives_by_differences() {
        let strains = ["x*y", "0.1 - x^2", "sin(y)", "0.2*x"].map(|text| text.parse().expect("ok"));
        let given = Eigenstrain::from(strains);
        for state in [StressState::PlaneStrain, StressState::PlaneStress] {
            for eigenstrain in [None, Some(Box::new(given.clone()))] {
                let [young, poisson] = ["2 + x*y", "0.25 + 0.05*sin(x + 2*y)"]
                    .map(|text| text.parse().expect("a formula"));
                let equation = Equation::Elasticity(Elasticity {
                    young,
                    poisson,
                    state,
                    eigenstrain,
                    anisotropy: None,
                });
                let law = Law::new(&equation);
                let (at, axis) = (vec2(0.3, 0.2), vec2(0.6, 0.8));
                let slope = EnergySlope::new(law.clone(), at, 0.1).expect("no jump");
                let zero = Jet::constant(0.0);
                let u = [Jet { x: 0.3, y: -0.2, ..zero }, Jet { x: 0.5, y: 0.7, ..zero }];
                let energy = |p: Vec2| {
                    let (law, strain) = (law.at(p), law.at(p).strain(&u));
                    0.5 * law.stress(&strain).work(&law.elastic(&strain))
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
        let equation = Equation::Elasticity(Elasticity {
            young,
            poisson,
            state,
            eigenstrain: None,
            anisotropy: None,
        });
        let slope = |radius| EnergySlope::new(Law::new(&equation), vec2(0.0, 0.0), radius);
        assert!(slope(0.2).is_some() && slope(0.4).is_none());
    }
}
