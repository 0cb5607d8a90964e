//! Gradients of quantities, exact: no differences.
//!
//! A quantity q is a formula of the position, the field's values and first derivatives and the
//! moduli. Its gradient is the chain rule over these inputs a,
//!
//! ```text
//! ∇q = Σ_a ∂q/∂a ∇a        ∇(∂u/∂x) = (u_xx, u_xy)   ∇λ = ∂λ/∂E ∇E + ∂λ/∂ν ∇ν   …
//! ```
//!
//! with the formula differentiated symbolically and the field's Hessian, through weights, functions
//! and polynomials. Built-in quantities are differentiated from
//! their [texts](crate::library::ELASTICITY).

use super::formula::{QuantityFormula, QuantityFormulaError, QuantityInput, Vocabulary};
use super::kinds::{Axis, ELASTIC, Quantity, QuantityError};
use super::material::MaterialGradient;
use super::sample::Sample;
use crate::crack::Side;
use crate::equation::Moduli;
use crate::field::{Field, LocalField};
use crate::jet::Jet;
use crate::vec2::{Vec2, vec2};
use ppum_formula::FormulaJets;

/// A quantity with its gradient at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValueWithGradient {
    /// q, that of [`Quantity::at`].
    pub value: f64,
    /// ∇q = (∂q/∂x, ∂q/∂y).
    pub gradient: Vec2,
}

/// A quantity of a field, ready to be evaluated with its gradient.
///
/// ```
/// use ppum::prelude::*;
/// use ppum::quantity::QuantityGradient;
///
/// // one patch, u = 1 + 2ξ² with ξ = x / 1.25
/// let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
/// let partition = Cover::uniform(domain, 0)?.partition(1.25, WeightFunction::Linear)?;
/// let mut potential = FieldData::new("potential", &["u"]);
/// potential.push_patch(&[(0, 2)]);
/// let coefficients = [1.0, 0.0, 0.0, 2.0, 0.0, 0.0];
/// potential.coefficients_mut(0).for_each(|c| c.copy_from_slice(&coefficients));
/// let step = Step::new(partition).with_function("one", FunctionKind::One).with_field(potential);
/// let dataset = Dataset::new(domain, Equation::poisson(1.0)).with_step(step);
/// let field = Field::new(&dataset, 0)?;
/// let slope = QuantityGradient::new(&Quantity::parse("du_dx^2", &field)?, &field)?;
/// let at = slope.at(&mut field.at(vec2(0.5, 0.0)), Vec2::ZERO, Side::Above);
/// let curvature: f64 = 4.0 / (1.25 * 1.25); // u_x = curvature · x
/// assert!((at.value - (0.5 * curvature).powi(2)).abs() < 1e-14);
/// assert!((at.gradient.x - curvature * curvature).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct QuantityGradient {
    quantity: Quantity,
    rule: GradientRule,
}

/// How the gradient is found.
#[derive(Clone, Debug)]
enum GradientRule {
    /// Derivatives of the partition of unity.
    Partition,
    /// A component.
    Component(usize),
    /// A derivative of a component.
    Derivative(usize, Axis),
    /// The norm of the components.
    Norm,
    /// The norm of their gradients.
    GradientNorm,
    /// The norm of what they are less the exact solution, given by formulas with their derivatives.
    Error(Vec<FormulaJets>),
    /// The chain rule.
    Chain(Box<FormulaChain>),
}

/// A formula with its derivatives with respect to its inputs.
#[derive(Clone, Debug)]
struct FormulaChain {
    jets: FormulaJets,
    /// The inputs: their indices in the scope and their origins, in the order of the derivatives.
    inputs: Vec<(usize, QuantityInput)>,
    n_inputs: usize,
    /// `None` if the material is the same everywhere.
    material: Option<MaterialGradient>,
}

impl QuantityGradient {
    /// Differentiates a quantity of a field.
    ///
    /// # Errors
    /// The field lacks what the quantity needs, or the derivatives are too large.
    pub fn new(quantity: &Quantity, field: &Field<'_>) -> Result<Self, QuantityError> {
        quantity.check(field)?;
        Ok(Self { quantity: quantity.clone(), rule: GradientRule::new(quantity, field)? })
    }

    /// The quantity.
    #[must_use]
    pub fn quantity(&self) -> &Quantity {
        &self.quantity
    }

    /// Value and gradient at `anchor + offset`; on a crack those of the given side, NaN outside the
    /// domain.
    ///
    /// Where the quantity has no gradient, as |u| at u = 0, σ₁ where both principal stresses are
    /// one, or stresses at a tip, it is not finite, or that of one piece, as
    /// [formulas](ppum_formula) say. Costs a few times [`Quantity::at`].
    ///
    /// # Panics
    /// If the field has fewer components than the one that this was made for.
    #[must_use]
    pub fn at(&self, local: &mut LocalField<'_>, offset: Vec2, side: Side) -> ValueWithGradient {
        if matches!(self.rule, GradientRule::Partition) {
            return self.of_partition(local, offset);
        }
        let mut jets = vec![Jet::constant(0.0); local.field.components()];
        let inside = match self.rule {
            GradientRule::Component(_) | GradientRule::Norm | GradientRule::Error(_) => {
                local.evaluate::<1>(offset, side, &mut jets)
            }
            _ => local.evaluate::<2>(offset, side, &mut jets),
        };
        if inside { self.of_jets(local, offset, &jets) } else { ValueWithGradient::NOWHERE }
    }

