//! Fields that are known beyond lines of symmetry, and their quantities.
//!
//! The field of a half of a symmetric body is that of the whole. With S the reflection at the
//! line, and for several lines with the product of their reflections,
//!
//! ```text
//! u*(x) = ± S u(Sx)        u_c* = ± s_c u_c        ∂u_c*/∂x_d = ± s_c s_d ∂u_c/∂x_d
//! ```
//!
//! with s = −1 of a coordinate that is reflected and + for a symmetric field, − for an
//! antisymmetric one. A potential has s_c = 1. So a quantity of u* at x is a quantity of u at Sx:
//! built-in ones are themselves there, up to their sign ([`ValueChange`]); in formulas what they
//! are made of is replaced.

use std::borrow::Cow;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use super::formula::{Input, Vocabulary};
use super::kinds::{Axis, Quantity, QuantityError};
use crate::dataset::EIGENSTRAINS;
use crate::field::Field;
use crate::vec2::{Vec2, vec2};

/// Reflections at lines parallel to the axes, and the sign with which they repeat a field.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reflection {
    /// The lines x = a and y = b, where there is a reflection at one.
    pub lines: [Option<f64>; 2],
    /// True for −S u(Sx), an antisymmetric field.
    pub is_odd: bool,
}

/// What makes the values of a quantity of the reflected field of those of another quantity of the
/// field. It undoes itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueChange {
    /// Nothing.
    Same,
    /// −v; +∞, the value where there is no gradient, stays.
    Negated,
    /// An angle of a direction, in (−π/2, π/2], reflected, turned by π/2, or both.
    Turned {
        /// True for −v.
        is_reversed: bool,
        /// True for v + π/2.
        is_quarter: bool,
    },
}

/// A quantity of a field that has, at Sx and changed, the values of one of the reflected field at
/// x.
#[derive(Clone, Debug, PartialEq)]
pub struct Reflected {
    /// The quantity.
    pub quantity: Quantity,
    /// The change of its values.
    pub change: ValueChange,
}

impl ValueChange {
    fn signed(sign: f64) -> Self {
        if sign < 0.0 { Self::Negated } else { Self::Same }
    }

    /// The value of the reflected field.
    #[must_use]
    pub fn apply(self, value: f64) -> f64 {
        match self {
            Self::Same => value,
            Self::Negated if value == f64::INFINITY => value,
            Self::Negated => -value,
            Self::Turned { .. } if !value.is_finite() => value,
            Self::Turned { is_reversed, is_quarter } => {
                let reflected = if is_reversed { -value } else { value };
                let turned = if is_quarter { reflected + FRAC_PI_2 } else { reflected };
                match turned {
                    angle if angle > FRAC_PI_2 => angle - PI,
                    angle if angle <= -FRAC_PI_2 => angle + PI,
                    angle => angle,
                }
            }
        }
    }
}

impl Reflection {
    /// No reflection.
    pub const NONE: Self = Self { lines: [None; 2], is_odd: false };

    /// The point Sx.
    #[must_use]
    pub fn point(&self, p: Vec2) -> Vec2 {
        let beyond = |line: Option<f64>, at: f64| line.map_or(at, |line| 2.0 * line - at);
        vec2(beyond(self.lines[0], p.x), beyond(self.lines[1], p.y))
    }

    /// The vector S v.
    #[must_use]
    pub fn vector(&self, v: Vec2) -> Vec2 {
        let [x, y] = self.axes();
        vec2(x * v.x, y * v.y)
    }

    /// The sign of the field.
    #[must_use]
    pub fn sign(&self) -> f64 {
        if self.is_odd { -1.0 } else { 1.0 }
    }

    /// s of both coordinates.
    fn axes(&self) -> [f64; 2] {
        self.lines.map(|line| if line.is_some() { -1.0 } else { 1.0 })
    }

    /// The change of angles of a stress's direction: that of σ₁ of −σ is that of σ₂.
    #[must_use]
    pub fn direction(&self) -> ValueChange {
        let [x, y] = self.axes();
        match (x * y < 0.0, self.is_odd) {
            (false, false) => ValueChange::Same,
            (is_reversed, is_quarter) => ValueChange::Turned { is_reversed, is_quarter },
        }
    }

    /// The sign of a component of a field: two are those of a vector, others are potentials.
    fn of_component(&self, component: usize, count: usize) -> f64 {
        let axis = if count == 2 { self.axes()[component] } else { 1.0 };
        self.sign() * axis
    }

    /// The sign of an input of a formula; none of those that are as they were.
    fn of_input(&self, input: Input, count: usize) -> Option<f64> {
        let [x, y] = self.axes();
        Some(match input {
            Input::Value(c) => self.of_component(c, count),
            Input::SlopeX(c) => self.of_component(c, count) * x,
            Input::SlopeY(c) => self.of_component(c, count) * y,
            _ => return None,
        })
    }

