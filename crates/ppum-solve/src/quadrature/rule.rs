//! Rules of quadrature on parts of cells.

use super::error_estimate::QuadratureErrorEstimate;
use super::geometry::CrackFace;
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
    pub doubt: QuadratureErrorEstimate,
}

impl CellRule {
    /// The points with their weights.
    pub fn points(&self) -> impl Iterator<Item = (Vec2, f64)> {
        let all = self.offsets.iter().zip(&self.weights);
        all.map(|(&offset, &weight)| (self.anchor + offset, weight))
    }

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

/// A rule on the part of a segment in one cell on which one set of patches is active.
#[derive(Clone, Debug, PartialEq)]
pub struct EdgeRule {
    /// Origin of the offsets: the singular point they are graded toward, else the
    /// centre of the cell.
    pub anchor: Vec2,
    /// Points, relative to the anchor.
    pub offsets: Vec<Vec2>,
    /// Quadrature weights; they sum to the length.
    pub weights: Vec<f64>,
    /// The patches whose supports hold the points, ascending.
    pub patches: Vec<u32>,
    /// Unit normals out of the material, one per point.
    pub normals: Vec<Vec2>,
    /// The face that the points lie on, if they are on one. Rounding may put them on either side of
    /// the crack: what has sides there takes that of the face.
    pub face: Option<CrackFace>,
    /// Errors that the points leave.
    pub doubt: QuadratureErrorEstimate,
}

impl EdgeRule {
    pub(super) fn empty(anchor: Vec2, patches: &[u32]) -> Self {
        let (offsets, weights, normals) = (Vec::new(), Vec::new(), Vec::new());
        let doubt = QuadratureErrorEstimate::default();
        Self { anchor, offsets, weights, patches: patches.to_vec(), normals, face: None, doubt }
    }

    /// The points with their normals and weights.
    pub fn points(&self) -> impl Iterator<Item = (Vec2, Vec2, f64)> {
        let all = self.offsets.iter().zip(&self.normals).zip(&self.weights);
        all.map(|((&offset, &normal), &weight)| (self.anchor + offset, normal, weight))
    }

    pub(super) fn push(&mut self, offset: Vec2, weight: f64, normal: Vec2) {
        self.offsets.push(offset);
        self.weights.push(weight);
        self.normals.push(normal);
    }
}

/// The rules of a cell, one for each set of patches and anchor.
#[derive(Default)]
pub(super) struct Rules(pub(super) Vec<CellRule>);

impl Rules {
    pub(super) fn rule(&mut self, patches: &[u32], anchor: Vec2) -> &mut CellRule {
        let same = |r: &CellRule| r.anchor == anchor && r.patches == patches;
        let at = self.0.iter().position(same).unwrap_or_else(|| {
            let (offsets, weights, doubt) =
                (Vec::new(), Vec::new(), QuadratureErrorEstimate::default());
            self.0.push(CellRule { anchor, offsets, weights, patches: patches.to_vec(), doubt });
            self.0.len() - 1
        });
        &mut self.0[at]
    }
}