    /// Evaluates at many points on lanes: points that follow each other should be near each other.
    /// The numbers are those of [`at`](Self::at) up to rounding.
    ///
    /// # Panics
    /// As [`at`](Self::at).
    #[must_use]
    pub fn at_many(
        &self,
        local: &mut LocalField<'_>,
        offsets: &[Vec2],
        side: Side,
    ) -> Vec<ValueWithGradient> {
        if matches!(self.rule, GradientRule::Partition) {
            return offsets.iter().map(|&offset| self.at(local, offset, side)).collect();
        }
        let components = local.field.components();
        let mut jets = vec![Jet::constant(0.0); offsets.len() * components];
        local.evaluate_into::<2>(offsets, side, &mut jets);
        let rows = offsets.iter().zip(jets.chunks(components));
        rows.map(|(&offset, jets)| self.slope_from_jets(local, offset, jets)).collect()
    }

    /// Value and gradient where the field is known to its second derivatives; NaN outside
    /// the domain.
    pub(crate) fn slope_from_jets(
        &self,
        local: &mut LocalField<'_>,
        offset: Vec2,
        jets: &[Jet<f64>],
    ) -> ValueWithGradient {
        match self.rule {
            GradientRule::Partition => self.of_partition(local, offset),
            _ if local.has_values(offset, jets) => self.of_jets(local, offset, jets),
            _ => ValueWithGradient::NOWHERE,
        }
    }

    /// Where the field is known, at a point of the domain.
    fn of_jets(
        &self,
        local: &LocalField<'_>,
        offset: Vec2,
        jets: &[Jet<f64>],
    ) -> ValueWithGradient {
        let value = self.quantity.of_values(local, offset, jets);
        let gradient = match &self.rule {
            GradientRule::Partition => vec2(f64::NAN, f64::NAN),
            GradientRule::Component(c) => gradient(&jets[*c]),
            GradientRule::Derivative(c, axis) => gradient_of_derivative(&jets[*c], *axis),
            GradientRule::Norm => norm(jets.iter().map(|u| (u.v, gradient(u))), value),
            GradientRule::GradientNorm => norm(jets.iter().flat_map(derivatives), value),
            GradientRule::Error(exact) => {
                let p = local.anchor + offset;
                norm(jets.iter().zip(exact).map(|(u, exact)| difference(u, exact, p)), value)
            }
            GradientRule::Chain(chain) => chain.gradient(local, offset, jets),
        };
        ValueWithGradient { value, gradient }
    }

    /// A quantity of the partition; `None` outside the domain.
    fn of_partition(&self, local: &mut LocalField<'_>, offset: Vec2) -> ValueWithGradient {
        let jet = match self.quantity {
            Quantity::PartitionFunction(patch) => {
                local.partition_function::<1>(patch as usize, offset)
            }
            Quantity::WeightSum => local.covering::<1>(offset).map(|all| all.weight_sum),
            _ => local.covering::<0>(offset).map(|all| Jet::constant(all.overlap as f64)),
        };
        jet.map_or(ValueWithGradient::NOWHERE, |jet| ValueWithGradient {
            value: jet.v,
            gradient: gradient(&jet),
        })
    }
}

impl ValueWithGradient {
    /// Outside the domain.
    const NOWHERE: Self = Self { value: f64::NAN, gradient: vec2(f64::NAN, f64::NAN) };
}

impl GradientRule {
    fn new(quantity: &Quantity, field: &Field<'_>) -> Result<Self, QuantityError> {
        Ok(match quantity {
            Quantity::WeightSum | Quantity::Overlap | Quantity::PartitionFunction(_) => {
                Self::Partition
            }
            Quantity::Component(c) => Self::Component(usize::from(*c)),
            Quantity::Derivative(c, axis) => Self::Derivative(usize::from(*c), *axis),
            Quantity::Magnitude => Self::Norm,
            Quantity::GradientNorm => Self::GradientNorm,
            Quantity::Error => {
                let compile = |formula| FormulaJets::new(&[formula], 1);
                let exact: Result<_, _> = field.exact_formulas().iter().map(compile).collect();
                Self::Error(exact.map_err(QuantityFormulaError::from)?)
            }
            Quantity::Formula(formula) => Self::Chain(Box::new(FormulaChain::new(formula, field)?)),
            built_in => {
                let formula = text(built_in, field)?;
                Self::Chain(Box::new(FormulaChain::new(&formula, field)?))
            }
        })
    }
}

