//! Points that are loaded or held.

use ppum::crack::Side;
use ppum::vec2::Vec2;

/// A force at a point of an elastic body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Force {
    /// The point: inside, on a straight part of the boundary, or on a crack, but at no corner or
    /// tip.
    pub at: Vec2,
    /// The force on the body \[S L, per unit thickness\].
    pub value: Vec2,
    /// On a crack, the side of the body on whose face the force acts.
    pub face: Option<Side>,
}

/// A point that keeps a body, or a piece of one, from moving as a whole, and takes no force.
///
/// It chooses among solutions that differ by rigid-body modes: strains do not depend on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    /// The point, in the body or on its boundary, but on no crack.
    pub at: Vec2,
    /// The displacement of each component there \[L\]; none where it is free.
    pub displacement: [Option<f64>; 2],
}

impl Support {
    /// A point that does not move.
    #[must_use]
    pub fn new(at: Vec2) -> Self {
        Self { at, displacement: [Some(0.0); 2] }
    }
}
