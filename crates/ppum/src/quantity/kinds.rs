//! The quantities: their names, what they need, and their values.

use std::borrow::Cow;
use std::sync::Arc;

use super::face::{FaceQuantity, face_names};
use super::foreign::own_name;
use super::formula::{QuantityFormula, QuantityFormulaError, Vocabulary};
use super::sample::{Sample, Source};
use super::tensors::Strain;
use crate::crack::Side;
use crate::dataset::NamedQuantity;
use crate::equation::{Equation, Moduli, TEMPERATURE};
use crate::field::{Field, LocalField};
use crate::jet::Jet;
use crate::library::{ANISOTROPY, HEAT};
use crate::text::hint;
use crate::vec2::Vec2;
use ppum_formula::real::Real;

/// A scalar made of a field. Made from its name or formula with [`Quantity::parse`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Quantity {
    /// One component of the field: `ux`, `uy`, `u`.
    Component(u8),
    /// Euclidean norm of all components: `magnitude`.
    Magnitude,
    /// ∂u_c/∂x or ∂u_c/∂y: `dux_dx`, `dux_dy`, …
    Derivative(u8, Axis),
    /// Frobenius norm of the gradient: `gradient`.
    GradientNorm,
    /// ∂u_x/∂x + ∂u_y/∂y: `divergence`.
    Divergence,
    /// ∂u_y/∂x − ∂u_x/∂y: `curl`.
    Curl,
    /// Strain component ε_xx, ε_yy, ε_xy (tensor, not engineering): `exx`, `eyy`, `exy`.
    Strain(Axis, Axis),
    /// Stress component σ_xx, σ_yy, σ_xy: `sxx`, `syy`, `sxy`.
    Stress(Axis, Axis),
    /// σ_zz: `szz`.
    StressOut,
    /// √(3/2 s:s) of the deviator s of the full stress tensor: `von-mises`.
    VonMises,
    /// Largest difference of principal stresses, the third included: `tresca`.
    Tresca,
    /// Larger in-plane principal stress: `s1`.
    Principal1,
    /// Smaller in-plane principal stress: `s2`.
    Principal2,
    /// Angle of the direction of s1 from the x axis, in (−π/2, π/2], radians: `direction`.
    PrincipalDirection,
    /// tr(σ)/3 of the full tensor: `hydrostatic`.
    Hydrostatic,
    /// ½ σ:(ε − ε⁰), or ½ κ |∇u|²: `energy`.
    EnergyDensity,
    /// |u − u_exact|: `error`.
    Error,
    /// S = Σ W_i: `weight-sum`.
    WeightSum,
    /// Number of patches that cover the point: `overlap`.
    Overlap,
    /// φ_i of patch i: `phi:7`.
    PartitionFunction(u32),
    /// A quantity of the faces of cracks: `normal-traction`, …
    Face(Arc<FaceQuantity<Quantity>>),
    /// A formula of the others: `sqrt(ux^2 + uy^2)`.
    Formula(Arc<QuantityFormula>),
}

/// A coordinate direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Horizontal.
    X,
    /// Vertical.
    Y,
}

