//! The stress of a gradient, as tensors: elasticity and Poisson share every line of the assembly.

use super::heat::{FaceLocation, Temperature, TemperatureField};
use super::strain::{
    HOOP, OPERATORS, PAIRS, Rigidity, Strain, Stress, WeightedRigidity, has_hoop_strain, hoop,
    operators, transposed, unit,
};
use ppum::dataset::Equation;
use ppum::equation::Moduli;
use ppum::expression::Expression;
use ppum::jet::Jet;
use ppum::quantity::MaterialGradient;
use ppum::vec2::Vec2;
use std::sync::Arc;

/// C\[i\]\[k\]\[j\]\[l\]
type Tensor = [[[[f64; OPERATORS]; 2]; OPERATORS]; 2];

/// The law of an equation: the stress of u is σ_ik = Σ_jl C\[i\]\[k\]\[j\]\[l\] (D_l u_j − ε⁰_jl)
/// with the given strains ε⁰ and C = Σ_m a_m(x) T_m, constant tensors T_m times coefficients a_m of
/// position.
///
/// Elasticity: C = λ δ_ik δ_jl + μ (δ_ij δ_kl + δ_il δ_jk) with the plane λ, and in bodies of
/// revolution λ + 2μ for the hoop strain, λ beside the others; Poisson: κ δ_kl. An anisotropic body
/// has four terms beside these, of [`Moduli::anisotropy`]. Where the constants are the same
/// everywhere there is one term with coefficient 1.
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
const TERMS: usize = 6;

/// The coefficients of the terms.
pub type Coefficients<R = f64> = [R; TERMS];

