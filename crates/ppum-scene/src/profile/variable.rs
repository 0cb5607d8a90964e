//! The variable that values along a curve are drawn against, and the quantities that are drawn.

use ppum::quantity::Quantity;

/// Quantities under their names.
pub type NamedQuantities = [(String, Quantity)];

/// The variable that values along a curve belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variable {
    /// Arc length.
    Length,
    /// Angle, degrees.
    Angle,
    /// Distance from a tip, in steps of its logarithm.
    Distance,
}

impl Variable {
    /// Name of its column.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Length => "s",
            Self::Angle => "theta",
            Self::Distance => "r",
        }
    }

    pub(super) fn unit(self) -> &'static str {
        if self == Self::Angle { "deg" } else { "" }
    }
}