/// A quantity that is not known, or has no meaning for the field.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum QuantityError {
    /// No such name.
    #[error("there is no quantity `{name}`{hint}; known are {known}, and formulas of them")]
    Unknown {
        /// The name asked for.
        name: String,
        /// A suggestion, if a known name is similar, see [`hint`].
        hint: String,
        /// All names that have a meaning for the field.
        known: String,
    },
    /// Needs the exact solution.
    #[error("`{0}` needs the exact solution, which this dataset does not hold")]
    NoExact(String),
    /// A patch that does not exist.
    #[error("there is no patch {patch}; the partition has {count} (numbered from 0)")]
    Patch {
        /// The patch asked for.
        patch: u32,
        /// Number of patches.
        count: usize,
    },
    /// Has values on faces of cracks alone.
    #[error(
        "`{0}` has values on the faces of cracks only: sample or plot it along a crack, or probe a point of one"
    )]
    Face(&'static str),
    /// A formula is wrong.
    #[error("{0}")]
    Formula(#[from] QuantityFormulaError),
}

use Quantity as Q;

/// A quantity with its name, and its symbol for labels.
type NamedRow = (&'static str, &'static str, Quantity);

/// The quantities every field of the equation has, besides components and derivatives.
const GENERAL: [NamedRow; 6] = [
    ("magnitude", "|u|", Q::Magnitude),
    ("gradient", "|∇u|", Q::GradientNorm),
    ("energy", "energy density", Q::EnergyDensity),
    ("error", "|u − u_{exact}|", Q::Error),
    ("weight-sum", "Σ W", Q::WeightSum),
    ("overlap", "patches covering", Q::Overlap),
];

/// The quantities of elasticity.
pub(super) const ELASTIC: [NamedRow; 15] = [
    ("divergence", "div u", Q::Divergence),
    ("curl", "curl u", Q::Curl),
    ("exx", "ε_{xx}", Q::Strain(Axis::X, Axis::X)),
    ("eyy", "ε_{yy}", Q::Strain(Axis::Y, Axis::Y)),
    ("exy", "ε_{xy}", Q::Strain(Axis::X, Axis::Y)),
    ("sxx", "σ_{xx}", Q::Stress(Axis::X, Axis::X)),
    ("syy", "σ_{yy}", Q::Stress(Axis::Y, Axis::Y)),
    ("sxy", "σ_{xy}", Q::Stress(Axis::X, Axis::Y)),
    ("szz", "σ_{zz}", Q::StressOut),
    ("von-mises", "von Mises stress", Q::VonMises),
    ("tresca", "Tresca stress", Q::Tresca),
    ("s1", "principal stress σ_{1}", Q::Principal1),
    ("s2", "principal stress σ_{2}", Q::Principal2),
    ("direction", "direction of σ_{1}", Q::PrincipalDirection),
    ("hydrostatic", "hydrostatic stress", Q::Hydrostatic),
];

/// Names and symbols of the quantities of heat, which are formulas of the library.
const HEAT_SYMBOLS: [(&str, &str); HEAT] =
    [("temperature", "T"), ("qx", "q_{x}"), ("qy", "q_{y}"), ("flux", "|q|")];

/// The quantities of [`ELASTIC`] before those of stresses.
const STRAINS_ALONE: usize = 5;

/// All names with a meaning for a field with these components, with their quantities; the φ of a
/// patch, `phi:N`, comes on top.
#[must_use]
pub fn names(equation: &Equation, components: &[String]) -> Vec<(String, Quantity)> {
    let mut all = Vec::new();
    for (c, name) in (0..=u8::MAX).zip(components) {
        all.push((name.clone(), Q::Component(c)));
        all.push((format!("d{name}_dx"), Q::Derivative(c, Axis::X)));
        all.push((format!("d{name}_dy"), Q::Derivative(c, Axis::Y)));
    }
    let solves = components.len() == equation.components();
    let elastic: &[_] = if solves && equation.elastic().is_some() { &ELASTIC } else { &[] };
    // those of stresses in an anisotropic body are formulas of the library
    let is_isotropic = equation.anisotropy().is_none();
    let elastic = if is_isotropic { elastic } else { &elastic[..elastic.len().min(STRAINS_ALONE)] };
    // a temperature is no part of a size: of a field with one, sizes are formulas of the library
    let has_sizes = !solves || equation.expansion().is_none();
    let is_round = solves && equation.is_axisymmetric();
    let has = |quantity: &Quantity| match quantity {
        Q::StressOut => !is_round,
        Q::EnergyDensity => solves && is_isotropic,
        Q::Magnitude | Q::GradientNorm => has_sizes,
        _ => true,
    };
    let known = GENERAL.iter().chain(elastic).filter(|(.., quantity)| has(quantity));
    all.extend(known.map(|(name, _, q)| ((*name).to_owned(), q.clone())));
    all
}

/// Names of all that can be shown of a field: those of its equation that have what they need, those
/// that the dataset defines, and `phi:N`.
#[must_use]
pub fn available(field: &Field<'_>) -> Vec<String> {
    let all = names(field.equation, &field.data.components);
    let usable = all.into_iter().filter(|(_, quantity)| quantity.check(field).is_ok());
    let usable = usable.map(|(name, _)| name);
    let sizes = ["magnitude", "gradient"].into_iter().filter(|_| field.has_temperature());
    // formulas of the library are of components with the names of the equation
    let is_named = field.data.components == field.equation.component_names();
    let has_formulas = is_named && field.is_displacement();
    let is_anisotropic = has_formulas && field.equation.anisotropy().is_some();
    let stresses = ANISOTROPY.iter().map(|(name, _)| *name).filter(|_| is_anisotropic);
    let is_round = has_formulas && field.equation.is_axisymmetric();
    let around = ["ehoop", "shoop"].into_iter().filter(|_| is_round);
    let is_heat = is_named && matches!(field.equation, Equation::Poisson { .. });
    let is_free = |name: &&str| field.quantities.iter().all(|named| named.name != **name);
    let heat = HEAT_SYMBOLS.iter().map(|(name, _)| *name).filter(|_| is_heat).filter(is_free);
    let sizes = sizes.chain(stresses).chain(around).chain(heat);
    let named = field
        .quantities
        .iter()
        .map(|quantity| quantity.name.clone())
        .filter(|name| Quantity::parse(name, field).is_ok());
    usable
        .chain(sizes.map(|name| name.replace('_', "-")))
        .chain(named)
        .chain(["phi:N".into()])
        .collect()
}

/// The name of a formula's quantity, with `_` for `-`; formulas as they are.
fn underscored(text: &str) -> Cow<'_, str> {
    let is_name = ELASTIC.iter().any(|(name, ..)| *name == text);
    if is_name { text.replace('-', "_").into() } else { text.into() }
}