/// A built-in quantity of strains as the formula of its text.
fn text(quantity: &Quantity, field: &Field<'_>) -> Result<QuantityFormula, QuantityFormulaError> {
    let names = match field.components() {
        1 => &["u"][..],
        3 if field.has_temperature() => field.equation.component_names(),
        _ => &["ux", "uy"],
    };
    let names: Vec<String> = names.iter().map(|&name: &&str| name.to_owned()).collect();
    let vocabulary = Vocabulary { components: &names, named: &[], ..Vocabulary::of(field) };
    let text = match quantity {
        Quantity::EnergyDensity => "energy".to_owned(),
        // the text of the library has an angle of its own where σ_xy = 0, without a slope
        Quantity::PrincipalDirection if field.equation.eigenstrains().next().is_some() => {
            "atan2(2*elastic_xy, elastic_xx - elastic_yy)/2".to_owned()
        }
        Quantity::PrincipalDirection => "atan2(2*exy, exx - eyy)/2".to_owned(),
        other => {
            let row = ELASTIC.iter().find(|(.., known)| known == other);
            row.map_or_else(String::new, |(name, ..)| name.replace('-', "_"))
        }
    };
    QuantityFormula::new(&text, &vocabulary)
}

impl FormulaChain {
    fn new(formula: &QuantityFormula, field: &Field<'_>) -> Result<Self, QuantityFormulaError> {
        let names: Vec<&str> = formula.formula().scope().inputs().collect();
        let inputs = formula.inputs().to_vec();
        let variables: Vec<&str> = inputs.iter().map(|&(index, _)| names[index]).collect();
        let jets = FormulaJets::partials(formula.formula(), &variables)?;
        let material = MaterialGradient::new(field.equation)?;
        Ok(Self { jets, inputs, n_inputs: names.len(), material })
    }

    fn gradient(&self, local: &LocalField<'_>, offset: Vec2, jets: &[Jet<f64>]) -> Vec2 {
        let (anchor, equation) = (local.anchor, local.field.equation);
        let offset = [offset.x, offset.y];
        let moduli = equation.moduli(anchor, offset);
        let at = Sample { anchor, offset, moduli, jets, exact: &[] };
        let mut values = vec![0.0; self.n_inputs];
        for (index, input) in &self.inputs {
            values[*index] = input.value(&at);
        }
        let mut partials = vec![0.0; 1 + self.inputs.len()];
        self.jets.evaluate(&values, &mut Vec::new(), &mut partials);
        let material = self.material.as_ref().map(|m| m.at(anchor + Vec2::from(offset), &moduli));
        let parts = self.inputs.iter().zip(&partials[1..]).map(|((_, input), &partial)| {
            let gradient = input.gradient(jets, material.as_ref());
            // what does not change has no part, though the quantity may depend on it without bound
            if gradient == Vec2::ZERO || partial == 0.0 { Vec2::ZERO } else { gradient * partial }
        });
        parts.fold(Vec2::ZERO, |sum, part| sum + part)
    }
}

impl QuantityInput {
    fn gradient(self, jets: &[Jet<f64>], material: Option<&Moduli<Vec2>>) -> Vec2 {
        match self {
            Self::X => vec2(1.0, 0.0),
            Self::Y => vec2(0.0, 1.0),
            Self::Value(c) => gradient(&jets[c]),
            Self::SlopeX(c) => gradient_of_derivative(&jets[c], Axis::X),
            Self::SlopeY(c) => gradient_of_derivative(&jets[c], Axis::Y),
            modulus => material.and_then(|m| modulus.modulus(m)).unwrap_or(Vec2::ZERO),
        }
    }
}

/// ∇u
fn gradient(u: &Jet<f64>) -> Vec2 {
    vec2(u.x, u.y)
}

/// ∇(∂u/∂x) or ∇(∂u/∂y)
fn gradient_of_derivative(u: &Jet<f64>, axis: Axis) -> Vec2 {
    match axis {
        Axis::X => vec2(u.xx, u.xy),
        Axis::Y => vec2(u.xy, u.yy),
    }
}

/// Both derivatives with their gradients.
fn derivatives(u: &Jet<f64>) -> [(f64, Vec2); 2] {
    [(u.x, gradient_of_derivative(u, Axis::X)), (u.y, gradient_of_derivative(u, Axis::Y))]
}

/// u − u_exact with its gradient.
fn difference(u: &Jet<f64>, exact: &FormulaJets, p: Vec2) -> (f64, Vec2) {
    let mut out = [0.0; 3];
    exact.evaluate(&[p.x, p.y], &mut Vec::new(), &mut out);
    (u.v - out[0], gradient(u) - vec2(out[1], out[2]))
}

/// ∇|v| = Σ v ∇v / |v|
fn norm(parts: impl Iterator<Item = (f64, Vec2)>, norm: f64) -> Vec2 {
    parts.fold(Vec2::ZERO, |sum, (v, gradient)| sum + gradient * (v / norm))
}
