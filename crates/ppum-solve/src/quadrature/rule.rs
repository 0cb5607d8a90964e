//! Rules of quadrature on parts of cells.

use super::error_estimate::QuadratureError;
use ppum::vec2::Vec2;

/// A rule on a part of a cell on which one set of patches is active.
#[derive(Clone, Debug, PartialEq)]
pub struct CellRule {
    /// Origin of the offsets: a singular point near it, else the centre of the cell.
    pub anchor: Vec2,
    /// Points, relative to the anchor; inside the part, never on its boundary or on a crack.
    pub offsets: Vec<Vec2>,
    /// Quadrature weights, positive; they sum to the area.
    pub weights: Vec<f64>,
    /// The patches whose open supports hold the points, ascending.
    pub patches: Vec<u32>,
    /// Errors that the points leave.
    pub doubt: QuadratureError,
}

impl CellRule {
    /// Adds a point. Weights that rounding leaves without area are dropped.
    pub(super) fn push(&mut self, offset: Vec2, weight: f64) {
        if weight > 0.0 {
            self.offsets.push(offset);
            self.weights.push(weight);
        }
    }

    /// Holds what every user relies on.
    pub(super) fn check(&self, singular: &[Vec2]) {
        let finite = self.offsets.iter().all(|x| x.is_finite())
            && self.weights.iter().all(|w| w.is_finite());
        assert!(finite, "quadrature points must be finite");
        let at_point = singular.contains(&self.anchor) && self.offsets.contains(&Vec2::ZERO);
        assert!(!at_point, "a quadrature point lies on the singular point {:?}", self.anchor);
    }
}

/// The rules of a cell, one for each set of patches and anchor.
#[derive(Default)]
pub(super) struct Rules(pub(super) Vec<CellRule>);

impl Rules {
    pub(super) fn rule(&mut self, patches: &[u32], anchor: Vec2) -> &mut CellRule {
        let same = |r: &CellRule| r.anchor == anchor && r.patches == patches;
        let at = self.0.iter().position(same).unwrap_or_else(|| {
            let (offsets, weights, doubt) = (Vec::new(), Vec::new(), QuadratureError::default());
            self.0.push(CellRule { anchor, offsets, weights, patches: patches.to_vec(), doubt });
            self.0.len() - 1
        });
        &mut self.0[at]
    }
}