/// Symbol and unit of a quantity of heat.
fn heat_label<'f>(text: &str, field: &Field<'f>) -> Option<(&'static str, &'f str)> {
    let is_heat = matches!(field.equation, Equation::Poisson { .. });
    let (name, symbol) = *HEAT_SYMBOLS.iter().find(|(name, _)| is_heat && *name == text)?;
    Some((symbol, if name == TEMPERATURE { &field.data.unit } else { "" }))
}

impl QuantityError {
    fn unknown(name: &str, known: Vec<String>) -> Self {
        let is_known = |name: &str| known.iter().any(|known| known == name);
        let own = own_name(name).filter(|own| is_known(own));
        let hint = match own {
            _ if name == "szz" && is_known("shoop") => {
                "; the third stress of a body of revolution is `shoop`".to_owned()
            }
            Some(own) => format!(" (did you mean `{own}`?)"),
            None => hint(name, known.iter().map(String::as_str)),
        };
        Self::Unknown { name: name.into(), hint, known: known.join(", ") }
    }
}

impl Quantity {
    /// The quantity of a name, for a field with these components.
    ///
    /// # Errors
    /// [`QuantityError::Unknown`], which lists what there is.
    pub fn from_name(
        name: &str,
        equation: &Equation,
        components: &[String],
    ) -> Result<Self, QuantityError> {
        if let Some(patch) = name.strip_prefix("phi:").and_then(|n| n.parse().ok()) {
            return Ok(Self::PartitionFunction(patch));
        }
        let all = names(equation, components);
        all.iter()
            .find(|(known, _)| known == name)
            .map(|(_, quantity)| quantity.clone())
            .ok_or_else(|| {
                let known = all.iter().map(|(known, _)| known.clone());
                QuantityError::unknown(name, known.chain(["phi:N".into()]).collect())
            })
    }

