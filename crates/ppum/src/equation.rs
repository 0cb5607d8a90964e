//! The equation behind a field and its material, the same everywhere or given by formulas.

mod anisotropic;

use crate::anisotropy::Anisotropy;
use crate::domain::Domain;
use crate::expression::Expression;
use crate::vec2::{Vec2, vec2};
use ppum_formula::real::Real;

/// Intervals in each direction of the points at which formulas of a material are looked at.
const LOOKS: u32 = 64;

/// The differential equation behind a field.
#[derive(Clone, Debug, PartialEq)]
pub enum Equation {
    /// Linear elasticity, −div σ(u) = f, two displacement components.
    Elasticity(Elasticity),
    /// −∇·(κ ∇u) = f, one component.
    Poisson {
        /// κ > 0, at every point of the domain.
        conductivity: Expression,
        /// True if the plane is the half-plane of a body of revolution, x the radius.
        axisymmetric: bool,
    },
    /// No equation: a field of any number of components, without a material.
    None,
}

/// A linear elastic body in the plane; its constants may differ from place to place.
#[derive(Clone, Debug, PartialEq)]
pub struct Elasticity {
    /// Young's modulus E > 0, a stress.
    pub young: Expression,
    /// Poisson's ratio ν; see [`Material::poisson`] for its range.
    pub poisson: Expression,
    /// Plane strain, plane stress, or a body of revolution.
    pub state: StressState,
    /// Strains ε⁰ that make no stress where the body takes them: σ = C(ε − ε⁰).
    pub eigenstrain: Option<Box<Eigenstrain>>,
    /// The law of an anisotropic body, which takes the place of E and ν: these are those of an
    /// isotropic body of its size then.
    pub anisotropy: Option<Box<Anisotropy>>,
}

/// Strains that are given, by formulas and by a temperature of the field.
#[derive(Clone, Debug, PartialEq)]
pub struct Eigenstrain {
    /// ε⁰_xx, ε⁰_yy, ε⁰_xy and ε⁰_zz, such as α ΔT of a temperature given by a formula. ε⁰_zz has
    /// no effect in plane stress, and is the hoop strain in a body of revolution.
    pub strains: [Expression; 4],
    /// The coefficient α of thermal expansion, if the third component of the field is a change of
    /// temperature T: it strains the body by α T in all directions, beside `strains`.
    pub expansion: Option<Expression>,
}

impl From<[Expression; 4]> for Eigenstrain {
    fn from(strains: [Expression; 4]) -> Self {
        Self { strains, expansion: None }
    }
}

/// The names of the given strains in files and in formulas.
pub const EIGENSTRAINS: [&str; 4] =
    ["eigenstrain_xx", "eigenstrain_yy", "eigenstrain_xy", "eigenstrain_zz"];

/// The name of the component that is a change of temperature.
pub const TEMPERATURE: &str = "temperature";

/// The name of the coefficient of thermal expansion in files and in formulas.
pub const EXPANSION: &str = "expansion";

impl Elasticity {
    /// The material at a point.
    #[must_use]
    pub fn at(&self, p: Vec2) -> Material {
        Material { young: self.young.value(p), poisson: self.poisson.value(p), state: self.state }
    }

    /// The material, if it is isotropic and the same everywhere, however given strains vary.
    #[must_use]
    pub fn uniform(&self) -> Option<Material> {
        if self.anisotropy.is_some() {
            return None;
        }
        let (young, poisson) = (self.young.constant()?, self.poisson.constant()?);
        Some(Material { young, poisson, state: self.state })
    }
}

impl From<Material> for Elasticity {
    fn from(material: Material) -> Self {
        let Material { young, poisson, state } = material;
        let (young, poisson) = (young.into(), poisson.into());
        Self { young, poisson, state, eigenstrain: None, anisotropy: None }
    }
}

impl Equation {
    /// Elasticity of one material.
    #[must_use]
    pub fn elasticity(material: Material) -> Self {
        Self::Elasticity(material.into())
    }

    /// Poisson's equation with one conductivity κ.
    #[must_use]
    pub fn poisson(conductivity: f64) -> Self {
        Self::Poisson { conductivity: conductivity.into(), axisymmetric: false }
    }

