//! The stress of a gradient, as tensors: elasticity and Poisson share every line of the assembly.

use super::heat::{FaceLocation, Temperature, TemperatureField};
use ppum::dataset::Equation;
use ppum::equation::Moduli;
use ppum::expression::Expression;
use ppum::vec2::{Vec2, vec2};
use std::sync::Arc;

/// C\[i\]\[k\]\[j\]\[l\]
type Tensor = [[[[f64; 2]; 2]; 2]; 2];

/// The law of an equation: the flux of ∇u is σ_ik = Σ_jl C\[i\]\[k\]\[j\]\[l\] (∂u_j/∂x_l − ε⁰_jl)
/// with the given strains ε⁰ and C = Σ_m a_m(x) T_m, constant tensors T_m times coefficients a_m of
/// position.
///
/// Elasticity: C = λ δ_ik δ_jl + μ (δ_ij δ_kl + δ_il δ_jk) with the plane λ; Poisson: κ δ_kl. Where
/// the constants are the same everywhere there is one term with coefficient 1.
#[derive(Clone, Debug)]
pub struct Law<'e> {
    /// Components of u.
    pub components: usize,
    pub(super) equation: &'e Equation,
    /// A temperature that strains the body, beside what the equation gives.
    pub(super) temperature: Option<Arc<TemperatureField<'e>>>,
    /// The terms' tensors.
    pub(crate) terms: Vec<LawAt>,
    uniform: bool,
}

/// Largest number of terms.
const TERMS: usize = 2;

/// The coefficients of the terms.
pub type Coefficients<R = f64> = [R; TERMS];

impl<'e> Law<'e> {
    /// The law of an equation.
    #[must_use]
    pub fn new(equation: &'e Equation) -> Self {
        let components = equation.components();
        let (terms, uniform, temperature) = (units(components), false, None);
        let mut law = Self { components, equation, temperature, terms, uniform };
        if equation.has_uniform_material() {
            (law.terms, law.uniform) = (vec![law.linear_at(Vec2::ZERO)], true);
        }
        law
    }

    /// The law of the same body, strained by a temperature if there is one.
    #[must_use]
    pub fn heated(self, temperature: Option<&'e Temperature>) -> Self {
        Self { temperature: temperature.map(|heat| Arc::new(heat.field())), ..self }
    }

    /// The formulas of the body: its equation's, and the coefficient of expansion by a temperature
    /// that is solved for.
    pub fn constants(&self) -> (&'e Equation, Option<&Expression>) {
        (self.equation, self.temperature.as_ref().and_then(|heat| heat.expansion()))
    }

    /// The law at a point.
    #[must_use]
    pub fn at(&self, x: Vec2) -> LawAt {
        self.on(x, None)
    }

    /// The law at a point, on the face of a crack if it lies on one.
    #[must_use]
    pub fn on(&self, x: Vec2, face: FaceLocation) -> LawAt {
        let law = self.linear_at(x);
        if !self.has_initial_stress() {
            return law;
        }
        let moduli = self.moduli(x, face);
        let ([xx, yy, xy], [.., zz]) = (moduli.plane_eigenstrain(), moduli.eigenstrain);
        let eigenstrain = [vec2(xx, xy), vec2(xy, yy)];
        LawAt { eigenstrain, through: moduli.young * zz * zz, ..law }
    }

    /// True if the body may have stresses where it does not deform.
    pub fn has_initial_stress(&self) -> bool {
        self.temperature.is_some() || self.equation.eigenstrains().next().is_some()
    }

    /// True if these stresses vary for other reasons than the material.
    pub(crate) fn has_varying_strains(&self) -> bool {
        let is_varying = |(_, e): (_, &Expression)| e.constant().is_none();
        self.temperature.is_some() || self.equation.eigenstrains().any(is_varying)
    }