    /// The quantity of a name, one the dataset names, or a formula of the names; see
    /// [`QuantityFormula`].
    ///
    /// # Errors
    /// [`QuantityError::Unknown`] for a single word that means nothing, [`QuantityError::Formula`]
    /// for a formula that is wrong.
    pub fn parse(text: &str, field: &Field<'_>) -> Result<Self, QuantityError> {
        let components = &field.data.components;
        let text = text.trim();
        if let Ok(known) = Self::from_name(text, field.equation, components) {
            return Ok(known);
        }
        let mut vocabulary = Vocabulary::of(field);
        if let Some(at) = field.quantities.iter().position(|named| named.name == text) {
            let NamedQuantity { name, text, unit } = &field.quantities[at];
            vocabulary.named = &field.quantities[..at];
            let formula = QuantityFormula::new(text, &vocabulary)?.named(name, unit);
            return Ok(Self::Formula(Arc::new(formula)));
        }
        if let Some(face) = FaceQuantity::parse(text, field, |name| Self::parse(name, field).ok()) {
            return Ok(Self::Face(Arc::new(face)));
        }
        let is_name = text.starts_with(char::is_alphabetic)
            && text.chars().all(|c| c.is_alphanumeric() || "_-:".contains(c));
        match QuantityFormula::new(&underscored(text), &vocabulary) {
            Ok(formula) if field.equation.anisotropy().is_some() => {
                let row = ELASTIC.iter().chain(&GENERAL).find(|(name, ..)| *name == text);
                let symbol = row.map(|(_, symbol, _)| *symbol);
                Ok(Self::Formula(Arc::new(match symbol {
                    Some(symbol) => formula.named(symbol, ""),
                    None => formula,
                })))
            }
            Ok(formula) => Ok(Self::Formula(Arc::new(match heat_label(text, field) {
                Some((symbol, unit)) => formula.named(symbol, unit),
                None => formula,
            }))),
            Err(_) if is_name => {
                let faces = face_names(field).map(str::to_owned);
                Err(QuantityError::unknown(
                    text,
                    available(field).into_iter().chain(faces).collect(),
                ))
            }
            Err(error) => Err(error.into()),
        }
    }

    /// The ingredients of the quantity.
    #[must_use]
    pub fn source(&self) -> Source {
        match self {
            Q::Component(_) | Q::Magnitude => Source::Values,
            Q::Error => Source::Exact,
            Q::WeightSum | Q::Overlap | Q::PartitionFunction(_) => Source::Partition,
            Q::Formula(formula) => formula.source(),
            _ => Source::Gradient,
        }
    }

    /// Evaluates a quantity of values and gradients; quantities of the partition give NaN here.
    #[inline(always)]
    pub fn of_field<R: Real>(&self, at: &Sample<'_, R>) -> R {
        let u = at.jets;
        let value = match self {
            Q::Component(c) => return u[*c as usize].v,
            Q::Magnitude => return norm(u.iter().map(|jet| jet.v), u[0].v),
            Q::Error => return distance(u, at.exact),
            Q::Formula(formula) => return formula.evaluate(at),
            Q::Derivative(c, Axis::X) => u[*c as usize].x,
            Q::Derivative(c, Axis::Y) => u[*c as usize].y,
            Q::GradientNorm => norm(u.iter().flat_map(|jet| [jet.x, jet.y]), u[0].v),
            Q::EnergyDensity if u.len() == 1 => {
                let square = u[0].x.mul_add(u[0].x, u[0].y * u[0].y);
                square * square.broadcast(0.5) * at.moduli.conductivity
            }
            _ if u.len() < 2 => u[0].v.broadcast(f64::NAN),
            _ => {
                let strain = Strain::new(u);
                let moduli = if u.len() > 2 { at.moduli.heated(u[2].v) } else { at.moduli };
                if moduli.axisymmetric {
                    let hoop = at.hoop_strain();
                    match self {
                        Q::Divergence => strain.xx + strain.yy + hoop,
                        _ => self.of_strain(&moduli.with_hoop_strain(hoop), &strain),
                    }
                } else {
                    self.of_strain(&moduli, &strain)
                }
            }
        };
        at.apart(R::select(value.ge(value), value, value.broadcast(f64::INFINITY)))
    }

