//! The elements of a mesh as data.

use std::ops::Range;

use super::map::PolynomialMap;
use super::shape::Shape;
use crate::polynomial::PolynomialSpace;
use crate::vec2::{Rect, Vec2, vec2};

/// Part of its own size by which the box of an element is larger than what holds it: who looks for
/// the elements at an anchor finds those beside it, too.
const BESIDE: f64 = 1.0 / 32.0;

/// The elements of a mesh as patches. Structure of arrays; vectors have one entry per patch where
/// nothing else is said.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// The reference shapes.
    pub shape: Vec<Shape>,
    /// Images of ξ = 0.
    pub origin: Vec<Vec2>,
    /// Degrees of the maps.
    pub map_degree: Vec<u8>,
    /// Monomials of the maps.
    pub map_space: Vec<PolynomialSpace>,
    /// First column of each map in `map`; patches may share one.
    pub map_offset: Vec<u64>,
    /// Coefficients of the maps M without constant terms, for x and for y.
    pub map: [Vec<f64>; 2],
    /// The mesh's own number of the element; the sides of a cut share it.
    pub element: Vec<u32>,
    /// Offsets of the patches' clips, one more than patches; empty if there is no clip.
    pub clip_offsets: Vec<u64>,
    /// The clips of all patches.
    pub clips: Vec<Clip>,
}

/// A patch's half of the plane: where a level field is not negative, or where it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Clip {
    /// Index of the level field among the step's fields.
    pub field: u32,
    /// True for level ≥ 0, false for level < 0.
    pub is_above: bool,
}

impl Mesh {
    /// Number of patches.
    #[must_use]
    pub fn len(&self) -> usize {
        self.shape.len()
    }

    /// True if there is no patch.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.shape.is_empty()
    }

    /// The columns of a patch's map.
    #[must_use]
    pub fn map_range(&self, patch: usize) -> Range<usize> {
        let start = self.map_offset[patch] as usize;
        start..start + self.map_space[patch].size(self.map_degree[patch].into()) - 1
    }

    /// The coefficients of a patch's map without the constant, for x and for y.
    #[must_use]
    pub fn map_of(&self, patch: usize) -> [&[f64]; 2] {
        let range = self.map_range(patch);
        [&self.map[0][range.clone()], &self.map[1][range]]
    }

    /// A box that holds the patch: |ξ|, |η| ≤ 1, so no component is farther from the origin's than
    /// Σ |coefficient|.
    #[must_use]
    pub fn bounds(&self, patch: usize) -> Rect {
        let [x, y] = self.map_of(patch).map(|c| c.iter().map(|c| c.abs()).sum());
        Rect::around(self.origin[patch], vec2(x, y))
    }

    /// A box that holds a patch and what lies beside it.
    pub(crate) fn reach(&self, patch: usize) -> Rect {
        let bounds = self.bounds(patch);
        let margin = bounds.size() * BESIDE;
        Rect::new(bounds.min - margin, bounds.max + margin)
    }

    /// The clips of a patch.
    #[must_use]
    pub fn clips(&self, patch: usize) -> &[Clip] {
        match self.clip_offsets.get(patch..patch + 2) {
            Some(&[start, end]) => &self.clips[start as usize..end as usize],
            _ => &[],
        }
    }

    pub(super) fn map(&self, patch: usize) -> PolynomialMap {
        PolynomialMap::new(self.map_space[patch], self.map_degree[patch], self.map_of(patch))
    }

    /// x = origin + M(ξ), and det DM(ξ).
    #[must_use]
    pub fn image(&self, patch: usize, xi: [f64; 2]) -> (Vec2, f64) {
        let [x, y] = self.map(patch).at::<f64, 1>(xi);
        (self.origin[patch] + vec2(x.v, y.v), x.x * y.y - x.y * y.x)
    }
}