    /// The stress −C ε⁰ at a point of a body that does not deform.
    pub(crate) fn initial_stress(&self, x: Vec2) -> [[f64; 2]; 2] {
        match self.has_initial_stress() {
            true => self.at(x).stress(&[Vec2::ZERO; 2]),
            false => [[0.0; 2]; 2],
        }
    }

    /// The formulas that make it, each of them once: a temperature gives the same strain in all
    /// directions.
    pub(crate) fn strain_formulas(&self) -> Vec<&'e Expression> {
        let mut all: Vec<&Expression> = Vec::new();
        for (_, strain) in self.equation.eigenstrains() {
            if !all.iter().any(|known| known.text() == strain.text()) {
                all.push(strain);
            }
        }
        all
    }

    fn moduli(&self, x: Vec2, face: FaceLocation) -> Moduli<f64> {
        match &self.temperature {
            Some(heat) => heat.moduli(x, face),
            None => self.equation.moduli(x, [0.0, 0.0]),
        }
    }

    /// The law at a point without given strains.
    fn linear_at(&self, x: Vec2) -> LawAt {
        let coefficients = self.coefficients(x);
        let mut tensor = Tensor::default();
        for (term, a) in self.terms.iter().zip(coefficients) {
            let entries = tensor.as_flattened_mut().as_flattened_mut().as_flattened_mut();
            let parts = term.tensor.as_flattened().as_flattened().as_flattened();
            entries.iter_mut().zip(parts).for_each(|(entry, part)| *entry += a * part);
        }
        LawAt { tensor, ..LawAt::zero(self.components) }
    }

    /// The coefficients a_m at a point, one per term.
    pub fn coefficients(&self, x: Vec2) -> Coefficients {
        if self.uniform {
            return [1.0, 0.0];
        }
        let Moduli { lambda, mu, conductivity, .. } = self.equation.moduli(x, [0.0, 0.0]);
        match self.equation {
            Equation::Elasticity(_) => [lambda, mu],
            Equation::Poisson { .. } => [conductivity, 0.0],
            Equation::None => [0.0; TERMS],
        }
    }

    /// The law at a point, as a matrix.
    pub(crate) fn rigidity(&self, x: Vec2) -> Rigidity {
        let mut sum = [[0.0; 3]; 3];
        for (term, a) in self.terms.iter().zip(self.coefficients(x)) {
            let Rigidity(part) = term.rigidity();
            let entries = sum.as_flattened_mut().iter_mut().zip(part.as_flattened());
            entries.for_each(|(sum, part)| *sum += a * part);
        }
        Rigidity(sum)
    }

    /// True if the law is the same everywhere.
    pub fn is_uniform(&self) -> bool {
        self.uniform
    }
}

/// The law as a matrix on strains (ε_11, ε_22, 2ε_12), or on the gradient of a potential, with
/// zeros after it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rigidity(pub(crate) [[f64; 3]; 3]);

/// The tensors of the coefficients λ and μ, or κ.
fn units(components: usize) -> Vec<LawAt> {
    let delta = |a: usize, b: usize| f64::from(u8::from(a == b));
    let term = |entry: &dyn Fn(usize, usize, usize, usize) -> f64| {
        let tensor = std::array::from_fn(|i| {
            std::array::from_fn(|k| {
                std::array::from_fn(|j| std::array::from_fn(|l| entry(i, k, j, l)))
            })
        });
        LawAt { tensor, ..LawAt::zero(components) }
    };
    if components == 1 {
        return vec![term(&|i, k, j, l| delta(i, 0) * delta(j, 0) * delta(k, l))];
    }
    vec![
        term(&|i, k, j, l| delta(i, k) * delta(j, l)),
        term(&|i, k, j, l| delta(i, j) * delta(k, l) + delta(i, l) * delta(j, k)),
    ]
}