    /// True if the body is one of revolution about x = 0, of which the plane is the half x ≥ 0.
    #[must_use]
    pub fn is_axisymmetric(&self) -> bool {
        match self {
            Self::Elasticity(body) => body.state == StressState::Axisymmetric,
            Self::Poisson { axisymmetric, .. } => *axisymmetric,
            Self::None => false,
        }
    }

    /// The names of the components of the field: ux and uy, and `temperature` of an elastic body
    /// with a coefficient of expansion; u of Poisson's equation; none without an equation.
    #[must_use]
    pub fn component_names(&self) -> &'static [&'static str] {
        match self {
            Self::Elasticity(_) if self.expansion().is_some() => &["ux", "uy", TEMPERATURE],
            Self::Elasticity(_) => &["ux", "uy"],
            Self::Poisson { .. } => &["u"],
            Self::None => &[],
        }
    }

    /// Number of components of the field: 2 for elasticity, 3 with a temperature, 1 for Poisson, 0
    /// without an equation.
    #[must_use]
    pub fn components(&self) -> usize {
        self.component_names().len()
    }

    /// The elastic body, if the equation has stresses.
    #[must_use]
    pub fn elastic(&self) -> Option<&Elasticity> {
        match self {
            Self::Elasticity(elasticity) => Some(elasticity),
            Self::Poisson { .. } | Self::None => None,
        }
    }

    /// The expressions of the material constants with their names: `young` and `poisson` or those
    /// of an [`Anisotropy`], `conductivity`, or none; after them the given strains and the
    /// coefficient of expansion, if there are any.
    pub fn constants(&self) -> impl Iterator<Item = (&'static str, &Expression)> {
        let list = match self {
            Self::Elasticity(Elasticity { anisotropy: Some(_), .. }) | Self::None => [None, None],
            Self::Elasticity(e) => [Some(("young", &e.young)), Some(("poisson", &e.poisson))],
            Self::Poisson { conductivity, .. } => [Some(("conductivity", conductivity)), None],
        };
        let expansion = self.expansion().map(|expansion| (EXPANSION, expansion));
        let isotropic = list.into_iter().flatten();
        isotropic.chain(self.stiffness()).chain(self.eigenstrains()).chain(expansion)
    }

    /// The law of an anisotropic body.
    #[must_use]
    pub fn anisotropy(&self) -> Option<&Anisotropy> {
        self.elastic()?.anisotropy.as_deref()
    }

    /// The constants of an anisotropic body with their names.
    pub fn stiffness(&self) -> impl Iterator<Item = (&'static str, &Expression)> {
        let body = self.elastic();
        body.into_iter().flat_map(|e| {
            e.anisotropy.iter().flat_map(|a| a.constants(e.state == StressState::PlaneStrain))
        })
    }

    /// The expressions of the given strains with their names.
    pub fn eigenstrains(&self) -> impl Iterator<Item = (&'static str, &Expression)> {
        let given = self.eigenstrain().map(|given| &given.strains);
        EIGENSTRAINS.into_iter().zip(given.into_iter().flatten())
    }

    /// The coefficient of thermal expansion of a body whose field has a temperature.
    #[must_use]
    pub fn expansion(&self) -> Option<&Expression> {
        self.eigenstrain()?.expansion.as_ref()
    }

    /// The equation of a body whose field has a temperature that strains it by a coefficient.
    #[must_use]
    pub fn with_expansion(&self, expansion: &Expression) -> Self {
        let mut equation = self.clone();
        if let Self::Elasticity(Elasticity { eigenstrain, .. }) = &mut equation {
            let zeros = || Box::new(Eigenstrain::from([0.0; 4].map(Expression::number)));
            eigenstrain.get_or_insert_with(zeros).expansion = Some(expansion.clone());
        }
        equation
    }

    /// The equation of a body without the temperature of its field.
    #[must_use]
    pub fn without_expansion(mut self) -> Self {
        if let Self::Elasticity(Elasticity { eigenstrain, .. }) = &mut self
            && let Some(given) = eigenstrain
            && given.expansion.take().is_some()
            && given.strains.iter().all(|e| e.constant() == Some(0.0))
        {
            *eigenstrain = None;
        }
        self
    }

    fn eigenstrain(&self) -> Option<&Eigenstrain> {
        self.elastic()?.eigenstrain.as_deref()
    }

    /// Sets the given strains to zero; those of a temperature of the field stay.
    pub(crate) fn clear_eigenstrains(&mut self) {
        if let Self::Elasticity(Elasticity { eigenstrain: Some(given), .. }) = self {
            given.strains = [0.0; 4].map(Expression::number);
        }
    }

    /// The error in the constants, if there is one: the name of the first impossible one, and the
    /// reason. Constants are checked once, formulas at the points of a grid that lie in the domain.
    #[must_use]
    pub fn invalid_constant(&self, domain: &Domain) -> Option<(&'static str, String)> {
        if self.is_uniform() {
            return self.invalid_constant_at(domain.bounds.center());
        }
        let at = |k: u32| f64::from(k) / f64::from(LOOKS);
        let (corner, size) = (domain.bounds.min, domain.bounds.size());
        let point = |j, i| corner + vec2(at(i) * size.x, at(j) * size.y);
        let points = (0..=LOOKS).flat_map(|j| (0..=LOOKS).map(move |i| point(j, i)));
        points.filter(|&p| domain.contains(p)).find_map(|p| {
            let place = format!(" at [{}, {}]", p.x, p.y);
            self.invalid_constant_at(p).map(|(name, message)| (name, message + &place))
        })
    }

    fn invalid_constant_at(&self, p: Vec2) -> Option<(&'static str, String)> {
        let expansion = self.expansion().map(|expansion| (EXPANSION, expansion));
        let given = self.eigenstrains().chain(expansion);
        let values = given.map(|(name, expression)| (name, expression.value(p)));
        let infinite = values.into_iter().find(|(_, value)| !value.is_finite());
        if let Some((name, value)) = infinite {
            return Some((name, format!("is {value}, but must be finite")));
        }
        let positive = |name, expression: &Expression| {
            let value = expression.value(p);
            let message = || (name, format!("is {value}, but must be positive and finite"));
            (!(value > 0.0 && value.is_finite())).then(message)
        };
        match self {
            Self::Elasticity(Elasticity {
                anisotropy: Some(_),
                state: StressState::Axisymmetric,
                ..
            }) => Some(("state", "is axisymmetric, but anisotropic bodies are plane".into())),
            Self::Elasticity(Elasticity { anisotropy: Some(law), state, .. }) => {
                law.invalid(*state == StressState::PlaneStrain, p)
            }
            Self::Elasticity(e) => positive("young", &e.young).or_else(|| {
                let nu = e.poisson.value(p);
                let (possible, rule) = match e.state {
                    StressState::PlaneStrain => (nu < 0.5, "-1 < ν < 0.5 in plane strain"),
                    StressState::PlaneStress => (nu <= 0.5, "-1 < ν ≤ 0.5 in plane stress"),
                    StressState::Axisymmetric => (nu < 0.5, "-1 < ν < 0.5 in a body of revolution"),
                };
                let message = || ("poisson", format!("is {nu}, but {rule}"));
                (!(possible && nu > -1.0)).then(message)
            }),
            Self::Poisson { conductivity, .. } => positive("conductivity", conductivity),
            Self::None => None,
        }
    }

    /// True if the constants are the same everywhere, given strains among them.
    #[must_use]
    pub fn is_uniform(&self) -> bool {
        self.constants().all(|(_, expression)| expression.constant().is_some())
    }

    /// True if the material is the same everywhere, however given strains vary.
    #[must_use]
    pub fn has_uniform_material(&self) -> bool {
        let (elastic, mut stiffness) = (self.elastic(), self.stiffness());
        let is_isotropic = |elastic: &&Elasticity| elastic.anisotropy.is_none();
        match elastic.filter(is_isotropic) {
            Some(elastic) => elastic.uniform().is_some(),
            None if elastic.is_some() => stiffness.all(|(_, e)| e.constant().is_some()),
            None => self.is_uniform(),
        }
    }

    /// The moduli at the points `anchor + offset` of some lanes.
    #[inline(always)]
    pub fn moduli<R: Real>(&self, anchor: Vec2, offset: [R; 2]) -> Moduli<R> {
        match self {
            Self::Elasticity(Elasticity { anisotropy: Some(law), eigenstrain, .. }) => {
                law.moduli(anchor, offset, eigenstrain.as_deref())
            }
            Self::Elasticity(e) => {
                let (young, poisson) =
                    (e.young.values(anchor, offset), e.poisson.values(anchor, offset));
                let axisymmetric = e.state == StressState::Axisymmetric;
                let moduli = Moduli { axisymmetric, ..Moduli::new(young, poisson, e.state) };
                match &e.eigenstrain {
                    None => moduli,
                    Some(given) => {
                        // neither `map` nor closures of vectors, which may not be inlined
                        let [xx, yy, xy, zz] = &given.strains;
                        let xx = xx.values(anchor, offset);
                        let yy = yy.values(anchor, offset);
                        let xy = xy.values(anchor, offset);
                        let eigenstrain = [xx, yy, xy, zz.values(anchor, offset)];
                        let expansion = match &given.expansion {
                            Some(expansion) => expansion.values(anchor, offset),
                            None => moduli.expansion,
                        };
                        Moduli { eigenstrain, expansion, ..moduli }.in_state(e.state)
                    }
                }
            }
            Self::Poisson { conductivity, .. } => {
                let zero = offset[0].broadcast(0.0);
                let conductivity = conductivity.values(anchor, offset);
                Moduli { conductivity, ..Moduli::all(zero) }
            }
            Self::None => Moduli::all(offset[0].broadcast(0.0)),
        }
    }
}