    #[inline(always)]
    fn of_strain<R: Real>(&self, moduli: &Moduli<R>, e: &Strain<R>) -> R {
        let elastic = e.elastic(moduli);
        let s = elastic.stress(moduli);
        match self {
            Q::Divergence => e.xx + e.yy,
            Q::Curl => e.curl,
            Q::Strain(Axis::X, Axis::X) => e.xx,
            Q::Strain(Axis::Y, Axis::Y) => e.yy,
            Q::Strain(..) => e.xy,
            Q::Stress(Axis::X, Axis::X) => s.xx,
            Q::Stress(Axis::Y, Axis::Y) => s.yy,
            Q::Stress(..) => s.xy,
            Q::StressOut => s.zz,
            Q::VonMises => s.von_mises(),
            Q::Tresca => s.tresca(),
            Q::Principal1 => s.center() + s.radius(),
            Q::Principal2 => s.center() - s.radius(),
            Q::PrincipalDirection => s.direction(),
            Q::Hydrostatic => (s.xx + s.yy + s.zz) * s.xx.broadcast(1.0 / 3.0),
            Q::EnergyDensity => elastic.energy(&s, moduli),
            _ => s.xx.broadcast(f64::NAN),
        }
    }

    /// Checks that the field has what the quantity needs, and values everywhere in the body.
    ///
    /// # Errors
    /// No exact solution, no such patch; a quantity of the faces of cracks.
    pub fn check(&self, field: &Field<'_>) -> Result<(), QuantityError> {
        match self {
            Q::Face(face) => Err(QuantityError::Face(face.name())),
            _ => self.check_at_points(field),
        }
    }

    /// Checks that the field has what the quantity needs, of which some points have values, maybe
    /// those on faces of cracks only.
    ///
    /// # Errors
    /// No exact solution, no such patch.
    pub fn check_at_points(&self, field: &Field<'_>) -> Result<(), QuantityError> {
        let count = field.step.partition.len();
        match *self {
            Q::Error if !field.has_exact() => Err(QuantityError::NoExact("error".into())),
            Q::PartitionFunction(patch) if patch as usize >= count => {
                Err(QuantityError::Patch { patch, count })
            }
            _ => Ok(()),
        }
    }

    /// The quantity at `anchor + offset`, the reference of every other evaluator; NaN outside the
    /// domain. On a crack the given side is taken.
    pub fn at(&self, local: &mut LocalField<'_>, offset: Vec2, side: Side) -> f64 {
        let mut u = vec![Jet::constant(0.0); local.field.components()];
        let inside = match self.source() {
            Source::Partition => return self.of_partition(local, offset).unwrap_or(f64::NAN),
            Source::Gradient => local.evaluate::<1>(offset, side, &mut u),
            Source::Values | Source::Exact => local.evaluate::<0>(offset, side, &mut u),
        };
        match self {
            _ if !inside => f64::NAN,
            Q::Face(face) => face.of_jets(local, (offset, side), &u, Self::of_values),
            _ => self.of_values(local, offset, &u),
        }
    }

    /// A quantity of the partition; `None` outside the domain and for other quantities.
    pub(super) fn of_partition(&self, local: &mut LocalField<'_>, offset: Vec2) -> Option<f64> {
        match *self {
            Q::WeightSum => Some(local.covering::<0>(offset)?.weight_sum.v),
            Q::Overlap => Some(local.covering::<0>(offset)?.overlap as f64),
            Q::PartitionFunction(patch) => {
                Some(local.partition_function::<0>(patch as usize, offset)?.v)
            }
            _ => None,
        }
    }

