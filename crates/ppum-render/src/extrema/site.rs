//! The features that extreme values lie on.

use ppum::crack::{SegmentId, Side};

use super::singular::SingularKind;

/// The feature that an extremum lies on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ExtremumSite {
    /// Nothing.
    Inside,
    /// The border of the view or of the domain.
    Border,
    /// A face of a crack: the value is that of this side.
    Face(SegmentId, Side),
    /// The rim of the hole of this index.
    Rim(usize),
    /// An interface of the material.
    Interface,
    /// A singular point.
    Singular(SingularKind),
    /// The centre of a pixel; between pixels nothing was looked at.
    Pixel,
    /// Any place: the quantity has one value all over the body, except for rounding.
    Everywhere,
}

impl ExtremumSite {
    /// One word for it: `inside`, `border`, `face`, `rim`, `interface`, `singular`, `pixel`,
    /// `everywhere`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Inside => "inside",
            Self::Border => "border",
            Self::Face(..) => "face",
            Self::Rim(_) => "rim",
            Self::Interface => "interface",
            Self::Singular(_) => "singular",
            Self::Pixel => "pixel",
            Self::Everywhere => "everywhere",
        }
    }
}
