//! Points that are held.

use ppum::vec2::Vec2;

/// A point that keeps a body, or a piece of one, from moving as a whole, and takes no force.
///
/// It chooses among solutions that differ by rigid-body modes: strains do not depend on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    /// The point, in the body or on its border, but on no crack.
    pub at: Vec2,
    /// Of each component, the displacement there \[L\]; none where it is free.
    pub displacement: [Option<f64>; 2],
}

impl Support {
    /// A point that does not move.
    #[must_use]
    pub fn new(at: Vec2) -> Self {
        Self { at, displacement: [Some(0.0); 2] }
    }
}