    /// The unit of the quantity for labels, if the dataset gives one: that of the field for
    /// components and magnitude, that of a quantity which the dataset names.
    #[must_use]
    pub fn unit<'q>(&'q self, field: &'q Field<'_>) -> &'q str {
        match self {
            Q::Component(_) | Q::Magnitude => &field.data.unit,
            Q::Face(face) if face.is_jump() => &field.data.unit,
            Q::Formula(formula) => formula.unit(),
            _ => "",
        }
    }

    /// The symbol of the quantity for labels, with subscripts as `_{…}`: `σ_{yy}`, `∂u_{x}/∂y`.
    #[must_use]
    pub fn symbol(&self, components: &[String]) -> String {
        let component = |c: u8| match components {
            [only] => only.clone(),
            [.., last] if c == 2 && last == TEMPERATURE => "T".into(),
            _ => format!("u_{{{}}}", ["x", "y", "z"].get(c as usize).unwrap_or(&"?")),
        };
        // strains and stresses are symmetric
        let listed = match self {
            Q::Strain(Axis::Y, Axis::X) => &Q::Strain(Axis::X, Axis::Y),
            Q::Stress(Axis::Y, Axis::X) => &Q::Stress(Axis::X, Axis::Y),
            other => other,
        };
        match self {
            Q::Formula(formula) => formula.label(),
            Q::Face(face) => face.symbol().to_owned(),
            Q::Component(c) => component(*c),
            Q::Derivative(c, axis) => format!("∂{}/∂{}", component(*c), axis.name()),
            Q::PartitionFunction(patch) => format!("φ_{{{patch}}}"),
            _ => {
                let row = GENERAL.iter().chain(&ELASTIC).find(|(.., known)| known == listed);
                row.map_or_else(String::new, |(_, symbol, _)| (*symbol).to_owned())
            }
        }
    }
}

impl Axis {
    /// `x` or `y`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
        }
    }
}

/// √Σ v²
#[inline(always)]
fn norm<R: Real>(values: impl Iterator<Item = R>, like: R) -> R {
    let mut square = like.broadcast(0.0);
    for v in values {
        square = v.mul_add(v, square);
    }
    square.sqrt()
}