    /// Definitions of the inputs of formulas that are not as they were, and given strains with
    /// their signs.
    pub(super) fn definitions<'a>(
        &self,
        inputs: &[(String, Input)],
        texts: &mut [(String, Cow<'a, str>)],
    ) -> Vec<(String, Cow<'a, str>)> {
        if *self == Self::NONE {
            return Vec::new();
        }
        let [x, y] = self.axes();
        for (name, text) in texts.iter_mut().filter(|(name, _)| EIGENSTRAINS.contains(&&**name)) {
            let sign = if *name == EIGENSTRAINS[2] { x * y } else { 1.0 };
            if sign * self.sign() < 0.0 {
                *text = format!("-({text}\n)").into();
            }
        }
        let count = inputs.iter().filter(|(_, input)| matches!(input, Input::Value(_))).count();
        let text = |name: &str, input: Input| match input {
            Input::X => self.lines[0].map(|line| format!("({:?}) - {name}", 2.0 * line)),
            Input::Y => self.lines[1].map(|line| format!("({:?}) - {name}", 2.0 * line)),
            input => self.of_input(input, count).filter(|s| *s < 0.0).map(|_| format!("-{name}")),
        };
        let changed = |(name, input): &(String, Input)| {
            text(name, *input).map(|text| (name.clone(), Cow::Owned(text)))
        };
        inputs.iter().filter_map(changed).collect()
    }
}

impl Quantity {
    /// The quantity of a field that has the values of this one of the reflected field.
    ///
    /// # Errors
    /// A formula that is too large.
    pub fn reflected(
        &self,
        at: &Reflection,
        field: &Field<'_>,
    ) -> Result<Reflected, QuantityError> {
        use Quantity as Q;
        let ([x, y], sign, count) = (at.axes(), at.sign(), field.components());
        let mixed = |a: Axis, b: Axis| if a == b { sign } else { sign * x * y };
        let sign = match self {
            Q::Formula(formula) => {
                let formula = formula.reflected(&Vocabulary::of(field), *at);
                let formula = formula.map_err(QuantityError::Formula)?;
                let quantity = Q::Formula(Arc::new(formula));
                return Ok(Reflected { quantity, change: ValueChange::Same });
            }
            Q::PrincipalDirection => {
                return Ok(Reflected { quantity: self.clone(), change: at.direction() });
            }
            Q::Component(c) => at.of_component(usize::from(*c), count),
            Q::Derivative(c, Axis::X) => at.of_component(usize::from(*c), count) * x,
            Q::Derivative(c, Axis::Y) => at.of_component(usize::from(*c), count) * y,
            Q::Curl => sign * x * y,
            Q::Strain(a, b) | Q::Stress(a, b) => mixed(*a, *b),
            Q::Divergence | Q::StressOut | Q::Principal1 | Q::Principal2 | Q::Hydrostatic => sign,
            _ => 1.0,
        };
        // the larger principal stress of −σ is the smaller one of σ
        let quantity = match self {
            Q::Principal1 if at.is_odd => Q::Principal2,
            Q::Principal2 if at.is_odd => Q::Principal1,
            same => same.clone(),
        };
        Ok(Reflected { quantity, change: ValueChange::signed(sign) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::{Dataset, NamedQuantity};
    use crate::equation::{Elasticity, Equation, StressState};
    use crate::expression::Expression;
    use crate::jet::Jet;
    use crate::quantity::{Sample, Source, available};
    use ppum_testkit::random::Random;
    use ppum_testkit::synthetic::Recipe;

    /// An expression of the coordinates X and Y of the point Sx, times a sign.
    fn expression(text: &str, at: &Reflection, sign: f64) -> Expression {
        let coordinate = |name: &str, line: Option<f64>| match line {
            Some(line) => format!("(2*({line:?}) - {name})"),
            None => name.to_owned(),
        };
        let [x, y] = at.lines;
        let text = text.replace('X', &coordinate("x", x)).replace('Y', &coordinate("y", y));
        Expression::parse(&format!("({sign:?})*({text})")).expect("an expression")
    }

    /// The equation of the reflected body: its constants and given strains at x are those at Sx.
    fn elastic(has_strains: bool, at: &Reflection) -> Equation {
        let ([x, y], sign) = (at.axes(), at.sign());
        let texts = [("0.01*X", 1.0), ("0.02*Y - 0.1", 1.0), ("0.03 + X*Y", x * y), ("X", 1.0)];
        let given = texts.map(|(text, s)| expression(text, at, s * sign));
        Equation::Elasticity(Elasticity {
            young: expression("1.7 + 0.2*X", at, 1.0),
            poisson: expression("0.3 - 0.1*Y", at, 1.0),
            state: StressState::PlaneStrain,
            eigenstrain: has_strains.then(|| Box::new(given)),
        })
    }

    fn dataset(equation: Equation, components: usize) -> Dataset {
        let mut dataset = Recipe { components, ..Recipe::random(3) }.dataset();
        dataset.equation = equation;
        let named = |name: &str, text: &str| NamedQuantity {
            name: name.to_owned(),
            text: text.to_owned(),
            unit: String::new(),
        };
        let first = if components == 2 { "ux*x - duy_dx" } else { "u*x - du_dx" };
        dataset.quantities = vec![named("mine", first), named("both", "mine*y + 3*mine^2")];
        dataset
    }

    fn all_reflections(random: &mut Random) -> Vec<Reflection> {
        let (a, b) = (random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        let lines = [[Some(a), None], [None, Some(b)], [Some(a), Some(b)], [None, Some(0.0)]];
        let both = |lines| [false, true].map(|is_odd| Reflection { lines, is_odd });
        lines.into_iter().flat_map(both).collect()
    }

    /// Values and slopes of the field at Sx as those of the reflected field at x, by its
    /// definition.
    fn continued(at: &Reflection, jets: &[Jet<f64>]) -> Vec<Jet<f64>> {
        let ([x, y], sign) = (at.axes(), at.sign());
        let of = |(c, u): (usize, &Jet<f64>)| {
            let s = if jets.len() == 2 { sign * [x, y][c] } else { sign };
            Jet { v: s * u.v, x: s * x * u.x, y: s * y * u.y, ..Jet::constant(0.0) }
        };
        jets.iter().enumerate().map(of).collect()
    }

    fn value(text: &str, dataset: &Dataset, p: Vec2, jets: &[Jet<f64>]) -> f64 {
        let field = Field::new(dataset, 0).expect("a field");
        let quantity = Quantity::parse(text, &field).expect("a quantity");
        of(&quantity, dataset, p, jets)
    }

    fn of(quantity: &Quantity, dataset: &Dataset, anchor: Vec2, jets: &[Jet<f64>]) -> f64 {
        let (offset, moduli) = ([0.0; 2], dataset.equation.moduli(anchor, [0.0; 2]));
        quantity.of_field(&Sample { anchor, offset, moduli, jets, exact: &[] })
    }

    /// Every quantity of the field and many formulas, of random values and slopes, in a body whose
    /// constants and given strains change from place to place: what is reflected is what the
    /// reflected body has. A direction has no sense, so that angles may differ by π.
    #[test]
    fn quantities_are_those_of_the_reflected_body() {
        let mut random = Random(0x3b11_70c5_9e4d_2a86);
        let elastic_texts =
            ["von_mises + x*sxy*y", "s1 - 2*s2*x", "exx*x^2 + curl", "max(ux, y) # of x", "mine*x"];
        for case in 0..3 {
            let equation = |at: &Reflection| match case {
                2 => Equation::poisson(2.5),
                _ => elastic(case == 1, at),
            };
            let count = if case == 2 { 1 } else { 2 };
            let more: &[&str] = match case {
                0 => &elastic_texts,
                1 => &["eigenstrain_xy*x + sxy", "sxx - y*tresca + both", "elastic_xy*ux"],
                _ => &["u*x + du_dy*y", "energy*x", "both - mine*y"],
            };
            let body = dataset(equation(&Reflection::NONE), count);
            let field = Field::new(&body, 0).expect("a field");
            let names = available(&field).into_iter().filter(|name| name != "phi:N");
            for name in names.chain(more.iter().map(|&text| text.to_owned())) {
                let quantity = Quantity::parse(&name, &field).expect("a quantity");
                if matches!(quantity.source(), Source::Partition | Source::Exact) {
                    continue;
                }
                for at in all_reflections(&mut random) {
                    let mut number = || random.between(-1.0, 1.0);
                    let x = vec2(number(), number());
                    let mut jet =
                        || Jet { v: number(), x: number(), y: number(), ..Jet::constant(0.0) };
                    let jets: Vec<_> = (0..count).map(|_| jet()).collect();
                    let found = quantity.reflected(&at, &field).expect("a quantity");
                    let there = of(&found.quantity, &body, at.point(x), &jets);
                    let value_here = found.change.apply(there);
                    let reflected = dataset(equation(&at), count);
                    let expected = value(&name, &reflected, x, &continued(&at, &jets));
                    let mut apart = (value_here - expected).abs();
                    if name == "direction" {
                        apart = apart.min((PI - apart).abs());
                        assert!(value_here > -FRAC_PI_2 && value_here <= FRAC_PI_2);
                    }
                    // some roundings of terms up to 100
                    assert!(apart < 1e-12, "{name} {at:?}: {value_here}, not {expected}");
                    let again = found.change.apply(value_here);
                    assert!((again - there).abs() < 1e-15, "{again} is not {there}");
                }
            }
        }
    }

    /// Where there is no gradient there is none of the reflected field.
    #[test]
    fn singular_values_stay() {
        let turned = ValueChange::Turned { is_reversed: true, is_quarter: true };
        for change in [ValueChange::Same, ValueChange::Negated, turned] {
            assert_eq!(change.apply(f64::INFINITY), f64::INFINITY);
            assert!(change.apply(f64::NAN).is_nan());
        }
    }
}