/// The law at a point, as one tensor.
#[derive(Clone, Copy, Debug)]
pub struct LawAt {
    components: usize,
    tensor: Tensor,
    /// ε⁰
    eigenstrain: [Vec2; 2],
    /// E (ε⁰_zz)², twice the energy of the strain that the third direction does not take.
    through: f64,
}

impl LawAt {
    fn zero(components: usize) -> Self {
        let (tensor, eigenstrain) = (Tensor::default(), [Vec2::ZERO; 2]);
        Self { components, tensor, eigenstrain, through: 0.0 }
    }

    /// Components of u.
    #[must_use]
    pub(crate) fn components(&self) -> usize {
        self.components
    }

    /// C_ikjl
    #[must_use]
    pub(crate) fn entry(&self, [i, k]: [usize; 2], [j, l]: [usize; 2]) -> f64 {
        self.tensor[i][k][j][l]
    }

    /// The indices [i, k, j, l] of entries other than zero.
    pub(crate) fn entries(&self) -> impl Iterator<Item = [usize; 4]> {
        let all = (0..16).map(|n| [n / 8, n / 4 % 2, n / 2 % 2, n % 2]);
        all.filter(|&[i, k, j, l]| self.tensor[i][k][j][l] != 0.0)
    }

    fn rigidity(&self) -> Rigidity {
        let pairs: &[[usize; 2]] =
            if self.components == 1 { &[[0, 0], [0, 1]] } else { &[[0, 0], [1, 1], [0, 1]] };
        let mut matrix = [[0.0; 3]; 3];
        for (row, &a) in matrix.iter_mut().zip(pairs) {
            row.iter_mut().zip(pairs).for_each(|(sum, &b)| *sum = self.entry(a, b));
        }
        Rigidity(matrix)
    }

    /// Component i of the traction σ n of the function N e_j with gradient `d`.
    #[must_use]
    pub(crate) fn traction(&self, i: usize, j: usize, d: Vec2, n: Vec2) -> f64 {
        let row = |k: usize| self.tensor[i][k][j][0] * d.x + self.tensor[i][k][j][1] * d.y;
        row(0) * n.x + row(1) * n.y
    }

    /// The modulus of component i: the traction of a unit stretch along its axis, κ of a potential.
    #[must_use]
    pub fn modulus(&self, i: usize) -> f64 {
        self.tensor[i][i][i][i]
    }

    /// λ: the stress along one axis of a unit stretch along the other.
    #[must_use]
    pub fn lambda(&self) -> f64 {
        self.tensor[0][0][1][1]
    }

    /// The stress (flux) σ of a gradient, `g[j] = ∇u_j`; rows beyond the components are zero.
    #[must_use]
    pub fn stress(&self, g: &[Vec2; 2]) -> [[f64; 2]; 2] {
        self.linear_stress(&self.elastic(g))
    }

    /// The part of a gradient that has stress.
    #[must_use]
    pub fn elastic(&self, g: &[Vec2; 2]) -> [Vec2; 2] {
        std::array::from_fn(|j| g[j] - self.eigenstrain[j])
    }

    /// Twice the energy that a gradient stores, per area.
    #[must_use]
    pub(crate) fn energy(&self, g: &[Vec2; 2]) -> f64 {
        let (e, s) = (self.elastic(g), self.stress(g));
        let row = |i: usize| s[i][0] * e[i].x + s[i][1] * e[i].y;
        (0..self.components).map(row).sum::<f64>() + self.through
    }

    /// The change of the stress by a change of the gradient: that of a body without stresses of
    /// its own.
    #[must_use]
    pub fn linear_stress(&self, g: &[Vec2; 2]) -> [[f64; 2]; 2] {
        let entry = |i: usize, k: usize| {
            (0..self.components)
                .map(|j| self.tensor[i][k][j][0] * g[j].x + self.tensor[i][k][j][1] * g[j].y)
                .sum()
        };
        std::array::from_fn(|i| std::array::from_fn(|k| entry(i, k)))
    }
}