/// √Σ (u − e)²
#[inline(always)]
fn distance<R: Real>(u: &[Jet<R>], exact: &[R]) -> R {
    let (mut square, mut c) = (u[0].v.broadcast(0.0), 0);
    while c < u.len() {
        let difference = u[c].v - exact[c];
        square = difference.mul_add(difference, square);
        c += 1;
    }
    square.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equation::{Material, StressState};

    fn material(state: StressState) -> Material {
        Material { young: 1.0, poisson: 0.3, state }
    }

    /// Displacement gradient that produces a given stress, by the inverse law written out.
    fn gradient(m: &Material, sxx: f64, syy: f64, sxy: f64) -> [Jet<f64>; 2] {
        let (e, nu) = (m.young, m.poisson);
        let szz = m.out_of_plane() * (sxx + syy);
        let strain = |a: f64, b: f64, c: f64| (a - nu * (b + c)) / e;
        let shear = (1.0 + nu) / e * sxy;
        let jet = |x, y| Jet { x, y, ..Jet::constant(0.0) };
        [jet(strain(sxx, syy, szz), shear), jet(shear, strain(syy, sxx, szz))]
    }

    fn value(m: Material, u: &[Jet<f64>], name: &str) -> f64 {
        let names = ["ux".to_owned(), "uy".to_owned()];
        let quantity = Quantity::from_name(name, &Equation::elasticity(m), &names);
        let moduli = Moduli::new(m.young, m.poisson, m.state);
        let (anchor, offset) = (Vec2::ZERO, [0.0, 0.0]);
        quantity.expect("known name").of_field(&Sample {
            anchor,
            offset,
            moduli,
            jets: u,
            exact: &[],
        })
    }

    #[test]
    fn stresses_from_the_inverse_law() {
        for state in [StressState::PlaneStrain, StressState::PlaneStress] {
            let m = material(state);
            let u = gradient(&m, 3.0, -1.0, 2.0);
            let szz = if state == StressState::PlaneStrain { 0.6 } else { 0.0 };
            let radius = 8f64.sqrt();
            let energy = 0.5 * (3.0 * u[0].x - u[1].y + 4.0 * u[0].y);
            let mises = (0.5 * (16.0 + (1.0 + szz) * (1.0 + szz) + (szz - 3.0) * (szz - 3.0))
                + 12.0f64)
                .sqrt();
            for (name, expected) in [
                ("sxx", 3.0),
                ("syy", -1.0),
                ("sxy", 2.0),
                ("szz", szz),
                ("s1", 1.0 + radius),
                ("s2", 1.0 - radius),
                ("tresca", 2.0 * radius),
                ("von-mises", mises),
                ("hydrostatic", (2.0 + szz) / 3.0),
                ("direction", 0.5 * 4f64.atan2(4.0)),
                ("energy", energy),
                ("divergence", u[0].x + u[1].y),
                ("curl", 0.0),
            ] {
                assert!((value(m, &u, name) - expected).abs() < 1e-14, "{name} {state:?}");
            }
        }
    }

    #[test]
    fn direction_all_round() {
        let m = material(StressState::PlaneStress);
        for k in -49..=50 {
            let angle = f64::from(k) / 100.0 * std::f64::consts::PI;
            let (c, s) = ((2.0 * angle).cos(), (2.0 * angle).sin());
            let found = value(m, &gradient(&m, 1.0 + c, 1.0 - c, s), "direction");
            let mut apart = (found - angle).abs();
            apart = apart.min(std::f64::consts::PI - apart);
            assert!(apart < 1e-12, "{angle} {found}");
        }
    }

    #[test]
    fn infinite_where_the_gradient_does_not_exist() {
        let m = material(StressState::PlaneStrain);
        let nan = Jet { x: f64::NAN, y: f64::NAN, ..Jet::constant(0.0) };
        let components = ["ux".to_owned(), "uy".to_owned()];
        let all = names(&Equation::elasticity(m), &components);
        let of_gradient = all.iter().filter(|(_, q)| q.source() == Source::Gradient);
        for (name, _) in of_gradient {
            assert_eq!(value(m, &[nan, nan], name), f64::INFINITY, "{name}");
        }
        assert_eq!(value(m, &[nan, nan], "ux"), 0.0);
        assert_eq!(value(m, &[Jet::constant(0.0); 2], "direction"), 0.0);
    }

    #[test]
    fn symbols_name_the_components() {
        let (one, two) = (["u".to_owned()], ["ux".to_owned(), "uy".to_owned()]);
        for (quantity, components, expected) in [
            (Quantity::Stress(Axis::Y, Axis::Y), &two[..], "σ_{yy}"),
            (Quantity::Derivative(0, Axis::Y), &two[..], "∂u_{x}/∂y"),
            (Quantity::Derivative(0, Axis::X), &one[..], "∂u/∂x"),
            (Quantity::Component(1), &two[..], "u_{y}"),
            (Quantity::PartitionFunction(7), &two[..], "φ_{7}"),
        ] {
            assert_eq!(quantity.symbol(components), expected);
        }
    }

    /// Stresses are made of displacements: a temperature beside them has none.
    #[test]
    fn other_fields_have_no_stress() {
        let equation = Equation::elasticity(material(StressState::PlaneStrain));
        let one = ["temperature".to_owned()];
        for name in ["von-mises", "energy", "divergence"] {
            assert!(Quantity::from_name(name, &equation, &one).is_err());
        }
        assert!(Quantity::from_name("gradient", &equation, &one).is_ok());
    }

    #[test]
    fn unknown_names_list_the_known() {
        let equation = Equation::poisson(1.0);
        let error =
            Quantity::from_name("sxx", &equation, &["u".to_owned()]).expect_err("no stress");
        assert!(error.to_string().contains("du_dx"), "{error}");
    }
}
