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

use std::sync::Arc;

use super::formula::Vocabulary;
use super::kinds::{Axis, Quantity, QuantityError};
use super::reflection::{Reflection, ValueChange};
use crate::field::Field;

/// A quantity of a field that has, at Sx and changed, the values of one of the reflected field at
/// x.
#[derive(Clone, Debug, PartialEq)]
pub struct ReflectedQuantity {
    /// The quantity.
    pub quantity: Quantity,
    /// The change of its values.
    pub change: ValueChange,
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
    ) -> Result<ReflectedQuantity, QuantityError> {
        use Quantity as Q;
        let ([x, y], sign) = (at.axes(), at.sign());
        let vector = Vocabulary::of(field).vector();
        let mixed = |a: Axis, b: Axis| if a == b { sign } else { sign * x * y };
        let sign = match self {
            Q::Formula(formula) => {
                let formula = formula.reflected(&Vocabulary::of(field), *at);
                let formula = formula.map_err(QuantityError::Formula)?;
                let quantity = Q::Formula(Arc::new(formula));
                return Ok(ReflectedQuantity { quantity, change: ValueChange::Same });
            }
            Q::PrincipalDirection => {
                return Ok(ReflectedQuantity { quantity: self.clone(), change: at.direction() });
            }
            Q::Component(c) => at.of_component(usize::from(*c), vector),
            Q::Derivative(c, Axis::X) => at.of_component(usize::from(*c), vector) * x,
            Q::Derivative(c, Axis::Y) => at.of_component(usize::from(*c), vector) * y,
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
        Ok(ReflectedQuantity { quantity, change: ValueChange::signed(sign) })
    }
}