impl<'e> Law<'e> {
    /// The law of an equation.
    #[must_use]
    pub fn new(equation: &'e Equation) -> Self {
        let components = equation.components();
        let mut terms = units(equation);
        terms.extend(equation.anisotropy().iter().flat_map(|_| anisotropic_units()));
        let (uniform, temperature) = (false, None);
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
        let [xx, yy, xy, zz] = moduli.eigenstrain;
        if self.has_hoop_strain() {
            let eigenstrain = Strain::symmetric([xx, yy, xy]).with_hoop(zz);
            return LawAt { eigenstrain, ..law };
        }
        let eigenstrain = Strain::symmetric(moduli.plane_eigenstrain());
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
    pub(crate) fn initial_stress(&self, x: Vec2) -> Stress {
        match self.has_initial_stress() {
            true => self.at(x).stress(&Strain::default()),
            false => Stress::default(),
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
        let radius = self.has_hoop_strain().then_some(x.x);
        LawAt { tensor, radius, ..LawAt::zero(self.components) }
    }

    /// True if the strains of the body have a hoop strain among them.
    pub fn has_hoop_strain(&self) -> bool {
        has_hoop_strain(self.equation)
    }

    /// The coefficients a_m at a point, one per term.
    pub fn coefficients(&self, x: Vec2) -> Coefficients {
        if self.uniform {
            return [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        }
        self.coefficients_of(&self.equation.moduli(x, [0.0, 0.0]))
    }

    /// The derivatives of the coefficients along an axis.
    pub(super) fn coefficient_slopes(
        &self,
        x: Vec2,
        axis: Vec2,
        material: &MaterialGradient,
    ) -> Coefficients {
        if self.uniform {
            return Coefficients::default();
        }
        let slopes = material.at(x, &self.equation.moduli(x, [0.0; 2]));
        self.coefficients_of(&slopes).map(|slope| slope.dot(axis))
    }

    /// The coefficients by the moduli at a point, or their slopes by those of the moduli; moduli
    /// that an equation does not have are zero.
    fn coefficients_of<R: Copy>(&self, moduli: &Moduli<R>) -> Coefficients<R> {
        let [a, b, c, d] = moduli.anisotropy;
        match self.equation {
            Equation::Poisson { .. } => [moduli.conductivity, moduli.mu, a, b, c, d],
            _ => [moduli.lambda, moduli.mu, a, b, c, d],
        }
    }

    /// How much the law differs between two points, in parts of its size.
    pub(crate) fn contrast(&self, points: [Vec2; 2]) -> f64 {
        let [a, b] = points.map(|p| self.coefficients(p));
        let (mut jump, mut sum) = (0.0, 0.0);
        for (k, term) in self.terms.iter().enumerate() {
            jump += term.size() * (a[k] - b[k]).abs();
            sum += term.size() * (a[k].abs() + b[k].abs());
        }
        jump / sum
    }

    /// The law at points with their weights, as matrices.
    pub(crate) fn rigidity(&self, points: impl Iterator<Item = (Vec2, f64)>) -> WeightedRigidity {
        let uniform = self.uniform.then(|| self.rigidity_at(Vec2::ZERO));
        let weighted = |(x, weight): (Vec2, f64)| {
            let at = uniform.unwrap_or_else(|| self.rigidity_at(x));
            at.map(|row| row.map(|entry| weight * entry))
        };
        WeightedRigidity(points.map(weighted).collect())
    }

    fn rigidity_at(&self, x: Vec2) -> Rigidity {
        let mut sum = Rigidity::default();
        for (term, a) in self.terms.iter().zip(self.coefficients(x)) {
            for (row, pair) in sum.iter_mut().zip(PAIRS) {
                row.iter_mut()
                    .zip(PAIRS)
                    .for_each(|(sum, other)| *sum += a * term.entry(pair, other));
            }
        }
        sum
    }

    /// True if the law is the same everywhere.
    pub fn is_uniform(&self) -> bool {
        self.uniform
    }
}

/// The tensors of the coefficients λ and μ, or κ.
fn units(equation: &Equation) -> Vec<LawAt> {
    let (components, operators) = (equation.components(), operators(equation));
    let is_strain = |[j, k]: [usize; 2]| k < operators && [j, k] != [1, HOOP];
    let same = |a: [usize; 2], b: [usize; 2]| f64::from(u8::from(a == b));
    let term = |entry: &dyn Fn([usize; 2], [usize; 2]) -> f64| {
        let tensor = std::array::from_fn(|i| {
            std::array::from_fn(|k| {
                std::array::from_fn(|j| {
                    std::array::from_fn(|l| {
                        let is_entry = is_strain([i, k]) && is_strain([j, l]);
                        if is_entry { entry([i, k], [j, l]) } else { 0.0 }
                    })
                })
            })
        });
        LawAt { tensor, ..LawAt::zero(components) }
    };
    if components == 1 {
        return vec![term(&|a, b| if a[0] == 0 { same(a, b) } else { 0.0 })];
    }
    vec![term(&|a, b| unit(a) * unit(b)), term(&|a, b| same(a, b) + same(a, transposed(b)))]
}

/// The tensors of the coefficients that an anisotropic body has beside λ and μ.
fn anisotropic_units() -> Vec<LawAt> {
    let (xx, yy, shear) = ([[0, 0]], [[1, 1]], [[0, 1], [1, 0]]);
    let term = |rows: &[[usize; 2]], columns: &[[usize; 2]]| {
        let mut law = LawAt::zero(2);
        for &[i, k] in rows {
            for &[j, l] in columns {
                law.tensor[i][k][j][l] = 1.0;
                law.tensor[j][l][i][k] = 1.0;
            }
        }
        law
    };
    vec![term(&xx, &xx), term(&yy, &yy), term(&xx, &shear), term(&yy, &shear)]
}

/// The law at a point, as one tensor.
#[derive(Clone, Copy, Debug)]
pub struct LawAt {
    components: usize,
    tensor: Tensor,
    /// ε⁰
    eigenstrain: Strain,
    /// E (ε⁰_zz)², twice the energy of the strain that the third direction does not take.
    through: f64,
    /// The distance of the point from the axis, where there is a hoop strain.
    radius: Option<f64>,
}

impl LawAt {
    fn zero(components: usize) -> Self {
        let (tensor, eigenstrain) = (Tensor::default(), Strain::default());
        Self { components, tensor, eigenstrain, through: 0.0, radius: None }
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
        let pairs = || (0..2).flat_map(|i| (0..OPERATORS).map(move |k| [i, k]));
        let all = pairs().flat_map(move |[i, k]| pairs().map(move |[j, l]| [i, k, j, l]));
        all.filter(|&[i, k, j, l]| self.tensor[i][k][j][l] != 0.0)
    }

    /// Component i of the traction σ n of the function N e_j with D_k N = `slopes`.
    #[must_use]
    pub(crate) fn traction(&self, i: usize, j: usize, slopes: [f64; OPERATORS], n: Vec2) -> f64 {
        let row = |k: usize| dot(&self.tensor[i][k][j], &slopes);
        row(0) * n.x + row(1) * n.y
    }

    /// The modulus of component i: the traction of a unit stretch along its axis, κ of a potential.
    #[must_use]
    pub fn modulus(&self, i: usize) -> f64 {
        self.tensor[i][i][i][i]
    }

    /// The largest entry.
    fn size(&self) -> f64 {
        let entries = self.tensor.as_flattened().as_flattened().as_flattened();
        entries.iter().fold(0.0, |most, entry| entry.abs().max(most))
    }

    /// λ: the stress along one axis of a unit stretch along the other.
    #[must_use]
    pub fn lambda(&self) -> f64 {
        self.tensor[0][0][1][1]
    }

    /// The strain of a field with these components at the point of the law.
    #[must_use]
    pub fn strain(&self, u: &[Jet<f64>]) -> Strain {
        let strain = Strain::new(&u[..self.components]);
        self.radius.map_or(strain, |x| strain.with_hoop(hoop(u[0].v, u[0].x, x)))
    }

    /// The stress (flux) σ of a strain; rows beyond the components are zero.
    #[must_use]
    pub fn stress(&self, strain: &Strain) -> Stress {
        self.linear_stress(&self.elastic(strain))
    }

    /// The part of a strain that has stress.
    #[must_use]
    pub fn elastic(&self, strain: &Strain) -> Strain {
        strain.plus(-1.0, &self.eigenstrain)
    }

    /// Twice the energy that a strain stores, per area.
    #[must_use]
    pub(crate) fn energy(&self, strain: &Strain) -> f64 {
        self.stress(strain).work(&self.elastic(strain)) + self.through
    }

    /// The change of the stress by a change of the strain: that of a body without stresses of
    /// its own.
    #[must_use]
    pub fn linear_stress(&self, strain: &Strain) -> Stress {
        let entry = |i: usize, k: usize| {
            (0..self.components).map(|j| dot(&self.tensor[i][k][j], &strain.0[j])).sum()
        };
        Stress(std::array::from_fn(|i| std::array::from_fn(|k| entry(i, k))))
    }
}

fn dot(a: &[f64; OPERATORS], b: &[f64; OPERATORS]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