/// The constants of an equation at a point, as its quantities need them; zero where the equation
/// has no such constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moduli<R> {
    /// E, of an anisotropic body that of the third direction.
    pub young: R,
    /// ν
    pub poisson: R,
    /// λ of the plane law, see [`Material::lambda`]; c₁₂ of an anisotropic body.
    pub lambda: R,
    /// μ; c₆₆ of an anisotropic body.
    pub mu: R,
    /// c₁₁ − c₁₂ − 2c₆₆, c₂₂ − c₁₂ − 2c₆₆, c₁₆ and c₂₆ of an anisotropic body in the world's axes:
    /// zero of an isotropic one.
    pub anisotropy: [R; 4],
    /// σ_zz / (σ_xx + σ_yy)
    pub out_of_plane: R,
    /// κ of Poisson's equation.
    pub conductivity: R,
    /// ε⁰_xx, ε⁰_yy, ε⁰_xy and ε⁰_zz; the last is zero in plane stress, where it has no effect. Of
    /// an anisotropic body the first three are those under which the stresses of the plane vanish.
    pub eigenstrain: [R; 4],
    /// α of a body whose field has a temperature.
    pub expansion: R,
    /// α of the third direction: zero in plane stress.
    pub expansion_out: R,
    /// True if the third direction has the hoop strain of a body of revolution.
    pub axisymmetric: bool,
}

