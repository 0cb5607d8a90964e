//! The data that quantities are made of.

use crate::equation::Moduli;
use crate::jet::Jet;
use crate::vec2::Vec2;
use ppum_formula::real::Real;

/// The ingredients of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The field's values.
    Values,
    /// The field's gradient.
    Gradient,
    /// The values and the exact solution.
    Exact,
    /// The partition of unity alone.
    Partition,
}

/// A field at a point, or at a vector of points: what quantities are made of.
#[derive(Clone, Copy, Debug)]
pub struct Sample<'a, R> {
    /// Points are `anchor + offset`.
    pub anchor: Vec2,
    /// Offsets from the anchor.
    pub offset: [R; 2],
    /// The constants of the equation there.
    pub moduli: Moduli<R>,
    /// The components with derivatives, as many as the quantity's
    /// [source](super::Quantity::source) asks.
    pub jets: &'a [Jet<R>],
    /// The exact values, for [`Quantity::Error`](super::Quantity::Error) alone; may be empty
    /// otherwise.
    pub exact: &'a [R],
}

impl<R: Real> Sample<'_, R> {
    /// The hoop strain of a body of revolution, u_x/x.
    #[inline(always)]
    pub(super) fn hoop_strain(&self) -> R {
        let (ux, x) = (self.jets[0], self.offset[0].broadcast(self.anchor.x) + self.offset[0]);
        let (zero, one) = (x.broadcast(0.0), x.broadcast(1.0));
        let is_beside = x.abs().gt(zero);
        R::select(is_beside, ux.v / R::select(is_beside, x, one), ux.x)
    }

    /// A quantity of the gradient: +∞ where a derivative of any component is infinite or none.
    #[inline(always)]
    pub(super) fn apart(&self, value: R) -> R {
        let (zero, infinite) = (value.broadcast(0.0), value.broadcast(f64::INFINITY));
        // zero, or NaN
        let mut test = zero;
        for jet in self.jets {
            test = jet.x.mul_add(zero, jet.y.mul_add(zero, test));
        }
        R::select(test.ge(test), value, infinite)
    }
}
