//! Gradients of a material's constants.

use super::formula::QuantityFormulaError;
use crate::anisotropy::{Anisotropy, LawSlopes, STIFFNESS};
use crate::equation::{Equation, Moduli, StressState};
use crate::expression::Expression;
use crate::library::{PLANE_STRAIN, PLANE_STRESS};
use crate::vec2::{Vec2, vec2};
use ppum_formula::{Formula, FormulaJets, Scope};

/// The gradients of an equation's moduli: those of its formulas through the moduli's own.
#[derive(Clone, Debug)]
pub struct MaterialGradient {
    /// young and poisson, or conductivity, or those of an anisotropic body, then the given strains;
    /// `None` of what is the same everywhere.
    constants: Vec<Option<FormulaJets>>,
    /// The law of an anisotropic body, and its state.
    anisotropy: Option<Box<Anisotropy>>,
    state: StressState,
    /// mu, lambda and out_of_plane as functions of young and poisson.
    law: Option<FormulaJets>,
}

impl MaterialGradient {
    /// That of an equation; `None` if its constants are the same everywhere.
    ///
    /// # Errors
    /// Derivatives that are too large.
    pub fn new(equation: &Equation) -> Result<Option<Self>, QuantityFormulaError> {
        if equation.is_uniform() {
            return Ok(None);
        }
        let constants: Result<_, _> = equation.constants().map(|(_, e)| constant(e)).collect();
        let law = equation.elastic().map(|elastic| law(elastic.state)).transpose()?;
        let anisotropy = equation.elastic().and_then(|elastic| elastic.anisotropy.clone());
        let state = equation.elastic().map_or(StressState::PlaneStress, |elastic| elastic.state);
        Ok(Some(Self { constants: constants?, anisotropy, state, law }))
    }

    /// The gradients of the given strains at a point, in the order of [`Moduli::eigenstrain`].
    #[must_use]
    pub fn eigenstrain(&self, p: Vec2) -> [Vec2; 4] {
        let first = self.constants.len().saturating_sub(4);
        std::array::from_fn(|k| self.gradient(first + k, p))
    }

    /// The gradients of the strains of the plane under which the stresses of an anisotropic body
    /// vanish, as [`Moduli::plane_eigenstrain`] has them; none of other bodies.
    #[must_use]
    pub fn anisotropic_eigenstrain(&self, p: Vec2, moduli: &Moduli<f64>) -> Option<[Vec2; 3]> {
        let law = self.anisotropy.as_ref()?;
        let (ratio, slopes) = (law.ratio_at(p), self.slopes(law, p));
        let [xx, yy, xy, zz] = self.eigenstrain(p);
        let through = |k: usize| {
            zz * ratio[k] + vec2(slopes[0].ratio[k], slopes[1].ratio[k]) * moduli.eigenstrain[3]
        };
        Some([xx + through(0), yy + through(1), xy + through(2) * 0.5])
    }

    /// How the law of an anisotropic body changes along x and along y.
    fn slopes(&self, law: &Anisotropy, p: Vec2) -> [LawSlopes; 2] {
        let count = law.constants(self.state == StressState::PlaneStrain).count();
        // the angle is the last one
        let index = |k: usize| if k == STIFFNESS.len() - 1 { count - 1 } else { k };
        let is_there = |k: &usize| *k == STIFFNESS.len() - 1 || *k < count - 1;
        let all = (0..STIFFNESS.len())
            .map(|k| Some(k).filter(is_there).map_or(Vec2::ZERO, |k| self.gradient(index(k), p)));
        let all: Vec<Vec2> = all.collect();
        [law.slopes(p, |k| all[k].x), law.slopes(p, |k| all[k].y)]
    }

    fn gradient(&self, constant: usize, p: Vec2) -> Vec2 {
        let jets = self.constants.get(constant).and_then(Option::as_ref);
        jets.map_or(Vec2::ZERO, |jets| {
            let [_, x, y] = evaluate::<3>(jets, [p.x, p.y]);
            vec2(x, y)
        })
    }

    /// The gradients of the moduli at a point, without those of strains.
    #[must_use]
    pub fn at(&self, p: Vec2, moduli: &Moduli<f64>) -> Moduli<Vec2> {
        let of = |k: usize| self.gradient(k, p);
        let zero = Vec2::ZERO;
        let none = Moduli::all(zero);
        if let Some(law) = &self.anisotropy {
            let [x, y] = self.slopes(law, p).map(|slopes| slopes.plane);
            let [c11, c12, c16, c22, c26, c66] = std::array::from_fn(|k| vec2(x[k], y[k]));
            let both = c12 + c66 * 2.0;
            let anisotropy = [c11 - both, c22 - both, c16, c26];
            return Moduli { lambda: c12, mu: c66, anisotropy, ..none };
        }
        let Some(law) = &self.law else { return Moduli { conductivity: of(0), ..none } };
        let (young, poisson) = (of(0), of(1));
        let law = evaluate::<9>(law, [moduli.young, moduli.poisson]);
        // a term that is constant has no part, though its factor may be infinite
        let part = |slope: f64, of: Vec2| if of == zero { zero } else { of * slope };
        let chain = |k: usize| part(law[3 * k + 1], young) + part(law[3 * k + 2], poisson);
        Moduli { young, poisson, mu: chain(0), lambda: chain(1), out_of_plane: chain(2), ..none }
    }
}

fn constant(expression: &Expression) -> Result<Option<FormulaJets>, QuantityFormulaError> {
    if expression.constant().is_some() {
        return Ok(None);
    }
    Ok(Some(FormulaJets::new(&[expression.formula()], 1)?))
}

fn law(state: StressState) -> Result<FormulaJets, QuantityFormulaError> {
    let texts = match state {
        StressState::PlaneStrain | StressState::Axisymmetric => PLANE_STRAIN,
        StressState::PlaneStress => PLANE_STRESS,
    };
    let scope = Scope::new(&["young", "poisson"])?;
    let [mu, lambda, out_of_plane] = texts.map(|(_, text)| Formula::parse(text, &scope));
    Ok(FormulaJets::new(&[&mu?, &lambda?, &out_of_plane?], 1)?)
}

fn evaluate<const N: usize>(jets: &FormulaJets, inputs: [f64; 2]) -> [f64; N] {
    let mut out = [0.0; N];
    jets.evaluate(&inputs, &mut Vec::new(), &mut out);
    out
}