impl<R: Copy> Moduli<R> {
    /// One value for all.
    #[inline(always)]
    pub(crate) fn all(value: R) -> Self {
        Self {
            young: value,
            poisson: value,
            lambda: value,
            mu: value,
            anisotropy: [value; 4],
            out_of_plane: value,
            conductivity: value,
            eigenstrain: [value; 4],
            expansion: value,
            expansion_out: value,
            axisymmetric: false,
        }
    }
}

impl<R: Real> Moduli<R> {
    /// The moduli of an elastic material.
    #[inline(always)]
    #[must_use]
    pub fn new(young: R, poisson: R, state: StressState) -> Self {
        let (zero, one) = (young.broadcast(0.0), young.broadcast(1.0));
        let mu = young / (one.broadcast(2.0) * (one + poisson));
        let (denominator, out_of_plane) = match state {
            StressState::PlaneStrain | StressState::Axisymmetric => {
                ((one + poisson) * (one - one.broadcast(2.0) * poisson), poisson)
            }
            StressState::PlaneStress => (one - poisson * poisson, zero),
        };
        let lambda = young * poisson / denominator;
        Self { young, poisson, lambda, mu, out_of_plane, ..Self::all(zero) }
    }

    #[inline(always)]
    fn in_state(self, state: StressState) -> Self {
        let [xx, yy, xy, zz] = self.eigenstrain;
        let (zz, out) = match state {
            StressState::PlaneStress => (zz.broadcast(0.0), zz.broadcast(0.0)),
            StressState::PlaneStrain | StressState::Axisymmetric => (zz, self.expansion),
        };
        Self { eigenstrain: [xx, yy, xy, zz], expansion_out: out, ..self }
    }

