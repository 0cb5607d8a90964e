//! The patches of a step.

use std::borrow::Cow;

use crate::mesh::Mesh;
use crate::vec2::{Rect, Vec2};
use crate::weight::WeightFunction;

/// The patches of a step, and how their local fields make one field.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Partition {
    /// Boxes that overlap, with weights.
    Boxes(BoxPartition),
    /// Elements of a mesh, or parts of them: φ_i is 1 in patch i and 0 elsewhere.
    Mesh(Mesh),
}

impl From<BoxPartition> for Partition {
    fn from(boxes: BoxPartition) -> Self {
        Self::Boxes(boxes)
    }
}

impl From<Mesh> for Partition {
    fn from(mesh: Mesh) -> Self {
        Self::Mesh(mesh)
    }
}

/// The boxes of a mesh: none.
static NO_BOXES: BoxPartition = BoxPartition::EMPTY;

impl Partition {
    /// Number of patches.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Boxes(boxes) => boxes.len(),
            Self::Mesh(mesh) => mesh.len(),
        }
    }

    /// True if there is no patch.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The boxes; of a mesh an empty list of them.
    #[must_use]
    #[inline]
    pub fn boxes(&self) -> &BoxPartition {
        match self {
            Self::Boxes(boxes) => boxes,
            Self::Mesh(_) => &NO_BOXES,
        }
    }

    /// The boxes, to be changed; `None` for a mesh.
    pub fn boxes_mut(&mut self) -> Option<&mut BoxPartition> {
        match self {
            Self::Boxes(boxes) => Some(boxes),
            Self::Mesh(_) => None,
        }
    }

    /// The mesh; `None` for boxes.
    #[must_use]
    #[inline]
    pub fn mesh(&self) -> Option<&Mesh> {
        match self {
            Self::Boxes(_) => None,
            Self::Mesh(mesh) => Some(mesh),
        }
    }

    /// The centre of a box, or the origin of an element.
    ///
    /// # Panics
    /// If there is no such patch.
    #[must_use]
    pub fn center(&self, patch: usize) -> Vec2 {
        match self {
            Self::Boxes(boxes) => boxes.center[patch],
            Self::Mesh(mesh) => mesh.origin[patch],
        }
    }

    /// The half-extents of a box, or of one that holds an element.
    ///
    /// # Panics
    /// If there is no such patch.
    #[must_use]
    pub fn half(&self, patch: usize) -> Vec2 {
        match self {
            Self::Boxes(boxes) => boxes.half[patch],
            Self::Mesh(mesh) => mesh.bounds(patch).size() * 0.5,
        }
    }

    /// A box of each patch: the cell that it comes from, if it comes from none its support, or a
    /// box that holds the element.
    #[must_use]
    pub fn cells(&self) -> Cow<'_, [Rect]> {
        match self {
            Self::Boxes(boxes) if boxes.has_cells() => Cow::Borrowed(&boxes.cell),
            Self::Boxes(boxes) => (0..boxes.len()).map(|patch| boxes.support(patch)).collect(),
            Self::Mesh(mesh) => (0..mesh.len()).map(|patch| mesh.bounds(patch)).collect(),
        }
    }

    /// A box that holds the patch.
    ///
    /// # Panics
    /// If there is no such patch.
    #[must_use]
    pub fn support(&self, patch: usize) -> Rect {
        match self {
            Self::Boxes(boxes) => boxes.support(patch),
            Self::Mesh(mesh) => mesh.bounds(patch),
        }
    }
}

/// A Shepard partition of unity over boxes (`kind = "shepard-box"`): φ_i = W_i / Σ_l W_l with
/// W_i(x) = w(|x − center_i,x| / half_i,x) · w(|y − center_i,y| / half_i,y).
///
/// Structure of arrays; all vectors have one entry per patch. The polynomial frame (`origin`,
/// `scale`) is kept apart from the support (`center`, `half`); the solver makes them equal.
#[derive(Clone, Debug, PartialEq)]
pub struct BoxPartition {
    /// The weight function w of t = |ξ|.
    pub weight: WeightFunction,
    /// Centre of the support box.
    pub center: Vec<Vec2>,
    /// Half-extent of the support box, positive.
    pub half: Vec<Vec2>,
    /// Origin of the polynomial coordinates ξ.
    pub origin: Vec<Vec2>,
    /// Scale of the polynomial coordinates ξ, positive.
    pub scale: Vec<Vec2>,
    /// The leaf cell C_i that generated the patch; the cells tile the domain's box, but
    /// for cells in holes, which may be missing. Empty if the boxes come from no cells.
    pub cell: Vec<Rect>,
    /// Level of the cell in its tree, 0 at the root; empty without cells.
    pub level: Vec<u8>,
    /// Index into `points` of the point that generated the patch, if one did.
    pub point: Vec<Option<u32>>,
    /// The scattered points the cover was made from; empty for uniform covers.
    pub points: Vec<Vec2>,
}

impl BoxPartition {
    /// No patches.
    pub const EMPTY: Self = Self {
        weight: WeightFunction::Linear,
        center: Vec::new(),
        half: Vec::new(),
        origin: Vec::new(),
        scale: Vec::new(),
        cell: Vec::new(),
        level: Vec::new(),
        point: Vec::new(),
        points: Vec::new(),
    };

    /// Number of patches.
    #[must_use]
    pub fn len(&self) -> usize {
        self.center.len()
    }

    /// True if there is no patch.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.center.is_empty()
    }

    /// True if the patches come from cells, which tile the domain.
    #[must_use]
    pub fn has_cells(&self) -> bool {
        !self.cell.is_empty()
    }

    /// How far apart patches stand: the size of the patch's cell, without cells half that of its
    /// support.
    #[must_use]
    pub fn spacing(&self, patch: usize) -> Vec2 {
        self.cell.get(patch).map_or(self.half[patch], Rect::size)
    }

    /// The support ω_i as a box.
    #[must_use]
    pub fn support(&self, patch: usize) -> Rect {
        Rect::around(self.center[patch], self.half[patch])
    }
}