    /// The moduli where a change of temperature T strains the body by α T beside what is given.
    #[inline(always)]
    #[must_use]
    pub fn heated(&self, temperature: R) -> Self {
        let [xx, yy, xy, zz] = self.eigenstrain;
        let (plane, out) = (self.expansion * temperature, self.expansion_out * temperature);
        Self { eigenstrain: [xx + plane, yy + plane, xy, zz + out], ..*self }
    }

    /// The moduli where the third direction takes a hoop strain: that of plane strain, of which it
    /// is given away, has the same stresses.
    #[inline(always)]
    #[must_use]
    pub fn with_hoop_strain(&self, hoop: R) -> Self {
        let [xx, yy, xy, zz] = self.eigenstrain;
        Self { eigenstrain: [xx, yy, xy, zz - hoop], ..*self }
    }

    /// The strains in the plane under which σ_xx, σ_yy and σ_xy vanish: those given, and in plane
    /// strain ν ε⁰_zz in all directions, as ε_zz = 0 leaves −ε⁰_zz in the third.
    #[inline(always)]
    #[must_use]
    pub fn plane_eigenstrain(&self) -> [R; 3] {
        let [xx, yy, xy, zz] = self.eigenstrain;
        let through = self.out_of_plane * zz;
        [xx + through, yy + through, xy]
    }
}

/// Isotropic linear elastic material in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Young's modulus E > 0, a stress.
    pub young: f64,
    /// Poisson's ratio, −1 < ν < 1/2 (plane stress: −1 < ν ≤ 1/2).
    pub poisson: f64,
    /// Plane strain, plane stress, or a body of revolution.
    pub state: StressState,
}

/// The assumption about the third direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StressState {
    /// ε_zz = 0.
    PlaneStrain,
    /// σ_zz = 0.
    PlaneStress,
    /// The third direction is that around the axis x = 0 of a body of revolution, with the strain
    /// u_x/x. The moduli are those of plane strain, as the fields of cracks are.
    Axisymmetric,
}

impl Material {
    /// Shear modulus μ = E / (2 (1 + ν)).
    #[must_use]
    pub fn mu(&self) -> f64 {
        self.moduli().mu
    }

    /// Lamé's λ of the plane law σ = 2μ ε + λ tr(ε) I over the in-plane components:
    /// Eν / ((1+ν)(1−2ν)) in plane strain, Eν / (1−ν²) in plane stress.
    #[must_use]
    pub fn lambda(&self) -> f64 {
        self.moduli().lambda
    }

    /// Kolosov's constant κ: 3 − 4ν in plane strain, (3 − ν)/(1 + ν) in plane stress.
    #[must_use]
    pub fn kolosov(&self) -> f64 {
        match self.state {
            StressState::PlaneStrain | StressState::Axisymmetric => 3.0 - 4.0 * self.poisson,
            StressState::PlaneStress => (3.0 - self.poisson) / (1.0 + self.poisson),
        }
    }

    /// E′ of G = K²/E′: E/(1 − ν²) in plane strain, E in plane stress.
    #[must_use]
    pub fn effective_young(&self) -> f64 {
        match self.state {
            StressState::PlaneStress => self.young,
            _ => self.young / (1.0 - self.poisson * self.poisson),
        }
    }

    /// σ_zz / (σ_xx + σ_yy): ν in plane strain, 0 in plane stress.
    #[must_use]
    pub fn out_of_plane(&self) -> f64 {
        self.moduli().out_of_plane
    }

    fn moduli(&self) -> Moduli<f64> {
        Moduli::new(self.young, self.poisson, self.state)
    }
}
